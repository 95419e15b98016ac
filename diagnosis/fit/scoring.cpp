#include "diagnosis/fit/scoring.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <utility>

#include "diagnosis/fit/zone_edges.h"
#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

constexpr std::size_t kBestSingles = 7;
constexpr std::size_t kPartnersOfBest = 5;

/// Fits of one account, one a form.
using Forms = std::vector<CandidateFit>;

ScoredId scored(const Account& account, const Forms& forms, std::size_t tried) {
  MarginalFit marginal = marginal_of(forms, tried);
  return {.account = account, .score = marginal.log_marginal, .fit = std::move(marginal.likeliest)};
}

ScoredId base(Account::Kind kind, const FitProblem& problem, const SettingWeights& weights) {
  const auto fit = fit_candidate(problem, {}, weights, start_of(problem, {}));
  return scored({.kind = kind}, {*fit}, 1);
}

/// Soil numbers as their tests have them, or off by more than these say: one is as likely as the
/// other beforehand. The first is what effects are fitted with, so that what they gain over it is
/// theirs.
ScoredId other_soil(const FitProblem& problem, const FitProblem& wide) {
  Forms forms;
  for (const FitProblem* soil : {&problem, &wide}) {
    forms.push_back(*fit_candidate(*soil, {}, SettingWeights::of_none(), start_of(*soil, {})));
  }
  return scored({.kind = Account::Kind::kParameters}, forms, forms.size());
}

/// Score of a fit with another effect added, to first order from its starting point.
double quick_score(const FitProblem& problem, const CandidateFit& single, const Effect& effect,
                   const std::vector<std::size_t>& settings) {
  Hypothesis pair = single.candidate;
  pair.effects.push_back(effect);
  const auto size = static_cast<Eigen::Index>(effect.coordinates.size());
  Eigen::VectorXd x(single.x.size() + size);
  x.head(single.x.size()) = single.x;
  for (Eigen::Index i = 0; i < size; ++i) {
    x[single.x.size() + i] = effect.start[static_cast<std::size_t>(i)];
  }
  bool either_sign = false;
  for (Eigen::Index i = 0; i < size; ++i) {
    if (effect.coordinates[static_cast<std::size_t>(i)].is_positive()) continue;
    x[single.x.size() + i] = 0.5;
    either_sign = true;
  }
  const auto prediction = predict(problem.bed, problem.soil, pair, x);
  if (!prediction) return -INFINITY;
  Linearised model{.residual =
                       problem.bed.measured() - single.prediction + single.jacobian * single.x};
  model.jacobian.resize(single.jacobian.rows(), single.jacobian.cols() + 1);
  model.jacobian.leftCols(single.jacobian.cols()) = single.jacobian;
  model.jacobian.rightCols(1) = (either_sign ? 2 : 1) * (*prediction - single.prediction);
  const Posterior with = posterior_of(problem.bed, problem.discrepancy, model, settings);
  const double amount = with.x[with.x.size() - 1];
  const Eigen::MatrixXd covariance =
      with.precision.llt().solve(Eigen::MatrixXd::Identity(with.x.size(), with.x.size()));
  const double gain = amount * amount / covariance(with.x.size() - 1, with.x.size() - 1);
  return !either_sign && amount < 0 ? -gain : gain;
}

/// The discrepancy of half a run's noise over middling scales.
std::size_t smallest_setting() {
  const auto& all = discrepancy_settings();
  return static_cast<std::size_t>(
      std::ranges::find_if(
          all, [](const DiscrepancySetting& s) { return s.amplitude > 0 && s.scales == 1; }) -
      all.begin());
}

/// The effects that add most to a single, at most two of one id: channels and zones are many.
std::vector<std::size_t> partners(const FitProblem& problem, const ScoredId& single,
                                  const std::vector<Effect>& effects,
                                  const std::vector<std::size_t>& settings) {
  std::vector<std::pair<double, std::size_t>> gains;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    if (effects[k].id == single.id()) continue;
    gains.emplace_back(-quick_score(problem, single.fit, effects[k], settings), k);
  }
  std::ranges::sort(gains);
  std::vector<std::size_t> taken;
  std::map<std::string, int> of_id;
  for (const auto& [gain, k] : gains) {
    if (taken.size() == kPartnersOfBest) break;
    if (++of_id[effects[k].id] <= 2) taken.push_back(k);
  }
  return taken;
}

std::vector<Hypothesis> promising_pairs(const FitProblem& problem,
                                        const std::vector<ScoredId>& singles,
                                        const std::vector<Effect>& effects) {
  std::vector<Hypothesis> pairs;
  const auto add = [&](const Hypothesis& single, const Effect& effect) {
    const Effect& first = single.effects.front();
    if (first.id == effect.id || (is_told_by_time(first) && is_told_by_time(effect))) return;
    const bool known = std::ranges::any_of(pairs, [&](const Hypothesis& pair) {
      const auto same = [](const Effect& a, const Effect& b) {
        return a.id == b.id && a.form == b.form && a.fixed == b.fixed;
      };
      return (same(pair.effects[0], first) && same(pair.effects[1], effect)) ||
             (same(pair.effects[1], first) && same(pair.effects[0], effect));
    });
    if (!known) pairs.push_back({{first, effect}});
  };
  // from where it ended alone
  const auto settled = [&](const ScoredId& single) {
    Effect effect = single.fit.candidate.effects.front();
    const auto size = static_cast<Eigen::Index>(effect.start.size());
    const Eigen::VectorXd x = single.fit.x.tail(size);
    effect.start.assign(x.data(), x.data() + size);
    return effect;
  };
  const std::size_t best = std::min(kBestSingles, singles.size());
  for (std::size_t i = 0; i < best; ++i) {
    for (std::size_t k = i + 1; k < best; ++k) {
      add({{settled(singles[i])}}, singles[k].fit.candidate.effects.front());
    }
  }
  // a discrepancy as large as the single needed may hide its fellow: partners under a small one too
  const std::vector<std::size_t> small(problem.bed.channels.size(), smallest_setting());
  for (std::size_t i = 0; i < std::min<std::size_t>(4, best); ++i) {
    for (const auto& settings : {singles[i].fit.evidence.settings, small}) {
      for (const std::size_t k : partners(problem, singles[i], effects, settings)) {
        add({{settled(singles[i])}}, effects[k]);
      }
    }
  }
  return pairs;
}

/// Fits candidates in parallel; what has no forces stays empty.
std::vector<std::optional<CandidateFit>> fit_all(const FitProblem& problem,
                                                 const std::vector<Hypothesis>& candidates,
                                                 const ScoringOptions& options, double from,
                                                 double to) {
  std::vector<std::optional<CandidateFit>> fits(candidates.size());
  std::mutex progress_mutex;
  std::size_t done = 0;
  parallel_for(candidates.size(), options.threads, [&](std::size_t i) {
    fits[i] = fit_candidate(problem, candidates[i], SettingWeights::of_named(),
                            start_of(problem, candidates[i]));
    const std::scoped_lock lock(progress_mutex);
    ++done;
    if (options.progress) {
      options.progress(from + (to - from) * static_cast<double>(done) /
                                  static_cast<double>(candidates.size()));
    }
  });
  return fits;
}

/// Adds zones whose edges lie about those of the likeliest: the list has eighths of the bed, and
/// what these misplace of a strong zone would be left for something else to explain. Only where a
/// zone says more than `than`, a log marginal likelihood.
void add_finer_zones(const FitProblem& problem, const ScoringOptions& options, double than,
                     std::vector<Hypothesis>& singles,
                     std::vector<std::optional<CandidateFit>>& fits) {
  const auto score = [&](std::size_t i) {
    const bool is_zone = singles[i].effects.front().id == "soil_zone";
    return is_zone && fits[i] ? fits[i]->evidence.log_marginal : -INFINITY;
  };
  const auto likeliest = [&] {
    std::vector<double> scores;
    for (std::size_t i = 0; i < singles.size(); ++i) scores.push_back(score(i));
    return static_cast<std::size_t>(std::ranges::max_element(scores) - scores.begin());
  };
  if (singles.empty()) return;
  const ZoneEdges edges(problem.bed);
  std::size_t best = likeliest();
  if (!(score(best) > than)) return;
  for (auto step = static_cast<std::ptrdiff_t>(edges.count() / 8); step >= 1;) {
    Effect zone = singles[best].effects.front();
    const Eigen::VectorXd x = fits[best]->x.tail(static_cast<Eigen::Index>(zone.start.size()));
    zone.start.assign(x.begin(), x.end());
    std::vector<Hypothesis> about;
    for (const auto& [from, to] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {1, 1}, {-1, -1}}) {
      if (const auto moved = edges.moved(zone, from * step, to * step)) about.push_back({{*moved}});
    }
    const auto fitted = fit_all(problem, about, {.threads = options.threads}, 0, 0);
    singles.insert(singles.end(), about.begin(), about.end());
    fits.insert(fits.end(), fitted.begin(), fitted.end());
    const std::size_t before = std::exchange(best, likeliest());
    if (best == before) step /= 2;
  }
}

std::vector<ScoredId> gather(const std::vector<Hypothesis>& candidates,
                             const std::vector<std::optional<CandidateFit>>& fits) {
  using Names = std::set<std::string>;
  std::map<Names, Forms> by_names;
  std::map<Names, std::size_t> tried;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Names names;
    for (const Effect& effect : candidates[i].effects) names.insert(effect.id);
    ++tried[names];
    if (fits[i]) by_names[names].push_back(*fits[i]);
  }
  std::vector<ScoredId> all;
  for (const auto& [names, forms] : by_names) {
    all.push_back(scored({.effects = names}, forms, tried[names]));
  }
  std::ranges::stable_sort(all, std::greater{}, &ScoredId::score);
  return all;
}

/// Of a name, a pair of them or what is on no list.
double log_prior_of(const Account& account) {
  if (account.kind == Account::Kind::kUnexplained) return Thresholds::kUnexplained_log_prior;
  return account.effects.size() > 1 ? Thresholds::kPair_log_prior : 0;
}

double shared_temperature(const std::vector<ScoredId>& scored) {
  return temperature_of(std::ranges::max_element(scored, {}, &ScoredId::score)->score -
                        scored_as(Account::Kind::kParameters, scored).score);
}

/// The logarithm of each candidate's likelihood as it is weighed. Names are fitted with the soil
/// free within its tests; that its numbers may all lie at their means is no merit over a name: the
/// plain model weighs as the free soil does, whichever of the two it is; all of it is that of the
/// one that is left where the other is given up.
std::vector<double> log_likelihoods(const std::vector<ScoredId>& scored) {
  const double temperature = shared_temperature(scored),
               free_soil = scored_as(Account::Kind::kParameters, scored).score / temperature;
  std::vector<double> plain, all;
  for (const ScoredId& s : scored) {
    if (s.account.is_plain() && !s.given_up) plain.push_back(s.score / temperature);
  }
  const double of_plain = log_sum(plain);
  for (const ScoredId& s : scored) {
    const double own = s.score / temperature;
    all.push_back(s.account.is_plain() ? free_soil + own - of_plain : own);
  }
  return all;
}

}  // namespace

const ScoredId& scored_as(Account::Kind kind, const std::vector<ScoredId>& scored) {
  return *std::ranges::find_if(scored, [&](const ScoredId& s) { return s.account.kind == kind; });
}

double temperature_of(double gain_nats) {
  return 1 + 0.2 * std::log1p(std::max(0.0, gain_nats) / 10);
}

std::vector<ScoredId> score_candidates(const FitProblem& problem, const FitProblem& wide,
                                       const std::vector<Effect>& effects,
                                       const ScoringOptions& options) {
  std::vector<ScoredId> all;
  const std::vector<SoilCoordinate> known;
  const Eigen::MatrixXd nothing_free(problem.bed.size(), 0);
  const FitProblem fixed{problem.bed, known, problem.discrepancy, nothing_free};
  all.push_back(base(Account::Kind::kNone, fixed, SettingWeights::of_none()));
  all.push_back(other_soil(problem, wide));
  // what is on no list may well look like other soil numbers than can be: nothing is kept clear
  const FitProblem anything{problem.bed, problem.soil, problem.discrepancy, nothing_free};
  all.push_back(base(Account::Kind::kUnexplained, anything, SettingWeights::of_unexplained()));
  std::vector<Hypothesis> singles;
  for (const Effect& effect : effects) singles.push_back({{effect}});
  auto fits = fit_all(problem, singles, options, 0, 0.5);
  add_finer_zones(problem, options, scored_as(Account::Kind::kParameters, all).score, singles,
                  fits);
  const std::vector<ScoredId> alone = gather(singles, fits);
  all.insert(all.end(), alone.begin(), alone.end());
  const std::vector<Hypothesis> pairs = promising_pairs(problem, alone, effects);
  const std::vector<ScoredId> together = gather(pairs, fit_all(problem, pairs, options, 0.5, 1));
  all.insert(all.end(), together.begin(), together.end());
  return all;
}

NameSupport support_of(const std::vector<ScoredId>& scored, PlainModel tests) {
  const double soil = scored_as(Account::Kind::kParameters, scored).score;
  const std::vector<double> likelihood = log_likelihoods(scored);
  double best = -INFINITY;
  std::vector<double> plain, other;
  for (std::size_t i = 0; i < scored.size(); ++i) {
    const Account& account = scored[i].account;
    if (account.is_plain() && scored[i].given_up) continue;
    const double prior = log_prior_of(account);
    (account.is_plain() ? plain : other).push_back(likelihood[i] + prior);
    if (account.kind == Account::Kind::kEffects) best = std::max(best, scored[i].score + prior);
  }
  return {tests, best - soil, log_sum(other) - log_sum(plain)};
}

void weigh(std::vector<ScoredId>& scored, PlainModel plain) {
  const std::vector<double> likelihood = log_likelihoods(scored);
  std::vector<double> terms;
  for (std::size_t i = 0; i < scored.size(); ++i) {
    const ScoredId& s = scored[i];
    const bool is_plain = s.account.is_plain();
    double prior = log_prior_of(s.account);
    if (is_plain && plain == PlainModel::kHolds) prior = Thresholds::kHolds_log_prior;
    if (is_plain && plain == PlainModel::kDoubted) prior = Thresholds::kDoubted_log_prior;
    const bool out = s.given_up || (is_plain && plain == PlainModel::kRefuted);
    terms.push_back(out ? -INFINITY : likelihood[i] + prior);
  }
  const double whole = log_sum(terms);
  for (std::size_t i = 0; i < scored.size(); ++i) {
    scored[i].probability = std::exp(terms[i] - whole);
  }
  std::ranges::stable_sort(
      scored, [](const auto& a, const auto& b) { return a.probability > b.probability; });
}

}  // namespace regoplan
