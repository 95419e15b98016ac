#include "app/evaluate/chart_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

/// What is drawn for one soil, on ground of one slope.
struct Curve {
  int soil = 0;
  std::size_t slope = 0;  ///< index in the settings' slopes; 0 where the slope is the axis
  std::vector<SvgPoint> points;
};

/// Curves that lie upon each other all along: one line stands for them. There are many where the
/// steering or tipping over ends what soils would bear.
using SharedLine = std::vector<Curve>;

bool coincide(const SvgPanel& p, const Curve& a, const Curve& b) {
  constexpr double kTellApart_px = 0.5;
  return std::ranges::equal(a.points, b.points, [&](const SvgPoint& at_a, const SvgPoint& at_b) {
    return at_a.x == at_b.x && std::abs(p.py(at_a.y) - p.py(at_b.y)) < kTellApart_px;
  });
}

std::vector<SharedLine> shared_lines(const SvgPanel& p, const std::vector<Curve>& curves) {
  std::vector<SharedLine> lines;
  for (const Curve& curve : curves) {
    const auto same = std::ranges::find_if(
        lines, [&](const SharedLine& line) { return coincide(p, line.front(), curve); });
    if (same == lines.end()) {
      lines.push_back({curve});
    } else {
      same->push_back(curve);
    }
  }
  return lines;
}

/// The colour of its soil and the dashes of its slope; several of either have one of their own.
SvgStroke stroke_of(const SharedLine& line) {
  const Curve& first = line.front();
  const bool of_one_soil =
      std::ranges::all_of(line, [&](const Curve& curve) { return curve.soil == first.soil; });
  const bool of_one_slope =
      std::ranges::all_of(line, [&](const Curve& curve) { return curve.slope == first.slope; });
  return {.colour = of_one_soil ? colour_of(first.soil) : "#666",
          .dashes = of_one_slope ? kDashes.at(first.slope % kDashes.size()) : "none",
          .width = of_one_soil && of_one_slope ? 2.0 : 3.0};
}

/// A panel with its curves, and the lines that stand for several of them, as they are numbered.
struct DrawnPanel {
  std::string svg;
  std::vector<SharedLine> numbered;
};

/// \param numbered_before lines of other panels
void draw_curves(DrawnPanel& panel, const SvgPanel& p, const std::vector<Curve>& curves,
                 std::size_t numbered_before) {
  constexpr double kNumber_px = 12;
  std::vector<double> numbers_at_px;
  for (SharedLine& line : shared_lines(p, curves)) {
    panel.svg += line_svg(p, line.front().points, stroke_of(line));
    if (line.size() == 1) continue;
    double at_px = std::clamp(p.py(line.front().points.back().y), p.top, p.top + p.height) + 4;
    const auto taken = [&](double other_px) { return std::abs(other_px - at_px) < kNumber_px; };
    while (std::ranges::any_of(numbers_at_px, taken)) at_px -= kNumber_px;
    numbers_at_px.push_back(at_px);
    panel.numbered.push_back(std::move(line));
    panel.svg += fmt::format(R"(<text x="{}" y="{:.1f}" font-weight="bold">{}</text>)"
                             "\n",
                             p.left + p.width + 5, at_px, numbered_before + panel.numbered.size());
  }
}

DrawnPanel curvature_panel(const ChartSettings& settings, const FeasibilityChart& chart) {
  double highest = 0;
  for (const SafeCurvature& at : chart.curvatures) highest = std::max(highest, at.curvature_1pm);
  const SvgPanel p{.left = 70,
                   .top = 84,
                   .width = 430,
                   .height = 330,
                   .x = axis_over("speed [m/s]", 0, *std::ranges::max_element(settings.speeds_mps)),
                   .y = axis_over("largest safe path curvature [1/m]", 0, highest)};
  DrawnPanel panel{.svg = titled_axes(p, "Turns: safe below the line"), .numbered = {}};
  panel.svg += line_svg(p,
                        {{p.x.low, settings.vehicle.curvature_max_1pm},
                         {p.x.high, settings.vehicle.curvature_max_1pm}},
                        kLimit);
  std::vector<Curve> curves;
  for (const SafeCurvature& at : chart.curvatures) {
    const auto slope = static_cast<std::size_t>(
        std::ranges::find(settings.slopes_rad, at.slope_rad) - settings.slopes_rad.begin());
    if (curves.empty() || curves.back().soil != at.soil || curves.back().slope != slope) {
      curves.push_back({.soil = at.soil, .slope = slope, .points = {}});
    }
    curves.back().points.push_back({at.speed_mps, at.curvature_1pm});
  }
  draw_curves(panel, p, curves, 0);
  return panel;
}

DrawnPanel slope_panel(const ChartSettings& settings, const FeasibilityChart& chart,
                       std::size_t numbered_before) {
  const double steepest = degrees(chart.side_slopes.back().slope_rad);
  const SvgPanel p{.left = 590,
                   .top = 84,
                   .width = 300,
                   .height = 330,
                   .x = axis_over("side slope [deg]", 0, steepest),
                   .y = {"smallest stability margin", -0.2, 0.8, 0.2}};
  DrawnPanel panel{.svg = titled_axes(p, "Straight across a slope"), .numbered = {}};
  panel.svg += line_svg(
      p, {{p.x.low, settings.limits.margin_min}, {p.x.high, settings.limits.margin_min}}, kLimit);
  std::vector<Curve> curves;
  for (const SideSlope& at : chart.side_slopes) {
    if (curves.empty() || curves.back().soil != at.soil) {
      curves.push_back({.soil = at.soil, .slope = 0, .points = {}});
    }
    curves.back().points.push_back(
        {degrees(at.slope_rad), std::min({at.cornering, at.tip_over, at.traction})});
  }
  draw_curves(panel, p, curves, numbered_before);
  return panel;
}

std::string slope_text(double slope_rad) {
  return fmt::format("{:g}", std::round(degrees(slope_rad) * 1e6) / 1e6);
}

/// One row of the legend.
struct LegendEntry {
  double x_px = 0, y_px = 0;
  SvgStroke stroke;
  std::string text;
};

std::string entry_svg(const LegendEntry& entry) {
  return fmt::format(R"(<line x1="{0}" y1="{1}" x2="{2}" y2="{1}" stroke="{3}" stroke-width="{4}")"
                     R"( stroke-dasharray="{5}"/><text x="{6}" y="{7}">{8}</text>)"
                     "\n",
                     entry.x_px, entry.y_px, entry.x_px + 34, entry.stroke.colour,
                     entry.stroke.width, entry.stroke.dashes, entry.x_px + 42, entry.y_px + 4,
                     html_escaped(entry.text));
}

constexpr double kLegendTop_px = 470, kLegendRow_px = 20;
constexpr double kLegendLeft_px = 70, kLegendRight_px = 590;

std::string legend(const ChartSettings& settings, const FeasibilityChart& chart) {
  std::string svg;
  const std::vector<double> limits = side_slope_limits_rad(chart, settings);
  double y_px = kLegendTop_px;
  for (std::size_t i = 0; i < settings.soils.size(); ++i, y_px += kLegendRow_px) {
    svg += entry_svg(
        {kLegendLeft_px,
         y_px,
         {.colour = colour_of(static_cast<int>(i))},
         fmt::format("{}: side slopes safe {}", settings.soils[i].name,
                     std::isnan(limits[i]) ? "nowhere"
                                           : fmt::format("up to {:.0f} deg", degrees(limits[i])))});
  }
  y_px = kLegendTop_px;
  for (std::size_t i = 0; i < settings.slopes_rad.size(); ++i, y_px += kLegendRow_px) {
    svg += entry_svg({kLegendRight_px,
                      y_px,
                      {.colour = "#333", .dashes = kDashes.at(i % kDashes.size())},
                      fmt::format("turns on ground that rises {} deg to one side",
                                  slope_text(settings.slopes_rad[i]))});
  }
  return svg + entry_svg({kLegendRight_px,
                          y_px,
                          {.colour = "#999", .dashes = "1 3"},
                          "end of the steering; smallest margin allowed"});
}

/// Which curves a numbered line stands for: its soils, a row for each slope.
std::vector<std::string> names_of(const ChartSettings& settings, const SharedLine& line,
                                  bool of_turns) {
  std::vector<std::string> rows;
  for (std::size_t slope = 0; slope < settings.slopes_rad.size(); ++slope) {
    std::vector<std::string> soils;
    for (const Curve& curve : line) {
      if (curve.slope != slope) continue;
      soils.push_back(settings.soils[static_cast<std::size_t>(curve.soil)].name);
    }
    if (soils.empty()) continue;
    rows.push_back(fmt::format("{}{}", fmt::join(soils, ", "),
                               of_turns ? fmt::format(", turns on ground that rises {} deg",
                                                      slope_text(settings.slopes_rad[slope]))
                                        : ", straight across a slope"));
  }
  return rows;
}

struct LegendOfLines {
  std::string svg;
  double bottom_px = 0;
};

LegendOfLines legend_of_lines(const ChartSettings& settings, const DrawnPanel& turns,
                              const DrawnPanel& slopes, double top_px) {
  LegendOfLines legend{.svg = {}, .bottom_px = top_px};
  std::size_t number = 0;
  const auto tell = [&](const SharedLine& line, bool of_turns) {
    std::string before = fmt::format("{} is one line for ", ++number);
    for (const std::string& names : names_of(settings, line, of_turns)) {
      legend.svg += entry_svg({kLegendLeft_px, legend.bottom_px, stroke_of(line), before + names});
      legend.bottom_px += kLegendRow_px;
      before = fmt::format("{} is also the line for ", number);
    }
  };
  for (const SharedLine& line : turns.numbered) tell(line, true);
  for (const SharedLine& line : slopes.numbered) tell(line, false);
  return legend;
}

std::string picture(const ChartSettings& settings, const FeasibilityChart& chart) {
  const std::size_t rows = std::max(settings.soils.size(), settings.slopes_rad.size() + 1);
  const DrawnPanel turns = curvature_panel(settings, chart);
  const DrawnPanel slopes = slope_panel(settings, chart, turns.numbered.size());
  const LegendOfLines lines = legend_of_lines(
      settings, turns, slopes, kLegendTop_px + kLegendRow_px * static_cast<double>(rows));
  const std::string content = fmt::format(
      R"(<text x="20" y="26" font-size="15" font-weight="bold">What {0} may drive</text>)"
      "\n"
      R"(<text x="20" y="46" fill="#666">gravity {1:g} m/s2; mean soils; margins of cornering, )"
      R"(tip-over and traction at least {2:g}; slip angle to {3:.3g} deg, slip to {4:g}, sinkage to )"
      R"({5:.3g} m</text>)"
      "\n{6}{7}{8}{9}",
      html_escaped(settings.vehicle.name), settings.gravity_mps2, settings.limits.margin_min,
      degrees(settings.limits.slip_angle_max_rad), settings.limits.slip_max,
      settings.limits.sinkage_max_m, turns.svg, slopes.svg, legend(settings, chart), lines.svg);
  return svg_picture(920, lines.bottom_px + 10, content);
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
