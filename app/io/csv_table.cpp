#include "app/io/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <istream>
#include <iterator>
#include <utility>

#include "app/io/csv_cells.h"
#include "app/io/number_text.h"
#include "terramech/basics/nearest_name.h"

namespace regoplan {
namespace {

std::string trimmed(const std::string& cell) {
  const std::size_t from = cell.find_first_not_of(' ');
  return from == std::string::npos ? "" : cell.substr(from, cell.find_last_not_of(' ') - from + 1);
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

CsvTable::CsvTable(std::istream& stream, std::string file)
    : stream_(stream), file_(std::move(file)) {
  std::optional<Cells> header = next_line();
  if (!header) throw InputError(file_ + ": empty (expected a header line)");
  constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";
  if (header->front().starts_with(kByteOrderMark)) header->front().erase(0, 3);
  for (std::string& column : *header) {
    column = trimmed(column);
    if (std::ranges::count(*header, column) > 1) throw error("column " + column + " given twice");
  }
  columns_ = std::move(*header);
  if (const auto why = why_no_table(columns_)) throw error(*why);
}

std::optional<std::size_t> CsvTable::find_column(std::string_view sought) const {
  const auto found = std::ranges::find(columns_, sought);
  if (found == columns_.end()) return {};
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t CsvTable::column(std::string_view sought) const {
  const auto found = find_column(sought);
  if (!found) throw error(fmt::format("column {} is missing", sought));
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
  std::optional<Cells> cells = next_line();
  if (cells && cells->size() != columns_.size()) {
    throw error(fmt::format("{} cells (the header has {})", cells->size(), columns_.size()));
  }
  if (cells) std::ranges::transform(*cells, cells->begin(), trimmed);
  return cells;
}

double CsvTable::number(const Cells& cells, std::size_t index, const ValueRange& allowed,
                        std::string_view hint) const {
  const std::string& cell = cells[index];
  const std::optional<double> value = parse_number(cell);
  if (value && allowed.contains(*value)) return *value;
  const std::string what = fmt::format("{}: {} is not valid (allowed: {}){}{}", columns_[index],
                                       cell.empty() ? "an empty cell" : cell, allowed.text(),
                                       hint.empty() ? "" : "; ", hint);
  if (!value) throw error(what);
  throw OutOfRangeError(
      error(what),
      {.line = line_, .column = columns_[index], .value = *value, .allowed = allowed.text()});
}

std::optional<CsvTable::Cells> CsvTable::next_line() {
  std::string line;
  int blank = 0;
  while (std::getline(stream_, line)) {
    ++line_;
    if (line.ends_with('\r')) line.pop_back();
    if (!line.empty()) break;
    ++blank;
  }
  if (stream_.bad()) throw InputError(file_ + ": cannot be read");
  if (line.empty()) return {};  // blank lines at the end say nothing
  if (blank > 0) throw InputError(fmt::format("{}:{}: an empty line", file_, line_ - 1));
  std::optional<Cells> cells = split_cells(line);
  if (!cells) throw error("a quote is not closed");
  return cells;
}

InputError CsvTable::error(const std::string& what) const {
  return InputError(fmt::format("{}:{}: {}", file_, line_, what));
}

}  // namespace regoplan
