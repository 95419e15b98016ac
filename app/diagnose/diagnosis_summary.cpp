#include "app/diagnose/diagnosis_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/diagnose/diagnosis_report.h"

namespace regoplan {
namespace {

constexpr std::size_t kShown = 5;

std::string region_text(const MismatchRegion& mismatch) {
  std::string text;
  for (const auto& [column, ends] : mismatch.region) {
    text +=
        fmt::format("{}{} {:.3g} to {:.3g}", text.empty() ? "" : ", ", column, ends[0], ends[1]);
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
  for (std::size_t i = 0; i < std::min(kShown, diagnosis.ranking.size()); ++i) {
    const ScoredCandidate& candidate = diagnosis.ranking[i];
    text += fmt::format("{:>8} {:>5.1f} % {}\n", i == 0 ? "what:" : "", 100 * candidate.probability,
                        candidate.id);
  }
  for (const Claim& claim : diagnosis.claims) {
    text +=
        fmt::format("{:>8} {:>5.1f} % ({:.1f} to {:.1f}) {}\n",
                    &claim == diagnosis.claims.data() ? "share:" : "", 100 * claim.share.explained,
                    100 * claim.share.low, 100 * claim.share.high, claim.id);
  }
  if (!diagnosis.fit.empty()) {
    text +=
        fmt::format("{:>8} {:>11} {:>9} {:>9} {:>10} {:>9}   on runs held out by {}\n", "rmse:", "",
                    "noise", "baseline", "calibrated", "corrected", diagnosis.held_out_by);
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
