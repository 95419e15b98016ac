#pragma once

#include <array>
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "planner/problem/plan_result.h"
#include "planner/runtime/draw_statistics.h"
#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan {

/// One draw of each soil of a map, in their order.
using SoilDraw = std::vector<Soil>;

/// Draw k depends on the soils, the seed and k alone: the same for every path that is compared.
SoilDraw soil_draw(const PlanningProblem& problem, std::uint64_t seed, int number);

/// The smallest margins along a path, each for itself. What is missing counts as -1; traction that
/// is missing because the lateral demand is beyond the supply, as the cornering margin or 0.
struct PathMargins {
  double cornering = 1, tip_over = 1, traction = 1;

  double smallest() const;
  bool operator==(const PathMargins&) const = default;
};

/// The smallest of each margin over several places.
PathMargins smallest_of(const std::vector<PathMargins>& places);

/// The margins of a point, what is missing counted as above.
PathMargins margins_at(const TrajectoryPoint& point);

/// Where each margin is smallest at the mean soils: indices of a few places, 2 m apart, for each.
/// \param at_mean of each state
std::vector<std::size_t> decisive_places(const std::vector<VehicleState>& states,
                                         const std::vector<PathMargins>& at_mean);

/// Margins of states on one draw of the soils, by the direct wheel model at its fast accuracy.
std::vector<PathMargins> margins_on(const PlanningProblem& problem,
                                    const std::vector<VehicleState>& states, const SoilDraw& soils);

/// How much one soil number decides.
struct SoilInfluence {
  std::string soil;
  std::string parameter;  ///< as it stands in files
  double share = 0;       ///< of the margin's variance: squared standardised regression coefficient
  double margin_per_std = 0;  ///< change of the smallest margin when it grows by one deviation
};

/// What is known of a path's margins, given what is known of the soils.
struct SoilSpread {
  int draws = 0;         ///< 0 where every soil number is known
  int direct_draws = 0;  ///< of them judged by the wheel model itself; the others by a surrogate
  /// How much the surrogate promised too much at worst, in draws that it was not made from, against
  /// the wheel model at more places of the path. Taken off what the surrogate says. Where that is
  /// too large of a margin, what it promised too much where that margin was the smallest; and where
  /// that too is too large, every draw is the wheel model's.
  PathMargins surrogate_error{.cornering = 0, .tip_over = 0, .traction = 0};
  int places = 0;  ///< of the path that were judged in each draw
  /// Of a margin that the surrogate promises too much of, over the wheel model's draws alone.
  Quantiles cornering, tip_over, traction;
  Quantiles margin;
  QuantileInterval margin_p05_interval;  ///< what sampling leaves open of `margin.p05`
  QuantileInterval margin_p50_interval;  ///< and of the median
  Probability feasible;                  ///< that the smallest margin is allowed
  /// The largest first; empty where the draws are fewer than `kDrawsANumber` for each uncertain
  /// number: a regression on so few says nothing.
  std::vector<SoilInfluence> influences;
  double explained = 0;  ///< of the margin's variance, by the regression behind `influences`
};

struct SpreadSettings {
  int draws = 1000;  ///< at least 2
  std::uint64_t seed = 1;
  int threads = 2;
  std::stop_token stop = {};  ///< what it interrupts is worth nothing
};

/// The spread over `draws` draws of the soils. The margins are judged, on every uncertain soil that
/// the states stand on, at the places where each is smallest at the mean soils. A quadratic
/// surrogate in the soil numbers is made from the first draws, checked on the next, and used where
/// its error is small in every margin that is the smallest in some draw; otherwise the wheel model
/// judges every draw, of which there are then at most `kDirectDrawsMax`. \param states along the
/// path \param at_mean their margins at the mean soils, of the same size
SoilSpread soil_spread(const PlanningProblem& problem, const std::vector<VehicleState>& states,
                       const std::vector<PathMargins>& at_mean, const SpreadSettings& settings);

inline constexpr int kDirectDrawsMax = 200;
inline constexpr std::size_t kDrawsANumber = 3;

}  // namespace regoplan
