#include "app/export/nav2_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "planner/problem/obstacles.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;
using Pixels = std::vector<unsigned char>;

constexpr unsigned char kOccupied = 0, kFree = 254;

/// In the manner of map_server: the first row is the northernmost.
RenderedFile picture(const std::string& name, const GridFrame& frame, const Pixels& pixels) {
  std::string text = fmt::format("P5\n{} {}\n255\n", frame.columns, frame.rows);
  text.append(pixels.begin(), pixels.end());
  return {.name = name + ".pgm", .content = std::move(text)};
}

RenderedFile description(const std::string& name, const GridFrame& frame, const char* mode) {
  return {.name = name + ".yaml",
          .content = fmt::format("image: {}.pgm\nmode: {}\nresolution: {}\norigin: [{}, {}, 0]\n"
                                 "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n",
                                 name, mode, frame.cell_width_m, frame.west_m, frame.south_m())};
}

/// Occupies every cell that a rock touches.
void add_rock(const GridFrame& frame, const Rock& rock, Pixels& pixels) {
  const double cell_m = frame.cell_width_m;
  const auto column = [&](double x_m) {
    return static_cast<int>(std::floor((x_m - frame.west_m) / cell_m));
  };
  const auto row = [&](double y_m) {
    return static_cast<int>(std::floor((frame.north_m - y_m) / cell_m));
  };
  for (int r = std::max(0, row(rock.y_m + rock.radius_m));
       r <= std::min(frame.rows - 1, row(rock.y_m - rock.radius_m)); ++r) {
    for (int c = std::max(0, column(rock.x_m - rock.radius_m));
         c <= std::min(frame.columns - 1, column(rock.x_m + rock.radius_m)); ++c) {
      const double away_x_m = std::abs(frame.west_m + (c + 0.5) * cell_m - rock.x_m);
      const double away_y_m = std::abs(frame.north_m - (r + 0.5) * cell_m - rock.y_m);
      const double gap_m =
          std::hypot(std::max(0.0, away_x_m - cell_m / 2), std::max(0.0, away_y_m - cell_m / 2));
      if (gap_m > rock.radius_m) continue;
      pixels[static_cast<std::size_t>(r) * static_cast<std::size_t>(frame.columns) +
             static_cast<std::size_t>(c)] = kOccupied;
    }
  }
}

Pixels keepout(const PlanningProblem& problem, const TerrainRasters& rasters) {
  Pixels pixels;
  for (const float margin : rasters.margin) {
    const bool holds = margin >= problem.limits.margin_min;  // not where it is NaN
    pixels.push_back(holds ? kFree : kOccupied);
  }
  for (const Rock& rock : problem.map.rocks()) {
    if (in_the_way(problem.map, problem.vehicle, rock)) add_rock(rasters.frame, rock, pixels);
  }
  return pixels;
}

/// The largest speed at which a cell has a safe way on, as a share of the top speed in per cent.
Pixels speed_limits(const PlanningProblem& problem, const TerrainRasters& rasters) {
  Pixels pixels(rasters.margin.size(), 1);  // the slowest that the filter can say
  for (std::size_t speed = 0; speed < rasters.speeds_mps.size(); ++speed) {
    const double percent = 100 * rasters.speeds_mps[speed] / problem.speed_max_mps;
    const bool top = percent > 99.5;
    for (std::size_t cell = 0; cell < pixels.size(); ++cell) {
      if (!(rasters.supply_n[speed][cell] > 0)) continue;
      pixels[cell] = top ? 0 : static_cast<unsigned char>(std::lround(percent));
    }
  }
  return pixels;
}

Json feature(const Json& properties, const char* type, const Json& coordinates) {
  return {{"type", "Feature"},
          {"properties", properties},
          {"geometry", {{"type", type}, {"coordinates", coordinates}}}};
}

/// Places along a line from its first to its last, as far from each other by the way as equal
/// pieces of at most `spacing_m` are: its own points lie closer in some places and wider in others.
std::vector<std::array<double, 2>> evenly_spaced(const Json& line, double spacing_m) {
  std::vector<std::array<double, 2>> points;
  std::vector<double> way_m;
  for (const Json& point : line) {
    const std::array<double, 2> place{point.at(0), point.at(1)};
    const double step_m =
        points.empty() ? 0 : std::hypot(place[0] - points.back()[0], place[1] - points.back()[1]);
    way_m.push_back((way_m.empty() ? 0 : way_m.back()) + step_m);
    points.push_back(place);
  }
  const double length_m = way_m.back();
  if (!(length_m > 0)) return {points.front()};
  constexpr double kRounding = 1e-9;
  const double pieces = std::ceil(length_m / spacing_m * (1 - kRounding));
  std::vector<std::array<double, 2>> places{points.front()};
  std::size_t i = 1;
  for (int k = 1; k < pieces; ++k) {
    const double at_m = length_m * k / pieces;
    while (i + 1 < points.size() && way_m[i] < at_m) ++i;
    const double piece_m = way_m[i] - way_m[i - 1];
    const double share = piece_m > 0 ? (at_m - way_m[i - 1]) / piece_m : 0;
    places.push_back({std::lerp(points[i - 1][0], points[i][0], share),
                      std::lerp(points[i - 1][1], points[i][1], share)});
  }
  places.push_back(points.back());
  return places;
}

}  // namespace

std::vector<RenderedFile> nav2_masks(const PlanningProblem& problem,
                                     const TerrainRasters& rasters) {
  const GridFrame& frame = rasters.frame;
  if (std::abs(frame.cell_width_m - frame.cell_height_m) > 1e-9 * frame.cell_width_m) {
    throw InputError(fmt::format("map: cells of {} m by {} m (allowed for Nav2: square ones)",
                                 frame.cell_width_m, frame.cell_height_m));
  }
  return {picture("keepout", frame, keepout(problem, rasters)),
          description("keepout", frame, "trinary"),
          picture("speed", frame, speed_limits(problem, rasters)),
          description("speed", frame, "raw")};
}

RenderedFile nav2_route(const Json& candidate, double spacing_m) {
  const Json& line = candidate.at("features").at(0).at("geometry").at("coordinates");
  std::vector<Json> nodes;
  for (const std::array<double, 2>& place : evenly_spaced(line, spacing_m)) {
    nodes.push_back(Json::array({place[0], place[1]}));
  }
  Json features = Json::array();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    features.push_back(feature({{"id", i}, {"frame", "map"}}, "Point", nodes[i]));
  }
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    features.push_back(feature({{"id", nodes.size() + i - 1}, {"startid", i - 1}, {"endid", i}},
                               "MultiLineString",
                               Json::array({Json::array({nodes[i - 1], nodes[i]})})));
  }
  const Json json{{"type", "FeatureCollection"},
                  {"name", "route"},
                  {"crs", candidate.at("crs")},
                  {"features", features}};
  return {.name = "route.geojson", .content = json.dump(1) + "\n"};
}

}  // namespace regoplan
