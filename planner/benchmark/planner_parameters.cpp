#include "planner/benchmark/planner_parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

std::vector<std::string_view> parts(std::string_view text, char separator) {
  std::vector<std::string_view> all;
  for (std::size_t end = text.find(separator); end != text.npos; end = text.find(separator)) {
    all.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  all.push_back(text);
  return all;
}

template <typename Number>
std::optional<Number> whole_text_as(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// OMPL's own form of a range: `0,1` and `a,b,c` list what is allowed, `0.:1.`, `0.:.05:1.` and
/// `1:10:100` say from where to where, of whole numbers where no point stands in them. Nothing
/// suggested allows everything.
class SuggestedRange {
 public:
  explicit SuggestedRange(const std::string& suggestion) : suggestion_(suggestion) {
    const std::vector<std::string_view> ends = parts(suggestion_, ':');
    if (ends.size() < 2) return;
    low_ = whole_text_as<double>(ends.front());
    high_ = whole_text_as<double>(ends.back());
  }

  bool holds(const std::string& value) const {
    if (suggestion_.empty()) return true;
    if (!low_ || !high_) {
      const std::vector<std::string_view> listed = parts(suggestion_, ',');
      return std::ranges::find(listed, value) != listed.end();
    }
    if (is_whole() && !whole_text_as<long>(value)) return false;
    const std::optional<double> number = whole_text_as<double>(value);
    return number && *number >= *low_ && *number <= *high_;
  }

  /// What is allowed, in words.
  std::string text() const {
    if (low_ && high_) {
      return fmt::format("{}{:g} to {:g}", is_whole() ? "whole, " : "", *low_, *high_);
    }
    return fmt::format("{}", fmt::join(parts(suggestion_, ','), ", "));
  }

 private:
  bool is_whole() const { return suggestion_.find('.') == std::string::npos; }

  std::string suggestion_;
  std::optional<double> low_, high_;
};

/// \returns whether OMPL could read the value as the parameter's type: for some types it says so,
/// for others it throws
bool set_parameter(ompl::base::ParamSet& parameters, const std::string& key,
                   const std::string& value) {
  try {
    return parameters.setParam(key, value);
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

void set_parameters(ompl::base::Planner& planner, const std::string& name,
                    const std::map<std::string, std::string>& parameters) {
  std::vector<std::string> known;
  planner.params().getParamNames(known);
  for (const auto& [key, value] : parameters) {
    if (!planner.params().hasParam(key)) {
      throw InputError(fmt::format("{}: parameter {} is not known (allowed: {})", name, key,
                                   fmt::join(known, ", ")));
    }
    const SuggestedRange range(planner.params()[key].getRangeSuggestion());
    if (!range.holds(value)) {
      throw InputError(fmt::format("{}: parameter {}: {} is not valid (allowed: {})", name, key,
                                   value, range.text()));
    }
    if (!set_parameter(planner.params(), key, value)) {
      throw InputError(fmt::format("{}: parameter {}: {} is not valid", name, key, value));
    }
  }
}

}  // namespace regoplan
