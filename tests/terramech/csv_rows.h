#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

/// Rows of a CSV file by column name, for tests that read published tables.
namespace regoplan::csv_rows {

using Row = std::map<std::string, std::string>;

inline std::vector<Row> read(const std::string& file) {
  std::ifstream stream(file);
  std::string line, cell;
  std::vector<std::string> names;
  std::vector<Row> rows;
  while (std::getline(stream, line)) {
    if (line.ends_with('\r')) line.pop_back();
    std::istringstream cells(line);
    if (names.empty()) {
      while (std::getline(cells, cell, ',')) names.push_back(cell);
      continue;
    }
    Row row;
    for (std::size_t i = 0; i < names.size() && std::getline(cells, cell, ','); ++i) {
      row[names[i]] = cell;
    }
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

}  // namespace regoplan::csv_rows
