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

}  // namespace regoplan
