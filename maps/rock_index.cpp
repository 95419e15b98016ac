#include "maps/rock_index.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "terramech/basics/input_error.h"

namespace regoplan {

namespace {

void validate(const std::vector<Rock>& rocks) {
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    const Rock& rock = rocks[i];
    constexpr double kMost = 1e12;  // farther out, differences of coordinates mean nothing
    const bool valid = std::abs(rock.x_m) <= kMost && std::abs(rock.y_m) <= kMost &&
                       rock.radius_m > 0 && rock.radius_m <= kMost && rock.height_m > 0 &&
                       rock.height_m <= kMost;
    if (!valid) {
      throw InputError(
          fmt::format("rock {}: x_m {}, y_m {}, radius_m {}, height_m {} is not valid (allowed: "
                      "numbers up to {}, radius_m and height_m above 0)",
                      i + 1, rock.x_m, rock.y_m, rock.radius_m, rock.height_m, kMost));
    }
  }
}

}  // namespace

RockIndex::RockIndex(std::vector<Rock> rocks) : rocks_(std::move(rocks)) {
  validate(rocks_);
  if (rocks_.empty()) return;
  double east_m = -std::numeric_limits<double>::infinity();
  double north_m = east_m;
  west_m_ = south_m_ = std::numeric_limits<double>::infinity();
  for (const Rock& rock : rocks_) {
    west_m_ = std::min(west_m_, rock.x_m);
    south_m_ = std::min(south_m_, rock.y_m);
    east_m = std::max(east_m, rock.x_m);
    north_m = std::max(north_m, rock.y_m);
    radius_max_m_ = std::max(radius_max_m_, rock.radius_m);
  }
  // About one rock a bin, and no bin smaller than a vehicle needs.
  const double width_m = east_m - west_m_;
  const double height_m = north_m - south_m_;
  const double count = static_cast<double>(rocks_.size());
  bin_m_ = std::max(
      {1.0, std::sqrt(width_m * height_m / count), width_m / (count + 1), height_m / (count + 1)});
  columns_ = static_cast<int>(width_m / bin_m_) + 1;
  rows_ = static_cast<int>(height_m / bin_m_) + 1;

  std::vector<std::size_t> bin_of_rock(rocks_.size());
  bin_begin_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (std::size_t i = 0; i < rocks_.size(); ++i) {
    bin_of_rock[i] = static_cast<std::size_t>(bin(rocks_[i].y_m - south_m_, rows_)) * columns_ +
                     bin(rocks_[i].x_m - west_m_, columns_);
    ++bin_begin_[bin_of_rock[i] + 1];
  }
  std::partial_sum(bin_begin_.begin(), bin_begin_.end(), bin_begin_.begin());
  order_.resize(rocks_.size());
  std::vector<std::uint32_t> next(bin_begin_.begin(), bin_begin_.end() - 1);
  for (std::size_t i = 0; i < rocks_.size(); ++i) {
    order_[next[bin_of_rock[i]]++] = static_cast<std::uint32_t>(i);
  }
}

}  // namespace regoplan
