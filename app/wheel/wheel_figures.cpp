#include "app/wheel/wheel_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <string>

#include "app/page/svg_panel.h"
#include "terramech/wheel/cornering_force.h"
#include "terramech/wheel/paper_figures.h"

namespace regoplan {
namespace {

/// What of a curve's points is drawn.
struct Drawn {
  double FigureCurve::Point::*x;
  double FigureCurve::Point::*y;
};

SvgAxis axis_of(std::string label, double FigureCurve::Point::*value,
                const std::vector<FigureCurve>& curves) {
  double low = 0, high = 0;
  for (const FigureCurve& curve : curves) {
    for (const auto& point : curve.points) {
      low = std::min(low, point.*value);
      high = std::max(high, point.*value);
    }
  }
  return axis_over(std::move(label), low, high);
}

constexpr std::array kColours{"#1b6ca8", "#d1661c", "#2f8f4e", "#8a3fa0"};

std::string curve_svg(const FigureCurve& curve, std::string_view colour, const Drawn& drawn,
                      const SvgPanel& panel) {
  std::vector<SvgPoint> points;
  for (const auto& point : curve.points) points.push_back({point.*drawn.x, point.*drawn.y});
  if (!curve.of_constant_slip) return line_svg(panel, points, {.colour = colour});
  return line_svg(panel, points, {.colour = colour, .dashes = "4 3", .width = 1}) +
         fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle" fill="#666">{}</text>)"
                     "\n",
                     panel.px(points.back().x), panel.py(points.back().y) - 6, curve.label);
}

std::string page(double width, double height, std::string_view title, std::string_view content) {
  return svg_picture(
      width, height,
      fmt::format(R"(<text x="20" y="24" font-size="14" font-weight="bold">{}</text>)"
                  "\n"
                  R"(<text x="20" y="42" fill="#666">yoshida2004, r 0.09 m, b 0.10 m, {} N on )"
                  R"(Lunar Regolith Simulant</text>)"
                  "\n{}",
                  title, kPaperLoad_n, content));
}

/// All curves in one panel, those of constant slip angle named in a legend.
std::string one_panel(std::string_view title, const std::vector<FigureCurve>& curves,
                      const Drawn& drawn, const SvgAxis& x, const SvgAxis& y) {
  const SvgPanel panel{.left = 70, .top = 60, .width = 480, .height = 340, .x = x, .y = y};
  std::string svg = axes_svg(panel);
  std::size_t colour = 0;
  double legend_y = panel.top + 14;
  for (const FigureCurve& curve : curves) {
    if (curve.of_constant_slip) {
      svg += curve_svg(curve, "#888", drawn, panel);
      continue;
    }
    const std::string_view stroke = kColours[colour++ % kColours.size()];
    svg += curve_svg(curve, stroke, drawn, panel);
    const double at = panel.left + panel.width + 16;
    svg +=
        fmt::format(R"(<line x1="{0}" y1="{1}" x2="{2}" y2="{1}" stroke="{3}" stroke-width="2"/>)"
                    R"(<text x="{4}" y="{5}">{6}</text>)"
                    "\n",
                    at, legend_y, at + 24, stroke, at + 30, legend_y + 4, curve.label);
    legend_y += 20;
  }
  return page(670, 460, title, svg);
}

/// A panel a curve, all with the same axes.
std::string small_multiples(std::string_view title, const std::vector<FigureCurve>& curves,
                            const Drawn& drawn, const SvgAxis& x, const SvgAxis& y) {
  std::string svg;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::size_t row = i / 2, column = i % 2;
    const SvgPanel panel{.left = 70 + 320 * static_cast<double>(column),
                         .top = 72 + 260 * static_cast<double>(row),
                         .width = 230,
                         .height = 180,
                         .x = x,
                         .y = y};
    svg += axes_svg(panel) + curve_svg(curves[i], kColours[i % kColours.size()], drawn, panel);
    svg += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">slip angle {}</text>)"
                       "\n",
                       panel.left + panel.width / 2, panel.top - 6, curves[i].label);
  }
  return page(650, 590, title, svg);
}

std::string csv(const std::vector<FigureCurve>& curves) {
  std::string text = "curve,slip_ratio,slip_angle_deg,fx_n,fy_n,fc_n,fb_n\n";
  for (const FigureCurve& curve : curves) {
    for (const auto& point : curve.points) {
      const TravelForces travel =
          travel_forces(point.fx_n, point.fy_n, point.slip_angle_deg * std::numbers::pi / 180);
      text += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", curve.label,
                          point.slip_ratio, point.slip_angle_deg, point.fx_n, point.fy_n,
                          travel.cornering_n, travel.drag_n);
    }
  }
  return text;
}

}  // namespace

std::vector<RenderedFile> render_wheel_figures() {
  const PaperFigures figures = paper_figures();
  using Point = FigureCurve::Point;
  constexpr Drawn kSide{&Point::slip_ratio, &Point::fy_n};
  const auto slip = [](const auto& curves) {
    return axis_of("slip ratio s", &Point::slip_ratio, curves);
  };
  const auto side = [](const auto& curves) {
    return axis_of("lateral force Fy [N]", &Point::fy_n, curves);
  };
  return {
      {.name = "figure-6.svg",
       .content = one_panel("Fig. 6: lateral force over slip ratio", figures.figure_6, kSide,
                            slip(figures.figure_6), side(figures.figure_6))},
      {.name = "figure-6.csv", .content = csv(figures.figure_6)},
      {.name = "figure-7.svg",
       .content = one_panel("Fig. 7: longitudinal against lateral force (dashed: constant slip)",
                            figures.figure_7, {&Point::fx_n, &Point::fy_n},
                            axis_of("longitudinal force Fx [N]", &Point::fx_n, figures.figure_7),
                            side(figures.figure_7))},
      {.name = "figure-7.csv", .content = csv(figures.figure_7)},
      {.name = "figure-10.svg",
       .content =
           small_multiples("Fig. 10: the theoretical curves of the experiments", figures.figure_10,
                           kSide, slip(figures.figure_10), side(figures.figure_10))},
      {.name = "figure-10.csv", .content = csv(figures.figure_10)}};
}

}  // namespace regoplan
