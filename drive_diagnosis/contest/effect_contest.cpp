#include "drive_diagnosis/contest/effect_contest.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "drive_diagnosis/contest/free_columns.h"
#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {
namespace {

constexpr double kZone = 3;      ///< another soil's numbers, in standard deviations of this one's
constexpr double kAlike = 10;    ///< twice 5 nats
constexpr double kCosine = 0.9;  ///< effects more alike than this are not told apart
constexpr double kLeastOfAlike = 0.8;  ///< of the gain of what it is alike
/// Twice nats beyond chance that a first effect is asked, and any other: what the fit of a known
/// effect leaves looks like any. Recordings that begin out of balance gained 1.2 beyond chance
/// where nothing was otherwise; zones that were not there gained up to 7.5, of causes that are
/// cured (benchmarks/drives/HISTORY.md), as a cause that nobody knows yet may let them again.
constexpr double kToSpareFirstFault = 4, kToSpareFirstZone = 8, kToSpare = 12;
constexpr double kNarrowest = 0.7;  ///< of the noise that is told, what there may be
constexpr std::size_t kShortest = 2;
constexpr double kPower_sigmas = 0.84;  ///< of four in five

double spare(bool is_zone, bool is_first) {
  if (!is_first) return kToSpare;
  return is_zone ? kToSpareFirstZone : kToSpareFirstFault;
}

/// Inner products in the metric of noise and all that varies without a name (Woodbury's identity).
class Metric {
 public:
  explicit Metric(const Eigen::MatrixXd& columns) {
    const Eigen::Index p = columns.cols();
    const Eigen::LLT<Eigen::MatrixXd> factor(columns.transpose() * columns +
                                             Eigen::MatrixXd::Identity(p, p));
    shadow_ = factor.matrixL().solve(columns.transpose());
  }
  Eigen::MatrixXd products(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) const {
    return a.transpose() * b - (shadow_ * a).transpose() * (shadow_ * b);
  }

 private:
  Eigen::MatrixXd shadow_;
};

/// Twice the nats of evidence for one number whose deviation is told.
double gain_of_one(double length, double product, double deviation) {
  const double variance = deviation * deviation;
  return product * product / (1 / variance + length) - std::log(1 + variance * length);
}
double fault_gain(double length, double product) {
  return gain_of_one(length, product, kFault);
}

/// Gains of zones from the products of their windows' columns.
class ZoneGains {
 public:
  ZoneGains(Eigen::MatrixXd lengths, std::size_t numbers)
      : lengths_(std::move(lengths)), q_(static_cast<Eigen::Index>(numbers)) {}

  struct Factor {
    Eigen::LLT<Eigen::MatrixXd> factor;
    double log_det = 0;
  };
  Factor factor_of(const Eigen::MatrixXd& length) const {
    Factor result;
    result.factor.compute(kZone * kZone * length + Eigen::MatrixXd::Identity(q_, q_));
    for (Eigen::Index k = 0; k < q_; ++k) {
      result.log_det += 2 * std::log(result.factor.matrixLLT()(k, k));
    }
    return result;
  }
  static double gain(const Factor& factor, const Eigen::VectorXd& product) {
    return (kZone * factor.factor.matrixL().solve(product)).squaredNorm() - factor.log_det;
  }
  Eigen::MatrixXd block(Eigen::Index i, Eigen::Index j) const {
    return lengths_.block(i * q_, j * q_, q_, q_);
  }
  Eigen::MatrixXd length_of(const Eigen::VectorXd& share) const {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(q_, q_);
    for (Eigen::Index i = 0; i < share.size(); ++i) {
      if (share[i] == 0) continue;
      for (Eigen::Index j = 0; j < share.size(); ++j) {
        if (share[j] != 0) sum += share[i] * share[j] * block(i, j);
      }
    }
    return sum;
  }
  Eigen::VectorXd product_of(const Eigen::VectorXd& share, const Eigen::VectorXd& products) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(q_);
    for (Eigen::Index i = 0; i < share.size(); ++i) sum += share[i] * products.segment(i * q_, q_);
    return sum;
  }
  /// Calls visit(first, last, length) for every stretch of free windows without a gap.
  template <class Visit>
  void each_stretch(const std::vector<bool>& follows, const std::vector<bool>& free,
                    const Visit& visit) const {
    const auto n = static_cast<Eigen::Index>(follows.size());
    const Eigen::Index longest =
        std::max<Eigen::Index>(kShortest, std::min<Eigen::Index>(n / 2, 24));
    for (Eigen::Index first = 0; first < n; ++first) {
      if (!free[static_cast<std::size_t>(first)]) continue;
      Eigen::MatrixXd length = block(first, first);
      for (Eigen::Index last = first + 1; last < std::min(n, first + longest); ++last) {
        const auto next = static_cast<std::size_t>(last);
        if (!follows[next] || !free[next]) break;
        for (Eigen::Index i = first; i < last; ++i) length += block(i, last) + block(last, i);
        length += block(last, last);
        visit(first, last, length);
      }
    }
  }

 private:
  Eigen::MatrixXd lengths_;
  Eigen::Index q_;
};

/// Windows that lie neither in a known zone nor beside one: what is left there is that zone's.
std::vector<bool> free_of_zones(const EffectContest& contest) {
  const std::size_t n = contest.follows.size();
  std::vector<bool> free(n, true);
  for (const auto& [share, columns] : contest.zones_known) {
    for (std::size_t w = 0; w < n; ++w) {
      if (share[static_cast<Eigen::Index>(w)] == 0) continue;
      free[w] = false;
      if (w > 0) free[w - 1] = false;
      if (w + 1 < n) free[w + 1] = false;
    }
  }
  return free;
}

/// One contest: products of the data and of null draws with all that competes.
class Contest {
 public:
  Contest(const EffectContest& contest, std::uint64_t seed)
      : contest_(contest),
        columns_(free_columns(contest)),
        metric_(columns_),
        zones_(metric_.products(contest.soil, contest.soil), contest.soil_numbers) {
    constexpr Eigen::Index kDraws = 250;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Eigen::MatrixXd draws(contest.data.size(), kDraws + 1);
    draws.col(0) = contest.data;
    Eigen::VectorXd off(columns_.cols());
    for (Eigen::Index i = 1; i <= kDraws; ++i) {
      for (Eigen::Index k = 0; k < draws.rows(); ++k) draws(k, i) = normal(random);
      for (double& value : off) value = normal(random);
      draws.col(i) += columns_ * off;
    }
    lengths_ = metric_.products(contest.parameters, contest.parameters);
    products_ = metric_.products(contest.parameters, draws);
    soil_products_ = metric_.products(contest.soil, draws);
    energy_ = metric_.products(contest.data, contest.data)(0, 0);
  }

  EffectFound strongest() const {
    EffectFound best{.gain = -1e9};
    Eigen::VectorXd largest = fault_gains(best);
    const double best_fault = best.gain;
    const double best_zone = scan_zones(largest, best);
    return judged(best, largest, best_fault, best_zone);
  }

  /// Of one fault, whatever is stronger.
  EffectFound of(std::size_t parameter) const {
    EffectFound strongest{.gain = -1e9};
    Eigen::VectorXd largest = fault_gains(strongest);
    const double best_zone = scan_zones(largest, strongest);
    const auto k = static_cast<Eigen::Index>(parameter);
    const double gain = fault_gain(lengths_(k, k), products_(k, 0));
    return judged({.parameter = parameter, .gain = gain}, largest, gain, best_zone);
  }

 private:
  /// \returns the largest of all faults, of the data and of each null draw
  Eigen::VectorXd fault_gains(EffectFound& best) const {
    const Eigen::Index draws = products_.cols();
    Eigen::VectorXd largest = Eigen::VectorXd::Constant(draws, -1e9);
    for (Eigen::Index k = 0; k < lengths_.cols(); ++k) {
      const auto parameter = static_cast<std::size_t>(k);
      if (!may_be_claimed(parameter)) continue;
      for (Eigen::Index i = 0; i < draws; ++i) {
        largest[i] = std::max(largest[i], fault_gain(lengths_(k, k), products_(k, i)));
      }
      if (largest[0] > best.gain) best = {.parameter = parameter, .gain = largest[0]};
    }
    return largest;
  }

  /// \param largest gains of all that competes, of the data and of each null draw
  EffectFound judged(EffectFound best, Eigen::VectorXd& largest, double best_fault,
                     double best_zone) const {
    const double wide = judge(largest, best);
    for (std::size_t k = 0; k < contest_.claimable.size(); ++k) {
      if (!may_be_claimed(k)) continue;
      const FaultAlone& fault = best.faults.emplace_back(fault_alone(k, best.chance, wide));
      if (is_alike(best, fault)) best.alike.push_back(fault);
    }
    best.zone_alike = !best.is_zone && best_zone > best_fault - kAlike * wide * wide;
    return best;
  }

  bool may_be_claimed(std::size_t parameter) const {
    return contest_.claimable[parameter] &&
           std::ranges::find(contest_.faults_known, parameter) == contest_.faults_known.end();
  }

  bool is_alike(const EffectFound& best, const FaultAlone& other) const {
    if (!best.is_zone && other.parameter == best.parameter) return true;
    if (other.gain > best.gain - kAlike) return true;
    // What would have to be far larger than faults are is not what it looks like.
    if (best.is_zone || other.gain < kLeastOfAlike * best.gain) return false;
    const auto i = static_cast<Eigen::Index>(best.parameter),
               k = static_cast<Eigen::Index>(other.parameter);
    return std::abs(lengths_(i, k)) > kCosine * std::sqrt(lengths_(i, i) * lengths_(k, k));
  }

  struct ZonePlace {
    Eigen::Index first = 0, last = 0;
    const Eigen::VectorXd* soil = nullptr;  ///< the likely one; none: of any numbers
  };

  /// \returns the gain of the best zone
  double scan_zones(Eigen::VectorXd& largest, EffectFound& best) const {
    const auto q = static_cast<Eigen::Index>(contest_.soil_numbers);
    double best_zone = -1e9;
    ZonePlace most;
    const auto consider = [&](const Eigen::VectorXd& gains, const ZonePlace& place) {
      largest = largest.cwiseMax(gains);
      if (gains[0] <= best_zone) return;
      best_zone = gains[0];
      most = place;
    };
    const std::vector<bool> free = free_of_zones(contest_);
    zones_.each_stretch(
        contest_.follows, free,
        [&](Eigen::Index first, Eigen::Index last, const Eigen::MatrixXd& length) {
          Eigen::MatrixXd product = Eigen::MatrixXd::Zero(q, soil_products_.cols());
          for (Eigen::Index w = first; w <= last; ++w)
            product += soil_products_.middleRows(w * q, q);
          const ZoneGains::Factor factor = zones_.factor_of(length);
          const Eigen::MatrixXd solved = factor.factor.matrixL().solve(product);
          consider(
              (kZone * kZone * solved.colwise().squaredNorm().transpose()).array() - factor.log_det,
              {.first = first, .last = last});
          for (const Eigen::VectorXd& soil : contest_.likely_soils) {
            const double along = soil.dot(length * soil);
            const Eigen::VectorXd gains = (product.transpose() * soil).unaryExpr([along](double p) {
              return gain_of_one(along, p, 1);
            });
            consider(gains, {.first = first, .last = last, .soil = &soil});
          }
        });
    if (best_zone > best.gain) {
      best = {.is_zone = true, .gain = best_zone};
      place(most, best);
      liken(best);
    }
    return best_zone;
  }

  double gain_of(const Eigen::VectorXd& share, const Eigen::VectorXd* soil) const {
    const Eigen::MatrixXd length = zones_.length_of(share);
    const Eigen::VectorXd product = zones_.product_of(share, soil_products_.col(0));
    if (soil) return gain_of_one(soil->dot(length * *soil), soil->dot(product), 1);
    return ZoneGains::gain(zones_.factor_of(length), product);
  }

  /// Whether all windows follow each other there.
  bool is_unbroken(double begins, double ends) const {
    for (auto w = static_cast<std::size_t>(begins) + 1; static_cast<double>(w) < ends; ++w) {
      if (!contest_.follows[w]) return false;
    }
    return true;
  }

  /// Where in its outermost windows a zone begins and ends: by quarters of a window.
  void place(const ZonePlace& most_likely, EffectFound& zone) const {
    const auto n = static_cast<Eigen::Index>(contest_.follows.size());
    constexpr double kStep = 0.25, kReach = 1.5;
    std::vector<std::array<double, 3>> places;  // begins, ends, gain
    for (double from = -kReach; from <= kReach; from += kStep) {
      for (double to = -kReach; to <= kReach; to += kStep) {
        const double begins = static_cast<double>(most_likely.first) + from;
        const double ends = static_cast<double>(most_likely.last) + 1 + to;
        if (begins < 0 || ends > static_cast<double>(n) || ends - begins < 1) continue;
        if (!is_unbroken(begins, ends)) continue;
        const Eigen::VectorXd share = shares_between(begins, ends, contest_.follows.size());
        places.push_back({begins, ends, gain_of(share, most_likely.soil)});
      }
    }
    const auto& most = *std::ranges::max_element(places, {}, [](const auto& at) { return at[2]; });
    zone.gain = std::max(zone.gain, most[2]);
    zone.begins = most[0];
    zone.ends = most[1];
    zone.share = shares_between(zone.begins, zone.ends, contest_.follows.size());
    zone.first_at = {most[0], most[0]};
    zone.last_at = {most[1], most[1]};
    for (const auto& [begins, ends, gain] : places) {
      constexpr double kWithin = 3.84;  // of chi squared, 95 %
      if (gain < most[2] - kWithin) continue;
      zone.first_at = {std::min(zone.first_at[0], begins), std::max(zone.first_at[1], begins)};
      zone.last_at = {std::min(zone.last_at[0], ends), std::max(zone.last_at[1], ends)};
    }
  }

  /// Which of the likely soils lies there.
  void liken(EffectFound& zone) const {
    const Eigen::MatrixXd length = zones_.length_of(zone.share);
    const Eigen::VectorXd product = zones_.product_of(zone.share, soil_products_.col(0));
    double most = ZoneGains::gain(zones_.factor_of(length), product);
    for (std::size_t i = 0; i < contest_.likely_soils.size(); ++i) {
      const Eigen::VectorXd& soil = contest_.likely_soils[i];
      const double along = soil.dot(length * soil), towards = soil.dot(product);
      const double gain = gain_of_one(along, towards, 1);
      if (gain < most) continue;
      most = gain;
      zone.like = i;
      zone.like_size = towards / (1 + along);
      zone.like_std = 1 / std::sqrt(1 + along);
    }
  }

  /// \returns how wide the noise is, as a multiple of what is told
  double judge(Eigen::VectorXd& largest, EffectFound& best) const {
    const std::vector<double> chance(largest.data() + 1, largest.data() + largest.size());
    // Gains fall off as exp(-gain / 2): from one in twenty to one in a thousand.
    best.chance = quantile_value(chance, 0.95) + 2 * std::log(50.0);
    double explained = best.gain;
    if (!best.is_zone) {
      const auto k = static_cast<Eigen::Index>(best.parameter);
      explained = products_(k, 0) * products_(k, 0) / lengths_(k, k);
    }
    // What is left tells how wide the noise is, which inputs are told to have more or less than. A
    // zone has none narrower: one of chance takes what goes on from window to window out of it.
    const double wide =
        std::max(best.is_zone ? 1 : kNarrowest,
                 std::sqrt((energy_ - explained) / static_cast<double>(contest_.data.size())));
    best.asked = best.chance + spare(true, is_first());
    best.gain /= wide * wide;
    if (best.is_zone) {
      best.sigmas = std::sqrt(std::max(0.0, best.gain));
      best.stands_out = best.gain > best.asked;
    } else {
      const FaultAlone fault = fault_alone(best.parameter, best.chance, wide);
      best.size = fault.size;
      best.std = fault.std;
      best.sigmas = std::abs(best.size) / best.std;
      best.stands_out = best.gain > best.chance &&
                        best.sigmas * best.sigmas > best.chance + spare(false, is_first());
    }
    return wide;
  }

  bool is_first() const { return contest_.zones_known.empty() && contest_.faults_known.empty(); }

  /// \param wide what the noise that is told is to be multiplied by
  FaultAlone fault_alone(std::size_t parameter, double chance, double wide) const {
    const auto k = static_cast<Eigen::Index>(parameter);
    const double length = lengths_(k, k), product = products_(k, 0);
    FaultAlone fault{.parameter = parameter,
                     .size = product / length,
                     // the metric holds the parameter's own prior as well
                     .std = wide * std::sqrt(std::max(1e-12, 1 / length - 1)),
                     .gain = fault_gain(length, product) / (wide * wide)};
    const double asked_sigmas = std::sqrt(chance + spare(false, is_first()));
    const double product_asked =
        std::sqrt((chance * wide * wide + std::log(1 + kFault * kFault * length)) *
                  (1 / (kFault * kFault) + length));
    fault.least_shown =
        std::max(asked_sigmas * fault.std, product_asked / length) + kPower_sigmas * fault.std;
    return fault;
  }

  const EffectContest& contest_;
  Eigen::MatrixXd columns_;
  Metric metric_;
  ZoneGains zones_;
  Eigen::MatrixXd lengths_, products_, soil_products_;
  double energy_ = 0;
};

}  // namespace

Eigen::VectorXd shares_between(double begins, double ends, std::size_t windows) {
  Eigen::VectorXd share(static_cast<Eigen::Index>(windows));
  for (Eigen::Index w = 0; w < share.size(); ++w) {
    const auto from = static_cast<double>(w);
    share[w] = std::clamp(std::min(ends, from + 1) - std::max(begins, from), 0.0, 1.0);
  }
  return share;
}

EffectFound strongest_effect(const EffectContest& contest, std::uint64_t seed) {
  return Contest(contest, seed).strongest();
}

EffectFound judged_anew(EffectContest contest, std::size_t fault, std::uint64_t seed) {
  std::erase(contest.faults_known, fault);
  return Contest(contest, seed).of(fault);
}

std::vector<std::optional<int>> shortest_zones_shown(const EffectContest& contest, double asked) {
  constexpr double kOfPlaces = 0.9;
  const double needed = std::pow(std::sqrt(std::max(asked, 0.0)) + kPower_sigmas, 2);
  const Metric metric(free_columns(contest));
  const ZoneGains zones(metric.products(contest.soil, contest.soil), contest.soil_numbers);
  const std::size_t lengths = contest.follows.size() + 1;
  std::vector<int> places(lengths);
  std::vector<std::vector<int>> shown(contest.likely_soils.size(), places);
  zones.each_stretch(contest.follows, free_of_zones(contest),
                     [&](Eigen::Index first, Eigen::Index last, const Eigen::MatrixXd& length) {
                       const auto windows = static_cast<std::size_t>(last - first + 1);
                       ++places[windows];
                       for (std::size_t i = 0; i < shown.size(); ++i) {
                         const Eigen::VectorXd& soil = contest.likely_soils[i];
                         const double along = soil.dot(length * soil);
                         shown[i][windows] += gain_of_one(along, along, 1) > needed;
                       }
                     });
  std::vector<std::optional<int>> shortest;
  for (const std::vector<int>& of_soil : shown) {
    std::optional<int>& least = shortest.emplace_back();
    for (std::size_t windows = 1; windows < lengths; ++windows) {
      if (places[windows] == 0) continue;
      if (of_soil[windows] < kOfPlaces * places[windows]) {
        least.reset();
      } else if (!least) {
        least = static_cast<int>(windows);
      }
    }
  }
  return shortest;
}

}  // namespace regoplan
