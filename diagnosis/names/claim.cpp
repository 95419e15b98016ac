#include "diagnosis/names/claim.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "diagnosis/bed/whitening.h"

namespace regoplan {
namespace {

struct Weighted {
  std::set<std::string> ids;
  double probability = 0;
};

/// The smallest greedy set of ids such that a candidate contains one of them with this probability.
NameClass cover(const std::vector<Weighted>& candidates, double sure) {
  NameClass chosen;
  const auto hit = [&](const Weighted& w) {
    return std::ranges::any_of(chosen.ids, [&](const auto& id) { return w.ids.contains(id); });
  };
  while (chosen.probability < sure && chosen.ids.size() < Thresholds::kLargestClass) {
    std::map<std::string, double> gain;
    for (const Weighted& w : candidates) {
      if (hit(w)) continue;
      for (const std::string& id : w.ids) gain[id] += w.probability;
    }
    if (gain.empty()) break;
    const auto best = std::ranges::max_element(
        gain, [](const auto& a, const auto& b) { return a.second < b.second; });
    chosen.ids.push_back(best->first);
    chosen.probability += best->second;
  }
  return chosen;
}

bool holds_one_of(const ScoredId& scored, const NameClass& names) {
  return std::ranges::any_of(
      names.ids, [&](const std::string& id) { return scored.account.effects.contains(id); });
}

/// That a name of class `k` is at work, given the classes before it.
double probability_of(const std::vector<ScoredId>& scored, const std::vector<NameClass>& claimed,
                      std::size_t k) {
  double given = 0, both = 0;
  for (const ScoredId& s : scored) {
    const auto holds = [&](const NameClass& names) { return holds_one_of(s, names); };
    if (!std::all_of(claimed.begin(), claimed.begin() + static_cast<std::ptrdiff_t>(k), holds)) {
      continue;
    }
    given += s.probability;
    if (holds(claimed[k])) both += s.probability;
  }
  return both / given;
}

/// The one id of a candidate in which another of as many differs from it; empty where more do.
std::string only_other_id(const std::set<std::string>& ids, const std::set<std::string>& than) {
  std::vector<std::string> others;
  std::ranges::set_difference(ids, than, std::back_inserter(others));
  return ids.size() == than.size() && others.size() == 1 ? others.front() : "";
}

std::size_t effect_of(const CandidateFit& fit, const std::string& id) {
  const auto found = std::ranges::find(fit.candidate.effects, id, &Effect::id);
  return static_cast<std::size_t>(found - fit.candidate.effects.begin());
}

/// Whether an effect of a fit does, with numbers that are usual for it, what an effect of another
/// does, nearer than one prediction beats another. What its prior kept it from is no difference.
bool may_do_the_same(const FitProblem& problem, const CandidateFit& fit, std::size_t effect,
                     const CandidateFit& than, std::size_t other) {
  const auto own = part_of(problem.bed, problem.soil, fit, effect);
  const auto others = part_of(problem.bed, problem.soil, than, other);
  if (!own || !others) return false;
  const Eigen::Index first = first_of(problem.soil, fit.candidate, effect);
  const auto numbers = static_cast<Eigen::Index>(fit.candidate.effects[effect].coordinates.size());
  const NoiseFactors noise(problem.bed);
  const Eigen::VectorXd apart = whitened(problem.bed, noise, Eigen::VectorXd(*others - *own));
  const Eigen::MatrixXd columns =
      whitened(problem.bed, noise, Eigen::MatrixXd(fit.jacobian.middleCols(first, numbers)));
  const Eigen::VectorXd step = columns.completeOrthogonalDecomposition().solve(apart);
  const Eigen::VectorXd x = fit.x.segment(first, numbers) + step;
  return (apart - columns * step).norm() < Thresholds::kClear_errors &&
         x.lpNorm<Eigen::Infinity>() < Thresholds::kPlausible;
}

}  // namespace

std::vector<NameClass> claimed_names(const std::vector<ScoredId>& scored) {
  std::vector<Weighted> all;
  for (const ScoredId& s : scored) all.push_back({s.account.effects, s.probability});
  const NameClass first = cover(all, Thresholds::kSure);
  if (first.probability < Thresholds::kSure) return {};
  std::vector<NameClass> claimed{first};
  // given the first effect: is there a second?
  std::vector<Weighted> partners;
  double whole = 0;
  for (const Weighted& w : all) {
    Weighted partner = w;
    bool hit = false;
    for (const std::string& id : first.ids) hit = partner.ids.erase(id) > 0 || hit;
    if (!hit) continue;
    whole += w.probability;
    partners.push_back(partner);
  }
  double any = 0;  // of the names that a second may have
  for (Weighted& w : partners) {
    w.probability /= whole;
    if (!w.ids.empty()) any += w.probability;
  }
  if (any <= Thresholds::kLikelySecond) return claimed;
  const double sure = Thresholds::kSure * any;
  const NameClass second = cover(partners, sure);
  if (second.probability >= sure) claimed.push_back(second);
  return claimed;
}

bool is_of(const ScoredId& scored, const std::vector<NameClass>& claimed) {
  return scored.account.effects.size() == claimed.size() &&
         std::ranges::all_of(claimed,
                             [&](const NameClass& names) { return holds_one_of(scored, names); });
}

const ScoredId* best_of(const std::vector<ScoredId>& scored,
                        const std::vector<NameClass>& claimed) {
  const ScoredId* best = nullptr;
  for (const ScoredId& s : scored) {
    if (s.given_up || !is_of(s, claimed)) continue;
    if (best == nullptr || s.probability > best->probability) best = &s;
  }
  return best;
}

void add_names_alike(const FitProblem& problem, const std::vector<ScoredId>& scored,
                     const ScoredId& best, std::vector<NameClass>& claimed) {
  for (const ScoredId& s : scored) {
    const std::string own = only_other_id(best.account.effects, s.account.effects);
    const std::string other = only_other_id(s.account.effects, best.account.effects);
    const auto names = std::ranges::find_if(claimed, [&](const NameClass& one) {
      return std::ranges::find(one.ids, own) != one.ids.end();
    });
    const bool is_named = std::ranges::any_of(claimed, [&](const NameClass& one) {
      return std::ranges::find(one.ids, other) != one.ids.end();
    });
    if (own.empty() || names == claimed.end() || is_named || s.given_up) continue;
    if (names->ids.size() == Thresholds::kLargestClass) continue;
    if (s.score < best.score - Thresholds::kNearForm_nats) continue;
    const bool is_alike = may_do_the_same(problem, s.fit, effect_of(s.fit, other), best.fit,
                                          effect_of(best.fit, own));
    if (!is_alike || !objection(problem, s.fit).empty()) continue;
    names->ids.push_back(other);
    names->probability =
        probability_of(scored, claimed, static_cast<std::size_t>(names - claimed.begin()));
  }
}

std::vector<ScoredId> members_of(const std::vector<ScoredId>& scored,
                                 const std::vector<NameClass>& claimed) {
  std::vector<ScoredId> members;
  for (const ScoredId& s : scored) {
    if (members.size() == Thresholds::kLargestClass) break;
    if (!s.given_up && is_of(s, claimed)) members.push_back(s);
  }
  return members;
}

std::string objection(const FitProblem& problem, const CandidateFit& fit, double plausible_fault) {
  for (std::size_t i = 0; i < problem.soil.size(); ++i) {
    const double pull = fit.x[static_cast<Eigen::Index>(i)];
    if (std::abs(pull) > Thresholds::kSoilBack) {
      return fmt::format("{} would still lie {:.1f} prior standard deviations from its soil tests",
                         problem.soil[i].coordinate.name, std::abs(pull));
    }
  }
  for (std::size_t e = 0; e < fit.candidate.effects.size(); ++e) {
    const Effect& effect = fit.candidate.effects[e];
    const Eigen::Index first = first_of(problem.soil, fit.candidate, e);
    const bool is_lasting_fault =
        is_instrument(effect.id) && effect.course == FaultCourse::kConstant;
    const double plausible = is_lasting_fault ? plausible_fault : Thresholds::kPlausible;
    for (std::size_t i = 0; i < effect.coordinates.size(); ++i) {
      const double x = fit.x[first + static_cast<Eigen::Index>(i)];
      if (std::abs(x) < plausible) continue;
      return fmt::format("{} would need {} = {:.3g}, far from what is usual", effect.id,
                         effect.coordinates[i].name, effect.coordinates[i].value(x));
    }
    if (effect.id == "skid_branch") continue;  // named by where it is, whatever it does there
    const auto part = part_of(problem.bed, problem.soil, fit, e);
    if (!part) continue;
    for (const Channel channel : channels_of(problem, fit, e)) {
      for (std::size_t c = 0; c < problem.bed.channels.size(); ++c) {
        const ChannelData& data = problem.bed.channels[c];
        if (data.channel != channel) continue;
        const Eigen::Index from = problem.bed.offset(c), n = data.mean.size();
        const Eigen::VectorXd weight = data.noise.diagonal().cwiseInverse();
        const Eigen::VectorXd own = part->segment(from, n);
        const Eigen::VectorXd left = data.mean - fit.prediction.segment(from, n) + own;
        const double own_size = std::sqrt(own.dot(weight.cwiseProduct(own)));
        if (own.dot(weight.cwiseProduct(left)) < -Thresholds::kWrongWay_deviations * own_size) {
          return fmt::format("{} would move {} the wrong way", effect.id, name(channel));
        }
      }
    }
  }
  return "";
}

std::vector<Channel> channels_of(const FitProblem& problem, const CandidateFit& fit,
                                 std::size_t effect) {
  std::vector<Channel> channels;
  const auto part = part_of(problem.bed, problem.soil, fit, effect);
  if (!part) return channels;
  std::vector<double> strength;
  for (std::size_t c = 0; c < problem.bed.channels.size(); ++c) {
    const ChannelData& data = problem.bed.channels[c];
    const Eigen::VectorXd own = part->segment(problem.bed.offset(c), data.mean.size());
    strength.push_back((own.array().square() / data.noise.diagonal().array()).sum());
  }
  constexpr double kShows = 16, kShare = 0.02;
  const double most = std::ranges::max(strength);
  for (std::size_t c = 0; c < strength.size(); ++c) {
    if (strength[c] > kShows && strength[c] > kShare * most) {
      channels.push_back(problem.bed.channels[c].channel);
    }
  }
  return channels;
}

std::vector<Claim> claims_of(const FitProblem& problem, const std::vector<ScoredId>& scored,
                             const std::vector<NameClass>& claimed, const CandidateFit& fit) {
  std::vector<Claim> claims;
  for (const NameClass& names : claimed) {
    for (std::size_t e = 0; e < fit.candidate.effects.size(); ++e) {
      const Effect& effect = fit.candidate.effects[e];
      if (std::ranges::find(names.ids, effect.id) == names.ids.end()) continue;
      Claim claim{.id = effect.id,
                  .form = effect.form,
                  .probability = std::min(names.probability, 1.0),
                  .channels = channels_of(problem, fit, e)};
      const Eigen::Index first = first_of(problem.soil, fit.candidate, e);
      for (std::size_t i = 0; i < effect.coordinates.size(); ++i) {
        const Eigen::Index k = first + static_cast<Eigen::Index>(i);
        const Coordinate& c = effect.coordinates[i];
        claim.parameters[c.name] = {
            c.value(fit.x[k]),
            std::abs(c.slope(fit.x[k])) * std::sqrt(fit.evidence.covariance(k, k))};
      }
      for (const auto& [name, value] : effect.fixed) claim.parameters[name] = {value, 0};
      for (const std::string& id : names.ids) {
        if (id != effect.id) claim.equivalent.push_back(id);
      }
      double with = -INFINITY, without = -INFINITY;
      for (const ScoredId& s : scored) {
        if (s.given_up) continue;
        const std::set<std::string>& ids = s.account.effects;
        const bool named =
            std::ranges::any_of(names.ids, [&](const auto& id) { return ids.contains(id); });
        (named ? with : without) = std::max(named ? with : without, s.score);
      }
      claim.evidence_nats = with - without;
      claims.push_back(std::move(claim));
      break;
    }
  }
  return claims;
}

}  // namespace regoplan
