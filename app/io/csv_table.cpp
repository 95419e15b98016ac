#include "app/io/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <istream>
#include <utility>

#include "app/io/csv_cells.h"
#include "app/io/number_text.h"

namespace regoplan {
namespace {

std::string trimmed(const std::string& cell) {
  const std::size_t from = cell.find_first_not_of(' ');
  return from == std::string::npos ? "" : cell.substr(from, cell.find_last_not_of(' ') - from + 1);
}

}  // namespace

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
  require_commas();
}

/// Of what other programs export, the two that would be told as missing columns.
void CsvTable::require_commas() const {
  const std::string& first = columns_.front();
  if (first.starts_with("\xFF\xFE") || first.starts_with("\xFE\xFF")) {
    throw error("the file is UTF-16 (allowed: UTF-8)");
  }
  if (columns_.size() > 1) return;
  for (const auto& [separator, name] : {std::pair{';', "semicolons"}, std::pair{'\t', "tabs"}}) {
    if (first.find(separator) != std::string::npos) {
      throw error(fmt::format("cells are separated by {} (allowed: commas)", name));
    }
  }
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
