#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

/// Branch-free exponential, logarithm, sine and cosine that compilers turn into vector code inside
/// loops (the library's own are calls). Accuracy in the stated ranges: VectorMath tests.
namespace regoplan::vector_math {

/// exp(x) for x <= 700, to 3e-16 relative; x below -700 counts as -700 (1e-304).
inline double exp(double x) {
  constexpr double kLog2e = 1.4426950408889634;
  constexpr double kLn2High = 0.693147180369123816490;
  constexpr double kLn2Low = 1.90821492927058770002e-10;
  constexpr double kRound = 0x1.8p52;  // adding it leaves the nearest integer in the low bits
  const double clipped = x < -700 ? -700 : x;
  const double rounded = clipped * kLog2e + kRound;
  const double k = rounded - kRound;
  const double f = (clipped - k * kLn2High) - k * kLn2Low;
  // Taylor series on |f| <= ln(2)/2, its remainder below 1e-17
  double p = 1.0 / 6227020800.0;
  p = p * f + 1.0 / 479001600.0;
  p = p * f + 1.0 / 39916800.0;
  p = p * f + 1.0 / 3628800.0;
  p = p * f + 1.0 / 362880.0;
  p = p * f + 1.0 / 40320.0;
  p = p * f + 1.0 / 5040.0;
  p = p * f + 1.0 / 720.0;
  p = p * f + 1.0 / 120.0;
  p = p * f + 1.0 / 24.0;
  p = p * f + 1.0 / 6.0;
  p = p * f + 0.5;
  p = p * f + 1.0;
  p = p * f + 1.0;
  const auto exponent = (std::bit_cast<std::uint64_t>(rounded) + 1023) << 52;
  return p * std::bit_cast<double>(exponent);
}

/// ln(x) for normal positive x, to 1e-15 relative to max(|ln x|, 0.3).
inline double log(double x) {
  constexpr double kLn2 = 0.69314718055994530942;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  // x = 2^k m with m in [sqrt(1/2), sqrt(2))
  const std::uint64_t shifted = bits - 0x3FE6A09E667F3BCDULL;
  const auto k_biased = (shifted >> 52) ^ 0x800;  // k + 2048 as 12 bits: no signed conversion
  const double k = std::bit_cast<double>(k_biased | 0x4330000000000000ULL) - (0x1p52 + 2048.0);
  const double m = std::bit_cast<double>(bits - ((k_biased - 2048) << 52));
  const double z = (m - 1) / (m + 1);
  const double z2 = z * z;
  // 2 artanh(z), |z| <= 0.1716
  double p = 2.0 / 21;
  p = p * z2 + 2.0 / 19;
  p = p * z2 + 2.0 / 17;
  p = p * z2 + 2.0 / 15;
  p = p * z2 + 2.0 / 13;
  p = p * z2 + 2.0 / 11;
  p = p * z2 + 2.0 / 9;
  p = p * z2 + 2.0 / 7;
  p = p * z2 + 2.0 / 5;
  p = p * z2 + 2.0 / 3;
  p = p * z2 + 2.0;
  return k * kLn2 + p * z;
}

/// sin(x) for |x| <= 1.85, to 4e-16 absolute (Taylor series to x^23).
inline double sin(double x) {
  const double x2 = x * x;
  double p = -1.0 / 25852016738884976640000.0;
  p = p * x2 + 1.0 / 51090942171709440000.0;
  p = p * x2 - 1.0 / 121645100408832000.0;
  p = p * x2 + 1.0 / 355687428096000.0;
  p = p * x2 - 1.0 / 1307674368000.0;
  p = p * x2 + 1.0 / 6227020800.0;
  p = p * x2 - 1.0 / 39916800.0;
  p = p * x2 + 1.0 / 362880.0;
  p = p * x2 - 1.0 / 5040.0;
  p = p * x2 + 1.0 / 120.0;
  p = p * x2 - 1.0 / 6.0;
  p = p * x2 + 1.0 / 1.0;
  return x * p;
}

/// cos(x) for |x| <= 1.85, to 4e-16 absolute (Taylor series to x^24).
inline double cos(double x) {
  const double x2 = x * x;
  double p = 1.0 / 620448401733239439360000.0;
  p = p * x2 - 1.0 / 1124000727777607680000.0;
  p = p * x2 + 1.0 / 2432902008176640000.0;
  p = p * x2 - 1.0 / 6402373705728000.0;
  p = p * x2 + 1.0 / 20922789888000.0;
  p = p * x2 - 1.0 / 87178291200.0;
  p = p * x2 + 1.0 / 479001600.0;
  p = p * x2 - 1.0 / 3628800.0;
  p = p * x2 + 1.0 / 40320.0;
  p = p * x2 - 1.0 / 720.0;
  p = p * x2 + 1.0 / 24.0;
  p = p * x2 - 1.0 / 2.0;
  p = p * x2 + 1.0 / 1.0;
  return p;
}

}  // namespace regoplan::vector_math
