#pragma once

#include <vector>

#include "planner/problem/planning_problem.h"
#include "planner/runtime/plain_bytes.h"

namespace regoplan {

/// What a problem's vehicle may do on each part of its map, on a north-up grid like that of the
/// elevation, for maps of people; no search reads it. NaN where the ground under the vehicle is
/// unknown or steeper than the problem allows. Rocks are not in it.
struct TerrainRasters {
  GridFrame frame;
  /// Stability margin (the smallest of cornering, tip-over and traction) of driving straight on at
  /// a steady pace, the smallest over the headings; -1 where no steady driving is found.
  std::vector<float> margin;
  /// Share of the draws of the soils in which driving straight on at a steady pace keeps the least
  /// margin in every direction; empty where it was not worked out.
  std::vector<float> probability;
  std::vector<double> speeds_mps;
  /// For each speed the lateral supply, newtons: the smaller of its two ends, A+ and -A-, in the
  /// tightest turn to either side that keeps every margin at that speed, the slope across the path.
  std::vector<std::vector<float>> supply_n;
};

/// Hands every field to an archive (`bytes_of`).
template <class Archive, FieldsOf<TerrainRasters> Rasters>
void each_field(Archive& archive, Rasters& rasters) {
  auto& frame = rasters.frame;
  archive(frame.columns);
  archive(frame.rows);
  archive(frame.west_m);
  archive(frame.north_m);
  archive(frame.cell_width_m);
  archive(frame.cell_height_m);
  archive(frame.crs_wkt);
  archive(rasters.margin);
  archive(rasters.probability);
  archive(rasters.speeds_mps);
  archive(rasters.supply_n);
}

}  // namespace regoplan
