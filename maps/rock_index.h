#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace regoplan {

/// A rock that stands on the ground: a vertical cylinder.
struct Rock {
  double x_m = 0;
  double y_m = 0;
  double radius_m = 0;
  double height_m = 0;
  bool operator==(const Rock&) const = default;
};

/// Finds the rocks near a place: rocks sorted into the square bins that hold their centres.
class RockIndex {
 public:
  RockIndex() = default;
  /// \throws InputError naming the first rock with a number that is not finite, or a radius or
  /// height that is not positive
  explicit RockIndex(std::vector<Rock> rocks);

  /// In the order in which they were given.
  const std::vector<Rock>& rocks() const { return rocks_; }

  /// Whether `test(rock)` holds for any rock whose bounding square touches the rectangle. Visits
  /// each such rock at most once and stops at the first that passes.
  template <typename Test>
  bool any_of(double x_min_m, double x_max_m, double y_min_m, double y_max_m, Test test) const {
    if (rocks_.empty()) return false;
    const int first_column = bin(x_min_m - radius_max_m_ - west_m_, columns_);
    const int last_column = bin(x_max_m + radius_max_m_ - west_m_, columns_);
    const int first_row = bin(y_min_m - radius_max_m_ - south_m_, rows_);
    const int last_row = bin(y_max_m + radius_max_m_ - south_m_, rows_);
    for (int row = first_row; row <= last_row; ++row) {
      const std::size_t row_begin = static_cast<std::size_t>(row) * columns_;
      // The bins of a row lie one after another, so do their rocks.
      for (std::uint32_t i = bin_begin_[row_begin + first_column];
           i < bin_begin_[row_begin + last_column + 1]; ++i) {
        const Rock& rock = rocks_[order_[i]];
        if (rock.x_m + rock.radius_m < x_min_m || rock.x_m - rock.radius_m > x_max_m ||
            rock.y_m + rock.radius_m < y_min_m || rock.y_m - rock.radius_m > y_max_m) {
          continue;
        }
        if (test(rock)) return true;
      }
    }
    return false;
  }

 private:
  int bin(double offset_m, int bins) const {
    return static_cast<int>(std::clamp(offset_m / bin_m_, 0.0, static_cast<double>(bins - 1)));
  }

  std::vector<Rock> rocks_;
  std::vector<std::uint32_t> order_;      ///< rocks by bin, row by row from the south
  std::vector<std::uint32_t> bin_begin_;  ///< where each bin begins in `order_`, and its end
  double west_m_ = 0;
  double south_m_ = 0;
  double bin_m_ = 1;
  double radius_max_m_ = 0;
  int columns_ = 0;
  int rows_ = 0;
};

}  // namespace regoplan
