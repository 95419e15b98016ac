#include "maps/rock_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "maps/table_text.h"
#include "maps/whole_file.h"
#include "terramech/basics/input_error.h"

namespace regoplan {

namespace {

struct Column {
  std::string_view name;
  double Rock::*member;
  bool positive;
};

/// Farther out, differences of coordinates mean nothing.
constexpr double kNumberMax = 1e12;

constexpr std::array<Column, 4> kColumns{{{"x_m", &Rock::x_m, false},
                                          {"y_m", &Rock::y_m, false},
                                          {"radius_m", &Rock::radius_m, true},
                                          {"height_m", &Rock::height_m, true}}};

std::vector<std::string_view> fields(std::string_view line) {
  std::vector<std::string_view> result;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    result.push_back(trimmed(line.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  return result;
}

/// Where each of kColumns stands in the header.
std::array<std::size_t, kColumns.size()> find_columns(std::string_view header,
                                                      const std::string& file) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (header.starts_with(kByteOrderMark)) header.remove_prefix(kByteOrderMark.size());
  const std::vector<std::string_view> names = fields(header);
  std::array<std::size_t, kColumns.size()> places{};
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    const auto count = std::count(names.begin(), names.end(), kColumns[i].name);
    if (count != 1) {
      throw InputError(
          fmt::format("{}:1: column {} stands {} times in the header \"{}\" (needs "
                      "x_m, y_m, radius_m, height_m once each)",
                      file, kColumns[i].name, count, trimmed(header)));
    }
    places[i] = static_cast<std::size_t>(std::find(names.begin(), names.end(), kColumns[i].name) -
                                         names.begin());
  }
  return places;
}

double number(std::string_view text, const Column& column, const std::string& file, int line) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool valid = error == std::errc() && end == text.data() + text.size() &&
                     std::abs(value) <= kNumberMax && (!column.positive || value > 0);
  if (!valid) {
    throw InputError(fmt::format(
        "{}:{}: {}: \"{}\" is not valid (allowed: a number, {} to {})", file, line, column.name,
        text, column.positive ? "above 0" : fmt::format("{}", -kNumberMax), kNumberMax));
  }
  return value;
}

struct RockRow {
  Rock rock;
  int line = 0;
};

std::vector<RockRow> read_rows(const std::string& file) {
  if (std::filesystem::is_directory(file)) throw InputError(file + ": is a folder");
  std::ifstream stream(file);
  std::string text;
  if (!stream || !std::getline(stream, text)) {
    throw InputError(fmt::format("{}: cannot be read, or is empty", file));
  }
  const auto places = find_columns(text, file);
  const std::size_t columns = fields(text).size();
  std::vector<RockRow> rows;
  for (int line = 2; std::getline(stream, text); ++line) {
    if (trimmed(text).empty()) continue;
    const std::vector<std::string_view> cells = fields(text);
    if (cells.size() != columns) {
      throw InputError(fmt::format("{}:{}: {} columns where the header has {}", file, line,
                                   cells.size(), columns));
    }
    Rock rock;
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      rock.*kColumns[i].member = number(cells[places[i]], kColumns[i], file, line);
    }
    rows.push_back({rock, line});
  }
  if (stream.bad()) throw InputError(fmt::format("{}: cannot be read to its end", file));
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
