#include "app/diagnose/diagnosis_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/diagnose/diagnosis_report.h"
#include "diagnosis/findings/sentence.h"

namespace regoplan {
namespace {

constexpr std::size_t kShown = 5;

std::string region_text(const MismatchRegion& mismatch) {
  std::string text;
  for (const auto& [column, ends] : mismatch.region) {
    const auto [from, to] = to_digits_of_the_larger(ends[0], ends[1]);
    const std::string first = fmt::format("{:.3g}", from), last = fmt::format("{:.3g}", to);
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", column, first);
    if (last != first) text += " to " + last;
  }
  return text.empty() ? "everywhere" : text;
}

std::string conditions_text(const Experiment& experiment) {
  std::string text;
  if (experiment.further_sensor)
    text = fmt::format("measure {} as well", name(*experiment.further_sensor));
  for (const auto& [column, value] : experiment.conditions) {
    text += fmt::format("{}{} {:.3g}", text.empty() ? "" : ", ", column, value);
  }
  return text;
}

std::string names_text(const Claim& claim) {
  std::string text = claim.id;
  for (const std::string& id : claim.equivalent) text += " or " + id;
  return text;
}

/// Why shares may be more than the whole, where they are.
std::string above_all_text(const Diagnosis& diagnosis) {
  double sum = 0;
  for (const Claim& claim : diagnosis.claims) sum += claim.share ? claim.share->explained : 0;
  constexpr double kMoreThanAll = 1.0005;  // what is told as 100.1 % and more
  if (sum < kMoreThanAll) return "";
  return "         above 100 %: on held-out runs the rest is less than the noise leads one to "
         "expect\n";
}

/// The probability of each claim, alone or beside others, and its share where that was measured.
std::string claims_text(const Diagnosis& diagnosis) {
  std::string text;
  for (const Claim& claim : diagnosis.claims) {
    text += fmt::format("{:>8} {}, {}", text.empty() ? "what:" : "", names_text(claim),
                        probability_words(claim.probability));
    if (claim.share) {
      text += fmt::format("; share {:.1f} % ({:.1f} to {:.1f})", 100 * claim.share->explained,
                          100 * claim.share->low, 100 * claim.share->high);
    }
    text += "\n";
  }
  return text + above_all_text(diagnosis);
}

/// The candidates that compete, each the whole of what is missing; they sum to 1, and a claim's
/// probability is the sum of those that hold one of its names.
std::string candidates_text(const Diagnosis& diagnosis) {
  const std::string_view first = diagnosis.claims.empty() ? "what:" : "of it:";
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, diagnosis.ranking.size()); ++i) {
    const auto& [id, probability, evidence_nats] = diagnosis.ranking[i];
    const bool alone =
        std::ranges::find(diagnosis.claims, id, &Claim::id) != diagnosis.claims.end();
    text += fmt::format("{:>8} {:>5.1f} % {}{}\n", i == 0 ? first : "", 100 * probability, id,
                        alone ? " alone" : "");
  }
  return text;
}

}  // namespace

std::string diagnosis_summary(const DiagnosisRun& run) {
  const Diagnosis& diagnosis = run.diagnosis;
  std::string text = fmt::format("{}{}: {}\n", diagnosis.interrupted ? "interrupted; by then " : "",
                                 name(diagnosis.verdict), diagnosis_headline(run));
  for (std::size_t i = 0; i < std::min(kShown, diagnosis.where.size()); ++i) {
    const MismatchRegion& at = diagnosis.where[i];
    text += fmt::format("{:>8} {} off by {:.3g} ({:.3g} to {:.3g}) at {}\n", i == 0 ? "where:" : "",
                        name(at.channel), at.effect, at.ci95[0], at.ci95[1], region_text(at));
  }
  text += claims_text(diagnosis) + candidates_text(diagnosis);
  if (!diagnosis.fit.empty()) {
    // Of a difference the last two models are what both share and the names alone.
    const bool differs = !run.references.empty();
    text += fmt::format("{:>8} {:>11} {:>9} {:>9} {:>10} {:>9}   on runs held out by {}\n",
                        "rmse:", "", "noise", "baseline", differs ? "shared" : "calibrated",
                        differs ? "by names" : "corrected", diagnosis.held_out_by);
  }
  for (const ChannelFit& fit : diagnosis.fit) {
    text +=
        fmt::format("{:>20} {:>9.3g} {:>9.3g} {:>10.3g} {:>9.3g}\n", name(fit.channel),
                    fit.noise_floor, fit.baseline_rmse, fit.calibrated_rmse, fit.corrected_rmse);
  }
  if (!diagnosis.next_experiments.empty()) {
    const Experiment& next = diagnosis.next_experiments.front();
    const std::string parts = next.separates.empty()
                                  ? ""
                                  : fmt::format("separates {}; ", fmt::join(next.separates, ", "));
    text += fmt::format("{:>8} {} ({}{:.2g} nats)\n", "next:", conditions_text(next), parts,
                        next.expected_gain_nats);
  }
  return text;
}

}  // namespace regoplan
