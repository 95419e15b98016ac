#include "app/page/report_layers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/page/base64.h"

namespace regoplan {
namespace {

using nlohmann::json;

constexpr int kCellsASideMax = 256;

/// The smallest known value of a block of cells; NaN where none is known.
float smallest_of(const GridFrame& frame, const std::vector<float>& values, int factor,
                  int block_column, int block_row) {
  float smallest = std::numeric_limits<float>::quiet_NaN();
  for (int row = block_row * factor; row < std::min((block_row + 1) * factor, frame.rows); ++row) {
    const auto of_row = values.begin() + static_cast<std::ptrdiff_t>(row) * frame.columns;
    const int end = std::min((block_column + 1) * factor, frame.columns);
    for (int column = block_column * factor; column < end; ++column)
      smallest = std::fmin(smallest, of_row[column]);
  }
  return smallest;
}

/// Values as bytes, with the range that they stand for.
json quantised(const std::vector<float>& values) {
  float min = std::numeric_limits<float>::infinity(), max = -min;
  for (const float value : values) {
    if (std::isnan(value)) continue;
    min = std::min(min, value);
    max = std::max(max, value);
  }
  const float steps = max > min ? 254 / (max - min) : 0;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(values.size());
  for (const float value : values)
    bytes.push_back(std::isnan(value)
                        ? std::uint8_t{0}
                        : static_cast<std::uint8_t>(1 + std::lround((value - min) * steps)));
  return {{"min", min}, {"max", max}, {"base64", base64(bytes)}};
}

json layer(const GridFrame& frame, const std::vector<float>& values) {
  const int factor = (std::max(frame.columns, frame.rows) + kCellsASideMax - 1) / kCellsASideMax;
  const int columns = (frame.columns + factor - 1) / factor;
  const int rows = (frame.rows + factor - 1) / factor;
  std::vector<float> smallest;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      smallest.push_back(smallest_of(frame, values, factor, column, row));
  json made = quantised(smallest);
  made["columns"] = columns;
  made["rows"] = rows;
  made["cell_width_m"] = factor * frame.cell_width_m;
  made["cell_height_m"] = factor * frame.cell_height_m;
  return made;
}

}  // namespace

json report_layers(const TerrainRasters& rasters) {
  json layers = json::array();
  layers.push_back(layer(rasters.frame, rasters.margin));
  layers.back()["of"] = "margin";
  if (!rasters.probability.empty()) {
    layers.push_back(layer(rasters.frame, rasters.probability));
    layers.back()["of"] = "probability";
  }
  for (std::size_t i = 0; i < rasters.speeds_mps.size(); ++i) {
    layers.push_back(layer(rasters.frame, rasters.supply_n[i]));
    layers.back()["of"] = "supply";
    layers.back()["speed_mps"] = rasters.speeds_mps[i];
  }
  return layers;
}

}  // namespace regoplan
