#include "app/export/qgis_style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace regoplan {

std::string qgis_margin_style(double margin_min) {
  struct Stop {
    double margin;
    const char* colour;
    std::string label;
  };
  const double calm = std::max(2 * margin_min, 0.2);
  const std::array<Stop, 5> stops{
      {{-1, "#67000d", "-1: no steady driving"},
       {0, "#d7301f", "0"},
       {margin_min, "#fdae61", fmt::format("{}: the least allowed", margin_min)},
       {calm, "#66bd63", fmt::format("{}", calm)},
       {std::max(0.5, 2 * calm), "#006837", "ample"}}};
  std::string items;
  for (const Stop& stop : stops) {
    items += fmt::format("          <item value=\"{}\" color=\"{}\" alpha=\"255\" label=\"{}\"/>\n",
                         stop.margin, stop.colour, stop.label);
  }
  return fmt::format(
      "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n"
      "<qgis version=\"3.22.0\" styleCategories=\"Symbology\">\n"
      "  <pipe>\n"
      "    <rasterrenderer type=\"singlebandpseudocolor\" band=\"1\" opacity=\"0.75\" "
      "classificationMin=\"{0}\" classificationMax=\"{1}\">\n"
      "      <rastershader>\n"
      "        <colorrampshader colorRampType=\"INTERPOLATED\" clip=\"0\" minimumValue=\"{0}\" "
      "maximumValue=\"{1}\">\n{2}"
      "        </colorrampshader>\n"
      "      </rastershader>\n"
      "    </rasterrenderer>\n"
      "  </pipe>\n"
      "</qgis>\n",
      stops.front().margin, stops.back().margin, items);
}

}  // namespace regoplan
