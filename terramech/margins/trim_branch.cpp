#include "terramech/margins/trim_branch.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "terramech/basics/bracketed_root.h"

namespace regoplan {
namespace {

using Point = SteadyManoeuvre::Point;

/// Unit tangent of the branch, oriented like `along`.
std::optional<Point> tangent_of(const SteadyManoeuvre::Slopes& slopes, const Point& along) {
  Eigen::Matrix4d system;
  system << slopes, along.transpose();
  const Point tangent = system.partialPivLu().solve(Point{0, 0, 0, 1});
  const double length = tangent.norm();
  if (!std::isfinite(length) || length == 0) return std::nullopt;
  return tangent / length;
}

/// The trim on the plane through `predicted` across the tangent, by Newton's method; the slopes,
/// those of a trim nearby at first, are taken anew only when it slows down.
std::optional<Point> correct(const SteadyManoeuvre& manoeuvre, const Point& predicted,
                             const Point& tangent, const ForceLine& line,
                             std::optional<SteadyManoeuvre::Slopes> slopes, double converged) {
  constexpr double kAcceptedWhereSlow = 1e-4;
  Point at = predicted;
  std::optional<Eigen::PartialPivLU<Eigen::Matrix4d>> solver;
  double error_before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 12; ++iteration) {
    const auto residual = manoeuvre.residual(at, line);
    if (!residual) return std::nullopt;
    const double error = residual->cwiseAbs().maxCoeff();
    if (error < converged) return at;
    const bool slows = error > 0.2 * error_before;
    if (slows && iteration > 3 && error < kAcceptedWhereSlow) return at;
    if (slows && iteration > 6) return std::nullopt;
    if (!slopes || slows) {
      slopes = manoeuvre.slopes(at, line, *residual);
      solver.reset();
    }
    if (!slopes) return std::nullopt;
    error_before = error;
    if (!solver) {
      Eigen::Matrix4d system;
      system << *slopes, tangent.transpose();
      solver = system.partialPivLu();
    }
    Point missing;
    missing << *residual, tangent.dot(at - predicted);
    at -= solver->solve(missing);
    if (!at.allFinite()) return std::nullopt;
  }
  return std::nullopt;
}

/// Walks a branch, step by step.
class Walk {
 public:
  Walk(const SteadyManoeuvre& manoeuvre, const Point& start, const ForceLine& line)
      : manoeuvre_(manoeuvre),
        line_(line),
        at_(start),
        before_(start),
        slopes_(slopes_at(start)),
        slopes_before_(slopes_) {}

  const Point& at() const { return at_; }
  const Point& before() const { return before_; }
  bool folded() const { return tangent_[3] <= 0; }

  /// The branch at arc length `arc` beyond where it stood before the last step.
  std::optional<Point> between(double arc) const {
    // Cubic through both ends with their tangents.
    const double t = arc / last_arc_, u = 1 - t;
    const double along = std::max(tangent_.dot(tangent_before_), 0.1);
    const Point guess = u * u * ((1 + 2 * t) * before_ + arc * tangent_before_) +
                        t * t * ((3 - 2 * t) * at_ - (last_arc_ - arc) / along * tangent_);
    return correct(manoeuvre_, guess, tangent_before_, line_, slopes_before_, kConverged);
  }
  double last_arc() const { return last_arc_; }

  /// One step, halved as often as it takes; false where the branch cannot be followed further.
  bool step() {
    constexpr double kLongest = 0.4, kShortest = 1e-4;
    while (arc_ > kShortest) {
      const Point straight = at_ + arc_ * tangent_;
      auto next =
          correct(manoeuvre_, straight + arc_ * arc_ * bend_, tangent_, line_, slopes_, kOnTheWay);
      if (!next) next = correct(manoeuvre_, straight, tangent_, line_, slopes_, kOnTheWay);
      const auto slopes = next ? slopes_at(*next) : std::nullopt;
      const auto tangent = slopes ? tangent_of(*slopes, tangent_) : std::nullopt;
      if (tangent && tangent->dot(tangent_) > least_turn()) {
        before_ = at_;
        tangent_before_ = tangent_;
        slopes_before_ = slopes_;
        last_arc_ = arc_;
        bend_ = (*tangent - tangent_) / (2 * arc_);
        at_ = *next;
        tangent_ = *tangent;
        slopes_ = slopes;
        arc_ = std::min(arc_ * 1.6, kLongest);
        return true;
      }
      arc_ /= 2;
    }
    return false;
  }

 private:
  /// Balanced to this share of the load: where a branch ends, and where it only passes.
  static constexpr double kConverged = 3e-7, kOnTheWay = 1e-5;

  std::optional<SteadyManoeuvre::Slopes> slopes_at(const Point& at) const {
    return manoeuvre_.slopes(at, line_);
  }

  /// Cosine of the sharpest turn of a step. The branch has a kink where a wheel's side slip changes
  /// sign (its forces depend on |beta|): however short a step, it turns there.
  double least_turn() const {
    constexpr double kAcrossKink = 0.02;
    const bool sets_out = last_arc_ == 0;
    return sets_out || arc_ < kAcrossKink ? 0 : 0.8;
  }

  const SteadyManoeuvre& manoeuvre_;
  const ForceLine& line_;
  Point at_, before_;
  // The first step goes straight along p: it often starts at a kink, where the slopes are those of
  // one side only.
  Point tangent_ = Point{0, 0, 0, 1}, tangent_before_ = tangent_;
  std::optional<SteadyManoeuvre::Slopes> slopes_, slopes_before_;
  Point bend_ = Point::Zero();  // half the curvature of the last step
  double arc_ = 0.05;
  double last_arc_ = 0;
};

/// The top of p between the last two points, by golden section on the arc length.
Point fold_within_step(const Walk& walk) {
  constexpr double kGolden = 0.6180339887498949;
  Point top = walk.before()[3] > walk.at()[3] ? walk.before() : walk.at();
  const auto p_at = [&](double arc) {
    const auto point = walk.between(arc);
    if (point && (*point)[3] > top[3]) top = *point;
    return point ? (*point)[3] : -1e300;
  };
  double low = 0, high = walk.last_arc();
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double p_a = p_at(a), p_b = p_at(b);
  for (int i = 0; i < 20; ++i) {
    if (p_a > p_b) {
      high = b;
      b = a;
      p_b = p_a;
      a = high - kGolden * (high - low);
      p_a = p_at(a);
    } else {
      low = a;
      a = b;
      p_a = p_b;
      b = low + kGolden * (high - low);
      p_b = p_at(b);
    }
  }
  return top;
}

constexpr int kLongestWalk = 200;  // steps

/// Goes on to the fold, limits aside.
std::optional<double> fold_of(Walk walk) {
  for (int i = 0; i < kLongestWalk; ++i) {
    if (walk.folded()) return fold_within_step(walk)[3];
    if (!walk.step()) return walk.at()[3];
  }
  return std::nullopt;
}

}  // namespace

std::string_view name(BranchLimit limit) {
  switch (limit) {
    case BranchLimit::kFold:
      return "fold";
    case BranchLimit::kSlipAngle:
      return "slip angle";
    case BranchLimit::kSlip:
      return "slip";
    case BranchLimit::kSinkage:
      return "sinkage";
    case BranchLimit::kSteering:
      return "steering range";
    case BranchLimit::kTorque:
      return "motor torque";
    case BranchLimit::kLiftedWheel:
      return "lifted wheel";
  }
  return "";
}

LimitUse limit_use(const Trim& trim, const TrimLimits& limits) {
  double mean_load = 0;
  for (const TrimmedWheel& wheel : trim.wheels) mean_load += wheel.load_n;
  mean_load /= static_cast<double>(trim.wheels.size());

  LimitUse use;
  const auto consider = [&](double used, BranchLimit limit, std::size_t wheel) {
    if (used > use.used) use = {used, limit, static_cast<int>(wheel)};
  };
  for (std::size_t i = 0; i < trim.wheels.size(); ++i) {
    const TrimmedWheel& wheel = trim.wheels[i];
    consider(std::abs(wheel.slip_angle_rad) / limits.slip_angle_max_rad, BranchLimit::kSlipAngle,
             i);
    consider(std::abs(wheel.slip) / limits.slip_max, BranchLimit::kSlip, i);
    consider(wheel.forces.sinkage_m / limits.sinkage_max_m, BranchLimit::kSinkage, i);
    consider(std::abs(wheel.steer_rad) / limits.steer_angle_max_rad, BranchLimit::kSteering, i);
    consider(std::abs(wheel.forces.torque_nm) / limits.torque_max_nm, BranchLimit::kTorque, i);
    consider(1.02 - wheel.load_n / mean_load, BranchLimit::kLiftedWheel, i);
  }
  return use;
}

namespace {

/// Where the first limit is reached within the last step of a walk, over the arc length; the walk
/// stands beyond the limit.
Point limit_within_step(const Walk& walk, double used_before,
                        const std::function<double(const Point&)>& used) {
  Point at = walk.at();
  const auto excess = [&](double arc) {
    const auto point = walk.between(arc);
    if (!point) return 0.0;  // as near as the walk can say
    at = *point;
    return used(at) - 1;
  };
  bracketed_root(
      excess, {.from = 0, .f_from = used_before - 1, .to = walk.last_arc(), .f_to = used(at) - 1},
      {.argument = 1e-9, .value = 1e-5, .calls_max = 20});
  return at;
}

}  // namespace

BranchEnd follow_branch(const SteadyManoeuvre& manoeuvre, const Point& start, const ForceLine& line,
                        double target_p, const TrimLimits& limits, bool find_fold) {
  const auto use_at = [&](const Point& at) { return limit_use(manoeuvre.trim(at, line), limits); };
  const auto target_near = [&](Point guess) {
    guess[3] = target_p;
    const Point at = manoeuvre.solve(guess, line).value_or(guess);
    return BranchEnd{.p = target_p, .point = at, .reached_target = true};
  };
  const auto ended_at = [](const Point& at, const LimitUse& use) {
    return BranchEnd{.p = at[3], .point = at, .limit = use.limit, .wheel = use.wheel};
  };

  LimitUse use = use_at(start);
  if (use.used >= 1) return ended_at(start, use);
  Walk walk(manoeuvre, start, line);
  for (int i = 0; i < kLongestWalk; ++i) {
    const double used_before = use.used;
    if (!walk.step()) {  // a wheel lifts or sinks: the limit it is nearest to
      BranchEnd end = ended_at(walk.at(), use);
      end.fold_p = end.p;
      return end;
    }
    use = use_at(walk.at());
    if (walk.folded()) {
      const Point top = fold_within_step(walk);
      const LimitUse use_at_top = use_at(top);
      if (use_at_top.used < 1) {  // the fold comes before any limit
        if (top[3] >= target_p) return target_near(walk.before());
        BranchEnd end = ended_at(top, {.limit = BranchLimit::kFold, .wheel = use_at_top.wheel});
        end.fold_p = end.p;
        return end;
      }
    }
    if (use.used >= 1) {
      const Point at =
          limit_within_step(walk, used_before, [&](const Point& p) { return use_at(p).used; });
      if (at[3] >= target_p) return target_near(at);
      BranchEnd end = ended_at(at, use_at(at));
      if (find_fold) end.fold_p = fold_of(walk);
      return end;
    }
    if (walk.at()[3] >= target_p) return target_near(walk.at());
  }
  return ended_at(walk.at(), {.limit = BranchLimit::kFold});
}

}  // namespace regoplan
