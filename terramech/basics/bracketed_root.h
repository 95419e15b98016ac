#pragma once

#include <cmath>

namespace regoplan {

/// Two arguments between which a continuous function changes sign, with its values there.
struct Bracket {
  double from, f_from;
  double to, f_to;
};

/// When a root is close enough.
struct RootTolerance {
  double argument = 0;  ///< width of the bracket, or of a step
  double value = 0;     ///< of the function
  int calls_max = 80;   ///< the best known after these
};

/// Where a function is zero, by the Illinois method: a secant that keeps its bracket, and halves it
/// now and then, so that it also closes in on a jump. The last argument asked.
template <class Function>
double bracketed_root(const Function& f, Bracket at, const RootTolerance& tolerance) {
  constexpr int kHalving = 8;
  for (int i = 1; i <= tolerance.calls_max && std::abs(at.f_to) > tolerance.value; ++i) {
    const double next = i % kHalving == 0
                            ? (at.from + at.to) / 2
                            : at.to - at.f_to * (at.to - at.from) / (at.f_to - at.f_from);
    const double f_next = f(next), step = next - at.to;
    if (f_next * at.f_to < 0) {
      at.from = at.to;
      at.f_from = at.f_to;
    } else {
      at.f_from /= 2;
    }
    at.to = next;
    at.f_to = f_next;
    if (std::abs(step) <= tolerance.argument || std::abs(at.to - at.from) <= tolerance.argument) {
      break;
    }
  }
  return at.to;
}

}  // namespace regoplan
