#include "app/map/map_summary.h"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

/// `PROJCRS["UTM zone 33N", ...` is called "UTM zone 33N".
std::string crs_title(const std::string& wkt) {
  const std::size_t open = wkt.find('"');
  const std::size_t close = open == std::string::npos ? open : wkt.find('"', open + 1);
  return close == std::string::npos ? "none" : wkt.substr(open + 1, close - open - 1);
}

}  // namespace

std::string summary_text(const TerrainSummary& summary, bool with_soils) {
  const GridFrame& frame = summary.frame;
  std::string text = fmt::format(
      "  extent     x {} to {} m, y {} to {} m\n"
      "  cells      {} x {}, {} x {} m, {:.1f} % known\n"
      "  CRS        {}\n"
      "  height     {:.2f} to {:.2f} m\n"
      "  slope      median {:.1f}, 90 % {:.1f}, 99 % {:.1f}, max {:.1f} deg (at this cell size)\n",
      frame.west_m, frame.east_m(), frame.south_m(), frame.north_m, frame.columns, frame.rows,
      frame.cell_width_m, frame.cell_height_m, 100 * summary.known_share, crs_title(frame.crs_wkt),
      summary.height_min_m, summary.height_max_m, degrees(summary.slope_p50_rad),
      degrees(summary.slope_p90_rad), degrees(summary.slope_p99_rad),
      degrees(summary.slope_max_rad));
  if (!with_soils) return text;
  for (const TerrainSummary::SoilShare& soil : summary.soils) {
    text += fmt::format("  soil       {:.1f} % {}\n", 100 * soil.share, soil.name);
  }
  text += fmt::format("  forbidden  {:.1f} %\n", 100 * summary.no_soil_share);
  return text + fmt::format("  rocks      {}, {:.2f} % of the area\n", summary.rocks,
                            100 * summary.rock_share);
}

nlohmann::ordered_json summary_json(const TerrainSummary& summary, bool with_soils) {
  const GridFrame& frame = summary.frame;
  nlohmann::ordered_json json{{"west_m", frame.west_m},
                              {"east_m", frame.east_m()},
                              {"south_m", frame.south_m()},
                              {"north_m", frame.north_m},
                              {"columns", frame.columns},
                              {"rows", frame.rows},
                              {"cell_width_m", frame.cell_width_m},
                              {"cell_height_m", frame.cell_height_m},
                              {"crs_wkt", frame.crs_wkt},
                              {"known_share", summary.known_share},
                              {"height_min_m", summary.height_min_m},
                              {"height_max_m", summary.height_max_m},
                              {"slope_p50_deg", degrees(summary.slope_p50_rad)},
                              {"slope_p90_deg", degrees(summary.slope_p90_rad)},
                              {"slope_p99_deg", degrees(summary.slope_p99_rad)},
                              {"slope_max_deg", degrees(summary.slope_max_rad)}};
  if (!with_soils) return json;
  json["soils"] = nlohmann::ordered_json::object();
  for (const TerrainSummary::SoilShare& soil : summary.soils) {
    json["soils"][soil.name] = soil.share;
  }
  json["forbidden_share"] = summary.no_soil_share;
  json["rocks"] = summary.rocks;
  json["rock_share"] = summary.rock_share;
  return json;
}

void print_map_written(const TerrainMap& map, const std::filesystem::path& folder, bool json,
                       bool quiet) {
  const TerrainSummary summary = summarize(map);
  const std::string scenario = (folder / "scenario.yaml").string();
  if (json) {
    nlohmann::ordered_json result = summary_json(summary, true);
    result["scenario"] = scenario;
    fmt::print("{}\n", result.dump(2));
  } else if (!quiet) {
    fmt::print("{}\n{}", scenario, summary_text(summary, true));
  }
}

}  // namespace regoplan
