#include "drive_diagnosis/instruments/column_factors.h"

#include <algorithm>
#include <utility>

namespace regoplan {

std::vector<double> with_others_followed(const ColumnFactors& factors) {
  std::optional<double> all;
  bool agree = true;
  for (const std::optional<double>& factor : factors) {
    if (!factor) continue;
    agree = agree && (!all || *all == *factor);
    all = factor;
  }
  const double others = agree ? all.value_or(1) : 1;
  std::vector<double> result;
  for (const std::optional<double>& factor : factors) result.push_back(factor.value_or(others));
  return result;
}

void multiply_column(std::string_view channel, const std::vector<double>& factors,
                     std::vector<DriveRecording>& drives) {
  for (std::size_t i = 0; i < drives.size(); ++i) {
    DriveChannel* column = drives[i].channel(channel);
    if (column == nullptr || factors[i] == 1) continue;
    for (float& value : column->values) {
      value = static_cast<float>(factors[i] * static_cast<double>(value));
    }
  }
}

double FactoredColumns::factor() const {
  const auto other = std::ranges::find_if(factors, [](double factor) { return factor != 1; });
  return other == factors.end() ? 1 : *other;
}

bool FactoredColumns::is_of_every_drive() const {
  return std::ranges::all_of(factors, [this](double one) { return one == factor(); });
}

void FactoredColumns::add(std::string channel, std::vector<double> factors,
                          std::vector<FactoredColumns>& groups) {
  auto group = std::ranges::find(groups, factors, &FactoredColumns::factors);
  if (group == groups.end()) {
    groups.push_back({.factors = std::move(factors), .channels = {}});
    group = groups.end() - 1;
  }
  group->channels.push_back(std::move(channel));
}

std::vector<std::string> without_units(std::vector<std::string> channels) {
  for (std::string& channel : channels) {
    for (const std::string_view unit : {"_rad_s", "_rad", "_1pm"}) {
      if (channel.ends_with(unit)) channel.resize(channel.size() - unit.size());
    }
  }
  return channels;
}

std::vector<DriveFinding> findings_of(const FactoredColumns& columns, const DriveFinding& finding,
                                      const std::vector<DriveRecording>& drives) {
  if (columns.is_of_every_drive()) return {finding};
  std::vector<DriveFinding> findings;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (columns.factors[i] == 1) continue;
    findings.push_back(finding);
    findings.back().drive = drives[i].drive_id;
  }
  return findings;
}

}  // namespace regoplan
