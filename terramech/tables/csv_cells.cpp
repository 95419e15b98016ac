#include "terramech/tables/csv_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace regoplan {

namespace {

bool any_holds(const std::vector<std::string>& cells, char letter) {
  return std::ranges::any_of(
      cells, [&](const std::string& cell) { return cell.find(letter) != std::string::npos; });
}

}  // namespace

std::string number_cell(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

std::string text_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"') quoted += '"';
    quoted += letter;
  }
  return quoted + "\"";
}

std::string own_text_cell(std::string_view text) {
  const bool formula =
      !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
  return text_cell(formula ? fmt::format("'{}", text) : std::string(text));
}

bool holds_zero_byte(const std::vector<std::string>& cells) {
  return any_holds(cells, '\0');
}

std::optional<std::string> why_no_table(const std::vector<std::string>& columns) {
  const std::string& first = columns.front();
  if (first.starts_with("\xFF\xFE") || first.starts_with("\xFE\xFF")) {
    return "the file is UTF-16 (allowed: UTF-8)";
  }
  if (holds_zero_byte(columns)) return "zero bytes, as of UTF-16 (allowed: UTF-8)";
  if (any_holds(columns, '\r')) {
    return "a carriage return within the line (allowed: lines that end in a line feed)";
  }
  if (columns.size() > 1) return {};
  for (const auto& [separator, name] : {std::pair{';', "semicolons"}, std::pair{'\t', "tabs"}}) {
    if (first.find(separator) != std::string::npos) {
      return fmt::format("cells are separated by {} (allowed: commas)", name);
    }
  }
  return {};
}

std::vector<std::string> names_beside(const std::vector<std::string>& columns,
                                      const std::vector<std::string>& added) {
  const auto is_in = [](const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  std::vector<std::string> names = columns;
  for (std::string& name : names) {
    if (!is_in(added, name)) continue;
    do {
      name.insert(0, "input_");
    } while (is_in(added, name) || is_in(columns, name));
  }
  return names;
}

std::optional<std::vector<std::string>> split_cells(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char letter = line[i];
    if (quoted) {
      if (letter != '"') {
        cells.back() += letter;
      } else if (i + 1 < line.size() && line[i + 1] == '"') {
        cells.back() += '"';
        ++i;
      } else {
        quoted = false;
      }
    } else if (letter == '"' && cells.back().empty()) {
      quoted = true;
    } else if (letter == ',') {
      cells.emplace_back();
    } else {
      cells.back() += letter;
    }
  }
  if (quoted) return {};
  return cells;
}

}  // namespace regoplan
