#include <algorithm>
#include <array>

#include "diagnosis/findings/findings.h"
#include "diagnosis/findings/sentence.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {

std::string_view name(Verdict verdict) {
  constexpr std::array<std::string_view, 7> kNames{"consistent",  "parameters", "named",    "class",
                                                   "unexplained", "partly",     "undecided"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::string_view name(PlainModel plain) {
  constexpr std::array<std::string_view, 3> kNames{"holds", "doubted", "refuted"};
  return kNames[static_cast<std::size_t>(plain)];
}

std::string_view name(WhereOff off) {
  constexpr std::array<std::string_view, 3> kNames{"calibrated_model", "soil_beside_claim",
                                                   "reference"};
  return kNames[static_cast<std::size_t>(off)];
}

bool is_class(const std::vector<Claim>& claims) {
  return std::ranges::any_of(claims, [](const Claim& claim) { return !claim.equivalent.empty(); });
}

Verdict verdict_of_names(const Diagnosis& diagnosis) {
  const bool leaves_most = diagnosis.remainder_share > 1 - Thresholds::kWorthANameAlone;
  if (diagnosis.excess_is_clear && leaves_most) return Verdict::kPartly;
  return is_class(diagnosis.claims) ? Verdict::kClass : Verdict::kNamed;
}

Diagnosis undecided(const Recording& recording) {
  Diagnosis diagnosis{
      .verdict = Verdict::kUndecided, .notes = recording.warnings, .interrupted = true};
  diagnosis.sentence = sentence_of(diagnosis);
  return diagnosis;
}

}  // namespace regoplan
