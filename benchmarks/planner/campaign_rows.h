#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace regoplan {

/// The results of a campaign, a row a run, kept in a CSV file as they come: a campaign that was
/// stopped goes on where it was.
class CampaignRows {
 public:
  using Row = std::pair<std::string, std::vector<double>>;  ///< key, values

  /// Reads what there is. \throws std::runtime_error for a file with other columns
  CampaignRows(std::filesystem::path file, const std::vector<std::string>& columns);

  bool has(const std::string& key) const;
  /// Appends, and flushes.
  void add(const std::string& key, const std::vector<double>& values);
  const std::vector<Row>& all() const { return rows_; }

 private:
  std::filesystem::path file_;
  std::vector<Row> rows_;
};

}  // namespace regoplan
