#include "app/wheel/wheel_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "terramech/wheel/paper_figures.h"

namespace regoplan {
namespace {

struct Axis {
  std::string label;
  double FigureCurve::Point::*value;
  double low, high, tick;  // high and low are multiples of tick
};

/// Ends and ticks that hold all values, zero among them.
Axis axis_over(std::string label, double FigureCurve::Point::*value,
               const std::vector<FigureCurve>& curves) {
  double low = 0, high = 0;
  for (const FigureCurve& curve : curves) {
    for (const auto& point : curve.points) {
      low = std::min(low, point.*value);
      high = std::max(high, point.*value);
    }
  }
  const double rough = (high - low) / 5;
  const double decade = std::pow(10, std::floor(std::log10(rough)));
  double tick = 10 * decade;
  for (const double step : {5.0, 2.0, 1.0}) {
    if (step * decade >= rough) tick = step * decade;
  }
  const double rounding = 1e-9;
  return {.label = std::move(label),
          .value = value,
          .low = std::floor(low / tick + rounding) * tick,
          .high = std::ceil(high / tick - rounding) * tick,
          .tick = tick};
}

/// Where a panel stands on the page, in pixels.
struct Box {
  double left, top, width, height;
};

constexpr std::array kColours{"#1b6ca8", "#d1661c", "#2f8f4e", "#8a3fa0"};

std::string curve_svg(const FigureCurve& curve, std::string_view colour, const Axis& x,
                      const Axis& y, const Box& box) {
  const auto px = [&](double v) { return box.left + (v - x.low) / (x.high - x.low) * box.width; };
  const auto py = [&](double v) {
    return box.top + box.height - (v - y.low) / (y.high - y.low) * box.height;
  };
  std::string path;
  for (const auto& point : curve.points) {
    path += fmt::format("{:.1f},{:.1f} ", px(point.*x.value), py(point.*y.value));
  }
  std::string svg =
      fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="{}"{}/>)"
                  "\n",
                  path, colour, curve.of_constant_slip ? 1 : 2,
                  curve.of_constant_slip ? R"( stroke-dasharray="4 3")" : "");
  if (curve.of_constant_slip) {
    const auto& end = curve.points.back();
    svg += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle" fill="#666">{}</text>)"
                       "\n",
                       px(end.*x.value), py(end.*y.value) - 6, curve.label);
  }
  return svg;
}

std::string axes_svg(const Axis& x, const Axis& y, const Box& box) {
  std::string svg =
      fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#333"/>)"
                  "\n",
                  box.left, box.top, box.width, box.height);
  const auto ticks = [](const Axis& axis) {
    return static_cast<int>(std::lround((axis.high - axis.low) / axis.tick));
  };
  for (int i = 0; i <= ticks(x); ++i) {
    const double at = box.left + box.width * i / ticks(x);
    svg += fmt::format(R"(<line x1="{0:.1f}" y1="{1}" x2="{0:.1f}" y2="{2}" stroke="#ddd"/>)"
                       R"(<text x="{0:.1f}" y="{3}" text-anchor="middle">{4:.6g}</text>)"
                       "\n",
                       at, box.top, box.top + box.height, box.top + box.height + 16,
                       x.low + i * x.tick + 0.0);
  }
  for (int i = 0; i <= ticks(y); ++i) {
    const double at = box.top + box.height - box.height * i / ticks(y);
    svg += fmt::format(R"(<line x1="{1}" y1="{0:.1f}" x2="{2}" y2="{0:.1f}" stroke="#ddd"/>)"
                       R"(<text x="{3}" y="{4:.1f}" text-anchor="end">{5:.6g}</text>)"
                       "\n",
                       at, box.left, box.left + box.width, box.left - 6, at + 4,
                       y.low + i * y.tick + 0.0);
  }
  svg += fmt::format(
      R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)"
      R"svg(<text transform="translate({},{}) rotate(-90)" text-anchor="middle">{}</text>)svg"
      "\n",
      box.left + box.width / 2, box.top + box.height + 36, x.label, box.left - 44,
      box.top + box.height / 2, y.label);
  return svg;
}

std::string page(double width, double height, std::string_view title, std::string_view content) {
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" )"
      R"(font-family="Helvetica, Arial, sans-serif" font-size="12">)"
      "\n"
      R"(<rect width="100%" height="100%" fill="white"/>)"
      "\n"
      R"(<text x="20" y="24" font-size="14" font-weight="bold">{2}</text>)"
      "\n"
      R"(<text x="20" y="42" fill="#666">yoshida2004, r 0.09 m, b 0.10 m, {3} N on )"
      R"(Lunar Regolith Simulant</text>)"
      "\n{4}</svg>\n",
      width, height, title, kPaperLoad_n, content);
}

/// All curves in one panel, those of constant slip angle named in a legend.
std::string one_panel(std::string_view title, const std::vector<FigureCurve>& curves, const Axis& x,
                      const Axis& y) {
  constexpr Box kBox{.left = 70, .top = 60, .width = 480, .height = 340};
  std::string svg = axes_svg(x, y, kBox);
  std::size_t colour = 0;
  double legend_y = kBox.top + 14;
  for (const FigureCurve& curve : curves) {
    if (curve.of_constant_slip) {
      svg += curve_svg(curve, "#888", x, y, kBox);
      continue;
    }
    const std::string_view stroke = kColours[colour++ % kColours.size()];
    svg += curve_svg(curve, stroke, x, y, kBox);
    const double at = kBox.left + kBox.width + 16;
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
                            const Axis& x, const Axis& y) {
  std::string svg;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::size_t row = i / 2, column = i % 2;
    const Box box{.left = 70 + 320 * static_cast<double>(column),
                  .top = 72 + 260 * static_cast<double>(row),
                  .width = 230,
                  .height = 180};
    svg += axes_svg(x, y, box) + curve_svg(curves[i], kColours[i % kColours.size()], x, y, box);
    svg += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">slip angle {}</text>)"
                       "\n",
                       box.left + box.width / 2, box.top - 6, curves[i].label);
  }
  return page(650, 590, title, svg);
}

std::string csv(const std::vector<FigureCurve>& curves) {
  std::string text = "curve,slip_ratio,slip_angle_deg,fx_n,fy_n,fc_n,fb_n\n";
  for (const FigureCurve& curve : curves) {
    for (const auto& point : curve.points) {
      const double beta = point.slip_angle_deg * std::numbers::pi / 180;
      text += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", curve.label,
                          point.slip_ratio, point.slip_angle_deg, point.fx_n, point.fy_n,
                          point.fx_n * std::sin(beta) + point.fy_n * std::cos(beta),
                          point.fx_n * std::cos(beta) - point.fy_n * std::sin(beta));
    }
  }
  return text;
}

}  // namespace

std::vector<RenderedFile> render_wheel_figures() {
  const PaperFigures figures = paper_figures();
  using Point = FigureCurve::Point;
  const auto slip = [](const auto& curves) {
    return axis_over("slip ratio s", &Point::slip_ratio, curves);
  };
  const auto side = [](const auto& curves) {
    return axis_over("lateral force Fy [N]", &Point::fy_n, curves);
  };
  return {
      {.name = "figure-6.svg",
       .content = one_panel("Fig. 6: lateral force over slip ratio", figures.figure_6,
                            slip(figures.figure_6), side(figures.figure_6))},
      {.name = "figure-6.csv", .content = csv(figures.figure_6)},
      {.name = "figure-7.svg",
       .content = one_panel("Fig. 7: longitudinal against lateral force (dashed: constant slip)",
                            figures.figure_7,
                            axis_over("longitudinal force Fx [N]", &Point::fx_n, figures.figure_7),
                            side(figures.figure_7))},
      {.name = "figure-7.csv", .content = csv(figures.figure_7)},
      {.name = "figure-10.svg",
       .content =
           small_multiples("Fig. 10: the theoretical curves of the experiments", figures.figure_10,
                           slip(figures.figure_10), side(figures.figure_10))},
      {.name = "figure-10.csv", .content = csv(figures.figure_10)}};
}

}  // namespace regoplan
