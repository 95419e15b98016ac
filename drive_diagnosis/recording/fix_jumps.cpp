#include "drive_diagnosis/recording/fix_jumps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {
namespace {

/// How far a fix lies off the polynomial through others.
struct Offset {
  double size_m = 0;
  double noise_gain = 0;  ///< the standard deviation of either coordinate, by that of a fix
};

/// Usual distances off the track of others beyond which a fix is far off it: those of sound
/// recordings lie within ten.
constexpr double kFarScatters = 15;

/// Some fixes about a place, in order of their time.
using Around = std::array<std::size_t, 4>;

class FixTrack {
 public:
  FixTrack(const DriveRecording& drive, std::vector<std::size_t> rows, double speed_max_mps)
      : drive_(drive), rows_(std::move(rows)), speed_max_mps_(speed_max_mps) {
    std::vector<double> sizes;
    for (std::size_t k = 2; k + 2 < rows_.size(); ++k) {
      const auto around = around_run(k, 1);
      if (!around) continue;
      const Offset offset = offset_of(k, *around);
      sizes.push_back(offset.size_m / offset.noise_gain);
    }
    constexpr std::size_t kLeast = 8;
    if (sizes.size() >= kLeast) scatter_m_ = median_value(std::move(sizes));
  }

  std::vector<FixJump> jumps() {
    std::vector<FixJump> found;
    if (!scatter_m_) return found;
    for (std::size_t k = 0; k < rows_.size();) {
      const std::vector<FixJump> run = jumps_from(k);
      found.insert(found.end(), run.begin(), run.end());
      for (const FixJump& jump : run) std::erase(rows_, jump.row);
      // What had a jump beside it is judged anew without it.
      k = run.empty() ? k + 1 : k - std::min<std::size_t>(k, 4);
    }
    return found;
  }

 private:
  double time_s(std::size_t k) const { return drive_.time_s[rows_[k]]; }
  double way_m(std::size_t a, std::size_t b) const {
    return std::hypot(drive_.x_m[rows_[b]] - drive_.x_m[rows_[a]],
                      drive_.y_m[rows_[b]] - drive_.y_m[rows_[a]]);
  }
  bool is_near(std::size_t k) const { return time_s(k) - time_s(k - 1) <= kFixesApart_s; }

  /// Two fixes before so many in a row and two after; four of one side where the other has less.
  std::optional<Around> around_run(std::size_t first, std::size_t count) const {
    const std::size_t next = first + count;
    std::size_t before = 0, after = 0;
    while (before < 4 && before < first && is_near(first - before)) ++before;
    while (after < 4 && next + after < rows_.size() && is_near(next + after)) ++after;
    std::size_t used = 2;
    if (before < 2) used = 0;
    if (after < 2) used = 4;
    if (before < used || after < 4 - used) return {};
    Around around;
    for (std::size_t i = 0; i < 4; ++i) {
      around.at(i) = i < used ? first - used + i : next + i - used;
    }
    return around;
  }

  template <class Others>
  Offset offset_of(std::size_t k, const Others& others) const {
    double x_m = drive_.x_m[rows_[k]], y_m = drive_.y_m[rows_[k]], squares = 1;
    for (const std::size_t a : others) {
      double weight = 1;
      for (const std::size_t b : others) {
        if (b != a) weight *= (time_s(k) - time_s(b)) / (time_s(a) - time_s(b));
      }
      x_m -= weight * drive_.x_m[rows_[a]];
      y_m -= weight * drive_.y_m[rows_[a]];
      squares += weight * weight;
    }
    return {.size_m = std::hypot(x_m, y_m), .noise_gain = std::sqrt(squares)};
  }

  /// By how much a fix may be off: fixes scatter, and a vehicle that sets off, stops or turns goes
  /// no polynomial's way.
  double allowed_m(const Offset& offset, const Around& around) const {
    constexpr double kOfWay = 0.1, kOfSpeedMax = 0.1;
    const auto speed_mps = [&](std::size_t a, std::size_t b) {
      return way_m(a, b) / (time_s(b) - time_s(a));
    };
    const double fastest_mps =
        std::max({speed_mps(around[0], around[1]), speed_mps(around[2], around[3]),
                  kOfSpeedMax * speed_max_mps_});
    const double span_s = time_s(around[3]) - time_s(around[0]);
    return offset.noise_gain * (kFarScatters * *scatter_m_ + kOfWay * fastest_mps * span_s);
  }

  /// Whether the fixes around go on from one another: they do not across a step of the datum, nor
  /// where one of them jumps.
  bool goes_on(const Around& around) const {
    constexpr double kOfAllowed = 0.5;
    const Offset offset = offset_of(around[1], std::array{around[0], around[2], around[3]});
    return offset.size_m <= kOfAllowed * allowed_m(offset, around);
  }

  /// Whether a fix is so near the one before that it needs no look at those around.
  bool is_beside_the_last(std::size_t k) const {
    if (k == 0 || !is_near(k)) return false;
    const double driven_m = speed_max_mps_ * (time_s(k) - time_s(k - 1));
    return way_m(k - 1, k) + driven_m <= kFarScatters * *scatter_m_;
  }

  /// Those of the shortest run from there that jump; none where none does.
  std::vector<FixJump> jumps_from(std::size_t first) const {
    constexpr std::size_t kFew = 3;
    constexpr double kLongest_s = 1;
    if (is_beside_the_last(first)) return {};
    for (std::size_t count = 1; first + count <= rows_.size(); ++count) {
      const std::size_t last = first + count - 1;
      if (count > 1 && !is_near(last)) break;
      if (count > kFew && time_s(last) - time_s(first) > kLongest_s) break;
      const auto around = around_run(first, count);
      if (!around || !goes_on(*around)) continue;
      std::vector<FixJump> off;
      for (std::size_t k = first; k <= last; ++k) {
        const Offset offset = offset_of(k, *around);
        if (offset.size_m <= allowed_m(offset, *around)) {
          if (k == first) break;
          continue;
        }
        off.push_back({.row = rows_[k], .off_m = offset.size_m});
      }
      return off;
    }
    return {};
  }

  const DriveRecording& drive_;
  std::vector<std::size_t> rows_;
  double speed_max_mps_;
  /// Of a fix about the cubic through those around, in the median.
  std::optional<double> scatter_m_;
};

}  // namespace

std::vector<FixJump> fix_jumps(const DriveRecording& drive, std::vector<std::size_t> rows,
                               double speed_max_mps) {
  return FixTrack(drive, std::move(rows), speed_max_mps).jumps();
}

}  // namespace regoplan
