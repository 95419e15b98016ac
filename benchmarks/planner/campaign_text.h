#pragma once

#include <string>
#include <vector>

namespace regoplan {

/// A share with Wilson's interval.
std::string share_text(int successes, int runs);

/// By nearest rank; NaN of nothing.
double quantile(std::vector<double> values, double share);

/// Their median, 90 % quantile and largest.
std::string times_text(const std::vector<double>& times_s);

/// What the part of a key before the first or after the last of its colons says.
std::string first_part(const std::string& key);
std::string last_part(const std::string& key);

}  // namespace regoplan
