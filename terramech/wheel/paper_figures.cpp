#include "terramech/wheel/paper_figures.h"

#include <fmt/format.h>

#include <array>

#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr std::array kSlipAngles_deg{4.0, 8.0, 12.0, 16.0};

FigureCurve::Point point(const WheelModel& model, double slip, double angle_deg) {
  const WheelForces forces = model.forces(kPaperLoad_n, motion_at(slip, angle_deg * kDegree));
  return {
      .slip_ratio = slip, .slip_angle_deg = angle_deg, .fx_n = forces.fx_n, .fy_n = forces.fy_n};
}

FigureCurve over_slip(const WheelModel& model, double angle_deg, double slip_max) {
  constexpr int kSteps = 100;
  FigureCurve curve{.label = fmt::format("{:g} deg", angle_deg), .points = {}};
  for (int i = 0; i <= kSteps; ++i) {
    curve.points.push_back(point(model, slip_max * i / kSteps, angle_deg));
  }
  return curve;
}

FigureCurve over_slip_angle(const WheelModel& model, double slip) {
  constexpr int kSteps = 32;
  const double angle_max_deg = kSlipAngles_deg.back();
  FigureCurve curve{.label = fmt::format("s = {:g}", slip), .of_constant_slip = true, .points = {}};
  for (int i = 0; i <= kSteps; ++i) {
    curve.points.push_back(point(model, slip, angle_max_deg * i / kSteps));
  }
  return curve;
}

}  // namespace

WheelModelSpec paper_model() {
  return {.variant = WheelVariant::kYoshida2004,
          .wheel = {.radius_m = 0.09, .width_m = 0.10},
          .soil = {.cohesion_pa = 800,
                   .friction_angle_rad = 37.2 * kDegree,
                   .kc = 1.79e6,
                   .kphi = 1.95e6,  // printed in N/m^(n+1); N/m^(n+2) used (dimensions)
                   .n = 1,
                   .a0 = 0.40,
                   .a1 = 0.15,
                   .lambda = 0,
                   .density_kgpm3 = 1600,
                   .kx0_m = 0.004,  // printed "4 m"; mm used: at metres no shear is mobilised
                   .ky0_m = 0.045,  // printed "40-50 m"; mm used, the middle
                   .c0_m = 0.031}};
}

PaperFigures paper_figures() {
  const WheelModel model(paper_model());
  constexpr double kExperimentSlipMax = 0.7;
  PaperFigures figures;
  for (const double angle_deg : kSlipAngles_deg) {
    figures.figure_6.push_back(over_slip(model, angle_deg, 1));
    figures.figure_7.push_back(over_slip(model, angle_deg, 1));
    figures.figure_10.push_back(over_slip(model, angle_deg, kExperimentSlipMax));
  }
  for (const double slip : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    figures.figure_7.push_back(over_slip_angle(model, slip));
  }
  return figures;
}

}  // namespace regoplan
