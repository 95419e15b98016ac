#include "app/page/svg_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace regoplan {
namespace {

int ticks_of(const SvgAxis& axis) {
  return static_cast<int>(std::lround((axis.high - axis.low) / axis.tick));
}

/// The value at a tick; what is zero but for rounding is zero.
double value_at(const SvgAxis& axis, int tick) {
  const double value = axis.low + tick * axis.tick;
  return std::abs(value) < 1e-9 * axis.tick ? 0 : value;
}

}  // namespace

SvgAxis axis_over(std::string label, double low, double high) {
  constexpr double kTicks = 5, kRounding = 1e-9;
  low = std::min(low, 0.0);
  high = std::max(high, 0.0);
  const double rough = std::max(high - low, 1e-6) / kTicks;
  const double decade = std::pow(10, std::floor(std::log10(rough)));
  double tick = 10 * decade;
  for (const double step : {5.0, 2.0, 1.0}) {
    if (step * decade >= rough) tick = step * decade;
  }
  return {.label = std::move(label),
          .low = std::floor(low / tick + kRounding) * tick,
          .high = std::max(std::ceil(high / tick - kRounding), 1.0) * tick,
          .tick = tick};
}

double SvgPanel::px(double value) const {
  return left + (value - x.low) / (x.high - x.low) * width;
}

double SvgPanel::py(double value) const {
  return top + height - (value - y.low) / (y.high - y.low) * height;
}

std::string axes_svg(const SvgPanel& p) {
  std::string svg;
  for (int i = 0; i <= ticks_of(p.x); ++i) {
    const double value = value_at(p.x, i);
    svg += fmt::format(R"(<line x1="{0:.1f}" y1="{1}" x2="{0:.1f}" y2="{2}" stroke="#ddd"/>)"
                       R"(<text x="{0:.1f}" y="{3}" text-anchor="middle">{4:.6g}</text>)"
                       "\n",
                       p.px(value), p.top, p.top + p.height, p.top + p.height + 16, value);
  }
  for (int i = 0; i <= ticks_of(p.y); ++i) {
    const double value = value_at(p.y, i);
    svg += fmt::format(R"(<line x1="{1}" y1="{0:.1f}" x2="{2}" y2="{0:.1f}" stroke="#ddd"/>)"
                       R"(<text x="{3}" y="{4:.1f}" text-anchor="end">{5:.6g}</text>)"
                       "\n",
                       p.py(value), p.left, p.left + p.width, p.left - 6, p.py(value) + 4, value);
  }
  return svg +
         fmt::format(
             R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#333"/>)"
             R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)"
             R"svg(<text transform="translate({},{}) rotate(-90)" text-anchor="middle">{}</text>)svg"
             "\n",
             p.left, p.top, p.width, p.height, p.left + p.width / 2, p.top + p.height + 36,
             p.x.label, p.left - 48, p.top + p.height / 2, p.y.label);
}

std::string line_svg(const SvgPanel& p, const std::vector<SvgPoint>& points,
                     const SvgStroke& stroke) {
  std::string path;
  for (const SvgPoint& point : points) {
    path +=
        fmt::format("{:.1f},{:.1f} ", p.px(point.x), p.py(std::clamp(point.y, p.y.low, p.y.high)));
  }
  return fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="{}")"
                     R"( stroke-dasharray="{}"/>)"
                     "\n",
                     path, stroke.colour, stroke.width, stroke.dashes);
}

std::string svg_picture(double width, double height, std::string_view content) {
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" )"
      R"(font-family="Helvetica, Arial, sans-serif" font-size="12">)"
      "\n"
      R"(<rect width="100%" height="100%" fill="white"/>)"
      "\n{2}</svg>\n",
      width, height, content);
}

}  // namespace regoplan
