#pragma once

#include <vector>

#include "planner/plain_bytes.h"
#include "planner/planning_problem.h"

namespace regoplan {

/// What a problem's vehicle may do on each part of its map, on a north-up grid like that of the
/// elevation, for maps of people; no search reads it. NaN where the ground under the vehicle is
/// unknown or steeper than the problem allows. Rocks are not in it.
struct TerrainRasters {
  GridFrame frame;
  /// Stability margin (the smallest of cornering, tip-over and traction) of driving straight on at
  /// a steady pace, the smallest over the headings; -1 where no steady driving is found.
  std::vector<float> margin;
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
  archive(rasters.speeds_mps);
  archive(rasters.supply_n);
}

/// By the direct wheel model at its fast accuracy on planes of whole degrees (supply: every fifth)
/// of each soil, linear between them; the ground of a cell is the plane under the vehicle
/// that stands in it, heading east. Soils count with their means. Of maps with more than 1024 cells
/// a side every so manieth is taken, with cells as much larger.
TerrainRasters terrain_rasters(const PlanningProblem& problem);

}  // namespace regoplan
