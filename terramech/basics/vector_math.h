#pragma once

#include <cstddef>
#include <cstdint>

/// Branch-free functions on four doubles at a time, which compilers turn into whatever vector
/// instructions the machine has. Sized to what the wheel model needs, not to the last bit.
/// Accuracy: VectorMath tests.
// All of it is inlined: vectors never cross a call, so the ABI that the compiler warns of is not
// used.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace regoplan::vector_math {

using Vec [[gnu::vector_size(32)]] = double;
using Bits [[gnu::vector_size(32)]] = std::int64_t;
inline constexpr std::size_t kLanes = 4;

#define REGOPLAN_INLINE [[gnu::always_inline]] inline

/// Floats, four or eight at a time.
using Four [[gnu::vector_size(16)]] = float;
using Eight [[gnu::vector_size(32)]] = float;

/// The number in a vector, and the integers of its size beside each other.
template <class Numbers>
struct Traits;
template <>
struct Traits<Vec> {
  using Number = double;
  using Ints = Bits;
  static constexpr std::int64_t kSign = INT64_MIN;
};
template <>
struct Traits<Four> {
  using Number = float;
  using Ints [[gnu::vector_size(16)]] = std::int32_t;
  static constexpr std::int32_t kSign = INT32_MIN;
};
template <>
struct Traits<Eight> {
  using Number = float;
  using Ints [[gnu::vector_size(32)]] = std::int32_t;
  static constexpr std::int32_t kSign = INT32_MIN;
};
template <class Numbers>
using Number = typename Traits<Numbers>::Number;
template <class Numbers>
using Ints = typename Traits<Numbers>::Ints;

REGOPLAN_INLINE double sum(Vec v) {
  return (v[0] + v[2]) + (v[1] + v[3]);
}
REGOPLAN_INLINE double sum(Eight v) {
  const Four half =
      __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
  return double{(half[0] + half[2]) + (half[1] + half[3])};
}
template <class Numbers>
REGOPLAN_INLINE Numbers abs(Numbers v) {
  return reinterpret_cast<Numbers>(reinterpret_cast<Ints<Numbers>>(v) & ~Traits<Numbers>::kSign);
}
/// |magnitude| with the sign of `sign`; magnitude must not be negative.
template <class Numbers>
REGOPLAN_INLINE Numbers with_sign(Numbers magnitude, Numbers sign) {
  return reinterpret_cast<Numbers>(
      reinterpret_cast<Ints<Numbers>>(magnitude) |
      (reinterpret_cast<Ints<Numbers>>(sign) & Traits<Numbers>::kSign));
}

/// exp(x) for x <= 700, to 1.1e-8 relative; x below -700 counts as -700 (1e-304).
REGOPLAN_INLINE Vec exp(Vec x) {
  constexpr double kLog2e = 1.4426950408889634;
  constexpr double kLn2 = 0.69314718055994530942;
  constexpr double kRound = 0x1.8p52;  // adding it leaves the nearest integer in the low bits
  const Vec clipped = x < -700.0 ? Vec{} - 700.0 : x;
  const Vec rounded = clipped * kLog2e + kRound;
  const Vec f = clipped - (rounded - kRound) * kLn2;  // exact enough: |x| 2e-17 relative
  // 1 + f + f^2 (Chebyshev interpolation of the rest on |f| <= ln(2)/2), so that exp(x) - 1 keeps
  // its sign and size at tiny x
  const Vec f2 = f * f;
  const Vec high = (0.04166655461720141 + f * 0.008363179052728216) + f2 * 0.0013926183587875844;
  const Vec p = (1.0 + f) + f2 * ((0.5 + f * 0.1666657698969869) + f2 * high);
  const Bits exponent = (reinterpret_cast<Bits>(rounded) + 1023) << 52;
  return p * reinterpret_cast<Vec>(exponent);
}

/// ln(x) for normal positive x, to 3e-10 absolute.
REGOPLAN_INLINE Vec log(Vec x) {
  constexpr double kLn2 = 0.69314718055994530942;
  const Bits bits = reinterpret_cast<Bits>(x);
  // x = 2^k m with m in [sqrt(1/2), sqrt(2)); k comes as a double through the low bits of 2^52
  const Bits k_biased = ((bits - 0x3FE6A09E667F3BCDLL) >> 52) + 2048;
  const Vec k = reinterpret_cast<Vec>(k_biased | 0x4330000000000000LL) - (0x1p52 + 2048.0);
  const Vec m = reinterpret_cast<Vec>(bits - ((k_biased - 2048) << 52));
  const Vec z = (m - 1.0) / (m + 1.0);
  const Vec z2 = z * z;
  // 2 artanh(z) on |z| <= 0.1716: z times a Chebyshev interpolation in z^2
  const Vec p = (1.9999999986307635 + z2 * 0.6666681538348673) +
                z2 * z2 * (0.39974845374631796 + z2 * 0.29924530408465405);
  return k * kLn2 + p * z;
}

/// exp(x) of floats up to 87, to 4e-7 relative; x below -87 counts as -87 (2e-38).
REGOPLAN_INLINE Eight exp(Eight x) {
  constexpr float kRound = 0x1.8p23F;  // adding it leaves the nearest integer in the low bits
  const Eight clipped = x < -87.0F ? Eight{} - 87.0F : x;
  const Eight rounded = clipped * 1.44269504F + kRound;
  const Eight f = clipped - (rounded - kRound) * 0.69314718F;
  const Eight f2 = f * f;
  const Eight p =
      (1.0F + f) + f2 * ((0.5F + f * 0.16666667F) +
                         f2 * ((0.041666668F + f * 0.0083333333F) + f2 * 0.0013888889F));
  return p * reinterpret_cast<Eight>((reinterpret_cast<Ints<Eight>>(rounded) + 127) << 23);
}

/// ln(x) of floats that are normal and positive, to 3e-7 absolute and of the result.
template <class Floats>
REGOPLAN_INLINE Floats log_of_floats(Floats x) {
  // as in log(Vec), but for the series: ln(1 + z) - z over z^2, interpolated in Chebyshev's nodes,
  // which waits for no division
  const auto bits = reinterpret_cast<Ints<Floats>>(x);
  const Ints<Floats> k = (bits - 0x3F3504F3) >> 23;
  const Floats z = reinterpret_cast<Floats>(bits - (k << 23)) - 1.0F;
  const Floats z2 = z * z;
  const Floats low = (-0.50000091F + z * 0.33334114F) + z2 * (-0.24982451F + z * 0.19929057F);
  const Floats high = (-0.17132387F + z * 0.15984096F) - z2 * 0.10188586F;
  return (__builtin_convertvector(k, Floats) * 0.69314718F + z) + z2 * (low + z2 * z2 * high);
}

REGOPLAN_INLINE Eight log(Eight x) {
  return log_of_floats(x);
}

/// A rotation: sin(d) and 1 - cos(d), both without cancellation at small d.
template <class Numbers>
struct Turn {
  Numbers sin, versin;
};

/// For 0 <= d <= 3.7 rad, to 1e-7 of each (floats: 1e-6); to 2e-10 up to 2.2 rad. Taylor series at
/// d/4, doubled twice.
template <class Numbers>
REGOPLAN_INLINE Turn<Numbers> turn(Numbers d) {
  using N = Number<Numbers>;
  const Numbers x = d * N(0.25);
  const Numbers x2 = x * x;
  Numbers s = Numbers{} + N(1.0 / 362880);
  s = s * x2 - N(1.0 / 5040);
  s = s * x2 + N(1.0 / 120);
  s = s * x2 - N(1.0 / 6);
  s = s * x2 + N(1);
  s = s * x;
  Numbers v = Numbers{} + N(1.0 / 3628800);
  v = v * x2 - N(1.0 / 40320);
  v = v * x2 + N(1.0 / 720);
  v = v * x2 - N(1.0 / 24);
  v = v * x2 + N(0.5);
  v = v * x2;
  const Numbers s2 = (s + s) * (N(1) - v);
  const Numbers v2 = (s + s) * s;
  return {.sin = (s2 + s2) * (N(1) - v2), .versin = (s2 + s2) * s2};
}

}  // namespace regoplan::vector_math
