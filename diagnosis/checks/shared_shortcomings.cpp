#include "diagnosis/checks/shared_shortcomings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/checks/shared_surface.h"
#include "diagnosis/fit/calibration.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

const ChannelData* channel_of(const TestBed& bed, Channel channel, std::size_t* index) {
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    if (bed.channels[c].channel != channel) continue;
    *index = c;
    return &bed.channels[c];
  }
  return nullptr;
}

/// \param predictions of the base model, one vector a reference
ShortcomingPoints points_of(const std::vector<CondensedRecording>& references,
                            const std::vector<Eigen::VectorXd>& predictions, Channel channel) {
  ShortcomingPoints points;
  for (std::size_t r = 0; r < references.size(); ++r) {
    const TestBed& bed = references[r].bed;
    std::size_t c = 0;
    const ChannelData* data = channel_of(bed, channel, &c);
    if (data == nullptr) continue;
    const Eigen::Index from = points.residual.size(), n = data->mean.size();
    points.residual.conservativeResize(from + n);
    points.residual.tail(n) = data->mean - predictions[r].segment(bed.offset(c), n);
    Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(from + n, from + n);
    noise.topLeftCorner(from, from) = points.noise;
    noise.bottomRightCorner(n, n) = data->noise;
    points.noise = std::move(noise);
    for (const std::size_t k : data->conditions) points.at.push_back(&bed.conditions[k]);
    points.scale = std::max(points.scale, data->scale);
  }
  return points;
}

ConditionsAt all_of(const std::vector<Condition>& conditions) {
  ConditionsAt all;
  for (const Condition& at : conditions) all.push_back(&at);
  return all;
}

bool same_wheel(const DiagnosisSetup& a, const DiagnosisSetup& b) {
  return a.wheel.radius_m == b.wheel.radius_m && a.wheel.width_m == b.wheel.width_m;
}

/// Adds what was measured on another bed of the same wheel.
void join(const TestBed& other, TestBed& bed) {
  const std::size_t first = bed.conditions.size();
  bed.conditions.insert(bed.conditions.end(), other.conditions.begin(), other.conditions.end());
  if (other.accuracy == WheelAccuracy::kExact) bed.accuracy = other.accuracy;
  for (const ChannelData& more : other.channels) {
    std::size_t c = bed.channels.size();
    if (channel_of(bed, more.channel, &c) == nullptr) {
      bed.channels.push_back({.channel = more.channel, .mean = {}, .noise = {}});
    }
    ChannelData& data = bed.channels[c];
    for (const std::size_t k : more.conditions) data.conditions.push_back(first + k);
    const Eigen::Index from = data.mean.size(), n = more.mean.size();
    data.mean.conservativeResize(from + n);
    data.mean.tail(n) = more.mean;
    Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(from + n, from + n);
    noise.topLeftCorner(from, from) = data.noise;
    noise.bottomRightCorner(n, n) = more.noise;
    data.noise = std::move(noise);
    data.scale = std::max(data.scale, more.scale);
  }
}

/// What was measured on all references, a bed for each wheel: in whatever order they are given,
/// what is known of the soil after one wheel is the same.
std::vector<TestBed> beds_by_wheel(const std::vector<CondensedRecording>& references) {
  std::vector<TestBed> beds;
  for (const CondensedRecording& reference : references) {
    const auto same = std::ranges::find_if(
        beds, [&](const TestBed& bed) { return same_wheel(bed.setup, reference.bed.setup); });
    if (same == beds.end()) {
      beds.push_back(reference.bed);
    } else {
      join(reference.bed, *same);
    }
  }
  return beds;
}

/// The soil that fits all references together: each wheel in turn tells the next what it knows. On
/// the way back to the prior means, as uncertain as these, where the test has no forces on it.
UncertainSoil calibrated_on(const TestBed& test,
                            const std::vector<CondensedRecording>& references) {
  UncertainSoil soil = references.front().bed.setup.soil;
  for (TestBed& bed : beds_by_wheel(references)) {
    const std::vector<SoilCoordinate> coordinates = soil_coordinates(soil);
    bed.setup.soil = soil;
    const Calibration calibration = calibrate(bed, coordinates);
    soil.mean = soil_at(soil, coordinates, calibration.x);
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      soil.standard_deviation.*soil_parameters()[coordinates[i].parameter].member =
          coordinates[i].coordinate.spread * std::sqrt(calibration.covariance(k, k));
    }
  }
  const UncertainSoil& tested = test.setup.soil;
  const Soil& means = tested.mean;
  for (const double share : {1.0, 0.7, 0.4, 0.2}) {
    Soil between = means;
    for (const SoilParameter& p : soil_parameters()) {
      between.*p.member += share * (soil.mean.*p.member - means.*p.member);
    }
    const bool everywhere =
        predict(test, between, {}) && std::ranges::all_of(references, [&](const auto& reference) {
          return predict(reference.bed, between, {}).has_value();
        });
    if (!everywhere) continue;
    const bool is_fitted = share == 1;
    return {.mean = between,
            .standard_deviation = is_fitted ? soil.standard_deviation : tested.standard_deviation};
  }
  return tested;
}

/// Gives every condition the sinkage that the references measured, over the model's; where the
/// surface through it would leave no sinkage or an axle in the ground, a tenth of the model's and
/// four fifths of the radius.
/// \param places of its conditions, as references know them
void impose_sinkage(TestBed& bed, const std::vector<Condition>& places, const Soil& soil,
                    const ShortcomingPoints& sinkage) {
  constexpr double kLeast = 0.1, kMost = 0.8;
  const SharedSurface surface =
      surface_through(sinkage, Channel::kSinkage, all_of(places), bed.stop);
  const WheelModel model({.variant = bed.setup.variant,
                          .wheel = bed.setup.wheel,
                          .soil = soil,
                          .gravity_mps2 = bed.setup.gravity_mps2});
  for (std::size_t k = 0; k < bed.conditions.size(); ++k) {
    throw_if_stopped(bed.stop);
    Condition& at = bed.conditions[k];
    const auto base =
        channels_at(model, at.load_n, at.slip_ratio, at.slip_angle_rad, at.conditions);
    const double h = base ? (*base)[static_cast<std::size_t>(Channel::kSinkage)] : 0;
    double offset = std::clamp(h + surface.mean[static_cast<Eigen::Index>(k)], kLeast * h,
                               kMost * bed.setup.wheel.radius_m) -
                    h;
    // where cohesion alone would carry the load at that depth, as near to it as there are forces
    constexpr double kNone_m = 1e-6;
    for (; std::abs(offset) > kNone_m; offset /= 2) {
      at.conditions.sinkage_offset_m = offset;
      if (channels_at(model, at.load_n, at.slip_ratio, at.slip_angle_rad, at.conditions)) break;
    }
    if (std::abs(offset) <= kNone_m) at.conditions.sinkage_offset_m = 0;
  }
}

/// When a run was made is told as a share of its own recording's course: no place that two have in
/// common.
void forget_times(std::vector<Condition>& conditions) {
  for (Condition& at : conditions) at.when = 0;
}

/// What replicates follow in the course of one recording is no difference from another: along it
/// the noise is as large as it.
void add_course_to_noise(CondensedRecording& recording) {
  if (!recording.course || !recording.course->in_time()) return;
  for (std::size_t c = 0; c < recording.bed.channels.size(); ++c) {
    const std::vector<double>& trend = recording.course->trend[c];
    ChannelData& data = recording.bed.channels[c];
    Eigen::VectorXd along = Eigen::VectorXd::Zero(data.mean.size());
    for (Eigen::Index i = 0; i < along.size(); ++i) {
      const Condition& at = recording.bed.conditions[data.conditions[static_cast<std::size_t>(i)]];
      for (const std::size_t run : at.runs) {
        along[i] += recording.noise[c].trend * trend[run] / static_cast<double>(at.runs.size());
      }
    }
    along.array() -= along.mean();
    data.noise += along * along.transpose();
  }
}

/// A pass that the references did not drive is what differs, not a place of its own.
void forget_passes(const std::vector<CondensedRecording>& references, std::vector<Condition>& at) {
  int first = 0;
  for (const CondensedRecording& reference : references) {
    for (const Condition& known : reference.bed.conditions) {
      if (first == 0) first = known.conditions.pass;
      if (known.conditions.pass != first) return;
    }
  }
  for (Condition& one : at) one.conditions.pass = first;
}

Eigen::VectorXd prediction_of(const TestBed& bed, const Soil& soil) {
  const auto prediction = predict(bed, soil, {});
  if (!prediction) {
    throw InputError("the wheel has no forces under some condition of test or reference");
  }
  return *prediction;
}

}  // namespace

std::string_view name(SharedBase base) {
  constexpr std::array<std::string_view, 3> kNames{"prior means", "calibrated on the reference",
                                                   "the reference's sinkage imposed"};
  return kNames[static_cast<std::size_t>(base)];
}

DifferenceBed difference_bed(const CondensedRecording& test,
                             const std::vector<CondensedRecording>& references, SharedBase base) {
  DifferenceBed result{.base = base, .test = test};
  const UncertainSoil& tested = test.bed.setup.soil;
  const UncertainSoil known =
      base == SharedBase::kCalibrated ? calibrated_on(test.bed, references) : tested;
  const Soil& soil = known.mean;
  std::vector<CondensedRecording> told = references;
  for (CondensedRecording& r : told) {
    forget_times(r.bed.conditions);
    add_course_to_noise(r);
  }
  TestBed& bed = result.test.bed;
  std::vector<Condition> places = bed.conditions;
  forget_times(places);
  std::vector<Eigen::VectorXd> predictions;
  for (const CondensedRecording& r : told) predictions.push_back(prediction_of(r.bed, soil));
  if (base == SharedBase::kSinkageImposed) {
    const ShortcomingPoints sinkage = points_of(told, predictions, Channel::kSinkage);
    if (!sinkage.at.empty()) {
      impose_sinkage(bed, places, soil, sinkage);
      predictions.clear();
      for (CondensedRecording& r : told) {
        impose_sinkage(r.bed, r.bed.conditions, soil, sinkage);
        predictions.push_back(prediction_of(r.bed, soil));
      }
    }
  }
  forget_passes(references, places);
  result.measured = {.mean = bed.measured(),
                     .shared = Eigen::VectorXd::Zero(bed.size()),
                     .noise_variance = Eigen::VectorXd::Zero(bed.size()),
                     .tested_soil = tested,
                     .soil = known};
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    ChannelData& data = bed.channels[c];
    ConditionsAt wanted;
    for (const std::size_t k : data.conditions) wanted.push_back(&places[k]);
    const SharedSurface surface =
        surface_through(points_of(told, predictions, data.channel), data.channel, wanted, bed.stop);
    const Eigen::Index from = bed.offset(c), n = data.mean.size();
    result.measured.noise_variance.segment(from, n) = data.noise.diagonal();
    result.measured.shared.segment(from, n) = surface.mean;
    data.mean -= surface.mean;
    data.shared = surface.mean;
    data.noise += surface.covariance;
    for (Eigen::Index i = 0; i < n; ++i) {
      for (const std::size_t run :
           bed.conditions[data.conditions[static_cast<std::size_t>(i)]].runs) {
        result.test.adjusted[c][run] -= surface.mean[i];
      }
    }
  }
  add_course_to_noise(result.test);
  bed.setup.soil = {.mean = soil};
  return result;
}

}  // namespace regoplan
