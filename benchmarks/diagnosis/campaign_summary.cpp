#include "benchmarks/diagnosis/campaign_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "benchmarks/diagnosis/score.h"

namespace regoplan::challenge {
namespace {

struct Scored {
  const Truth* truth;
  const Outcome* outcome;
  Score score;
};

std::vector<Scored> scored(const std::vector<CaseResult>& results, const std::string& method) {
  std::vector<Scored> all;
  for (const CaseResult& result : results) {
    for (const Outcome& outcome : result.outcomes) {
      if (outcome.method != method) continue;
      all.push_back({&result.truth, &outcome, score(result.truth, outcome)});
    }
  }
  return all;
}

std::vector<std::string> methods(const std::vector<CaseResult>& results) {
  std::vector<std::string> names;
  for (const CaseResult& result : results) {
    for (const Outcome& outcome : result.outcomes) {
      if (!std::ranges::count(names, outcome.method)) names.push_back(outcome.method);
    }
  }
  return names;
}

double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return std::nan("");
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

bool is_corrected(const Scored& s) {
  return !s.score.silent && s.outcome->verdict != "failed";
}

struct HeldOut {
  double corrected_median = 0, corrected_p90 = 0, calibrated_median = 0;
  int cases = 0;
};

/// Over the cases in which something was corrected.
HeldOut held_out(const std::vector<Scored>& all) {
  std::vector<double> corrected, calibrated;
  for (const Scored& s : all) {
    if (!is_corrected(s) || std::isnan(s.score.corrected_ratio)) continue;
    corrected.push_back(s.score.corrected_ratio);
    calibrated.push_back(s.score.calibrated_ratio);
  }
  return {quantile(corrected, 0.5), quantile(corrected, 0.9), quantile(calibrated, 0.5),
          static_cast<int>(corrected.size())};
}

/// What names gain where no physics is missing: what thresholds on such gains are to exceed.
struct ByChance {
  std::string tests;
  std::vector<double> best_gain_nats, log_odds;
};

std::vector<ByChance> by_chance(const std::vector<Scored>& all) {
  std::vector<ByChance> nulls{{"holds"}, {"doubted"}, {"refuted"}};
  for (const Scored& s : all) {
    if (s.truth->stratum != Stratum::kNulls) continue;
    for (ByChance& of : nulls) {
      if (of.tests != s.outcome->tests) continue;
      of.best_gain_nats.push_back(s.outcome->best_gain_nats);
      of.log_odds.push_back(s.outcome->log_odds);
    }
  }
  std::erase_if(nulls, [](const ByChance& of) { return of.log_odds.empty(); });
  return nulls;
}

constexpr std::array<double, 5> kChanceQuantiles{0.5, 0.9, 0.95, 0.99, 1};

std::array<double, 5> quantiles(const std::vector<double>& values) {
  std::array<double, 5> all;
  std::ranges::transform(kChanceQuantiles, all.begin(),
                         [&](double share) { return quantile(values, share); });
  return all;
}

std::string chance_table(const std::vector<Scored>& all) {
  std::string text =
      "\n## What names gain on nulls (median, 90, 95, 99 %, most)\n\n"
      "| tests say of the plain model | nulls | best gain, nats | log odds |\n|---|---|---|---|\n";
  for (const ByChance& of : by_chance(all)) {
    text += fmt::format("| {} | {} | {:.1f} | {:.1f} |\n", of.tests, of.log_odds.size(),
                        fmt::join(quantiles(of.best_gain_nats), ", "),
                        fmt::join(quantiles(of.log_odds), ", "));
  }
  return text;
}

constexpr std::array<double, 8> kProbabilityBins{0, 0.5, 0.7, 0.8, 0.9, 0.95, 0.99, 1.0000001};

struct Bin {
  double low, high, mean = 0;
  int right = 0, claims = 0;
};

std::vector<Bin> reliability(const std::vector<Scored>& all) {
  std::vector<Bin> bins;
  for (std::size_t i = 0; i + 1 < kProbabilityBins.size(); ++i) {
    Bin bin{kProbabilityBins[i], kProbabilityBins[i + 1]};
    for (const Scored& s : all) {
      for (const ScoredClaim& claim : s.score.claims) {
        if (!(claim.probability >= bin.low && claim.probability < bin.high)) continue;
        bin.mean += claim.probability;
        bin.right += claim.right;
        ++bin.claims;
      }
    }
    if (bin.claims > 0) bin.mean /= bin.claims;
    bins.push_back(bin);
  }
  return bins;
}

std::string claimed(const Outcome& outcome) {
  if (outcome.claims.empty()) return outcome.verdict;
  std::vector<std::string> claims;
  for (const OutcomeClaim& claim : outcome.claims) {
    claims.push_back(claim.ids.size() == 1 ? claim.ids[0]
                                           : fmt::format("{{{}}}", fmt::join(claim.ids, ", ")));
  }
  return fmt::format("{}", fmt::join(claims, " + "));
}

std::string causes_of(const Truth& truth) {
  if (truth.causes.empty()) return "nothing";
  std::vector<std::string> causes;
  for (const TrueCause& cause : truth.causes) causes.push_back(cause.id);
  if (truth.stratum == Stratum::kParameters) return "parameters";
  return fmt::format("{}", fmt::join(causes, " + "));
}

std::string figures_of(const Truth& truth) {
  std::vector<std::string> causes;
  for (const TrueCause& cause : truth.causes) {
    causes.push_back(fmt::format("{}/{} {:.3g} ({:.0f} sigma)", cause.id, cause.form,
                                 cause.amplitude, cause.signal));
  }
  return causes.empty() ? "nothing" : fmt::format("{}", fmt::join(causes, " + "));
}

/// Whether the case went as its stratum asks.
bool is_good(const Scored& s) {
  switch (s.truth->stratum) {
    case Stratum::kNulls:
    case Stratum::kNullsByRun:
    case Stratum::kNullsOfFew:
      return s.score.silent;
    case Stratum::kParameters:
      return s.score.is_parameters;
    case Stratum::kUnlisted:
      return s.score.unexplained;
    case Stratum::kDrift:
    case Stratum::kDriftByRun:
      return s.truth->causes.front().accepted.empty() ? s.score.unexplained : s.score.right;
    default:
      return s.score.right;
  }
}

std::string measure_row(const Measure& m) {
  const auto [low, high] = wilson(m.hits, m.trials);
  return fmt::format("{:.1f} % ({}/{}; {:.1f}-{:.1f})", 100 * m.share(), m.hits, m.trials,
                     100 * low, 100 * high);
}

std::string measures_table(const std::vector<CaseResult>& results) {
  const std::vector<std::string> names = methods(results);
  std::vector<std::vector<Measure>> columns;
  for (const std::string& method : names) columns.push_back(measures(results, method));
  std::string text = "| stratum | measure | target |";
  std::string rule = "|---|---|---|";
  for (const std::string& method : names) {
    text += fmt::format(" {} |", method);
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (std::size_t i = 0; !columns.empty() && i < columns[0].size(); ++i) {
    const Measure& m = columns[0][i];
    if (m.trials == 0 && m.what != "claims of p > .9 right") continue;
    text += fmt::format("| {} | {} | {} {:.0f} % {} |", m.stratum, m.what,
                        m.at_most ? "<=" : ">=", 100 * m.target, m.met() ? "met" : "MISSED");
    for (const auto& column : columns) text += fmt::format(" {} |", measure_row(column[i]));
    text += '\n';
  }
  return text;
}

std::string held_out_table(const std::vector<CaseResult>& results) {
  std::string text =
      "\n## Held-out error over the noise floor, worst channel, where something was corrected\n\n"
      "| method | cases | calibrated, median | corrected, median | corrected, 90 % |\n"
      "|---|---|---|---|---|\n";
  for (const std::string& method : methods(results)) {
    const HeldOut h = held_out(scored(results, method));
    text += fmt::format("| {} | {} | {:.2f} | {:.2f} | {:.2f} |\n", method, h.cases,
                        h.calibrated_median, h.corrected_median, h.corrected_p90);
  }
  return text;
}

std::string reliability_table(const std::vector<CaseResult>& results) {
  std::string text =
      "\n## Reliability: probability claimed against share right\n\n"
      "| method | probability | claims | mean probability | right |\n"
      "|---|---|---|---|---|\n";
  for (const std::string& method : methods(results)) {
    for (const Bin& bin : reliability(scored(results, method))) {
      if (bin.claims == 0) continue;
      text += fmt::format("| {} | {:.2f}-{:.2f} | {} | {:.3f} | {} |\n", method, bin.low,
                          std::min(bin.high, 1.0), bin.claims, bin.mean,
                          measure_row({.hits = bin.right, .trials = bin.claims}));
    }
  }
  return text;
}

constexpr std::array<double, 5> kSignalBins{5, 8, 15, 40, 1e9};

std::string signal_table(const std::vector<Scored>& all) {
  std::string text =
      "\n## As asked, by signal after calibration (the weakest cause)\n\n"
      "| stratum | 5-8 sigma | 8-15 | 15-40 | above |\n|---|---|---|---|---|\n";
  for (const Stratum stratum : strata()) {
    if (is_null(stratum) || stratum == Stratum::kParameters) continue;
    text += fmt::format("| {} |", name(stratum));
    for (std::size_t i = 0; i + 1 < kSignalBins.size(); ++i) {
      int good = 0, cases = 0;
      for (const Scored& s : all) {
        if (s.truth->stratum != stratum || s.truth->causes.empty()) continue;
        const double signal = std::ranges::min(s.truth->causes, {}, &TrueCause::signal).signal;
        if (!(signal >= kSignalBins[i] && signal < kSignalBins[i + 1])) continue;
        ++cases;
        good += is_good(s);
      }
      text += fmt::format(" {}/{} |", good, cases);
    }
    text += '\n';
  }
  return text;
}

std::string confusion_table(const std::vector<Scored>& all) {
  std::map<std::string, std::map<std::string, int>> counts;
  for (const Scored& s : all) ++counts[causes_of(*s.truth)][claimed(*s.outcome)];
  std::string text =
      "\n## Confusion: truth, and what was said\n\n| truth | cases | said |\n|---|---|---|\n";
  for (const auto& [truth, said] : counts) {
    std::vector<std::pair<int, std::string>> order;
    int cases = 0;
    for (const auto& [what, count] : said) {
      order.emplace_back(-count, what);
      cases += count;
    }
    std::ranges::sort(order);
    std::vector<std::string> words;
    for (const auto& [count, what] : order) words.push_back(fmt::format("{} {}", what, -count));
    text += fmt::format("| {} | {} | {} |\n", truth, cases, fmt::join(words, "; "));
  }
  return text;
}

std::string failures_table(const std::vector<Scored>& all) {
  std::string text =
      "\n## Cases that went otherwise than asked\n\n"
      "| case | truth | said | probability | signal | p before, after | share explained | "
      "held-out: "
      "calibrated, corrected |\n|---|---|---|---|---|---|---|---|\n";
  for (const Scored& s : all) {
    if (is_good(s)) continue;
    std::vector<std::string> p;
    for (const OutcomeClaim& claim : s.outcome->claims)
      p.push_back(fmt::format("{:.3f}", claim.probability));
    const std::string said =
        s.outcome->verdict == "failed" ? "failed: " + s.outcome->sentence : claimed(*s.outcome);
    text += fmt::format(
        "| {}-{:03} | {} | {} | {} | {:.0f} -> {:.1f} | {:.2g}, {:.2g} | {:.2f} | {:.2f}, {:.2f} "
        "|\n",
        name(s.truth->stratum), s.truth->index, figures_of(*s.truth), said, fmt::join(p, ", "),
        s.truth->signal.before, s.truth->signal.after, s.outcome->p_before, s.outcome->p_after,
        s.outcome->share_explained, s.score.calibrated_ratio, s.score.corrected_ratio);
  }
  return text;
}

}  // namespace

std::vector<Measure> measures(const std::vector<CaseResult>& results, const std::string& method) {
  const std::vector<Scored> all = scored(results, method);
  std::vector<Measure> list;
  const auto count = [&](Stratum stratum, std::string what, bool at_most, double target, auto hit) {
    Measure m{.stratum = std::string(name(stratum)),
              .what = std::move(what),
              .target = target,
              .at_most = at_most};
    for (const Scored& s : all) {
      if (s.truth->stratum != stratum) continue;
      ++m.trials;
      m.hits += hit(s) ? 1 : 0;
    }
    list.push_back(m);
  };
  const auto right = [](const Scored& s) { return s.score.right; };
  const auto exact = [](const Scored& s) { return s.score.exact; };
  using enum Stratum;
  for (const Stratum nulls : {kNulls, kNullsByRun, kNullsOfFew}) {
    count(nulls, "false missing physics", true, 0.02,
          [](const Scored& s) { return !s.score.silent; });
  }
  count(kParameters, "`parameters`", false, 0.9,
        [](const Scored& s) { return s.score.is_parameters; });
  count(kInstruments, "named (class counts)", false, 0.85, right);
  count(kInstruments, "called physics", true, 0.03,
        [](const Scored& s) { return s.score.called_physics; });
  count(kLargeFaults, "named (class counts)", false, 0.85, right);
  count(kOneEffect, "right name or class", false, 0.9, right);
  count(kOneEffect, "exact name", false, 0.75, exact);
  Measure sure{.stratum = "one_effect", .what = "claims of p > .9 right", .target = 0.95};
  for (const Scored& s : all) {
    if (s.truth->stratum != kOneEffect) continue;
    for (const ScoredClaim& claim : s.score.claims) {
      if (claim.probability <= 0.9) continue;
      ++sure.trials;
      sure.hits += claim.right;
    }
  }
  list.push_back(sure);
  count(kTwoEffects, "both named", false, 0.6, [](const Scored& s) { return s.score.all_causes; });
  count(kTwoEffects, "any wrong name", true, 0.08,
        [](const Scored& s) { return s.score.wrong_name; });
  count(kUnlisted, "`unexplained`", false, 0.85,
        [](const Scored& s) { return s.score.unexplained; });
  count(kRutHidden, "located at 8 deg and beyond", false, 0.9,
        [](const Scored& s) { return s.score.located; });
  count(kRutHidden, "named, or a class that asks for rut depths", false, 0.9,
        [](const Scored& s) { return s.score.right && (s.score.exact || s.score.asks_for_ruts); });
  count(kRutShown, "named", false, 0.9, exact);
  for (const Stratum drift : {kDrift, kDriftByRun}) {
    count(drift, "located in time, order or place", false, 0.9,
          [](const Scored& s) { return s.score.located_in_course; });
    count(drift, "named or class; `unexplained` where it has no name", false, 0.75, is_good);
    count(drift, "`parameters`", true, 0, [](const Scored& s) { return s.score.is_parameters; });
  }
  Measure worse{.stratum = "all", .what = "corrected worse than calibrated", .at_most = true};
  for (const Scored& s : all) {
    worse.trials += is_corrected(s);
    worse.hits += is_corrected(s) && s.score.worse_than_calibrated;
  }
  list.push_back(worse);
  return list;
}

std::string summary_markdown(const std::vector<CaseResult>& results, const std::string& label) {
  const std::vector<Scored> all = scored(results, "diagnosis");
  std::vector<double> seconds;
  for (const Scored& s : all) seconds.push_back(s.outcome->seconds);
  return fmt::format(
             "# Diagnosis campaign\n\n{}; {} cases. Processor seconds a diagnosis: median "
             "{:.1f}, 90 % {:.1f}, longest {:.1f}.\n\n",
             label, results.size(), quantile(seconds, 0.5), quantile(seconds, 0.9),
             quantile(seconds, 1)) +
         measures_table(results) + held_out_table(results) + reliability_table(results) +
         signal_table(all) + chance_table(all) + confusion_table(all) + failures_table(all);
}

nlohmann::json summary_json(const std::vector<CaseResult>& results, const std::string& label) {
  nlohmann::json json{
      {"label", label}, {"cases", results.size()}, {"methods", nlohmann::json::object()}};
  for (const std::string& method : methods(results)) {
    const std::vector<Scored> all = scored(results, method);
    nlohmann::json table = nlohmann::json::array(), curve = nlohmann::json::array();
    for (const Measure& m : measures(results, method)) {
      table.push_back({{"stratum", m.stratum},
                       {"measure", m.what},
                       {"hits", m.hits},
                       {"trials", m.trials},
                       {"wilson95", wilson(m.hits, m.trials)},
                       {"target", m.target},
                       {"at_most", m.at_most},
                       {"met", m.met()}});
    }
    for (const Bin& bin : reliability(all)) {
      curve.push_back({{"from", bin.low},
                       {"to", std::min(bin.high, 1.0)},
                       {"claims", bin.claims},
                       {"mean_probability", bin.mean},
                       {"right", bin.right}});
    }
    nlohmann::json chance = nlohmann::json::array();
    for (const ByChance& of : by_chance(all)) {
      chance.push_back({{"tests", of.tests},
                        {"nulls", of.log_odds.size()},
                        {"quantiles", kChanceQuantiles},
                        {"best_gain_nats", quantiles(of.best_gain_nats)},
                        {"log_odds", quantiles(of.log_odds)}});
    }
    const HeldOut h = held_out(all);
    const auto number = [](double v) {
      return std::isnan(v) ? nlohmann::json() : nlohmann::json(v);
    };
    json["methods"][method] = {{"measures", table},
                               {"reliability", curve},
                               {"by_chance", chance},
                               {"held_out",
                                {{"cases", h.cases},
                                 {"calibrated_median", number(h.calibrated_median)},
                                 {"corrected_median", number(h.corrected_median)},
                                 {"corrected_p90", number(h.corrected_p90)}}}};
  }
  return json;
}

}  // namespace regoplan::challenge
