#include "diagnosis/names/next_experiment.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr double kReplicates = 3;

/// Predicted means of trial conditions and their variances from what a fit leaves uncertain.
struct Forecast {
  Eigen::VectorXd mean, variance;
};

std::optional<Forecast> forecast(const TestBed& trial, const FitProblem& problem,
                                 const CandidateFit& fit) {
  Hypothesis physics = fit.candidate;
  const auto mean = predict(trial, problem.soil, physics, fit.x);
  if (!mean) return std::nullopt;
  const auto j = jacobian_of(trial, problem.soil, physics, fit.x, *mean);
  if (!j) return std::nullopt;
  const Eigen::Index p = fit.x.size();
  const Eigen::MatrixXd spread = *j * fit.evidence.covariance.topLeftCorner(p, p);
  return Forecast{*mean, spread.cwiseProduct(*j).rowwise().sum()};
}

struct Trial {
  TestBed bed;  // one condition, or all with a further channel
  std::optional<Channel> sensor;
};

std::vector<double> distinct(std::vector<double> values) {
  std::ranges::sort(values);
  std::vector<double> kept;
  for (const double v : values) {
    if (kept.empty() || v - kept.back() > 1e-6 * (1 + std::abs(v))) kept.push_back(v);
  }
  return kept;
}

/// Where on the bed to measure: four places along it where a name has its own, else anywhere.
std::vector<double> positions_to_try(const TestBed& bed, const std::vector<ScoredId>& rivals) {
  const bool places_matter = std::ranges::any_of(rivals, [](const ScoredId& rival) {
    return std::ranges::any_of(rival.fit.candidate.effects,
                               [](const Effect& effect) { return effect.id == "soil_zone"; });
  });
  std::vector<double> along;
  for (const Condition& at : bed.conditions) along.push_back(at.conditions.position_m);
  if (!places_matter) return {along.front()};
  std::ranges::sort(along);
  constexpr std::size_t kPlaces = 4;
  std::vector<double> positions_m;
  for (std::size_t k = 0; k < kPlaces; ++k) {
    positions_m.push_back(along[(2 * k + 1) * along.size() / (2 * kPlaces)]);
  }
  return distinct(std::move(positions_m));
}

/// What is measured next comes after the last run.
std::vector<Condition> trial_conditions(const TestBed& bed,
                                        const std::vector<double>& positions_m) {
  double low = INFINITY, high = -INFINITY, widest = 0, last_time_s = -INFINITY;
  std::vector<double> loads, speeds, passes;
  for (const Condition& at : bed.conditions) {
    low = std::min(low, at.slip_ratio);
    high = std::max(high, at.slip_ratio);
    widest = std::max(widest, std::abs(at.slip_angle_rad));
    loads.push_back(at.load_n);
    speeds.push_back(at.conditions.speed_mps);
    passes.push_back(at.conditions.pass);
    last_time_s = std::max(last_time_s, at.conditions.time_s);
  }
  std::ranges::sort(loads);
  const double middle = loads[loads.size() / 2];
  const std::vector<double> slips = distinct(
      {std::max(low - 0.2, -0.9), low, 0.0, (low + high) / 2, high, std::min(high + 0.2, 0.95)});
  const std::vector<double> angles =
      distinct({0.0, widest / 2, widest,
                std::max(widest, std::min(1.5 * widest + 5 * kDegree, 45 * kDegree)), -widest});
  const std::vector<double> speed = distinct(speeds), pass = distinct(passes);
  std::vector<Condition> trials;
  const auto try_along_the_bed = [&](Condition at) {
    for (const double position_m : positions_m) {
      at.conditions.position_m = position_m;
      trials.push_back(at);
    }
  };
  for (const double s : slips) {
    for (const double b : angles) {
      for (const double load : distinct({0.5 * loads.front(), middle, 1.5 * loads.back()})) {
        for (const double v : distinct({speed.front(), speed.back()})) {
          for (const double n : distinct({pass.front(), pass.back()})) {
            Condition at{.load_n = load,
                         .slip_ratio = s,
                         .slip_angle_rad = b,
                         .conditions = bed.conditions.front().conditions};
            at.conditions.speed_mps = v;
            at.conditions.pass = static_cast<int>(n);
            at.conditions.time_s = last_time_s;
            try_along_the_bed(at);
          }
        }
      }
    }
  }
  return trials;
}

/// Noise of a channel that was not measured, from one that is like it.
double unmeasured_noise(const TestBed& bed, Channel channel) {
  double force = 0, sinkage = 1e-3, radius = bed.setup.wheel.radius_m;
  for (const ChannelData& data : bed.channels) {
    if (data.channel == Channel::kFx || data.channel == Channel::kFy) {
      force = std::max(force, data.scale);
    }
    if (data.channel == Channel::kSinkage) sinkage = data.scale;
  }
  if (force == 0) force = 0.02 * bed.conditions.front().load_n;
  if (channel == Channel::kTorque) return force * radius;
  return channel == Channel::kFx || channel == Channel::kFy ? force : sinkage;
}

std::vector<Trial> trials_of(const TestBed& bed, const std::vector<double>& positions_m) {
  std::vector<Trial> trials;
  for (const Condition& at : trial_conditions(bed, positions_m)) {
    Trial trial{.bed = {.setup = bed.setup,
                        .conditions = {at},
                        .base_model = bed.base_model,
                        .stop = bed.stop}};
    for (const ChannelData& data : bed.channels) {
      trial.bed.channels.push_back(
          {.channel = data.channel,
           .conditions = {0},
           .mean = Eigen::VectorXd::Zero(1),
           .noise = Eigen::MatrixXd::Constant(1, 1, data.scale * data.scale / kReplicates),
           .scale = data.scale});
    }
    trials.push_back(std::move(trial));
  }
  for (const Channel channel :
       {Channel::kTorque, Channel::kSinkage, Channel::kFy, Channel::kFx, Channel::kRutRight}) {
    const bool measured = std::ranges::any_of(
        bed.channels, [&](const ChannelData& data) { return data.channel == channel; });
    if (measured) continue;
    // instruments keep their channel's index: the new one comes last
    Trial trial{.bed = {.setup = bed.setup,
                        .conditions = bed.conditions,
                        .base_model = bed.base_model,
                        .stop = bed.stop},
                .sensor = channel};
    for (const ChannelData& data : bed.channels) {
      trial.bed.channels.push_back({.channel = data.channel, .scale = data.scale});
      trial.bed.channels.back().noise.resize(0, 0);
    }
    const auto n = static_cast<Eigen::Index>(bed.conditions.size());
    const double noise = unmeasured_noise(bed, channel);
    ChannelData& added = trial.bed.channels.emplace_back();
    added.channel = channel;
    added.scale = noise;
    for (std::size_t k = 0; k < bed.conditions.size(); ++k) added.conditions.push_back(k);
    added.mean.setZero(n);
    added.noise = noise * noise / kReplicates * Eigen::MatrixXd::Identity(n, n);
    trials.push_back(std::move(trial));
  }
  return trials;
}

Eigen::VectorXd noise_variance(const TestBed& bed) {
  Eigen::VectorXd variance(bed.size());
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    variance.segment(bed.offset(c), bed.channels[c].mean.size()) = bed.channels[c].noise.diagonal();
  }
  return variance;
}

}  // namespace

std::vector<Experiment> next_experiments(const FitProblem& problem,
                                         const std::vector<ScoredId>& rivals) {
  constexpr std::size_t kMostShown = 6;
  constexpr double kNames_nats = 0.5;  // pairs parted at least so far count as parted
  std::vector<Experiment> experiments;
  if (rivals.size() < 2) return experiments;
  const std::vector<double> positions_m = positions_to_try(problem.bed, rivals);
  for (const Trial& trial : trials_of(problem.bed, positions_m)) {
    std::vector<Forecast> forecasts;
    for (const ScoredId& rival : rivals) {
      auto f = forecast(trial.bed, problem, rival.fit);
      if (!f) break;
      forecasts.push_back(std::move(*f));
    }
    if (forecasts.size() < rivals.size()) continue;
    const Eigen::VectorXd noise = noise_variance(trial.bed);
    double sum = 0;
    int pairs = 0;
    std::set<std::string> parted;
    for (std::size_t a = 0; a < rivals.size(); ++a) {
      for (std::size_t b = a + 1; b < rivals.size(); ++b, ++pairs) {
        const Eigen::ArrayXd variance = noise + forecasts[a].variance + forecasts[b].variance;
        // what the fits leave uncertain is shared by the conditions: no sum beyond the likeliest
        const Eigen::ArrayXd each =
            (forecasts[a].mean - forecasts[b].mean).array().square() / variance / 2;
        const double gain = trial.sensor ? each.maxCoeff() : each.sum();
        sum += gain;
        if (gain > kNames_nats) parted.insert({rivals[a].id(), rivals[b].id()});
      }
    }
    if (parted.empty()) continue;
    Experiment experiment{.further_sensor = trial.sensor, .expected_gain_nats = sum / pairs};
    if (!trial.sensor) {
      const Condition& at = trial.bed.conditions.front();
      experiment.conditions = {{"slip_ratio", at.slip_ratio},
                               {"slip_angle_deg", at.slip_angle_rad / kDegree},
                               {"load_n", at.load_n}};
      if (at.conditions.speed_mps > 0) {
        experiment.conditions["speed_mps"] = at.conditions.speed_mps;
      }
      if (positions_m.size() > 1) experiment.conditions["position_m"] = at.conditions.position_m;
      if (at.conditions.pass > 1) experiment.conditions["pass"] = at.conditions.pass;
    }
    experiment.separates.assign(parted.begin(), parted.end());
    experiments.push_back(std::move(experiment));
  }
  std::ranges::stable_sort(experiments, [](const auto& a, const auto& b) {
    return a.expected_gain_nats > b.expected_gain_nats;
  });
  // the best conditions, but the best further sensor in any case
  std::vector<Experiment> shown;
  for (const Experiment& e : experiments) {
    const bool sensor_shown = std::ranges::any_of(
        shown, [](const Experiment& other) { return other.further_sensor.has_value(); });
    if (shown.size() < kMostShown - 1 || (e.further_sensor && !sensor_shown)) shown.push_back(e);
    if (shown.size() == kMostShown) break;
  }
  return shown;
}

}  // namespace regoplan
