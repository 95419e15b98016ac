// What EffectFit does with a zone: its soil and its edges, in turn.
#include <algorithm>
#include <iterator>
#include <utility>

#include "drive_diagnosis/fit/effect_fit.h"
#include "drive_diagnosis/fit/likely_edges.h"
#include "drive_diagnosis/fit/zone_borders.h"

namespace regoplan {

void EffectFit::settle_zone(EffectFound& zone) {
  const Settled start{.fit = fit_, .shifts = shifts_};
  LinearisedWindows here = linearise().windows;
  // A soil that fits badly leaves misfit in its zone, which would pass for noise.
  scatter_ = scatter_outside(here, zone.share);
  // A tenth of the windows is far from linear in what is sought: most of the time is saved.
  WindowSet windows = windows_far_from_linear(here);
  linearisation_.predict_only(std::move(windows), std::move(here));
  Settled best = likeliest_soil(start, zone);
  linearisation_.predict_all();
  take_edges(zone);
  go_on_from(std::move(best));
  go_on_from(settled_with_edges(zone));
  scatter_.reset();
}

/// Windows that a soil far from the map's moves beyond their first order while the zone that was
/// added last is settled: those that a zone touches or may come to touch, and those in which the
/// model has no motion.
WindowSet EffectFit::windows_far_from_linear(const LinearisedWindows& here) const {
  constexpr double kEdgesMove = 4;  // windows, in all rounds of place_edges
  std::vector<WindowZone> all = zones();
  all.back() = comparison_.widened(slanted_most(all.back()), kEdgesMove);
  WindowSet windows;
  std::ranges::set_union(here.unbalanced, comparison_.touching(all), std::back_inserter(windows));
  return windows;
}

/// \param zone gets the edges that it is likeliest with
EffectFit::Settled EffectFit::likeliest_soil(const Settled& start, EffectFound& zone) {
  const EffectFound found = zone;
  const auto& less = contest_.wide_directions;  // bearing, cohesion and friction come first
  const Eigen::VectorXd weaker = less[0] + less[1] + less[2];
  Settled best;
  for (const double weakness : {0.0, 1.4, 2.8}) {
    EffectFound placed = found;
    take_edges(placed);
    go_on_from(start);
    fit_.zones.back() = weakness * weaker;
    // From a soil that hardly carries the vehicle no step leads to one that does.
    if (weakness > 0 && !has_motions_in_last_zone()) continue;
    Settled settled = settled_with_edges(placed);
    // The map's soil is the answer where none of all says anything.
    if (!best.fit.zones.empty() && settled.nats >= best.nats) continue;
    best = std::move(settled);
    zone = placed;
  }
  return best;
}

/// Whether the model has a motion in half of the windows of the zone that was added last, or more.
bool EffectFit::has_motions_in_last_zone() {
  const PredictedWindows here = linearisation_.predicted(fit_, zones(), shifts_);
  const WindowSet& unbalanced = here.windows.unbalanced;
  const auto& share = contest_.zones_known.back().share;
  std::size_t windows = 0, without = 0;
  for (std::size_t i = 0; i < comparison_.size(); ++i) {
    if (share[i] < 0.5) continue;
    ++windows;
    without += std::ranges::binary_search(unbalanced, i);
  }
  return 2 * without <= windows;
}

/// Soil and edges of the zone that was added last, in turn: an edge that is off by half a window
/// asks for a soil that is nowhere.
EffectFit::Settled EffectFit::settled_with_edges(EffectFound& zone) {
  constexpr int kStepsBefore = 3, kRounds = 3;
  border_std_ = border_std(comparison_, {deviation(), zones()}, kEdgesFound, stop_);
  Settled settled = settled_from_here(kStepsBefore);
  for (int round = 0; round < kRounds; ++round) {
    go_on_from(settled);
    if (!place_edges(zone) && round > 0) break;
    border_std_ = border_std(comparison_, {deviation(), zones()}, kEdgesPlaced, stop_);
    settled = settled_from_here();
  }
  return settled;
}

/// The zone that was added last has these edges, and the soil that it had: its numbers are told
/// from what the map says most of it to be, which may be another soil now.
void EffectFit::take_edges(const EffectFound& zone) {
  const std::size_t last = fit_.zones.size() - 1;
  const int before = soil_of(last);
  contest_.zones_known.back().share = zone.share;
  edges_.back() = edges_of(zone);
  if (const int now = soil_of(last); now != before) {
    fit_.zones.back() = values_of(told_from(now, before, numbers_of(fit_.zones.back())));
  }
}

/// What a zone's numbers that are told from one soil of the map are from another.
SoilNumbers EffectFit::told_from(int soil, int before, const SoilNumbers& numbers) const {
  std::vector<SoilNumbers> all_along = deviation().soils;
  all_along.resize(map_.soils().size());
  const auto now = static_cast<std::size_t>(soil), then = static_cast<std::size_t>(before);
  SoilNumbers there = numbers;
  for (std::size_t k = 0; k < kSoilNumbers; ++k) there.at(k) += all_along[then].at(k);
  SoilNumbers told =
      deviations_between(map_.soils()[now].soil, deviating(map_.soils()[then].soil, there));
  for (std::size_t k = 0; k < kSoilNumbers; ++k) told.at(k) -= all_along[now].at(k);
  return told;
}

/// Moves the edges of the zone that was added last to where its soil makes them likeliest.
/// \returns whether they moved
bool EffectFit::place_edges(EffectFound& zone) {
  const Eigen::MatrixXd shifts = shifts_;
  const Weighed here = weigh();
  // What the inputs' scatter explains stays what it is.
  const Eigen::MatrixXd measured = comparison_.measured() + here.windows.windows.shifted_by(shifts);
  const VehicleDeviation vehicle = deviation();
  const LikelyEdges edges = likely_edges({.comparison = comparison_,
                                          .deviation = vehicle,
                                          .measured = measured,
                                          .predicted = here.windows.windows.base,
                                          .noise = here.noise},
                                         zones(), stop_);
  zone.begins = edges.at.begins;
  zone.ends = edges.at.ends;
  zone.begins_slant = edges.at.begins_slant;
  zone.ends_slant = edges.at.ends_slant;
  zone.first_at = edges.begins_ci95;
  zone.last_at = edges.ends_ci95;
  zone.share = shares_between(zone.begins, zone.ends, comparison_.size());
  const ZoneBorders before = edges_.back();
  take_edges(zone);
  return edges_.back() != before;
}

}  // namespace regoplan
