#include "drive_diagnosis/contest/held_out_stretches.h"

#include <algorithm>
#include <span>

namespace regoplan {
namespace {

/// Windows in which some of the parameters change anything.
std::vector<Eigen::Index> windows_changed(const EffectContest& contest,
                                          const std::vector<std::size_t>& parameters,
                                          Eigen::Index channels) {
  std::vector<Eigen::Index> windows;
  for (Eigen::Index row = 0; row < contest.data.size(); row += channels) {
    const bool changes = std::ranges::any_of(parameters, [&](std::size_t k) {
      const auto column = contest.parameters.col(static_cast<Eigen::Index>(k));
      return !column.segment(row, channels).isZero(0);
    });
    if (changes) windows.push_back(row / channels);
  }
  return windows;
}

/// The contest in which some parameters are what they are said to be.
EffectContest with_as_said(EffectContest contest, const std::vector<std::size_t>& parameters) {
  for (const std::size_t k : parameters) {
    contest.parameters.col(static_cast<Eigen::Index>(k)).setZero();
  }
  return contest;
}

/// The contest in which some windows say nothing.
EffectContest without(EffectContest contest, std::span<const Eigen::Index> windows,
                      Eigen::Index channels) {
  for (const Eigen::Index w : windows) {
    const auto forget = [&](auto& of_rows) {
      of_rows.middleRows(w * channels, channels).setZero();
    };
    forget(contest.data);
    forget(contest.parameters);
    if (contest.ground.size() > 0) forget(contest.ground);
    for (KnownZone& zone : contest.zones_known) forget(zone.columns);
  }
  return contest;
}

/// Nats by which windows are likely, given all others.
double nats_given_others(const EffectContest& contest, std::span<const Eigen::Index> windows,
                         Eigen::Index channels) {
  return likelihood_nats(contest) - likelihood_nats(without(contest, windows, channels));
}

}  // namespace

double held_out_nats(const EffectContest& contest, const std::vector<std::size_t>& together,
                     Eigen::Index channels) {
  constexpr std::size_t kStretches = 5;
  const std::vector<Eigen::Index> windows = windows_changed(contest, together, channels);
  if (windows.size() < 2) return 0;
  const EffectContest as_said = with_as_said(contest, together);
  const std::size_t stretches = std::min(kStretches, windows.size());
  double nats = 0;
  for (std::size_t i = 0; i < stretches; ++i) {
    const std::size_t first = i * windows.size() / stretches;
    const std::size_t next = (i + 1) * windows.size() / stretches;
    const auto held_out = std::span(windows).subspan(first, next - first);
    nats += nats_given_others(contest, held_out, channels) -
            nats_given_others(as_said, held_out, channels);
  }
  return nats;
}

}  // namespace regoplan
