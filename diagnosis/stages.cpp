#include "diagnosis/stages.h"

#include <utility>

#include "diagnosis/findings/sentence.h"
#include "terramech/basics/interruption.h"

namespace regoplan {

Diagnosis run_stages(Diagnosis& found, Diagnosis& complete, const std::function<void()>& stages) {
  complete = found;
  try {
    stages();
  } catch (const Interrupted&) {
    found = std::move(complete);
    found.interrupted = true;
  }
  found.sentence = sentence_of(found);
  return std::move(found);
}

}  // namespace regoplan
