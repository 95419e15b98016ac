#pragma once

#include <functional>

#include "diagnosis/findings/findings.h"

namespace regoplan {

/// Runs the stages of a diagnosis and makes its sentence; interrupted, of the stages that are
/// complete.
/// \param found filled in by the stages
/// \param complete what of it holds, kept by each stage that ends; undecided at first
Diagnosis run_stages(Diagnosis& found, Diagnosis& complete, const std::function<void()>& stages);

}  // namespace regoplan
