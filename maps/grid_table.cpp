#include "maps/grid_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numeric>
#include <optional>
#include <string_view>

#include "maps/table_text.h"
#include "maps/undeclared_nodata.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

struct Point {
  double x_m = 0, y_m = 0;
  float height_m = kUnknown;
  std::uint32_t line = 0;
};

[[noreturn]] void fail(const std::string& file, std::size_t line, std::string_view what) {
  throw InputError(fmt::format("{}:{}: {}", file, line, what));
}

char separator_of(std::string_view line) {
  for (const char separator : {',', ';', '\t'}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

/// The cells of a line; a run of spaces is one separator.
void split(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  if (separator == ' ') line = trimmed(line);
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    const std::string_view cell = trimmed(line.substr(begin, end - begin));
    if (separator != ' ' || !cell.empty()) cells.push_back(cell);
    begin = end + 1;
  }
}

std::optional<double> parsed(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

/// Which columns are x, y and height.
using Places = std::array<std::size_t, 3>;

Places places_in(const std::vector<std::string_view>& header, const std::string& file) {
  static const std::array<std::vector<std::string_view>, 3> kNames{{
      {"x", "x_m", "east", "east_m", "easting", "easting_m"},
      {"y", "y_m", "north", "north_m", "northing", "northing_m"},
      {"z", "z_m", "height", "height_m", "elevation", "elevation_m", "elev", "h"},
  }};
  Places places{};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto named = [&](std::string_view cell) {
      std::string name(cell);
      std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
      return std::ranges::find(kNames[k], name) != kNames[k].end();
    };
    const auto found = std::ranges::find_if(header, named);
    if (found == header.end() || std::find_if(found + 1, header.end(), named) != header.end()) {
      fail(file, 1,
           fmt::format("one column must be {} of the points, in metres (allowed: {})",
                       k == 0   ? "x"
                       : k == 1 ? "y"
                                : "the height",
                       fmt::join(kNames[k], ", ")));
    }
    places[k] = static_cast<std::size_t>(found - header.begin());
  }
  return places;
}

/// Reads the numbers of a row.
class RowReader {
 public:
  RowReader(const std::string& file, const HeightReading& reading)
      : file_(file), reading_(reading) {}

  Point point(const std::vector<std::string_view>& cells, const Places& places,
              std::size_t line) const {
    if (cells.size() <= std::ranges::max(places)) {
      fail(file_, line, fmt::format("{} cells (x, y and height need more)", cells.size()));
    }
    return {.x_m = coordinate(cells[places[0]], "x", line),
            .y_m = coordinate(cells[places[1]], "y", line),
            .height_m = height_m(cells[places[2]], line),
            .line = static_cast<std::uint32_t>(line)};
  }

 private:
  double coordinate(std::string_view cell, std::string_view name, std::size_t line) const {
    constexpr double kMost_m = 1e9;
    const std::optional<double> value = parsed(cell);
    if (!value || !(std::abs(*value) <= kMost_m)) {
      fail(file_, line,
           fmt::format("{}: {} is not valid (allowed: metres, -1e9 to 1e9)", name,
                       cell.empty() ? "an empty cell" : cell));
    }
    return *value;
  }

  float height_m(std::string_view cell, std::size_t line) const {
    constexpr double kMost_m = 1e6;
    if (cell.empty()) return kUnknown;
    const std::optional<double> value = parsed(cell);
    if (value && (std::isnan(*value) || value == reading_.nodata)) return kUnknown;
    const double height =
        value.value_or(kUnknown) * reading_.scale.value_or(1) + reading_.offset_m.value_or(0);
    if (!(std::abs(height) <= kMost_m)) {
      fail(file_, line,
           fmt::format("height: {} is not valid (allowed: metres, -1e6 to 1e6, nan or an empty "
                       "cell where it is not known)",
                       cell));
    }
    return static_cast<float>(height);
  }

  const std::string& file_;
  const HeightReading& reading_;
};

std::vector<Point> read_points(const std::string& file, const HeightReading& reading) {
  std::ifstream stream(file);
  std::string text;
  if (!stream || !std::getline(stream, text)) {
    throw InputError(file + ": cannot be read, or is empty");
  }
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  const char separator = separator_of(text);
  std::vector<std::string_view> cells;
  split(text, separator, cells);
  const bool has_header = !cells.empty() && !parsed(cells.front());
  const Places places = has_header ? places_in(cells, file) : Places{0, 1, 2};
  const RowReader row(file, reading);
  std::vector<Point> points;
  if (!has_header) points.push_back(row.point(cells, places, 1));
  for (std::size_t line = 2; std::getline(stream, text); ++line) {
    if (trimmed(text).empty()) continue;
    split(text, separator, cells);
    points.push_back(row.point(cells, places, line));
  }
  if (stream.bad()) throw InputError(file + ": cannot be read to its end");
  if (points.empty()) throw InputError(file + ": no points below the header");
  return points;
}

/// Evenly spaced coordinates.
struct GridAxis {
  double first_m = 0, spacing_m = 0;
  double count = 0;
};

/// The grid that most of the values lie on, from the gaps between them. \pre not empty
GridAxis axis_of(std::vector<double> values, std::string_view name, const std::string& file) {
  std::ranges::sort(values);
  const double first = values.front(), extent = values.back() - first;
  constexpr double kSame = 1e-6;  // of the extent: two spellings of one coordinate
  std::vector<double> gaps;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] - values[i - 1] > kSame * extent) gaps.push_back(values[i] - values[i - 1]);
  }
  if (gaps.empty()) {
    throw InputError(
        fmt::format("{}: all points have {} = {} (a grid needs two or more)", file, name, first));
  }
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::ranges::nth_element(gaps, middle);
  const double typical = *middle;
  // Rounded coordinates have rounded gaps, whose mean is the spacing; others span missing points.
  std::erase_if(gaps, [typical](double gap) { return std::abs(gap - typical) > 0.2 * typical; });
  const double mean =
      std::accumulate(gaps.begin(), gaps.end(), 0.0) / static_cast<double>(gaps.size());
  const double steps = std::max(1.0, std::round(extent / mean));
  return {.first_m = first, .spacing_m = extent / steps, .count = steps + 1};
}

/// Where on an axis a value lies.
std::size_t index_on(const GridAxis& axis, double value, std::string_view name, std::size_t line,
                     const std::string& file) {
  constexpr double kBeside = 0.05;
  const double at = (value - axis.first_m) / axis.spacing_m;
  if (std::abs(at - std::round(at)) > kBeside) {
    fail(file, line,
         fmt::format("{}: {} does not lie on a grid of {:.6g} m from {} on (allowed: evenly spaced "
                     "points); remedy: gdal_grid",
                     name, value, axis.spacing_m, axis.first_m));
  }
  return static_cast<std::size_t>(std::lround(at));
}

}  // namespace

bool is_grid_table(const std::string& file) {
  std::string ending = file.substr(file.size() - std::min<std::size_t>(4, file.size()));
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".csv" || ending == ".xyz";
}

ElevationRaster read_grid_table(const std::string& file, const HeightReading& reading) {
  const std::vector<Point> points = read_points(file, reading);
  const auto axis = [&](double Point::*member, std::string_view name) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const Point& point : points) values.push_back(point.*member);
    return axis_of(std::move(values), name, file);
  };
  const GridAxis x = axis(&Point::x_m, "x"), y = axis(&Point::y_m, "y");
  constexpr double kFewest = 0.1;  // of the cells: fewer points are a cloud and no grid
  if (static_cast<double>(points.size()) < kFewest * x.count * y.count) {
    throw InputError(fmt::format(
        "{}: {} points on a grid of {} x {} cells (allowed: a tenth of them, evenly spaced); "
        "remedy: gdal_grid",
        file, points.size(), x.count, y.count));
  }
  const auto columns = static_cast<std::size_t>(x.count), rows = static_cast<std::size_t>(y.count);
  ElevationRaster raster{.frame = {.columns = static_cast<int>(columns),
                                   .rows = static_cast<int>(rows),
                                   .west_m = x.first_m - x.spacing_m / 2,
                                   .north_m = y.first_m + (y.count - 0.5) * y.spacing_m,
                                   .cell_width_m = x.spacing_m,
                                   .cell_height_m = y.spacing_m},
                         .height_m = std::vector<float>(columns * rows, kUnknown)};
  std::vector<bool> given(columns * rows);
  bool known = false;
  for (const Point& point : points) {
    const std::size_t column = index_on(x, point.x_m, "x", point.line, file);
    const std::size_t row = rows - 1 - index_on(y, point.y_m, "y", point.line, file);
    const std::size_t cell = row * columns + column;
    if (given[cell]) {
      fail(file, point.line,
           fmt::format("the point ({}, {}) is given twice", point.x_m, point.y_m));
    }
    given[cell] = true;
    raster.height_m[cell] = point.height_m;
    known = known || !std::isnan(point.height_m);
  }
  if (!known) throw InputError(file + ": no point has a height");
  check_for_undeclared_nodata(raster, reading.scale.value_or(1), reading.offset_m.value_or(0),
                              file);
  return raster;
}

}  // namespace regoplan
