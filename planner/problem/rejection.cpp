#include "planner/problem/rejection.h"

#include <cstddef>

namespace regoplan {
namespace {

constexpr bool in_order() {
  for (std::size_t i = 0; i < kRejectionWords.size(); ++i) {
    if (kRejectionWords[i].rejection != static_cast<Rejection>(i)) return false;
  }
  return true;
}
static_assert(in_order(), "the table stands in the order of the enumeration");

const RejectionWords& words(Rejection rejection) {
  return kRejectionWords.at(static_cast<std::size_t>(rejection));
}

}  // namespace

std::string_view name(Rejection rejection) {
  return words(rejection).name;
}

const RejectedQuantity& quantity(Rejection rejection) {
  return words(rejection).quantity;
}

bool is_margin(Rejection rejection) {
  return quantity(rejection).at_least;
}

std::optional<RejectedState> rejected_by(const StateMargins& margins, double margin_min,
                                         RejectedState at) {
  const auto because = [&](Rejection reason, std::optional<double> margin) {
    at.reason = reason;
    if (margin) at.exceeded = {.found = *margin, .limit = margin_min};
    return at;
  };
  if (!margins.supply && margins.no_supply == NoSupply::kSinkage) {
    at.reason = Rejection::kSinkage;
    at.exceeded = {.found = margins.too_deep->sinkage_m, .limit = margins.too_deep->allowed_m};
    return at;
  }
  if (!margins.supply) {
    return because(
        margins.no_supply == NoSupply::kTraction ? Rejection::kTraction : Rejection::kCornering,
        std::nullopt);
  }
  // A lateral demand beyond the supply has no trim and hence no traction: that is cornering.
  if (margins.traction && *margins.traction < margin_min) {
    return because(Rejection::kTraction, margins.traction);
  }
  if (margins.tip_over < margin_min) return because(Rejection::kTipOver, margins.tip_over);
  if (*margins.cornering < margin_min) return because(Rejection::kCornering, margins.cornering);
  if (!margins.traction) return because(Rejection::kTraction, std::nullopt);
  return std::nullopt;
}

}  // namespace regoplan
