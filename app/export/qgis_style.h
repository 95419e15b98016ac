#pragma once

#include <string>

namespace regoplan {

/// A style of QGIS for margin.tif (`margin.qml` beside it is taken by itself): red to the least
/// margin, amber above it, green from twice as much and 0.2 on.
std::string qgis_margin_style(double margin_min);

}  // namespace regoplan
