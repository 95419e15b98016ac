#include "planner/soils/soil_uncertainty.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "planner/problem/world.h"
#include "planner/soils/soil_surrogate.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

PathMargins counted(const StateMargins& margins) {
  return {.cornering = margins.counted_cornering(),
          .tip_over = margins.tip_over,
          .traction = margins.counted_traction()};
}

std::vector<VehicleState> states_at(const std::vector<VehicleState>& states,
                                    const std::vector<std::size_t>& places) {
  std::vector<VehicleState> chosen;
  for (const std::size_t i : places) chosen.push_back(states[i]);
  return chosen;
}

/// On each uncertain soil by itself, as one that is weaker than its mean may bind where none does
/// at the means, and on all others together.
std::vector<std::size_t> decisive_on_each_soil(const TerrainMap& map,
                                               const std::vector<VehicleState>& states,
                                               const std::vector<PathMargins>& at_mean) {
  constexpr int kKnown = -1;
  std::map<int, std::vector<std::size_t>> by_soil;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const int soil = map.soil_index(states[i].x_m, states[i].y_m).value_or(kKnown);
    const bool varies = soil != kKnown && is_uncertain(map.soils()[static_cast<std::size_t>(soil)]);
    by_soil[varies ? soil : kKnown].push_back(i);
  }
  std::vector<std::size_t> decisive;
  for (const auto& [soil, indices] : by_soil) {
    std::vector<PathMargins> margins;
    for (const std::size_t i : indices) margins.push_back(at_mean[i]);
    for (const std::size_t k : decisive_places(states_at(states, indices), margins)) {
      decisive.push_back(indices[k]);
    }
  }
  std::ranges::sort(decisive);
  return decisive;
}

using MarginOfPath = double PathMargins::*;
constexpr std::array<MarginOfPath, 3> kMarginsOfPath{
    &PathMargins::cornering, &PathMargins::tip_over, &PathMargins::traction};

/// How far a surrogate may promise too much. What it promises too much is taken off.
constexpr double kTrusted = 0.03;

/// By how much the surrogate promises too much of each margin, from one of the draws on.
/// \param said, judged of the surrogate and of the wheel model, in each draw
PathMargins largest_overestimates(const std::vector<PathMargins>& said,
                                  const std::vector<PathMargins>& judged, std::size_t from) {
  PathMargins largest{.cornering = 0, .tip_over = 0, .traction = 0};
  for (std::size_t i = from; i < said.size(); ++i) {
    for (const MarginOfPath kind : kMarginsOfPath) {
      largest.*kind = std::max(largest.*kind, said[i].*kind - judged[i].*kind);
    }
  }
  return largest;
}

/// Of margins that the surrogate promises too much of, only what it does where they are the
/// smallest, in all draws of the wheel model: how they are judged elsewhere decides nothing.
/// \param said, judged of the surrogate and of the wheel model, in each draw
PathMargins error_where_it_counts(PathMargins error, const std::vector<PathMargins>& said,
                                  const std::vector<PathMargins>& judged) {
  PathMargins counting = error;
  for (const MarginOfPath kind : kMarginsOfPath) {
    if (error.*kind <= kTrusted) continue;
    counting.*kind = 0;
    for (std::size_t i = 0; i < said.size(); ++i) {
      const bool another_is_as_small = std::ranges::any_of(kMarginsOfPath, [&](MarginOfPath other) {
        return error.*other <= kTrusted && judged[i].*other <= judged[i].*kind;
      });
      if (another_is_as_small) continue;
      counting.*kind = std::max(counting.*kind, said[i].*kind - judged[i].*kind);
    }
  }
  return counting;
}

/// Of soils whose every number is known.
void tell_known(SoilSpread& spread, const PathMargins& known, double margin_min) {
  const auto fixed = [](double value) { return Quantiles{value, value, value}; };
  spread.cornering = fixed(known.cornering);
  spread.tip_over = fixed(known.tip_over);
  spread.traction = fixed(known.traction);
  spread.margin = fixed(known.smallest());
  spread.margin_p05_interval = {.low = known.smallest(), .high = known.smallest()};
  spread.margin_p50_interval = spread.margin_p05_interval;
  const double share = known.smallest() >= margin_min ? 1 : 0;
  spread.feasible = {.share = share, .low = share, .high = share};
}

/// Fills in quantiles, probability and influences from the margins of every draw.
/// \param told how many of the draws tell each margin, in the order of its kinds
void summarize(SoilSpread& spread, const PlanningProblem& problem, const SoilNumbers& numbers,
               const std::vector<PathMargins>& margins, const std::array<std::size_t, 3>& told,
               const Eigen::MatrixXd& deviations) {
  const auto quantiles = [&](std::size_t k) {
    std::vector<double> values;
    for (std::size_t i = 0; i < told.at(k); ++i) values.push_back(margins[i].*kMarginsOfPath.at(k));
    return quantiles_of(std::move(values));
  };
  spread.cornering = quantiles(0);
  spread.tip_over = quantiles(1);
  spread.traction = quantiles(2);
  std::vector<double> smallest_margins;
  for (const PathMargins& one : margins) smallest_margins.push_back(one.smallest());
  spread.margin = quantiles_of(smallest_margins);
  spread.margin_p05_interval = quantile_interval(smallest_margins, 0.05, {.low = -1, .high = 1});
  spread.margin_p50_interval = quantile_interval(smallest_margins, 0.5, {.low = -1, .high = 1});
  const auto allowed = std::count_if(margins.begin(), margins.end(), [&](const PathMargins& m) {
    return m.smallest() >= problem.limits.margin_min;
  });
  spread.feasible = probability_of(static_cast<int>(allowed), static_cast<int>(margins.size()));
  if (margins.size() < kDrawsANumber * numbers.size()) return;
  Eigen::VectorXd smallest(static_cast<Eigen::Index>(margins.size()));
  for (std::size_t i = 0; i < margins.size(); ++i) {
    smallest[static_cast<Eigen::Index>(i)] = margins[i].smallest();
  }
  const LinearInfluence influence = linear_influence(deviations, smallest);
  spread.explained = influence.explained;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto index = static_cast<Eigen::Index>(k);
    spread.influences.push_back(
        {.soil = problem.map.soils()[numbers[k].soil].name,
         .parameter = std::string(soil_parameters()[numbers[k].parameter].name),
         .share = influence.share[index],
         .margin_per_std = influence.slope[index]});
  }
  std::stable_sort(
      spread.influences.begin(), spread.influences.end(),
      [](const SoilInfluence& a, const SoilInfluence& b) { return a.share > b.share; });
}

}  // namespace

double PathMargins::smallest() const {
  return std::min({cornering, tip_over, traction});
}

PathMargins smallest_of(const std::vector<PathMargins>& places) {
  PathMargins smallest;
  for (const PathMargins& place : places) {
    smallest = {.cornering = std::min(smallest.cornering, place.cornering),
                .tip_over = std::min(smallest.tip_over, place.tip_over),
                .traction = std::min(smallest.traction, place.traction)};
  }
  return smallest;
}

std::vector<std::size_t> decisive_places(const std::vector<VehicleState>& states,
                                         const std::vector<PathMargins>& at_mean) {
  constexpr double kApart_m = 2;
  std::set<std::size_t> chosen;
  const auto take_smallest = [&](double PathMargins::*kind, std::size_t most) {
    std::vector<std::size_t> order(states.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return at_mean[a].*kind < at_mean[b].*kind;
    });
    std::vector<std::size_t> taken;
    for (const std::size_t i : order) {
      if (taken.size() == most) break;
      const auto near = [&](std::size_t other) {
        return std::hypot(states[i].x_m - states[other].x_m, states[i].y_m - states[other].y_m) <
               kApart_m;
      };
      if (std::none_of(taken.begin(), taken.end(), near)) taken.push_back(i);
    }
    chosen.insert(taken.begin(), taken.end());
  };
  take_smallest(&PathMargins::cornering, 3);
  take_smallest(&PathMargins::traction, 3);
  take_smallest(&PathMargins::tip_over, 1);
  return {chosen.begin(), chosen.end()};
}

PathMargins margins_at(const TrajectoryPoint& point) {
  const auto or_else = [](double value, double other) { return std::isnan(value) ? other : value; };
  const double cornering = or_else(point.cornering_margin, -1);
  return {.cornering = cornering,
          .tip_over = or_else(point.tip_over_margin, -1),
          .traction = or_else(point.traction_margin, std::min(cornering, 0.0))};
}

SoilDraw soil_draw(const PlanningProblem& problem, std::uint64_t seed, int number) {
  std::seed_seq sequence{seed, static_cast<std::uint64_t>(number)};
  std::mt19937_64 random(sequence);
  SoilDraw drawn;
  for (const MapSoil& soil : problem.map.soils()) {
    drawn.push_back(draw(soil.soil, problem.vehicle.wheel.width_m, random));
  }
  return drawn;
}

std::vector<PathMargins> margins_on(const PlanningProblem& problem,
                                    const std::vector<VehicleState>& states,
                                    const SoilDraw& soils) {
  const std::vector<WheelModel> models = models_of(problem, soils);
  const std::vector<WheelLaw> laws(models.begin(), models.end());
  const GroundFinder ground(problem.map, problem.vehicle);
  const VehicleDynamics dynamics(
      problem.vehicle, laws,
      [&](double x_m, double y_m, double yaw_rad) { return ground.at(x_m, y_m, yaw_rad); },
      problem.gravity_mps2);
  const MarginJudge judge(dynamics, laws, strain_limits(problem.limits));
  std::vector<PathMargins> margins;
  for (const VehicleState& state : states) {
    const GroundPatch patch = ground.at(state.x_m, state.y_m, state.yaw_rad);
    margins.push_back(counted(judge.margins(state, patch)));
  }
  return margins;
}

SoilSpread soil_spread(const PlanningProblem& problem, const std::vector<VehicleState>& states,
                       const std::vector<PathMargins>& at_mean, const SpreadSettings& settings) {
  const int draws = settings.draws, threads = settings.threads;
  assert(states.size() == at_mean.size() && !states.empty() && draws > 1);
  const std::vector<std::size_t> places = decisive_on_each_soil(problem.map, states, at_mean);
  const std::vector<VehicleState> decisive = states_at(states, places);
  const SoilNumbers numbers = uncertain_numbers(problem, decisive);
  SoilSpread spread{.places = static_cast<int>(places.size())};
  if (numbers.empty()) {
    tell_known(spread, smallest_of(at_mean), problem.limits.margin_min);
    return spread;
  }

  std::vector<SoilDraw> soils;
  for (int i = 0; i < draws; ++i) soils.push_back(soil_draw(problem, settings.seed, i));
  const Eigen::MatrixXd deviations = standard_deviations(problem.map.soils(), numbers, soils);

  // The first draws by the wheel model: those the surrogate is made from, and those that check it.
  const int learned = std::min(draws, SoilSurrogate::kTrainingDraws);
  constexpr int kChecked = 30;
  const int checked = std::min(draws - learned, kChecked);
  const auto direct = static_cast<std::size_t>(learned) + static_cast<std::size_t>(checked);
  constexpr std::size_t kElsewhere = 4;  // other places, in each draw that checks
  std::vector<std::vector<PathMargins>> judged(static_cast<std::size_t>(draws));
  std::vector<PathMargins> elsewhere(direct);
  parallel_for(direct, threads, [&](std::size_t i) {
    if (settings.stop.stop_requested()) return;
    judged[i] = margins_on(problem, decisive, soils[i]);
    if (i < static_cast<std::size_t>(learned)) return;
    std::vector<std::size_t> others;
    const std::size_t turn = i - static_cast<std::size_t>(learned);
    for (std::size_t k = 0; k < kElsewhere; ++k) {
      others.push_back((turn + k * kChecked) * states.size() / (kElsewhere * kChecked));
    }
    elsewhere[i] = smallest_of(margins_on(problem, states_at(states, others), soils[i]));
  });

  if (settings.stop.stop_requested()) return spread;

  std::vector<PathMargins> margins(static_cast<std::size_t>(draws));
  for (std::size_t i = 0; i < direct; ++i) {
    margins[i] = smallest_of({smallest_of(judged[i]), elsewhere[i]});
  }
  spread.draws = draws;
  spread.direct_draws = static_cast<int>(direct);
  std::array<std::size_t, 3> told{};
  told.fill(margins.size());
  if (static_cast<int>(direct) < draws) {
    std::vector<PlaceProbe> probes;
    for (const VehicleState& state : decisive) probes.emplace_back(problem, state);
    std::vector features(decisive.size(), std::vector<PlaceProbe::Features>(margins.size()));
    parallel_for(margins.size(), threads, [&](std::size_t i) {
      if (settings.stop.stop_requested()) return;
      const std::vector<WheelModel> models = models_of(problem, soils[i]);
      for (std::size_t k = 0; k < probes.size(); ++k) features[k][i] = probes[k].features(models);
    });
    if (settings.stop.stop_requested()) return spread;
    const SoilSurrogate surrogate(features, judged, static_cast<std::size_t>(learned));
    const auto say = [&](std::size_t i) {
      std::vector<PlaceProbe::Features> of_places;
      for (const auto& of_place : features) of_places.push_back(of_place[i]);
      return surrogate.smallest(of_places);
    };
    std::vector<PathMargins> said;
    for (std::size_t i = 0; i < direct; ++i) said.push_back(say(i));
    const PathMargins checked_error =
        largest_overestimates(said, margins, static_cast<std::size_t>(learned));
    const PathMargins error = error_where_it_counts(checked_error, said, margins);
    const bool trusted = std::ranges::all_of(
        kMarginsOfPath, [&](MarginOfPath kind) { return error.*kind <= kTrusted; });
    spread.surrogate_error = trusted ? error : checked_error;
    if (trusted) {
      for (std::size_t k = 0; k < told.size(); ++k) {
        told.at(k) = checked_error.*kMarginsOfPath.at(k) <= kTrusted ? margins.size() : direct;
      }
      for (std::size_t i = direct; i < margins.size(); ++i) {
        const PathMargins of_draw = say(i);
        for (const MarginOfPath kind : kMarginsOfPath) {
          margins[i].*kind = std::max(-1.0, of_draw.*kind - error.*kind);
        }
      }
    } else {
      const auto all = static_cast<std::size_t>(std::min(draws, kDirectDrawsMax));
      margins.resize(std::max(all, direct));
      parallel_for(margins.size() - direct, threads, [&](std::size_t k) {
        if (settings.stop.stop_requested()) return;
        margins[direct + k] = smallest_of(margins_on(problem, decisive, soils[direct + k]));
      });
      spread.draws = spread.direct_draws = static_cast<int>(margins.size());
      told.fill(margins.size());
    }
  }
  summarize(spread, problem, numbers, margins, told,
            deviations.topRows(static_cast<Eigen::Index>(margins.size())));
  return spread;
}

}  // namespace regoplan
