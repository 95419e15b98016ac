#include "app/evaluate/chart_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/io/csv_cells.h"
#include "app/page/report_page.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

struct Axis {
  std::string label;
  double low, high, tick;
};

/// Ticks that are round, about five of them, from 0.
Axis axis_to(std::string label, double high) {
  const double rough = std::max(high, 1e-6) / 5;
  const double decade = std::pow(10, std::floor(std::log10(rough)));
  double tick = 10 * decade;
  for (const double step : {5.0, 2.0, 1.0}) {
    if (step * decade >= rough) tick = step * decade;
  }
  constexpr double kRounding = 1e-9;
  return {std::move(label), 0, std::ceil(high / tick - kRounding) * tick, tick};
}

/// A panel of the picture, in pixels.
struct Panel {
  double left, top, width, height;
  Axis x, y;

  double px(double v) const { return left + (v - x.low) / (x.high - x.low) * width; }
  double py(double v) const { return top + height - (v - y.low) / (y.high - y.low) * height; }
};

std::string frame_svg(const Panel& p, std::string_view title) {
  std::string svg;
  for (int i = 0; p.x.low + i * p.x.tick <= p.x.high + p.x.tick / 2; ++i) {
    const double v = p.x.low + i * p.x.tick;
    svg += fmt::format(R"(<line x1="{0:.1f}" y1="{1}" x2="{0:.1f}" y2="{2}" stroke="#ddd"/>)"
                       R"(<text x="{0:.1f}" y="{3}" text-anchor="middle">{4:.4g}</text>)"
                       "\n",
                       p.px(v), p.top, p.top + p.height, p.top + p.height + 16, v);
  }
  for (int i = 0; p.y.low + i * p.y.tick <= p.y.high + p.y.tick / 2; ++i) {
    const double v = p.y.low + i * p.y.tick;
    const double shown = std::abs(v) < 1e-9 ? 0 : v;
    svg += fmt::format(R"(<line x1="{1}" y1="{0:.1f}" x2="{2}" y2="{0:.1f}" stroke="#ddd"/>)"
                       R"(<text x="{3}" y="{4:.1f}" text-anchor="end">{5:.4g}</text>)"
                       "\n",
                       p.py(v), p.left, p.left + p.width, p.left - 6, p.py(v) + 4, shown);
  }
  return svg +
         fmt::format(
             R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#333"/>)"
             R"(<text x="{}" y="{}" font-weight="bold">{}</text>)"
             R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)"
             R"svg(<text transform="translate({},{}) rotate(-90)" text-anchor="middle">{}</text>)svg"
             "\n",
             p.left, p.top, p.width, p.height, p.left, p.top - 10, html_escaped(title),
             p.left + p.width / 2, p.top + p.height + 36, p.x.label, p.left - 48,
             p.top + p.height / 2, p.y.label);
}

struct Place {
  double x, y;
};

std::string line_svg(const Panel& p, const std::vector<Place>& places, std::string_view colour,
                     std::string_view dashes, double width = 2) {
  std::string points;
  for (const Place& place : places) {
    points +=
        fmt::format("{:.1f},{:.1f} ", p.px(place.x), p.py(std::clamp(place.y, p.y.low, p.y.high)));
  }
  return fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="{}")"
                     R"( stroke-dasharray="{}"/>)"
                     "\n",
                     points, colour, width, dashes);
}

constexpr std::array kColours{"#0072b2", "#c2570c", "#00795a", "#8a3fa0", "#1b1f23", "#b59f00"};
constexpr std::array kDashes{"none", "7 4", "2 3", "9 3 2 3"};

std::string_view colour_of(int soil) {
  return kColours[static_cast<std::size_t>(soil) % kColours.size()];
}

std::string curvature_panel(const ChartSettings& settings, const FeasibilityChart& chart) {
  double highest = 0;
  for (const SafeCurvature& at : chart.curvatures) highest = std::max(highest, at.curvature_1pm);
  const Panel p{.left = 70,
                .top = 84,
                .width = 430,
                .height = 330,
                .x = axis_to("speed [m/s]", *std::ranges::max_element(settings.speeds_mps)),
                .y = axis_to("largest safe path curvature [1/m]", highest)};
  std::string svg = frame_svg(p, "Turns: safe below the line");
  svg += line_svg(p,
                  {{p.x.low, settings.vehicle.curvature_max_1pm},
                   {p.x.high, settings.vehicle.curvature_max_1pm}},
                  "#999", "1 3", 1.5);
  std::vector<Place> line;
  for (std::size_t i = 0; i < chart.curvatures.size(); ++i) {
    const SafeCurvature& at = chart.curvatures[i];
    line.push_back({at.speed_mps, at.curvature_1pm});
    const bool last = i + 1 == chart.curvatures.size() || chart.curvatures[i + 1].soil != at.soil ||
                      chart.curvatures[i + 1].slope_rad != at.slope_rad;
    if (!last) continue;
    const auto slope = static_cast<std::size_t>(
        std::ranges::find(settings.slopes_rad, at.slope_rad) - settings.slopes_rad.begin());
    svg += line_svg(p, line, colour_of(at.soil), kDashes.at(slope % kDashes.size()));
    line.clear();
  }
  return svg;
}

std::string slope_panel(const ChartSettings& settings, const FeasibilityChart& chart) {
  const double steepest = degrees(chart.side_slopes.back().slope_rad);
  Panel p{.left = 590,
          .top = 84,
          .width = 300,
          .height = 330,
          .x = axis_to("side slope [deg]", steepest),
          .y = {"smallest stability margin", -0.2, 0.8, 0.2}};
  std::string svg = frame_svg(p, "Straight across a slope");
  svg +=
      line_svg(p, {{p.x.low, settings.limits.margin_min}, {p.x.high, settings.limits.margin_min}},
               "#999", "1 3", 1.5);
  svg +=
      fmt::format(R"(<text x="{:.1f}" y="{:.1f}" fill="#666">smallest margin allowed, {:g}</text>)"
                  "\n",
                  p.left + 6, p.py(settings.limits.margin_min) - 5, settings.limits.margin_min);
  std::vector<Place> line;
  for (std::size_t i = 0; i < chart.side_slopes.size(); ++i) {
    const SideSlope& at = chart.side_slopes[i];
    line.push_back({degrees(at.slope_rad), std::min({at.cornering, at.tip_over, at.traction})});
    const bool last = i + 1 == chart.side_slopes.size() || chart.side_slopes[i + 1].soil != at.soil;
    if (!last) continue;
    svg += line_svg(p, line, colour_of(at.soil), "none");
    line.clear();
  }
  return svg;
}

std::string legend(const ChartSettings& settings, const FeasibilityChart& chart) {
  std::string svg;
  double y = 470;
  const std::vector<double> limits = side_slope_limits_rad(chart, settings);
  const auto entry = [&](double x, std::string_view colour, std::string_view dashes,
                         std::string_view text) {
    svg += fmt::format(R"(<line x1="{0}" y1="{1}" x2="{2}" y2="{1}" stroke="{3}" stroke-width="2")"
                       R"( stroke-dasharray="{4}"/><text x="{5}" y="{6}">{7}</text>)"
                       "\n",
                       x, y, x + 34, colour, dashes, x + 42, y + 4, html_escaped(text));
  };
  for (std::size_t i = 0; i < settings.soils.size(); ++i, y += 20) {
    entry(70, colour_of(static_cast<int>(i)), "none",
          fmt::format("{}: side slopes safe {}", settings.soils[i].name,
                      std::isnan(limits[i]) ? "nowhere"
                                            : fmt::format("up to {:.0f} deg", degrees(limits[i]))));
  }
  y = 470;
  for (std::size_t i = 0; i < settings.slopes_rad.size(); ++i, y += 20) {
    entry(590, "#333", kDashes.at(i % kDashes.size()),
          fmt::format("turns on ground that rises {:g} deg to one side",
                      std::round(degrees(settings.slopes_rad[i]) * 1e6) / 1e6));
  }
  entry(590, "#999", "1 3", "end of the steering; smallest margin allowed");
  return svg;
}

std::string picture(const ChartSettings& settings, const FeasibilityChart& chart) {
  const std::size_t rows = std::max(settings.soils.size(), settings.slopes_rad.size() + 1);
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 920 {0}" width="920" height="{0}" )"
      R"(font-family="Helvetica, Arial, sans-serif" font-size="12">)"
      "\n"
      R"(<rect width="100%" height="100%" fill="white"/>)"
      "\n"
      R"(<text x="20" y="26" font-size="15" font-weight="bold">What {1} may drive</text>)"
      "\n"
      R"(<text x="20" y="46" fill="#666">gravity {2:g} m/s2; mean soils; margins of cornering, )"
      R"(tip-over and traction at least {3:g}; slip angle to {4:.3g} deg, slip to {5:g}, sinkage to )"
      R"({6:.3g} m</text>)"
      "\n{7}{8}{9}</svg>\n",
      480 + 20 * rows, html_escaped(settings.vehicle.name), settings.gravity_mps2,
      settings.limits.margin_min, degrees(settings.limits.slip_angle_max_rad),
      settings.limits.slip_max, settings.limits.sinkage_max_m, curvature_panel(settings, chart),
      slope_panel(settings, chart), legend(settings, chart));
}

}  // namespace

std::vector<std::string> chart_file_names() {
  return {"feasibility.svg", "safe-curvature.csv", "side-slope.csv"};
}

std::vector<RenderedFile> render_chart(const ChartSettings& settings,
                                       const FeasibilityChart& chart) {
  const auto soil_name = [&](int soil) {
    return own_text_cell(settings.soils[static_cast<std::size_t>(soil)].name);
  };
  std::string curvatures =
      "soil,slope_deg,speed_mps,curvature_max_1pm,radius_min_m,centrifugal_per_weight,limited_by\n";
  for (const SafeCurvature& at : chart.curvatures) {
    curvatures += fmt::format(
        "{},{:.6g},{},{:.5g},{},{:.4g},{}\n", soil_name(at.soil), degrees(at.slope_rad),
        number_cell(at.speed_mps), at.curvature_1pm,
        at.curvature_1pm > 0 ? fmt::format("{:.5g}", 1 / at.curvature_1pm) : std::string(),
        at.speed_mps * at.speed_mps * at.curvature_1pm / settings.gravity_mps2, at.limit);
  }
  std::string slopes = "soil,slope_deg,cornering_margin,tip_over_margin,traction_margin,margin\n";
  for (const SideSlope& at : chart.side_slopes) {
    slopes += fmt::format("{},{:.6g},{:.5g},{:.5g},{:.5g},{:.5g}\n", soil_name(at.soil),
                          degrees(at.slope_rad), at.cornering, at.tip_over, at.traction,
                          std::min({at.cornering, at.tip_over, at.traction}));
  }
  return {{.name = "feasibility.svg", .content = picture(settings, chart)},
          {.name = "safe-curvature.csv", .content = std::move(curvatures)},
          {.name = "side-slope.csv", .content = std::move(slopes)}};
}

}  // namespace regoplan
