#include "terramech/tables/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <istream>
#include <iterator>
#include <utility>

#include "terramech/basics/nearest_name.h"
#include "terramech/tables/csv_cells.h"
#include "terramech/tables/number_text.h"

namespace regoplan {
namespace {

std::string trimmed(const std::string& cell) {
  constexpr const char* kBlanks = " \t";
  const std::size_t from = cell.find_first_not_of(kBlanks);
  if (from == std::string::npos) return "";
  return cell.substr(from, cell.find_last_not_of(kBlanks) - from + 1);
}

/// Data frames are written with the index of their rows first, in a column without a name.
bool is_row_index(std::size_t column, std::string_view cell) {
  return column == 0 && cell.find_first_not_of("0123456789") == std::string_view::npos;
}

/// For an error in a line that was meant as a comment.
std::string_view comment_hint(const std::vector<std::string>& cells) {
  if (!trimmed(cells.front()).starts_with('#')) return "";
  return "; comments (lines that begin with #) are not read";
}

}  // namespace

std::optional<std::string> meant_column(std::string_view written,
                                        const std::vector<std::string>& columns,
                                        const std::vector<std::string>& known) {
  std::vector<std::string> absent;
  std::ranges::copy_if(known, std::back_inserter(absent), [&](const std::string& name) {
    return std::ranges::find(columns, name) == columns.end();
  });
  return nearest_name(written, absent);
}

CsvTable::CsvTable(std::istream& stream, std::string file, EmptyLines empty_lines)
    : stream_(stream), file_(std::move(file)), empty_lines_(empty_lines) {
  read_header();
}

void CsvTable::read_header() {
  std::optional<Cells> header = next_line();
  if (!header) throw InputError(file_ + ": empty (expected a header line)");
  if (const auto why = why_no_table(*header)) throw error(*why);
  width_ = header->size();
  for (std::size_t i = 0; i < width_; ++i) {
    std::string column = trimmed((*header)[i]);
    if (column.empty()) continue;
    if (find_column(column)) throw error("column " + column + " given twice");
    columns_.push_back(std::move(column));
    places_.push_back(i);
  }
  if (columns_.empty()) throw error("no column has a name (expected a header line)");
}

std::optional<std::size_t> CsvTable::find_column(std::string_view sought) const {
  const auto found = std::ranges::find(columns_, sought);
  if (found == columns_.end()) return {};
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t CsvTable::column(std::string_view sought) const {
  const auto found = find_column(sought);
  if (!found) throw error(fmt::format("column {} is missing{}", sought, comment_hint(columns_)));
  return *found;
}

std::size_t CsvTable::required_column(std::string_view sought,
                                      const std::vector<std::string>& known) const {
  if (const auto found = find_column(sought)) return *found;
  for (const std::string& written : columns_) {
    if (std::ranges::find(known, written) != known.end()) continue;
    if (meant_column(written, columns_, known) != sought) continue;
    throw error(fmt::format("column {} is missing (the header has {})", sought, written));
  }
  return column(sought);
}

std::optional<CsvTable::Cells> CsvTable::next() {
  const std::optional<Cells> cells = next_line();
  if (!cells) return {};
  if (holds_zero_byte(*cells)) throw TornRowError(error("a zero byte (allowed: text in UTF-8)"));
  if (cells->size() != width_) {
    throw TornRowError(error(fmt::format("{} cells (the header has {}){}", cells->size(), width_,
                                         comment_hint(*cells))));
  }
  return named(*cells);
}

CsvTable::Cells CsvTable::named(const Cells& cells) const {
  Cells kept;
  kept.reserve(columns_.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::string cell = trimmed(cells[i]);
    const bool has_name = kept.size() < places_.size() && places_[kept.size()] == i;
    if (has_name) {
      kept.push_back(std::move(cell));
    } else if (!cell.empty() && !is_row_index(i, cell)) {
      throw error(fmt::format(
          "column {}, which has no name in the header: {} is not valid (allowed: empty cells, or a "
          "name in the header)",
          i + 1, cell));
    }
  }
  return kept;
}

double CsvTable::number(const Cells& cells, std::size_t index, const ValueRange& allowed,
                        std::string_view hint) const {
  const std::string& cell = cells[index];
  const std::optional<double> value = parse_number(cell);
  if (value && allowed.contains(*value)) return *value;
  const std::string what =
      fmt::format("{}: {} is not valid (allowed: {}){}{}{}", columns_[index],
                  cell.empty() ? "an empty cell" : cell, allowed.text(), hint.empty() ? "" : "; ",
                  hint, value ? "" : comment_hint(cells));
  if (!value) throw error(what);
  throw OutOfRangeError(
      error(what),
      {.line = line_, .column = columns_[index], .value = *value, .allowed = allowed.text()});
}

bool CsvTable::is_empty(std::string_view line) const {
  return empty_lines_ == EmptyLines::kAnywhere
             ? line.find_first_not_of(" ,\t") == std::string_view::npos
             : line.empty();
}

std::optional<CsvTable::Cells> CsvTable::next_line() {
  constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";
  std::string line;
  int empty = 0;
  bool any = false;
  while (!any && std::getline(stream_, line)) {
    if (++line_ == 1 && line.starts_with(kByteOrderMark)) line.erase(0, 3);
    if (line.ends_with('\r')) line.pop_back();
    any = !is_empty(line);
    if (!any) ++empty;
  }
  if (stream_.bad()) throw InputError(file_ + ": cannot be read");
  if (!any) return {};  // empty lines at the end say nothing
  if (empty > 0 && empty_lines_ == EmptyLines::kOnlyAtTheEnd) {
    throw InputError(fmt::format("{}:{}: an empty line", file_, line_ - 1));
  }
  std::optional<Cells> cells = split_cells(line);
  if (!cells) throw error("a quote is not closed");
  return cells;
}

InputError CsvTable::error(const std::string& what) const {
  return InputError(fmt::format("{}:{}: {}", file_, line_, what));
}

}  // namespace regoplan
