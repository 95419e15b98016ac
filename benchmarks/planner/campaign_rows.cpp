#include "benchmarks/planner/campaign_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace regoplan {

CampaignRows::CampaignRows(std::filesystem::path file, const std::vector<std::string>& columns)
    : file_(std::move(file)) {
  const std::string header = fmt::format("key,{}", fmt::join(columns, ","));
  std::ifstream stream(file_);
  if (!stream) {
    std::ofstream(file_) << header << "\n";
    return;
  }
  std::string line;
  std::getline(stream, line);
  if (line != header) throw std::runtime_error(fmt::format("{}: not {}", file_.string(), header));
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    std::string cell;
    Row row;
    std::getline(cells, row.first, ',');
    while (std::getline(cells, cell, ',')) row.second.push_back(std::stod(cell));
    // A line cut short by the end of a process is done again.
    if (row.second.size() == columns.size()) rows_.push_back(std::move(row));
  }
}

bool CampaignRows::has(const std::string& key) const {
  return std::any_of(rows_.begin(), rows_.end(), [&](const Row& row) { return row.first == key; });
}

void CampaignRows::add(const std::string& key, const std::vector<double>& values) {
  std::ofstream(file_, std::ios::app) << fmt::format("{},{}\n", key, fmt::join(values, ","));
  rows_.emplace_back(key, values);
}

}  // namespace regoplan
