#pragma once

#include <string>
#include <vector>

#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// One curve of a figure: forces at steps of slip ratio or slip angle.
struct FigureCurve {
  struct Point {
    double slip_ratio, slip_angle_deg;
    double fx_n, fy_n;
  };
  std::string label;
  bool of_constant_slip = false;  ///< else of constant slip angle
  std::vector<Point> points;
};

/// The model's curves of Figs. 6, 7 and 10 of Yoshida & Ishigami (2004), as plain data.
struct PaperFigures {
  std::vector<FigureCurve> figure_6;   ///< Fy over slip, slip angles 4 to 16 deg
  std::vector<FigureCurve> figure_7;   ///< Fx against Fy, at constant slip angle and constant slip
  std::vector<FigureCurve> figure_10;  ///< Fy over the slips of the experiment, one a slip angle
};

/// The paper's wheel on Lunar Regolith Simulant: variant yoshida2004, Table I in consistent units,
/// and what the table leaves open (a0, a1, lambda, density) as in the authors' paper of 2007.
WheelModelSpec paper_model();

/// The load of the paper's figures, 6.6 kg on Earth.
inline constexpr double kPaperLoad_n = 64.7;

PaperFigures paper_figures();

}  // namespace regoplan
