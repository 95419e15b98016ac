#include "diagnosis/fit/candidate_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "diagnosis/bed/whitening.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

constexpr double kFarthest = 6;  // prior standard deviations

bool is_slow(const Hypothesis& candidate) {
  return std::ranges::any_of(candidate.effects, &Effect::slow);
}

/// The fit's own coordinates and the shape's factors as one linear model.
Linearised linearised(const TestBed& bed, const CandidateFit& fit) {
  Linearised model{.residual = bed.measured() - fit.prediction + fit.jacobian * fit.x};
  model.jacobian.resize(bed.size(), fit.jacobian.cols() + fit.shape.cols());
  model.jacobian << fit.jacobian, fit.shape;
  return model;
}

/// Misfit under given settings, the shape's factors marginalised.
class ShapedMisfit {
 public:
  ShapedMisfit(const FitProblem& problem, const std::vector<std::size_t>& settings,
               Eigen::MatrixXd shape)
      : problem_(problem), settings_(settings), shape_(white(std::move(shape))) {
    const Eigen::Index p = shape_.cols();
    if (p == 0) return;
    precision_.compute(shape_.transpose() * shape_ + Eigen::MatrixXd::Identity(p, p));
  }

  double of(const Eigen::VectorXd& residual) const {
    const Eigen::VectorXd r = white(residual);
    if (shape_.cols() == 0) return r.squaredNorm();
    const Eigen::VectorXd b = shape_.transpose() * r;
    return r.squaredNorm() - b.dot(precision_.solve(b));
  }

 private:
  template <class Values>
  Values white(Values values) const {
    return whitened(problem_.bed, factors_under(problem_.discrepancy, settings_),
                    std::move(values));
  }

  const FitProblem& problem_;
  const std::vector<std::size_t>& settings_;
  Eigen::MatrixXd shape_;
  Eigen::LLT<Eigen::MatrixXd> precision_;
};

/// Of the first `count` numbers, whatever the others are.
Eigen::MatrixXd marginal_precision(const Eigen::MatrixXd& precision, Eigen::Index count) {
  const Eigen::Index others = precision.rows() - count;
  if (others == 0) return precision;
  const Eigen::MatrixXd across = precision.bottomLeftCorner(others, count);
  return precision.topLeftCorner(count, count) -
         across.transpose() * precision.bottomRightCorner(others, others).llt().solve(across);
}

/// A step whose end lies beyond the edge of valid soils: the numbers that are cut there go as far
/// as they may, all others where that leaves them best.
Eigen::VectorXd cut_to_edge(const FitProblem& problem, const Eigen::VectorXd& x,
                            const Eigen::MatrixXd& curvature, const Eigen::VectorXd& to_goal) {
  const Eigen::VectorXd inside = kept_inside(problem.bed.setup.soil, problem.soil, x + to_goal);
  const Eigen::VectorXd excess = x + to_goal - inside;
  Eigen::Index cut = 0;
  if (!(excess.cwiseAbs().maxCoeff(&cut) > 0)) return to_goal;
  // The curve's bottom at a fixed number: the others move by -H_rr^-1 H_rj of what it lacks.
  const Eigen::VectorXd response = curvature.llt().solve(Eigen::VectorXd::Unit(x.size(), cut));
  return to_goal - excess[cut] / response[cut] * response;
}

/// One damped step; false where nothing better was found.
bool step(const FitProblem& problem, const std::vector<std::size_t>& settings, CandidateFit& fit) {
  if (fit.x.size() == 0) return false;
  const TestBed& bed = problem.bed;
  const Eigen::VectorXd measured = bed.measured();
  const ShapedMisfit misfit(problem, settings, fit.shape);
  const auto cost = [&](const Eigen::VectorXd& prediction, const Eigen::VectorXd& x) {
    return misfit.of(measured - prediction) + x.squaredNorm();
  };
  const Posterior posterior =
      posterior_of(bed, problem.discrepancy, linearised(bed, fit), settings);
  const Eigen::VectorXd to_goal = posterior.x.head(fit.x.size()) - fit.x;
  const double before = cost(fit.prediction, fit.x);
  bool is_worth_another = false;
  const auto leads_to = [&](const Eigen::VectorXd& x) {
    const auto prediction = predict(bed, problem.soil, fit.candidate, x);
    if (!prediction) return false;
    const double after = cost(*prediction, x);
    if (!(after < before)) return false;
    fit.x = x;
    fit.prediction = *prediction;
    is_worth_another = before - after > 1e-3 * (1 + 1e-3 * before);
    return true;
  };
  const auto leads_on = [&](const Eigen::VectorXd& by) {
    return leads_to((fit.x + by).cwiseMin(kFarthest).cwiseMax(-kFarthest));
  };
  constexpr std::array kShares{1.0, 0.4, 0.16, 0.064, 0.0256};
  for (const double share : kShares) {
    if (leads_on(share * to_goal)) return is_worth_another;
  }
  // Straight towards the goal it is worse at once: across a kink some column is far off. Damped, a
  // step follows what is steepest.
  const Eigen::MatrixXd curvature = marginal_precision(posterior.precision, fit.x.size());
  const Eigen::VectorXd slope = curvature * to_goal;
  for (const double damping : {1.0, 10.0, 100.0}) {
    Eigen::MatrixXd damped = curvature;
    damped.diagonal() *= 1 + damping;
    if (leads_on(damped.llt().solve(slope))) return is_worth_another;
  }
  // Or the goal lies beyond the edge of valid soils: along it, then.
  const Eigen::VectorXd along_edge = cut_to_edge(problem, fit.x, curvature, to_goal);
  const bool is_near = maximum_stress_pull(problem.soil, fit.x) < Thresholds::kUnsuspectPull;
  if (along_edge == to_goal || !is_near) return false;
  for (const double share : kShares) {
    const Eigen::VectorXd goal =
        (fit.x + share * along_edge).cwiseMin(kFarthest).cwiseMax(-kFarthest);
    if (leads_to(kept_inside(bed.setup.soil, problem.soil, goal))) return is_worth_another;
  }
  return false;
}

/// Soil columns of slow candidates are those of the rest of the candidate.
std::optional<Eigen::MatrixXd> soil_columns(const FitProblem& problem, const CandidateFit& fit) {
  Hypothesis quick;
  const auto soil = static_cast<Eigen::Index>(problem.soil.size());
  std::vector<double> kept(fit.x.data(), fit.x.data() + soil);
  for (std::size_t e = 0; e < fit.candidate.effects.size(); ++e) {
    const Effect& effect = fit.candidate.effects[e];
    if (effect.slow) continue;
    const Eigen::Index first = first_of(problem.soil, fit.candidate, e);
    quick.effects.push_back(effect);
    for (std::size_t i = 0; i < effect.coordinates.size(); ++i) {
      kept.push_back(fit.x[first + static_cast<Eigen::Index>(i)]);
    }
  }
  const Eigen::VectorXd x =
      Eigen::Map<Eigen::VectorXd>(kept.data(), static_cast<Eigen::Index>(kept.size()));
  const auto prediction = predict(problem.bed, problem.soil, quick, x);
  if (!prediction) return std::nullopt;
  const auto columns = jacobian_of(problem.bed, problem.soil, quick, x, *prediction);
  if (!columns) return std::nullopt;
  return columns->leftCols(soil);
}

bool renew_jacobian(const FitProblem& problem, CandidateFit& fit) {
  const bool slow = is_slow(fit.candidate);
  const auto soil = static_cast<Eigen::Index>(problem.soil.size());
  if (slow) {
    const auto columns = soil_columns(problem, fit);
    if (!columns) return false;
    fit.jacobian.leftCols(soil) = *columns;
  }
  const auto columns =
      jacobian_of(problem.bed, problem.soil, fit.candidate, fit.x, fit.prediction, slow ? soil : 0);
  if (!columns) return false;
  fit.jacobian.rightCols(columns->cols()) = *columns;
  return true;
}

/// Appends columns to the shape: a smooth function of the conditions times a weight, per channel.
void append_shape(const TestBed& bed, const Eigen::MatrixXd& functions, const auto& weight,
                  CandidateFit& fit) {
  const Eigen::Index from = fit.shape.cols(), count = functions.cols();
  fit.shape.conservativeResize(Eigen::NoChange, from + count);
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    for (std::size_t i = 0; i < bed.channels[c].conditions.size(); ++i) {
      const Eigen::Index row = bed.offset(c) + static_cast<Eigen::Index>(i);
      const std::size_t at = bed.channels[c].conditions[i];
      fit.shape.row(row).tail(count) =
          weight(c, row, bed.conditions[at]) * functions.row(static_cast<Eigen::Index>(at));
    }
  }
}

/// What a mechanism adds may be wrong all over: alike in all channels, by a smooth function of the
/// conditions, and in each channel for itself, by one factor: formulas of one mechanism differ in
/// what they make of drawbar pull, torque and sinkage.
void append_shape_of(const TestBed& bed, const Eigen::MatrixXd& functions,
                     const Eigen::VectorXd& part, CandidateFit& fit) {
  append_shape(
      bed, functions,
      [&](std::size_t, Eigen::Index row, const Condition&) { return fit.shape_spread * part[row]; },
      fit);
  constexpr double kOfAChannel = 0.5;  // of the spread: chosen, on 240 generated recordings
  const Eigen::MatrixXd constant = Eigen::MatrixXd::Ones(functions.rows(), 1);
  for (std::size_t own = 0; own < bed.channels.size(); ++own) {
    append_shape(
        bed, constant,
        [&](std::size_t c, Eigen::Index row, const Condition&) {
          return c == own ? kOfAChannel * fit.shape_spread * part[row] : 0.0;
        },
        fit);
  }
}

void renew_shape(const FitProblem& problem, const Eigen::MatrixXd& functions, CandidateFit& fit) {
  const TestBed& bed = problem.bed;
  fit.shape.resize(bed.size(), 0);
  if (fit.shape_spread == 0) return;
  for (std::size_t e = 0; e < fit.candidate.effects.size(); ++e) {
    const Effect& effect = fit.candidate.effects[e];
    if (effect.kind != EffectKind::kMechanism || is_instrument(effect.id)) continue;
    const auto part = part_of(bed, problem.soil, fit, e);
    if (!part) continue;
    append_shape_of(bed, functions, *part, fit);
    if (effect.id != "skid_branch") continue;
    // named by where it is, whatever it does there: each channel for itself, growing with skid
    constexpr double kSkidAmplitude = 10;  // of a run's noise, per shape_spread and unit of skid
    const Eigen::MatrixXd coarse = functions.rightCols(std::min<Eigen::Index>(4, functions.cols()));
    for (std::size_t own = 0; own < bed.channels.size(); ++own) {
      append_shape(
          bed, coarse,
          [&](std::size_t c, Eigen::Index, const Condition& at) {
            const double side =
                bed.channels[c].channel == Channel::kFy ? std::sin(at.slip_angle_rad) * 4 : 1;
            return c == own ? fit.shape_spread * kSkidAmplitude * bed.channels[c].scale * side * 4 *
                                  std::max(-at.slip_ratio, 0.0)
                            : 0.0;
          },
          fit);
    }
  }
}

/// \return whether the start could be evaluated
bool begin(const FitProblem& problem, CandidateFit& fit) {
  const auto prediction = predict(problem.bed, problem.soil, fit.candidate, fit.x);
  if (!prediction) return false;
  fit.prediction = *prediction;
  fit.jacobian.resize(problem.bed.size(), fit.x.size());
  return renew_jacobian(problem, fit);
}

void descend(const FitProblem& problem, const std::vector<std::size_t>& settings, int steps,
             const Eigen::MatrixXd& functions, CandidateFit& fit) {
  for (int i = 0; i < steps; ++i) {
    renew_shape(problem, functions, fit);
    const bool better = step(problem, settings, fit);
    if (!renew_jacobian(problem, fit) || !better) break;
  }
  renew_shape(problem, functions, fit);
}

}  // namespace

std::optional<Eigen::MatrixXd> jacobian_of(const TestBed& bed,
                                           const std::vector<SoilCoordinate>& soil,
                                           const Hypothesis& candidate, const Eigen::VectorXd& x,
                                           const Eigen::VectorXd& prediction, Eigen::Index from,
                                           bool central, double step) {
  Eigen::MatrixXd columns(prediction.size(), x.size() - from);
  for (Eigen::Index i = from; i < x.size(); ++i) {
    const auto moved = [&](double by) {
      Eigen::VectorXd at = x;
      at[i] += by;
      return predict(bed, soil, candidate, at);
    };
    const auto up = moved(step);
    const auto down = central || !up ? moved(-step) : std::nullopt;
    if (up && down) {
      columns.col(i - from) = (*up - *down) / (2 * step);
    } else if (up) {
      columns.col(i - from) = (*up - prediction) / step;
    } else if (down) {
      columns.col(i - from) = (prediction - *down) / step;
    } else {
      return std::nullopt;
    }
  }
  return columns;
}

std::optional<Eigen::VectorXd> part_of(const TestBed& bed, const std::vector<SoilCoordinate>& soil,
                                       const CandidateFit& fit, std::size_t effect) {
  Hypothesis others = fit.candidate;
  others.effects.erase(others.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  const Eigen::Index first = first_of(soil, fit.candidate, effect);
  const auto size = static_cast<Eigen::Index>(fit.candidate.effects[effect].coordinates.size());
  Eigen::VectorXd x(fit.x.size() - size);
  x << fit.x.head(first), fit.x.tail(fit.x.size() - first - size);
  const auto rest = predict(bed, soil, others, x);
  if (!rest) return std::nullopt;
  return fit.prediction - *rest;
}

Eigen::Index first_of(const std::vector<SoilCoordinate>& soil, const Hypothesis& candidate,
                      std::size_t effect) {
  auto first = static_cast<Eigen::Index>(soil.size());
  for (std::size_t i = 0; i < effect; ++i) {
    first += static_cast<Eigen::Index>(candidate.effects[i].coordinates.size());
  }
  return first;
}

std::optional<CandidateFit> fit_under(const FitProblem& problem, const Hypothesis& candidate,
                                      const std::vector<std::size_t>& settings,
                                      const Eigen::VectorXd& start, int steps,
                                      double shape_spread) {
  CandidateFit fit{.candidate = candidate, .x = start, .shape_spread = shape_spread};
  if (!begin(problem, fit)) return std::nullopt;
  descend(problem, settings, steps, smooth_functions(problem.bed), fit);
  fit.evidence.settings = settings;
  return fit;
}

std::optional<CandidateFit> fit_to_widened(const FitProblem& problem, const Hypothesis& candidate,
                                           std::vector<double> widened,
                                           const Eigen::VectorXd& start, int steps) {
  constexpr int kRounds = 3;
  const std::vector<std::size_t> noise_only(problem.bed.channels.size(), 0);
  std::optional<CandidateFit> fit;
  for (int round = 0; round < kRounds; ++round) {
    const TestBed bed = with_noise_widened(problem.bed, widened);
    const Discrepancy discrepancy(bed);
    const FitProblem as_wide{bed, problem.soil, discrepancy, problem.soil_free};
    fit = fit_under(as_wide, candidate, noise_only, fit ? fit->x : start, steps, 0);
    if (!fit) return fit;
    fit->widened = widened;
    const Posterior posterior = posterior_of(bed, discrepancy, linearised(bed, *fit), noise_only);
    fit->evidence.x = posterior.x;
    fit->evidence.covariance = Eigen::MatrixXd::Identity(fit->x.size(), fit->x.size());
    if (fit->x.size() > 0) {
      fit->evidence.covariance = posterior.precision.llt().solve(fit->evidence.covariance);
    }
    const std::vector<double> left = deviations_off(problem.bed, fit->prediction);
    for (std::size_t c = 0; c < left.size(); ++c) widened[c] = std::min(widened[c], left[c]);
  }
  return fit;
}

Eigen::VectorXd start_of(const FitProblem& problem, const Hypothesis& candidate,
                         const CandidateFit* beside) {
  std::vector<double> x(problem.soil.size(), 0.0);
  if (beside != nullptr) x.assign(beside->x.begin(), beside->x.end());
  const std::size_t known = beside == nullptr ? 0 : beside->candidate.effects.size();
  for (std::size_t e = known; e < candidate.effects.size(); ++e) {
    const Effect& effect = candidate.effects[e];
    x.insert(x.end(), effect.start.begin(), effect.start.end());
  }
  return Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

double log_sum(const std::vector<double>& terms) {
  const double top = std::ranges::max(terms);
  double sum = 0;
  for (const double term : terms) sum += std::exp(term - top);
  return top + std::log(sum);
}

MarginalFit marginal_of(const std::vector<CandidateFit>& forms, std::size_t tried) {
  std::vector<double> scores;
  for (const CandidateFit& fit : forms) scores.push_back(fit.evidence.log_marginal);
  const auto best = std::ranges::max_element(scores) - scores.begin();
  return {log_sum(scores) - std::log(static_cast<double>(tried)),
          forms[static_cast<std::size_t>(best)]};
}

std::optional<CandidateFit> fit_candidate(const FitProblem& problem, const Hypothesis& candidate,
                                          const SettingWeights& weights,
                                          const Eigen::VectorXd& start) {
  const Eigen::MatrixXd functions = smooth_functions(problem.bed);
  CandidateFit fit{.candidate = candidate, .x = start, .shape_spread = kShapeSpreads.back()};
  if (!begin(problem, fit)) return std::nullopt;
  // begin under a discrepancy of twice a run's noise over middling scales
  std::size_t middling = 0;
  for (std::size_t k = 0; k < discrepancy_settings().size(); ++k) {
    const DiscrepancySetting& setting = discrepancy_settings()[k];
    if (setting.amplitude == 2 && setting.scales == 1) middling = k;
  }
  std::vector<std::size_t> settings(problem.bed.channels.size(), middling);
  constexpr int kRounds = 3;
  const auto weigh = [&] {
    return evidence_of(problem.bed, problem.discrepancy, linearised(problem.bed, fit),
                       problem.soil_free, weights);
  };
  for (int round = 0; round < kRounds; ++round) {
    descend(problem, settings, round == 0 ? 5 : 3, functions, fit);
    fit.evidence = weigh();
    if (fit.evidence.settings == settings) break;
    settings = fit.evidence.settings;
  }
  if (fit.shape.cols() == 0) return fit;
  // forms that hold closely deserve to be told from forms that hold roughly
  const CandidateFit rough = fit;
  fit.shape_spread = kShapeSpreads.front();
  renew_shape(problem, functions, fit);
  if (candidate.effects.size() == 1) descend(problem, settings, 2, functions, fit);
  fit.evidence = weigh();
  const double a = fit.evidence.log_marginal, b = rough.evidence.log_marginal;
  if (b > a) fit = rough;
  fit.evidence.log_marginal =
      std::max(a, b) + std::log1p(std::exp(-std::abs(a - b))) - std::log(2.0);
  return fit;
}

}  // namespace regoplan
