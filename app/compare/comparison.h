#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/compare/compared_result.h"

namespace regoplan {

/// Something that was set otherwise; null where it was not set at all.
struct ComparedSetting {
  std::string key;  ///< as in the result: `limits.margin_min`
  nlohmann::ordered_json a, b;
};

/// Entries of one name. Of what only one result has, the other is missing.
struct ComparedPair {
  std::string name;
  const ComparedEntry* a = nullptr;
  const ComparedEntry* b = nullptr;
  std::vector<std::optional<double>> change;  ///< b less a, of each metric that both have
  std::vector<bool> tied = {};  ///< of each metric: the draws of the soils do not tell it from a's
};

/// What differs between two results of one kind.
struct Comparison {
  std::vector<ComparedSetting> settings;
  std::vector<std::string> inputs;  ///< keys of files that are not the same
  std::vector<ComparedPair> pairs;  ///< in A's order, then what only B has
};

/// \param a, b must outlive the comparison \throws InputError where they are of two kinds
Comparison compared(const ComparedResult& a, const ComparedResult& b);

/// What a reader must know first, in a sentence or two.
std::string comparison_headline(const ComparedResult& a, const ComparedResult& b,
                                const Comparison& comparison);

/// comparison.json
nlohmann::ordered_json comparison_json(const ComparedResult& a, const ComparedResult& b,
                                       const Comparison& comparison);

}  // namespace regoplan
