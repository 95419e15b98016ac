#pragma once

#include <cstdint>

namespace regoplan {

/// Smooth random field of the plane that is the same wherever and in whatever order it is asked:
/// gradient noise after Perlin (2002), one wavelength, mean 0, about within [-1, 1]. The lattice
/// is turned and shifted by the seed, so that fields of several wavelengths hide it when summed.
class SmoothNoise {
 public:
  SmoothNoise(std::uint64_t seed, double wavelength_m);
  double operator()(double x_m, double y_m) const;

 private:
  std::uint64_t seed_;
  double cosine_pm_, sine_pm_;  ///< of the turn, over the wavelength
  double x_shift_, y_shift_;
};

/// A seed for one of several independent random things that hang on one seed.
std::uint64_t sub_seed(std::uint64_t seed, std::uint64_t stream);

}  // namespace regoplan
