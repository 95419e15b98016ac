#include "maps/rock_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "maps/whole_file.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/value_range.h"
#include "terramech/tables/csv_table.h"

namespace regoplan {

namespace {

struct Column {
  std::string_view name;
  double Rock::*member;
  ValueRange allowed;
};

/// Farther out, differences of coordinates mean nothing.
constexpr double kNumberMax = 1e12;
constexpr ValueRange kCoordinate{.min = -kNumberMax, .max = kNumberMax};
constexpr ValueRange kSize{.min = 0, .max = kNumberMax, .min_excluded = true};

constexpr std::array<Column, 4> kColumns{{{"x_m", &Rock::x_m, kCoordinate},
                                          {"y_m", &Rock::y_m, kCoordinate},
                                          {"radius_m", &Rock::radius_m, kSize},
                                          {"height_m", &Rock::height_m, kSize}}};

struct RockRow {
  Rock rock;
  std::int64_t line = 0;
};

std::vector<RockRow> read_rows(const std::string& file) {
  if (std::filesystem::is_directory(file)) throw InputError(file + ": is a folder");
  std::ifstream stream(file);
  if (!stream) throw InputError(file + ": no such file, or it cannot be read");
  CsvTable table(stream, file, EmptyLines::kAnywhere);
  std::vector<std::string> known;
  for (const Column& column : kColumns) known.emplace_back(column.name);
  std::array<std::size_t, kColumns.size()> places{};
  std::ranges::transform(kColumns, places.begin(), [&](const Column& column) {
    return table.required_column(column.name, known);
  });
  std::vector<RockRow> rows;
  while (const auto cells = table.next()) {
    RockRow row{.rock = {}, .line = table.line()};
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      row.rock.*kColumns.at(i).member = table.number(*cells, places.at(i), kColumns.at(i).allowed);
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<Rock> rocks_of(const std::vector<RockRow>& rows) {
  std::vector<Rock> rocks;
  for (const RockRow& row : rows) rocks.push_back(row.rock);
  return rocks;
}

}  // namespace

std::vector<Rock> read_rocks(const std::string& file) {
  return rocks_of(read_rows(file));
}

std::vector<Rock> read_rocks(const std::string& file, const GridFrame& map) {
  const std::vector<RockRow> rows = read_rows(file);
  const auto on_map = [&](const RockRow& row) { return covers(map, row.rock.x_m, row.rock.y_m); };
  if (!rows.empty() && std::ranges::none_of(rows, on_map)) {
    const auto& [first, line] = rows.front();
    throw InputError(fmt::format(
        "{}:{}: x_m {:.10g}, y_m {:.10g} lies beside the elevation raster ({}); none of {} rocks "
        "lies on it",
        file, line, first.x_m, first.y_m, extent_text(map), rows.size()));
  }
  return rocks_of(rows);
}

void write_rocks(const std::vector<Rock>& rocks, const std::string& file) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "x_m,y_m,radius_m,height_m\n");
  for (const Rock& rock : rocks) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", rock.x_m, rock.y_m, rock.radius_m,
                   rock.height_m);
  }
  write_whole_file(file, [&](const std::string& unfinished) {
    std::ofstream stream(unfinished, std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream.close();
    if (!stream) throw InputError(fmt::format("{}: cannot be written", file));
  });
}

}  // namespace regoplan
