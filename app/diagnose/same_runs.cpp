#include "app/diagnose/same_runs.h"

#include <fmt/format.h>

#include <algorithm>

#include "terramech/tables/number_text.h"

namespace regoplan {
namespace {

/// A number however it is written: 0.30 is 0.3.
std::string written_alike(const std::string& cell) {
  const std::optional<double> number = parse_number(cell);
  return number ? fmt::format("{}", *number) : cell;
}

/// What a run holds, each cell with the name of its column, in one order for all tables.
std::vector<std::string> content_of(const std::vector<std::string>& columns,
                                    const std::vector<std::string>& cells) {
  std::vector<std::string> content;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] == "run_id" || cells[i].empty()) continue;
    content.push_back(fmt::format("{}={}", columns[i], written_alike(cells[i])));
  }
  std::ranges::sort(content);
  return content;
}

std::vector<std::vector<std::string>> runs_of(const RecordingFile& file) {
  std::vector<std::vector<std::string>> runs;
  for (const auto& cells : file.cells) runs.push_back(content_of(file.columns, cells));
  std::ranges::sort(runs);
  return runs;
}

}  // namespace

bool are_same_runs(const RecordingFile& a, const RecordingFile& b) {
  return a.cells.size() == b.cells.size() && runs_of(a) == runs_of(b);
}

}  // namespace regoplan
