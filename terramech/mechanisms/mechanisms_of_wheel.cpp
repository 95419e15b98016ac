// Mechanisms of the wheel itself and of what it hangs on.
#include <algorithm>
#include <cmath>

#include "terramech/mechanisms/mechanism_catalogue.h"

namespace regoplan::mechanism_catalogue {

// NOLINTBEGIN(bugprone-easily-swappable-parameters, readability-function-size)
std::vector<Definition> of_wheel() {
  using E = Effects;
  using P = const Parameters&;
  using S = const WheelState&;
  return {
      {{"grousers",
        "passive_pressure",
        "thrust m b (gamma hg^2 Kp/2 + 2 c hg sqrt(Kp)) (1 - exp(-5 s)) a lug in the soil, of "
        "which there is "
        "one at least, digging d hg s",
        "Bekker 1969; Iizuka & Kubota 2011",
        {{"lug_height_m", .004, .02, .01, 0, .2},
         {"mobilised", .3, 1, .8, 0, 1, true},
         {"ripple", 0, .5, 0, 0, 1},
         {"lugs", 12, 32, 24, 0, 1000},
         {"digging", .05, 1, .5, 0, 10}}},
       [](E e, P p, S at) {
         e.lug_height_m = p[0];
         e.lug_share = p[1] * (1 - std::exp(-5 * driving(at)));
         e.lug_ripple = p[2];
         e.lugs = p[3];
         e.lug_phase_rad = p[3] * at.conditions.wheel_angle_rad;
         e.sinkage_added_m += p[4] * p[0] * driving(at);
         return e;
       }},
      {{"grousers",
        "effective_radius",
        "c, tan(phi) times 1 + 4 x (hg/r) (1 - exp(-5 s)), digging d hg s",
        "proxy; lugs as a larger shear radius",
        {{"lug_height_m", .004, .02, .01, 0, .2},
         {"share", .3, 1, .7, 0, 1, true},
         {"digging", .05, 1, .5, 0, 10}}},
       [](E e, P p, S at) {
         e.limit *= 1 + p[1] * p[0] / e.wheel.radius_m * 4 * (1 - std::exp(-5 * driving(at)));
         e.sinkage_added_m += p[2] * p[0] * driving(at);
         return e;
       }},
      {{"grousers",
        "soil_block",
        "soil between lugs shears as one with the wheel at r + x hg, driving or braking, by the "
        "slip of that radius where slip is told of r: there c (1 + g) (1 + 2 hg/b), tan(phi) (1 + "
        "g) (1 + 0.64 (hg/b) acot(hg/b)), "
        "g what soil grips on soil more than on a smooth rim; "
        "of all that, the share k acts sideways; digging d hg s",
        "Bekker 1960; Ding et al. 2011, J. Terramechanics 48, 27-45; g after Potyondy 1961, "
        "Geotechnique 11, 339-353",
        {{"lug_height_m", .004, .02, .01, 0, .2},
         {"share", .1, 1, .5, 0, 1, true},
         {"digging", .05, 1, .5, 0, 10},
         {"grip", 0, .5, 0, 0, 10},
         {"held", .05, 1, 1, 0, 1, true}}},
       [](E e, P p, S at) {
         const double radius = 1 + p[1] * p[0] / e.wheel.radius_m;
         const double slender = p[0] / e.wheel.width_m;
         // the way along both axes is that of the larger radius, which slips more than the rim
         for (double* modulus_m : {&e.soil.kx0_m, &e.soil.kx1_m, &e.soil.ky0_m, &e.soil.ky1_m}) {
           *modulus_m /= radius;
         }
         e.shear_radius *= radius;
         e.rim_factor *= radius;
         e.block_cohesion *= (1 + p[3]) * (1 + 2 * slender);
         e.block_friction *= (1 + p[3]) * (1 + 0.64 * slender * std::atan2(1, slender));
         e.block_held *= p[4];
         e.sinkage_added_m += p[2] * p[0] * driving(at);
         return e;
       }},
      {{"grousers",
        "carried_soil",
        "thrust m b hg (gamma hg Kp/2 + q Kp + 2 c sqrt(Kp)) a lug in the soil, q the ground "
        "pressure, rim radius r + hg/2, digging a hg s/(1 - s/2); Fy stays, the trench's sides "
        "having given way; carried soil behind the wheel: lambda += hg/r s, at most 1.5",
        "Lyasko 2010, J. Terramechanics 47; Ding et al. 2011, J. Terramechanics 48, 27-45",
        {{"lug_height_m", .004, .02, .01, 0, .2},
         {"mobilised", .05, .8, .2, 0, 1, true},
         {"carried", .05, 3, 1.2, 0, 100},
         {"lugs", 12, 32, 24, 0, 1000}}},
       [](E e, P p, S at) {
         const double s = driving(at);
         const double share = p[0] / e.wheel.radius_m;
         e.rim_factor *= 1 + share / 2;
         e.lug_height_m = p[0];
         // the tips slip more than the rim that slip is told of; in skid the soil holds them back
         const double tips =
             at.slip < 0 ? at.slip + share / 2 : 1 - (1 - at.slip) / (1 + share / 2);
         e.lug_share = p[1] * std::copysign(1 - std::exp(-5 * std::abs(tips)), tips);
         e.lug_pressed = 1;
         e.lugs = p[3];
         e.sinkage_added_m += p[2] * p[0] * s / (1 - s / 2);
         e.side_undisturbed = true;
         e.soil.lambda = std::clamp(e.soil.lambda + share * s, 0.0, 1.5);
         return e;
       }},
      {{"flexible_wheel",
        "substitute_circle",
        "r = r0 (1 + k W)",
        "Bekker 1960; Schmid 1995",
        {{"per_n", 1e-4, 5e-3, 1e-3, 0, 1}}},
       [](E e, P p, S at) {
         e.wheel.radius_m *= 1 + p[0] * at.load_n;
         return e;
       }},
      {{"sidewall_shear",
        "segment",
        "T += eta 2 r A (c + gamma h tan(phi)/2), A the flank's segment",
        "proxy; Gee-Clough 1976",
        {{"eta", .2, 1, .5, 0, 100}}},
       [](E e, P p, S) {
         e.flank_shear += p[0];
         return e;
       }},
      {{"bearing_drag",
        "linear",
        "T += (T0 + T1 W + T2 |w|) sgn(w)",
        "friction of bearings and gears",
        {{"t0_nm", 0, .2, .05, 0, 1e6},
         {"t1_m", 0, 2e-3, 5e-4, 0, 1000},
         {"t2_nms", 0, .05, 0, 0, 1e6}}},
       [](E e, P p, S at) {
         const double rate = std::abs(at.rim_speed_mps) / e.wheel.radius_m;
         e.drag_torque_nm += p[0] + p[1] * at.load_n + p[2] * rate;
         return e;
       }},
      {{"load_transfer",
        "proportional",
        "W = W0 (1 + k)",
        "statics",
        {{"share", -.2, .2, .08, -.99, 100}}},
       [](E e, P p, S) {
         e.load_n *= 1 + p[0];
         return e;
       }},
      {{"load_transfer", "offset", "W = W0 + dW", "statics", {{"added_n", -10, 10, 4, -1e6, 1e6}}},
       [](E e, P p, S) {
         e.load_n += p[0];
         return e;
       }},
      {{"load_transfer",
        "affine",
        "W = W0 (1 + k) + dW",
        "statics: a load cell whose gain and zero are off",
        {{"share", -.2, .2, .08, -.99, 100}, {"added_n", -10, 10, 4, -1e6, 1e6}}},
       [](E e, P p, S) {
         e.load_n += p[0] * e.load_n + p[1];
         return e;
       }},
      {{"load_transfer",
        "drawbar",
        "W = W0 + k Fx",
        "statics: the arm of a carriage that is not level",
        {{"share", -.3, .3, .1, -1, 1}}},
       [](E e, P p, S) {
         e.load_per_drawbar += p[0];
         return e;
       }},
      {{"load_transfer",
        "drifting",
        "W = W0 max(0, 1 + a (t - t0)+)",
        "statics: a load cell that drifts",
        {{"per_s", -1e-5, 1e-5, 1e-6, -10, 10}, {"first_time_s", 0, 1e6, 0, -1e12, 1e12}}},
       [](E e, P p, S at) {
         e.load_n *= std::max(0.0, 1 + p[0] * std::max(0.0, at.conditions.time_s - p[1]));
         return e;
       }},
      {{"load_transfer",
        "for_a_time",
        "from <= time <= to: W = W0 (1 + k)",
        "statics: a load cell that was set anew",
        {{"from_s", 0, 1e6, 0, -1e12, 1e12},
         {"to_s", 0, 1e6, 8.64e4, -1e12, 1e12},
         {"share", -.2, .2, .08, -.99, 100}}},
       [](E e, P p, S at) {
         const double time_s = at.conditions.time_s;
         if (time_s >= p[0] && time_s <= p[1]) e.load_n *= 1 + p[2];
         return e;
       }},
      {{"slip_scale",
        "rim_speed",
        "true rim speed = (1 + e) times the one told",
        "rolling radius or encoder",
        {{"error", -.12, .12, .03, -.9, 10}}},
       [](E e, P p, S) {
         e.rim_factor *= 1 + p[0];
         return e;
       }},
      {{"slope_tilt",
        "gravity",
        "Fx -= W sin(a) cos(heading - d), Fy likewise along y",
        "statics",
        {{"tilt_rad", .005, .05, .02, -1.5, 1.5}, {"direction_rad", -3.1, 3.1, 0, -6.3, 6.3}}},
       [](E e, P p, S at) {
         const double towards = at.conditions.heading_rad - p[1];
         e.tilt_x -= std::sin(p[0]) * std::cos(towards);
         e.tilt_y -= std::sin(p[0]) * std::sin(towards);
         return e;
       }},
  };
}
// NOLINTEND(bugprone-easily-swappable-parameters, readability-function-size)

}  // namespace regoplan::mechanism_catalogue
