#include "planner/evaluation/evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/driving/path_margins.h"
#include "planner/driving/stopping.h"
#include "planner/problem/rejection_text.h"
#include "terramech/basics/parallel_for.h"
#include "terramech/basics/value_range.h"

namespace regoplan {
namespace {

/// Between two places of a leg, where the curve is sharper, or speed lost or gathered harder, than
/// at both: so no sharp place and no short braking is passed over, wherever it lies.
std::vector<double> harder_between_m(const PathLeg& leg, double from_m, double to_m) {
  std::vector<double> places_m;
  const auto consider = [&](double s_m, const auto& asked_at) {
    constexpr double kRounding = 1e-9;
    if (asked_at(s_m) > std::max(asked_at(from_m), asked_at(to_m)) + kRounding) {
      places_m.push_back(s_m);
    }
  };
  consider(leg.curve.sharpest_m(from_m, to_m),
           [&leg](double s_m) { return std::abs(leg.curvature_1pm(s_m)); });
  const auto [braking_m, gathering_m] = leg.speed.hardest_m(from_m, to_m);
  consider(braking_m, [&leg](double s_m) { return -leg.speed.at(s_m).acceleration_mps2; });
  consider(gathering_m, [&leg](double s_m) { return leg.speed.at(s_m).acceleration_mps2; });
  std::ranges::sort(places_m);
  return places_m;
}

/// Along a leg without a record: at most half a metre apart, and where more is asked between.
void add_stations(std::vector<Station>& stations, const ReferencePath::Place& start, double way_m,
                  const Vehicle& vehicle) {
  const PathLeg& leg = start.leg;
  const auto add = [&](double s_m) {
    const ReferencePath::Place place{.leg = leg, .leg_start_s = start.leg_start_s, .s_m = s_m};
    stations.push_back({way_m + s_m, place.time_s(), leg.state_at(vehicle, s_m)});
  };
  constexpr double kApart_m = 0.5;
  const double length_m = leg.length_m();
  const int pieces = std::max(4, static_cast<int>(std::ceil(length_m / kApart_m)));
  add(0);
  for (int k = 1; k <= pieces; ++k) {
    const double from_m = length_m * (k - 1) / pieces, to_m = length_m * k / pieces;
    for (const double s_m : harder_between_m(leg, from_m, to_m)) add(s_m);
    add(to_m);
  }
}

std::vector<Station> stations_of(const ReferencePath& path, const Vehicle& vehicle) {
  std::vector<Station> stations;
  double way_m = 0;
  for (const PathLeg& leg : path.legs) {
    for (const RecordedMoment& moment : leg.recorded) {
      stations.push_back({way_m + moment.s_m, moment.time_s, moment.state});
    }
    way_m += leg.length_m();
  }
  if (!stations.empty()) return stations;
  double time_s = 0;
  way_m = 0;
  for (const PathLeg& leg : path.legs) {
    add_stations(stations, {.leg = leg, .leg_start_s = time_s}, way_m, vehicle);
    way_m += leg.length_m();
    time_s += leg.duration_s();
  }
  return stations;
}

/// A curvature that the vehicle cannot be steered to has no manoeuvre.
Judgement judge(const World& world, const Station& station) {
  const Vehicle& vehicle = world.problem().vehicle;
  constexpr double kRounding = 1e-9;
  if (std::abs(station.state.curvature_1pm) <= vehicle.curvature_max_1pm * (1 + kRounding)) {
    return world.judge(station.state, {}, station.time_s);
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const VehicleState& state = station.state;
  return {.point = {.time_s = station.time_s,
                    .x_m = state.x_m,
                    .y_m = state.y_m,
                    .z_m = world.problem().map.height_m(state.x_m, state.y_m),
                    .yaw_rad = state.yaw_rad,
                    .speed_mps = state.motion.vx_mps,
                    .curvature_1pm = state.curvature_1pm,
                    .acceleration_mps2 = state.rim_acceleration_mps2,
                    .soil = world.problem().map.soil_index(state.x_m, state.y_m).value_or(-1),
                    .demand_n = kNone,
                    .supply_min_n = kNone,
                    .supply_max_n = kNone,
                    .cornering_margin = kNone,
                    .tip_over_margin = kNone,
                    .traction_margin = kNone,
                    .margin = kNone},
          .rejected = {}};
}

/// Ground that is unknown because a wheel stands beyond the map is out of its bounds.
Rejection reason_at(const World& world, const RejectedState& rejected, const VehicleState& state) {
  if (rejected.reason != Rejection::kUnknownTerrain) return rejected.reason;
  const PlanningProblem& problem = world.problem();
  const double c = std::cos(state.yaw_rad), s = std::sin(state.yaw_rad);
  const bool beyond = std::ranges::any_of(problem.vehicle.wheels, [&](const WheelMount& wheel) {
    return !problem.map.inside(state.x_m + c * wheel.x_m - s * wheel.y_m,
                               state.y_m + s * wheel.x_m + c * wheel.y_m);
  });
  return beyond ? Rejection::kBounds : rejected.reason;
}

Refusal refusal_of(const World& world, const RejectedState& rejected, const Station& at) {
  return {.reason = reason_at(world, rejected, at.state),
          .x_m = rejected.x_m,
          .y_m = rejected.y_m,
          .s_m = at.s_m,
          .time_s = at.time_s,
          .exceeded = rejected.exceeded};
}

/// Whether another draw of the soils may lift a refusal of the commanded path.
bool hangs_on_soil(Rejection reason) {
  return is_margin(reason) || reason == Rejection::kSinkage;
}

/// Whether a state is refused because no steady trim has the forward force.
bool is_short_of_drive(const std::optional<RejectedState>& rejected) {
  return rejected && rejected->reason == Rejection::kTraction && !rejected->exceeded;
}

/// Why the vehicle cannot stop where it has arrived.
std::optional<RejectedState> refused_stop(const World& world, const TrackingRun& run) {
  if (run.end != TrackingEnd::kArrived) return std::nullopt;
  constexpr double kMarginsEvery_s = 0.5;
  return refused_stop(world, run.last.state,
                      {.coarse_s = run.step_s,
                       .coarse_per_margin = std::max(
                           1, static_cast<int>(std::lround(kMarginsEvery_s / run.step_s)))});
}

std::optional<Refusal> refusal_of(const World& world, const TrackingRun& run,
                                  double deviation_allowed_m) {
  const TrackingRun::Moment& last = run.last;
  Refusal refusal{
      .x_m = last.state.x_m, .y_m = last.state.y_m, .s_m = last.s_m, .time_s = last.time_s};
  switch (run.end) {
    case TrackingEnd::kArrived:
    case TrackingEnd::kInterrupted:
      return std::nullopt;
    case TrackingEnd::kRejected:
      refusal = refusal_of(world, *run.rejected, {last.s_m, last.time_s, last.state});
      break;
    case TrackingEnd::kStrayed:
      refusal.reason = Rejection::kDeviation;
      refusal.exceeded = {.found = std::abs(last.offset_m), .limit = deviation_allowed_m};
      break;
    case TrackingEnd::kStalled:
      refusal.reason = Rejection::kStalled;
      break;
    case TrackingEnd::kDynamics:
      refusal.reason = Rejection::kDynamics;
      break;
  }
  refusal.while_tracking = true;
  return refusal;
}

/// What ends the supply on the side of the demand.
std::optional<CorneringLimit> cornering_limit(const World& world, const VehicleState& state) {
  const PlanningProblem& problem = world.problem();
  const VehicleDynamics& dynamics = world.dynamics();
  const GroundPatch patch = dynamics.ground(state.x_m, state.y_m, state.yaw_rad);
  if (!patch.known ||
      !(std::abs(state.curvature_1pm) <= problem.vehicle.curvature_max_1pm * (1 + 1e-9))) {
    return std::nullopt;
  }
  const SupplyQuestion question = question_of(dynamics, state, patch);
  if (!(question.normal_n > 0)) return std::nullopt;
  const SupplyResult result = world.margin_judge().supply(question);
  if (!result.supply) return std::nullopt;
  const double demand = question.force.left_n;
  const SupplyEnd& left = result.supply->left;
  const SupplyEnd& right = result.supply->right;
  const SupplyEnd& end = left.force_n - demand < demand - right.force_n ? left : right;
  return CorneringLimit{
      .limit = end.limit,
      .wheel =
          end.wheel < 0 ? "" : problem.vehicle.wheels[static_cast<std::size_t>(end.wheel)].name,
      .supply_n = end.force_n,
      .fold_n = end.fold_n};
}

/// The energy of a run where it was `s_m` along, between two of its moments.
double energy_at_j(const TrackingRun::Moment& before, const TrackingRun::Moment& after,
                   double s_m) {
  const double way_m = after.s_m - before.s_m;
  const double share = way_m > 0 ? std::clamp((s_m - before.s_m) / way_m, 0.0, 1.0) : 0;
  return before.energy_j + share * (after.energy_j - before.energy_j);
}

void set_strain(TrajectoryPoint& point, const WheelStrain& strain) {
  point.slip_max = strain.slip;
  point.slip_angle_max_rad = strain.slip_angle_rad;
  point.sinkage_max_m = strain.sinkage_m;
  point.torque_max_nm = strain.torque_max_nm;
}

/// The strains and the energy that the run had where the station lies; none where it did not get,
/// and no strain where it stood before its first step.
void add_strains(std::vector<TrajectoryPoint>& points, const std::vector<double>& s_m,
                 const TrackingRun& run) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr WheelStrain kNotDriven{.slip = kNone,
                                   .slip_angle_rad = kNone,
                                   .sinkage_m = kNone,
                                   .load_min_n = kNone,
                                   .torque_max_nm = kNone};
  std::size_t k = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    set_strain(points[i], kNotDriven);
    while (k + 1 < run.moments.size() && run.moments[k + 1].s_m <= s_m[i]) ++k;
    if (run.moments.empty() || s_m[i] > run.last.s_m + 1) continue;
    // The first moment is that before the first step.
    const bool stands = s_m[i] <= run.moments.front().s_m || run.moments.size() == 1;
    if (!stands) set_strain(points[i], run.moments[std::max<std::size_t>(k, 1)].strain);
    points[i].energy_j = energy_at_j(
        run.moments[k], k + 1 < run.moments.size() ? run.moments[k + 1] : run.last, s_m[i]);
    points[i].yaw_rate_rad_s = run.moments[k].state.motion.yaw_rate_rad_s;
  }
}

void judge_steady(PathEvaluation& evaluation, const World& verdict,
                  const std::vector<Station>& stations, const EvaluationSettings& settings) {
  std::vector<Judgement> judgements(stations.size());
  parallel_for(stations.size(), settings.threads, [&](std::size_t i) {
    if (!settings.stop.stop_requested()) judgements[i] = judge(verdict, stations[i]);
  });
  const double curvature_max = verdict.problem().vehicle.curvature_max_1pm;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const Station& station = stations[i];
    const Judgement& judgement = judgements[i];
    evaluation.s_m.push_back(station.s_m);
    evaluation.points.push_back(judgement.point);
    if (evaluation.refusal) continue;
    if (judgement.rejected) {
      evaluation.refusal = refusal_of(verdict, *judgement.rejected, station);
    } else if (!(std::abs(station.state.curvature_1pm) <= curvature_max * (1 + 1e-9))) {
      evaluation.refusal =
          Refusal{.reason = Rejection::kSteering,
                  .x_m = station.state.x_m,
                  .y_m = station.state.y_m,
                  .s_m = station.s_m,
                  .time_s = station.time_s,
                  .exceeded = Exceeded{.found = std::abs(station.state.curvature_1pm),
                                       .limit = curvature_max}};
    }
  }
}

}  // namespace

void validate(const EvaluationSettings& settings) {
  if (settings.deviation_max_m) require("deviation_max_m", *settings.deviation_max_m, kAbove0);
  require("soil_draws", settings.soil_draws, {.min = 2, .max = 1e6});
  require("threads", settings.threads, {.min = 1, .max = 256});
}

double default_deviation_max_m(const Vehicle& vehicle) {
  return (vehicle.body.y_max_m - vehicle.body.y_min_m) / 2;
}

std::string sentence(const Refusal& refusal) {
  return fmt::format("{}{} at ({:.2f}, {:.2f}), {:.1f} m along, {:.1f} s{}",
                     refusal.while_stopping ? kCannotStop : std::string_view(),
                     rejection_text(refusal.reason, refusal.exceeded), refusal.x_m, refusal.y_m,
                     refusal.s_m, refusal.time_s,
                     refusal.while_tracking && !refusal.while_stopping ? ", when driven" : "");
}

PathEvaluation evaluate(const World& verdict, const ReferencePath& path,
                        const EvaluationSettings& settings) {
  validate(settings);
  validate(path);
  const Vehicle& vehicle = verdict.problem().vehicle;
  const double allowed_m = settings.deviation_max_m.value_or(default_deviation_max_m(vehicle));
  const TrackingRun run = track(verdict, path, settings.follower, allowed_m, settings.stop);
  return judged(verdict,
                {.name = path.name,
                 .length_m = path.length_m(),
                 .duration_s = path.duration_s(),
                 .speed_max_mps = path.speed_max_mps(),
                 .stations = stations_of(path, vehicle),
                 .run = run,
                 .deviation_allowed_m = allowed_m,
                 .refused_stop = path.goes_on ? std::nullopt : refused_stop(verdict, run)},
                settings);
}

PathEvaluation judged(const World& verdict, const DrivenCourse& course,
                      const EvaluationSettings& settings) {
  const PlanningProblem& problem = verdict.problem();
  PathEvaluation evaluation{.name = course.name,
                            .length_m = course.length_m,
                            .duration_s = course.duration_s,
                            .speed_max_mps = course.speed_max_mps,
                            .tracking = course.run,
                            .deviation_allowed_m = course.deviation_allowed_m};
  const std::vector<Station>& stations = course.stations;
  judge_steady(evaluation, verdict, stations, settings);
  if (settings.stop.stop_requested()) return evaluation;
  add_strains(evaluation.points, evaluation.s_m, evaluation.tracking);
  const std::optional<Refusal> when_driven =
      refusal_of(verdict, evaluation.tracking, evaluation.deviation_allowed_m);
  if (!evaluation.refusal) evaluation.refusal = when_driven;
  if (!evaluation.refusal && course.refused_stop) {
    const RejectedState& refused = *course.refused_stop;
    evaluation.refusal =
        refusal_of(verdict, refused,
                   {.s_m = course.length_m,
                    .time_s = course.run.duration_s,
                    .state = {.x_m = refused.x_m, .y_m = refused.y_m, .yaw_rad = refused.yaw_rad}});
    evaluation.refusal->while_tracking = evaluation.refusal->while_stopping = true;
  }
  evaluation.feasible = !evaluation.refusal;

  std::vector<VehicleState> states;
  std::vector<PathMargins> at_mean;
  std::vector<TrajectoryPoint> without_gaps = evaluation.points;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const PathMargins margins = margins_at(evaluation.points[i]);
    PathMargins& smallest = evaluation.margins;
    smallest = {.cornering = std::min(smallest.cornering, margins.cornering),
                .tip_over = std::min(smallest.tip_over, margins.tip_over),
                .traction = std::min(smallest.traction, margins.traction)};
    without_gaps[i].cornering_margin = margins.cornering;
    without_gaps[i].tip_over_margin = margins.tip_over;
    without_gaps[i].traction_margin = margins.traction;
    without_gaps[i].margin = margins.smallest();
    if (std::isnan(evaluation.points[i].tip_over_margin)) continue;  // no ground, no steering
    states.push_back(stations[i].state);
    at_mean.push_back(margins);
  }
  evaluation.margin_min = evaluation.margins.smallest();
  evaluation.margin_worst_tenth = margin_of_worst_tenth(without_gaps);
  // Where a margin is missing counts as it does in the smallest, so that both are of one state.
  evaluation.limiting = limiting_place(without_gaps);
  const Station& worst = stations[smallest_margin_index(without_gaps)];
  // Without a trim the margins are told apart by what it is wanting for.
  if (is_short_of_drive(judge(verdict, worst).rejected)) {
    evaluation.limiting.margin = MarginKind::kTraction;
  }
  if (evaluation.limiting.margin == MarginKind::kCornering) {
    evaluation.cornering_limit = cornering_limit(verdict, worst.state);
  }
  if (states.size() < stations.size()) return evaluation;
  evaluation.spread = soil_spread(problem, states, at_mean,
                                  {.draws = settings.soil_draws,
                                   .seed = settings.seed,
                                   .threads = settings.threads,
                                   .stop = settings.stop});
  // What the soils cannot mend.
  if (evaluation.refusal && !evaluation.refusal->while_tracking &&
      !hangs_on_soil(evaluation.refusal->reason)) {
    evaluation.spread->feasible = {.share = 0, .low = 0, .high = 0};
  }
  return evaluation;
}

Standing standing_of(const PathEvaluation& evaluation) {
  Standing standing{.duration_s = evaluation.duration_s, .length_m = evaluation.length_m};
  if (const auto& spread = evaluation.spread) {
    set_by_draws(standing, spread->margin.p05, spread->margin_p05_interval.high, spread->feasible);
  }
  if (!evaluation.feasible) standing.tier = Standing::kInfeasible;
  return standing;
}

}  // namespace regoplan
