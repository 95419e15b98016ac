#include "app/evaluate/chart_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/page/report_page.h"
#include "app/page/svg_panel.h"
#include "terramech/basics/angles.h"
#include "terramech/tables/csv_cells.h"

namespace regoplan {
namespace {

std::string titled_axes(const SvgPanel& p, std::string_view title) {
  return axes_svg(p) + fmt::format(R"(<text x="{}" y="{}" font-weight="bold">{}</text>)"
                                   "\n",
                                   p.left, p.top - 10, html_escaped(title));
}

/// The end of the steering, the smallest margin: what no line may cross.
constexpr SvgStroke kLimit{.colour = "#999", .dashes = "1 3", .width = 1.5};

constexpr std::array kColours{"#0072b2", "#c2570c", "#00795a", "#8a3fa0", "#1b1f23", "#b59f00"};
constexpr std::array kDashes{"none", "7 4", "2 3", "9 3 2 3"};

std::string_view colour_of(int soil) {
  return kColours[static_cast<std::size_t>(soil) % kColours.size()];
}

std::string curvature_panel(const ChartSettings& settings, const FeasibilityChart& chart) {
  double highest = 0;
  for (const SafeCurvature& at : chart.curvatures) highest = std::max(highest, at.curvature_1pm);
  const SvgPanel p{.left = 70,
                   .top = 84,
                   .width = 430,
                   .height = 330,
                   .x = axis_over("speed [m/s]", 0, *std::ranges::max_element(settings.speeds_mps)),
                   .y = axis_over("largest safe path curvature [1/m]", 0, highest)};
  std::string svg = titled_axes(p, "Turns: safe below the line");
  svg += line_svg(p,
                  {{p.x.low, settings.vehicle.curvature_max_1pm},
                   {p.x.high, settings.vehicle.curvature_max_1pm}},
                  kLimit);
  std::vector<SvgPoint> line;
  for (std::size_t i = 0; i < chart.curvatures.size(); ++i) {
    const SafeCurvature& at = chart.curvatures[i];
    line.push_back({at.speed_mps, at.curvature_1pm});
    const bool last = i + 1 == chart.curvatures.size() || chart.curvatures[i + 1].soil != at.soil ||
                      chart.curvatures[i + 1].slope_rad != at.slope_rad;
    if (!last) continue;
    const auto slope = static_cast<std::size_t>(
        std::ranges::find(settings.slopes_rad, at.slope_rad) - settings.slopes_rad.begin());
    svg += line_svg(p, line,
                    {.colour = colour_of(at.soil), .dashes = kDashes.at(slope % kDashes.size())});
    line.clear();
  }
  return svg;
}

std::string slope_panel(const ChartSettings& settings, const FeasibilityChart& chart) {
  const double steepest = degrees(chart.side_slopes.back().slope_rad);
  const SvgPanel p{.left = 590,
                   .top = 84,
                   .width = 300,
                   .height = 330,
                   .x = axis_over("side slope [deg]", 0, steepest),
                   .y = {"smallest stability margin", -0.2, 0.8, 0.2}};
  std::string svg = titled_axes(p, "Straight across a slope");
  svg += line_svg(
      p, {{p.x.low, settings.limits.margin_min}, {p.x.high, settings.limits.margin_min}}, kLimit);
  std::vector<SvgPoint> line;
  for (std::size_t i = 0; i < chart.side_slopes.size(); ++i) {
    const SideSlope& at = chart.side_slopes[i];
    line.push_back({degrees(at.slope_rad), std::min({at.cornering, at.tip_over, at.traction})});
    const bool last = i + 1 == chart.side_slopes.size() || chart.side_slopes[i + 1].soil != at.soil;
    if (!last) continue;
    svg += line_svg(p, line, {.colour = colour_of(at.soil)});
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
  const std::string content = fmt::format(
      R"(<text x="20" y="26" font-size="15" font-weight="bold">What {0} may drive</text>)"
      "\n"
      R"(<text x="20" y="46" fill="#666">gravity {1:g} m/s2; mean soils; margins of cornering, )"
      R"(tip-over and traction at least {2:g}; slip angle to {3:.3g} deg, slip to {4:g}, sinkage to )"
      R"({5:.3g} m</text>)"
      "\n{6}{7}{8}",
      html_escaped(settings.vehicle.name), settings.gravity_mps2, settings.limits.margin_min,
      degrees(settings.limits.slip_angle_max_rad), settings.limits.slip_max,
      settings.limits.sinkage_max_m, curvature_panel(settings, chart), slope_panel(settings, chart),
      legend(settings, chart));
  return svg_picture(920, 480 + 20 * static_cast<double>(rows), content);
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
