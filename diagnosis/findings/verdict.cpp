#include <array>

#include "diagnosis/findings/findings.h"
#include "diagnosis/findings/sentence.h"

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

Diagnosis undecided(const Recording& recording) {
  Diagnosis diagnosis{
      .verdict = Verdict::kUndecided, .notes = recording.warnings, .interrupted = true};
  diagnosis.sentence = sentence_of(diagnosis);
  return diagnosis;
}

}  // namespace regoplan
