#include "terramech/trim_branch.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>

namespace regoplan {
namespace {

using Point = SteadyManoeuvre::Point;

/// A point of the branch with the slopes near it.
struct BranchPoint {
  Point at;
  SteadyManoeuvre::Slopes slopes;
};

/// Unit tangent of the branch, oriented like `along`.
std::optional<Point> tangent_of(const SteadyManoeuvre::Slopes& slopes, const Point& along) {
  Eigen::Matrix4d system;
  system << slopes, along.transpose();
  const Point tangent = system.partialPivLu().solve(Point{0, 0, 0, 1});
  const double length = tangent.norm();
  if (!std::isfinite(length) || length == 0) return std::nullopt;
  return tangent / length;
}

/// The trim on the plane through `predicted` across the tangent, by Newton's method; the slopes are
/// taken anew only when it slows down.
std::optional<BranchPoint> correct(const SteadyManoeuvre& manoeuvre, const Point& predicted,
                                   const Point& tangent, const ForceLine& line) {
  constexpr double kConverged = 3e-7, kAccepted = 1e-4;
  Point at = predicted;
  std::optional<SteadyManoeuvre::Slopes> slopes;
  double error_before = 0;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const auto residual = manoeuvre.residual(at, line);
    if (!residual) return std::nullopt;
    const double error = residual->cwiseAbs().maxCoeff();
    if (slopes && error < kConverged) return BranchPoint{at, *slopes};
    const bool slows = slopes && error > 0.2 * error_before;
    if (slows && iteration > 3 && error < kAccepted) return BranchPoint{at, *slopes};
    if (slows && iteration > 6) return std::nullopt;
    if (!slopes || slows) slopes = manoeuvre.slopes(at, line, *residual);
    if (!slopes) return std::nullopt;
    error_before = error;
    Eigen::Matrix4d system;
    system << *slopes, tangent.transpose();
    Point missing;
    missing << *residual, tangent.dot(at - predicted);
    at -= system.partialPivLu().solve(missing);
    if (!at.allFinite()) return std::nullopt;
  }
  return std::nullopt;
}

/// Walks a branch, step by step.
class Walk {
 public:
  Walk(const SteadyManoeuvre& manoeuvre, const Point& start, const ForceLine& line)
      : manoeuvre_(manoeuvre), line_(line), at_(start), before_(start) {
    const auto residual = manoeuvre.residual(start, line);
    const auto slopes = residual ? manoeuvre.slopes(start, line, *residual) : std::nullopt;
    if (slopes) tangent_ = tangent_of(*slopes, Point{0, 0, 0, 1}).value_or(Point::Zero());
  }

  bool can_start() const { return tangent_ != Point::Zero() && tangent_[3] > 0; }
  const Point& at() const { return at_; }
  const Point& before() const { return before_; }
  bool folded() const { return tangent_[3] <= 0; }

  /// The branch at arc length `arc` beyond where it stood before the last step.
  std::optional<Point> between(double arc) const {
    const auto point = correct(manoeuvre_, before_ + arc * tangent_before_, tangent_before_, line_);
    if (!point) return std::nullopt;
    return point->at;
  }
  double last_arc() const { return last_arc_; }

  /// One step, halved as often as it takes; false where the branch cannot be followed further.
  bool step() {
    constexpr double kLongest = 0.4, kShortest = 1e-4;
    while (arc_ > kShortest) {
      const auto next = correct(manoeuvre_, at_ + arc_ * tangent_, tangent_, line_);
      const auto tangent = next ? tangent_of(next->slopes, tangent_) : std::nullopt;
      if (tangent && tangent->dot(tangent_) > 0.8) {
        before_ = at_;
        tangent_before_ = tangent_;
        last_arc_ = arc_;
        at_ = next->at;
        tangent_ = *tangent;
        arc_ = std::min(arc_ * 1.6, kLongest);
        return true;
      }
      arc_ /= 2;
    }
    return false;
  }

 private:
  const SteadyManoeuvre& manoeuvre_;
  const ForceLine& line_;
  Point at_, before_;
  Point tangent_ = Point::Zero(), tangent_before_ = Point::Zero();
  double arc_ = 0.2;
  double last_arc_ = 0;
};

double fold_between(const Walk& walk) {
  // The top of p between the last two points, by golden section on the arc length.
  constexpr double kGolden = 0.6180339887498949;
  const auto p_at = [&](double arc) {
    const auto point = walk.between(arc);
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
  return std::max({p_a, p_b, walk.before()[3], walk.at()[3]});
}

constexpr int kLongestWalk = 200;  // steps

/// Goes on to the fold, limits aside.
std::optional<double> fold_of(Walk walk) {
  for (int i = 0; i < kLongestWalk; ++i) {
    if (walk.folded()) return fold_between(walk);
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
    consider(1.02 - wheel.load_n / mean_load, BranchLimit::kLiftedWheel, i);
  }
  return use;
}

namespace {

/// Where the first limit is reached within the last step of a walk, by the Illinois method on the
/// arc length; the walk stands beyond the limit.
Point limit_within_step(const Walk& walk, double used_before,
                        const std::function<double(const Point&)>& used) {
  constexpr double kClose = 1e-6;
  double low = 0, high = walk.last_arc();
  double f_low = used_before - 1, f_high = used(walk.at()) - 1;
  Point at = walk.at();
  for (int i = 0; i < 20 && high - low > 1e-9; ++i) {
    const double middle = high - f_high * (high - low) / (f_high - f_low);
    const auto point = walk.between(middle);
    if (!point) break;
    const double f = used(*point) - 1;
    at = *point;
    if (std::abs(f) < kClose) break;
    if (f > 0) {
      high = middle;
      f_high = f;
      f_low /= 2;
    } else {
      low = middle;
      f_low = f;
      f_high /= 2;
    }
  }
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
  if (!walk.can_start()) return ended_at(start, {.limit = BranchLimit::kFold});
  for (int i = 0; i < kLongestWalk; ++i) {
    const double used_before = use.used;
    if (!walk.step()) {  // a wheel lifts or sinks: the limit it is nearest to
      BranchEnd end = ended_at(walk.at(), use);
      end.fold_p = end.p;
      return end;
    }
    use = use_at(walk.at());
    if (use.used >= 1) {
      const Point at =
          limit_within_step(walk, used_before, [&](const Point& p) { return use_at(p).used; });
      if (at[3] >= target_p) return target_near(at);
      BranchEnd end = ended_at(at, use_at(at));
      if (find_fold) end.fold_p = fold_of(walk);
      return end;
    }
    if (walk.at()[3] >= target_p) return target_near(walk.at());
    if (walk.folded()) {
      BranchEnd end = ended_at(walk.at(), {.limit = BranchLimit::kFold, .wheel = use.wheel});
      end.p = fold_between(walk);
      end.fold_p = end.p;
      return end;
    }
  }
  return ended_at(walk.at(), {.limit = BranchLimit::kFold});
}

}  // namespace regoplan
