#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regoplan {

/// An axis of a drawn panel; low and high are multiples of tick.
struct SvgAxis {
  std::string label;
  double low = 0, high = 1, tick = 1;
};

/// Round ticks, about five of them, that hold both values and zero.
SvgAxis axis_over(std::string label, double low, double high);

struct SvgPoint {
  double x = 0, y = 0;  ///< in the units of the axes
};

/// A panel of a picture, in pixels.
struct SvgPanel {
  double left = 0, top = 0, width = 0, height = 0;
  SvgAxis x, y;

  double px(double value) const;
  double py(double value) const;
};

/// Frame, grid, ticks and labels.
std::string axes_svg(const SvgPanel& panel);

/// What a line looks like.
struct SvgStroke {
  std::string_view colour;
  std::string_view dashes = "none";
  double width = 2;
};

/// A line through the points; what lies below or above the panel is drawn on its edge.
std::string line_svg(const SvgPanel& panel, const std::vector<SvgPoint>& points,
                     const SvgStroke& stroke);

/// The picture: white ground, our letters.
std::string svg_picture(double width, double height, std::string_view content);

}  // namespace regoplan
