#include "diagnosis/checks/location.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnosis/bed/condition_axes.h"
#include "diagnosis/bed/discrepancy.h"
#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

using Box = std::map<std::string, std::array<double, 2>>;

struct Region {
  std::size_t channel = 0;
  Box box;
  Eigen::VectorXd weight;  // sums residuals to their weighted mean
  std::vector<bool> inside;
};

struct Interval {
  std::size_t from, to;  // levels
};

std::vector<Interval> intervals(std::size_t levels, bool boxes) {
  constexpr std::size_t kMostForBoxes = 12;
  std::vector<Interval> all;
  for (std::size_t from = 0; from < levels; ++from) {
    for (std::size_t to = from; to < levels; ++to) {
      const bool whole = from == 0 && to == levels - 1;
      const bool half = from == 0 || to == levels - 1;
      if (!whole && (half || (boxes && levels <= kMostForBoxes))) all.push_back({from, to});
    }
  }
  return all;
}

std::vector<std::size_t> members(const ConditionAxis& axis, const Interval& interval) {
  std::vector<std::size_t> inside;
  for (std::size_t k = 0; k < axis.level.size(); ++k) {
    if (axis.level[k] >= interval.from && axis.level[k] <= interval.to) inside.push_back(k);
  }
  return inside;
}

/// Takes from the values of a channel the surface that a smooth discrepancy makes of them.
Eigen::MatrixXd left_by_surface(const TestBed& bed, const ChannelData& data) {
  // Strong enough to follow what the model lacks, of any size that was met; closer scales would
  // pass through every condition and leave nothing to be told by the run before.
  constexpr double kAmplitude = 8;  // of one run's noise
  const DiscrepancyScales& scales = discrepancy_scales()[1];
  const Eigen::Index n = data.mean.size();
  const ConditionsAt at = conditions_of(bed, data);
  const Eigen::MatrixXd whole = data.noise + std::pow(kAmplitude * data.scale, 2) *
                                                 discrepancy_kernels(scales, data.channel, at, at);
  return data.noise * whole.llt().solve(Eigen::MatrixXd::Identity(n, n));
}

class Scan {
 public:
  explicit Scan(const TestBed& bed) : bed_(bed), axes_(condition_axes(bed)) {
    std::vector<std::size_t> everywhere(bed.conditions.size());
    for (std::size_t k = 0; k < everywhere.size(); ++k) everywhere[k] = k;
    add({}, everywhere);
    for (const ConditionAxis& axis : axes_) {
      for (const Interval& interval : intervals(axis.levels, true)) {
        add({&axis}, members(axis, interval));
      }
    }
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      for (std::size_t b = a + 1; b < axes_.size(); ++b) corners(axes_[a], axes_[b]);
    }
    if (const auto memory = memory_axis(bed)) {
      const std::size_t first = regions_.size();
      for (const Interval& interval : intervals(memory->levels, true)) {
        std::vector<std::size_t> told = members(*memory, interval);
        std::erase_if(told, [&bed](std::size_t k) { return !follows_one_slip(bed.conditions[k]); });
        add({&*memory}, told);
      }
      count_beyond_own_conditions(first);
    }
  }

  const std::vector<Region>& regions() const { return regions_; }

 private:
  void corners(const ConditionAxis& a, const ConditionAxis& b) {
    constexpr std::size_t kMostLevels = 12;
    if (a.levels > kMostLevels || b.levels > kMostLevels || b.column == "time_s") return;
    for (const Interval& of_a : intervals(a.levels, false)) {
      const std::vector<std::size_t> in_a = members(a, of_a);
      for (const Interval& of_b : intervals(b.levels, false)) {
        std::vector<std::size_t> both;
        for (const std::size_t k : in_a) {
          if (b.level[k] >= of_b.from && b.level[k] <= of_b.to) both.push_back(k);
        }
        add({&a, &b}, both);
      }
    }
  }

  void add(const std::vector<const ConditionAxis*>& axes, const std::vector<std::size_t>& inside) {
    constexpr std::size_t kFewest = 2;
    if (inside.size() < kFewest) return;
    throw_if_stopped(bed_.stop);
    for (std::size_t c = 0; c < bed_.channels.size(); ++c) {
      const ChannelData& data = bed_.channels[c];
      Region region{.channel = c,
                    .weight = Eigen::VectorXd::Zero(bed_.size()),
                    .inside = std::vector<bool>(bed_.conditions.size())};
      std::size_t count = 0;
      for (std::size_t i = 0; i < data.conditions.size(); ++i) {
        if (!std::ranges::binary_search(inside, data.conditions[i])) continue;
        const auto row = static_cast<Eigen::Index>(i);
        region.weight[bed_.offset(c) + row] = 1 / data.noise(row, row);
        region.inside[data.conditions[i]] = true;
        ++count;
      }
      if (count < kFewest) continue;
      region.weight /= region.weight.sum();
      for (const ConditionAxis* axis : axes) {
        double low = INFINITY, high = -INFINITY;
        for (const std::size_t k : inside) {
          low = std::min(low, axis->value[k]);
          high = std::max(high, axis->value[k]);
        }
        region.box[axis->column] = {low, high};
      }
      regions_.push_back(std::move(region));
    }
  }

  /// Where a series sweeps over slip the run before tells of the run itself. From `first` on,
  /// regions take the mean of what a surface through the residuals over each run's own conditions
  /// leaves, scaled so that a residual of 1 in the region and 0 elsewhere still counts 1.
  void count_beyond_own_conditions(std::size_t first) {
    for (std::size_t c = 0; c < bed_.channels.size(); ++c) {
      const Eigen::MatrixXd left = left_by_surface(bed_, bed_.channels[c]);
      for (std::size_t i = first; i < regions_.size(); ++i) {
        if (regions_[i].channel != c) continue;
        auto weight = regions_[i].weight.segment(bed_.offset(c), left.rows());
        const Eigen::VectorXd within = (weight.array() > 0).cast<double>();
        const Eigen::VectorXd beyond = left.transpose() * weight;
        weight = beyond / beyond.dot(within);
      }
    }
  }

  const TestBed& bed_;
  std::vector<ConditionAxis> axes_;
  std::vector<Region> regions_;
};

bool mostly_shared(const Region& a, const Region& b) {
  if (a.channel != b.channel) return false;
  int both = 0, of_a = 0, of_b = 0;
  for (std::size_t k = 0; k < a.inside.size(); ++k) {
    both += a.inside[k] && b.inside[k];
    of_a += a.inside[k];
    of_b += b.inside[k];
  }
  return 2 * both >= std::min(of_a, of_b);
}

}  // namespace

std::vector<MismatchRegion> locate(const CondensedRecording& recording, const FitRemainder& fit,
                                   std::uint64_t seed) {
  constexpr int kDraws = 400;
  constexpr std::size_t kMostShown = 8;
  const std::vector<Region> regions = Scan(recording.bed).regions();
  const auto count = static_cast<Eigen::Index>(regions.size());
  Eigen::MatrixXd weights(count, recording.bed.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    weights.row(i) = regions[static_cast<std::size_t>(i)].weight.transpose();
  }
  const Eigen::VectorXd effect = weights * fit.residual;
  const Eigen::MatrixXd by_chance = weights * residuals_of_noise(recording, fit, seed, kDraws);
  const Eigen::VectorXd deviation =
      (by_chance.array().square().rowwise().mean()).sqrt().max(1e-300);
  std::vector<double> largest(kDraws);
  for (int d = 0; d < kDraws; ++d) {
    largest[static_cast<std::size_t>(d)] =
        (by_chance.col(d).array() / deviation.array()).abs().maxCoeff();
  }
  std::ranges::sort(largest);
  std::vector<Eigen::Index> order(regions.size());
  for (Eigen::Index i = 0; i < count; ++i) order[static_cast<std::size_t>(i)] = i;
  const auto score = [&](Eigen::Index i) { return std::abs(effect[i]) / deviation[i]; };
  std::ranges::stable_sort(order, [&](auto a, auto b) { return score(a) > score(b); });
  std::vector<MismatchRegion> found;
  std::vector<const Region*> kept;
  for (const Eigen::Index i : order) {
    const auto beyond = largest.end() - std::ranges::lower_bound(largest, score(i));
    const double p = (1.0 + static_cast<double>(beyond)) / (kDraws + 1.0);
    if (p > Thresholds::kLocation_p || found.size() == kMostShown) break;
    const Region& region = regions[static_cast<std::size_t>(i)];
    if (std::ranges::any_of(kept, [&](const Region* k) { return mostly_shared(*k, region); })) {
      continue;
    }
    kept.push_back(&region);
    found.push_back({.channel = recording.bed.channels[region.channel].channel,
                     .region = region.box,
                     .effect = effect[i],
                     .ci95 = {effect[i] - 1.96 * deviation[i], effect[i] + 1.96 * deviation[i]},
                     .p_value = p});
  }
  return found;
}

std::optional<MismatchRegion> last_part_of(const CondensedRecording& recording) {
  if (!recording.course) return std::nullopt;
  const Course& course = *recording.course;
  const auto runs = static_cast<double>(course.value.size());
  std::optional<MismatchRegion> clearest;
  double most = 0;
  for (std::size_t c = 0; c < recording.noise.size(); ++c) {
    double early = 0, late = 0, all = 0, earlies = 0, lates = 0, late_from = INFINITY;
    for (std::size_t run = 0; run < course.value.size(); ++run) {
      const double part = recording.noise[c].trend * course.trend[c][run];
      all += part / runs;
      if (course.value[run] < 1.0 / 3) early += part, ++earlies;
      if (course.value[run] <= 2.0 / 3) continue;
      late += part;
      ++lates;
      late_from = std::min(late_from, course.along[run]);
    }
    if (earlies == 0 || lates == 0) continue;
    const double step = std::abs(late / lates - early / earlies) / recording.noise[c].constant;
    if (step <= most) continue;
    most = step;
    // Off the model, which was fitted to all of the course.
    const double effect = late / lates - all;
    const double deviation = recording.noise[c].constant * std::sqrt(2 / std::max(runs, 1.0));
    const double from = course.is_stretch ? course.low : late_from;
    clearest = MismatchRegion{.channel = recording.bed.channels[c].channel,
                              .region = {{course.column, {from, course.high}}},
                              .effect = effect,
                              .ci95 = {effect - 1.96 * deviation, effect + 1.96 * deviation},
                              .p_value = std::exp(-course.gain_nats)};
  }
  return clearest;
}

}  // namespace regoplan
