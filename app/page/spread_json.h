#pragma once

#include <limits>
#include <optional>

#include "planner/problem/margin_spread.h"

namespace regoplan {

/// Adds what a candidate's margins are over the soils' draws: `margin_p05`, `margin_p50`,
/// `probability_feasible`, their 95 % intervals (of sampling) and `soil_draws`; null where nothing
/// was drawn.
template <class Json>
void add_spread(Json& json, const std::optional<MarginSpread>& spread) {
  const auto interval = [](double low, double high) { return Json::array({low, high}); };
  json["margin_p05"] = spread ? Json(spread->p05) : Json(nullptr);
  json["margin_p05_ci95"] = spread ? interval(spread->p05_low, spread->p05_high) : Json(nullptr);
  json["margin_p50"] = spread ? Json(spread->p50) : Json(nullptr);
  json["margin_p50_ci95"] = spread ? interval(spread->p50_low, spread->p50_high) : Json(nullptr);
  json["probability_feasible"] = spread ? Json(spread->feasible.share) : Json(nullptr);
  json["probability_feasible_ci95"] =
      spread ? interval(spread->feasible.low, spread->feasible.high) : Json(nullptr);
  json["soil_draws"] = spread ? spread->draws : 0;
}

}  // namespace regoplan
