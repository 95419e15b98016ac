#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/evaluate/evaluation_files.h"

namespace regoplan {

/// A name of files as words: `tip_over` as "tip over".
std::string as_words(std::string_view file_name);

/// A path's file without its folder; a manoeuvre as it is called.
std::string short_name(const EvaluatedPath& path);

/// The margin that is smallest, or where the path has none, or sinks too deep for one: what refuses
/// it.
std::string limited_by(const PathEvaluation& evaluation);

/// With three decimals; a dash where the path has no margins.
std::string margin_text(const PathEvaluation& evaluation, double margin);

/// What a drive of the path came to; a dash where nothing was driven.
std::string driven_text(const PathEvaluation& evaluation, const std::string& text);

/// Which margin is smallest, where, and what ends the supply there.
std::string limiting_text(const PathEvaluation& evaluation);

/// The soil numbers that decide most, `count_max` at most, with their shares; a dash where nothing
/// could be drawn.
std::string influence_text(const std::optional<SoilSpread>& spread, std::size_t count_max);

/// Which feasible paths share a rank, as draws of the soils cannot tell them apart; empty where
/// each has one.
std::string tie_sentence(const EvaluationResult& result);

/// That `plan` would not count a path that is feasible at the mean soils, as it is not shown to
/// hold in `probability_min` of the draws; empty where it is, or none is asked for.
std::string too_doubtful_text(const EvaluatedPath& path);

}  // namespace regoplan
