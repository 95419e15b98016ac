#include "diagnosis/names/claimed_place.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/bed/span.h"

namespace regoplan {
namespace {

/// The column that an effect has a place in.
struct PlaceColumn {
  const char* column;
  double WheelConditions::*value;  ///< where a condition stands in it
  double from_share;               ///< of the most that it does: where it does more, there it is
};

/// Nothing where what replicates follow says it already: which day it was, or, where times are only
/// assumed, which runs.
std::optional<PlaceColumn> column_of(const TestBed& bed, const Effect& effect) {
  const bool has_a_course = !bed.times_apart_s.empty() || bed.times_are_assumed;
  if (is_told_by_time(effect) && has_a_course) return std::nullopt;
  if (is_told_by_time(effect)) return PlaceColumn{"time_s", &WheelConditions::time_s, 0.5};
  if (effect.id == "soil_zone")
    return PlaceColumn{"position_m", &WheelConditions::position_m, 0.01};
  return std::nullopt;
}

/// What an effect adds to one channel, where it does so much as its place asks.
MismatchRegion region_in(const TestBed& bed, std::size_t channel, const PlaceColumn& place,
                         const Eigen::VectorXd& part) {
  const ChannelData& data = bed.channels[channel];
  const Eigen::VectorXd noise = data.noise.diagonal().cwiseSqrt();
  const double least = place.from_share * part.cwiseQuotient(noise).cwiseAbs().maxCoeff();
  Span span;
  for (Eigen::Index i = 0; i < part.size(); ++i) {
    const Condition& at = bed.conditions[data.conditions[static_cast<std::size_t>(i)]];
    if (std::abs(part[i]) / noise[i] >= least) span.take(at.conditions.*place.value);
  }
  double weights = 0, effect = 0;
  for (Eigen::Index i = 0; i < part.size(); ++i) {
    const Condition& at = bed.conditions[data.conditions[static_cast<std::size_t>(i)]];
    const double value = at.conditions.*place.value;
    if (value < span.low || value > span.high) continue;
    const double weight = 1 / (noise[i] * noise[i]);
    weights += weight;
    effect += weight * part[i];
  }
  effect /= weights;
  const double deviation = 1 / std::sqrt(weights);
  return {.channel = data.channel,
          .region = {{place.column, {span.low, span.high}}},
          .effect = effect,
          .ci95 = {effect - 1.96 * deviation, effect + 1.96 * deviation},
          .p_value = std::erfc(std::abs(effect) / deviation / std::sqrt(2.0))};
}

}  // namespace

std::vector<MismatchRegion> claimed_places(const FitProblem& problem, const CandidateFit& fit) {
  const TestBed& bed = problem.bed;
  std::vector<MismatchRegion> places;
  for (std::size_t e = 0; e < fit.candidate.effects.size(); ++e) {
    const auto place = column_of(bed, fit.candidate.effects[e]);
    if (!place) continue;
    const auto part = part_of(bed, problem.soil, fit, e);
    if (!part) continue;
    std::optional<MismatchRegion> clearest;
    double most = 0;
    for (std::size_t c = 0; c < bed.channels.size(); ++c) {
      const Eigen::VectorXd own = part->segment(bed.offset(c), bed.channels[c].mean.size());
      const Eigen::VectorXd variance = bed.channels[c].noise.diagonal();
      const double strength = own.cwiseAbs2().cwiseQuotient(variance).sum();
      if (!(strength > most)) continue;
      most = strength;
      clearest = region_in(bed, c, *place, own);
    }
    if (clearest) places.push_back(*clearest);
  }
  std::ranges::stable_sort(places, {}, &MismatchRegion::p_value);
  return places;
}

}  // namespace regoplan
