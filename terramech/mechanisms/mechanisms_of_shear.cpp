// Mechanisms of the shear stress.
#include <algorithm>
#include <cmath>

#include "terramech/mechanisms/mechanism_catalogue.h"

namespace regoplan::mechanism_catalogue {

// NOLINTBEGIN(bugprone-easily-swappable-parameters, readability-function-size)
std::vector<Definition> of_shear() {
  using E = Effects;
  using P = const Parameters&;
  using S = const WheelState&;
  return {
      {{"shear_modulus_slip_angle",
        "linear",
        "kx += kx1 |beta|, ky += ky1 |beta|",
        "Ishigami et al. 2007, J. Field Robotics 24",
        {{"kx1_m", .01, .1, .04, 0, 10}, {"ky1_m", .01, .1, .02, 0, 10}}},
       [](E e, P p, S) {
         e.soil.kx1_m += p[0];
         e.soil.ky1_m += p[1];
         return e;
       }},
      {{"shear_modulus_slip_angle",
        "power",
        "kx, ky times 1 + m sin^p|beta|",
        "proxy; as linear, with one factor for both moduli",
        {{"m", .5, 6, 2, 0, 100}, kExponent}},
       [](E e, P p, S at) {
         const double factor = 1 + p[0] * std::pow(std::sin(at.beta_abs_rad), p[1]);
         e.soil.kx0_m *= factor;
         e.soil.kx1_m *= factor;
         e.soil.ky0_m *= factor;
         e.soil.ky1_m *= factor;
         return e;
       }},
      {{"coupled_shear",
        "displacement",
        "tau = tau_max (1 - exp(-|j|/K)) j/|j|",
        "Wong 2008, Theory of Ground Vehicles",
        {}},
       [](E e, P, S) {
         e.shear = ShearLaw::kAlongDisplacement;
         return e;
       }},
      {{"coupled_shear",
        "slip_velocity",
        "tau = tau_max (1 - exp(-|j|/K)) v/|v|",
        "Tran et al. 2002; Wong & Preston-Thomas 1988",
        {}},
       [](E e, P, S) {
         e.shear = ShearLaw::kAlongSlipVelocity;
         return e;
       }},
      {{"coupled_shear",
        "within_limit",
        "shares ex, ey of eqs. (7)(10) over (1 + k (|e|^4 - max(ex, ey)^4))^(1/4)",
        "proxy; one Mohr-Coulomb limit on the resultant, felt only near it",
        {{"coupling", .5, 1.5, 1, 0, 100}}},
       [](E e, P p, S) {
         e.shear = ShearLaw::kWithinLimit;
         e.coupling = p[0];
         return e;
       }},
      {{"shear_hump",
        "wong",
        "tau/tau_max = Kr {1 + [1/(Kr (1 - 1/e)) - 1] exp(1 - j/Kw)} (1 - exp(-j/Kw))",
        "Wong 2008, eq. (2.73)",
        {{"residual", .4, .95, .7, 0, 1, true}}},
       [](E e, P p, S) {
         e.shear = ShearLaw::kHump;
         e.residual = p[0];
         return e;
       }},
      {{"shear_hump",
        "softening",
        "tau/tau_max = (1 - exp(-j/k)) (R + (1 - R) exp(-(j/(d k))^2)), k = kx or ky; the peak "
        "stays below tau_max",
        "proxy; dense soil loosens to its residual strength (Wong 2008, section 2.4)",
        {{"residual", .4, .95, .7, 0, 1, true}, {"distance", 2, 6, 3.5, .1, 100}}},
       [](E e, P p, S) {
         e.shear = ShearLaw::kSoftening;
         e.residual = p[0];
         e.softening = p[1];
         return e;
       }},
  };
}
// NOLINTEND(bugprone-easily-swappable-parameters, readability-function-size)

}  // namespace regoplan::mechanism_catalogue
