#pragma once

#include <string>
#include <string_view>

#include "app/evaluate/evaluation_files.h"

namespace regoplan {

/// A name of files as words: `tip_over` as "tip over".
std::string as_words(std::string_view file_name);

/// A path's file without its folder; a manoeuvre as it is called.
std::string short_name(const EvaluatedPath& path);

/// Which margin is smallest, where, and what ends the supply there.
std::string limiting_text(const PathEvaluation& evaluation);

/// The soil numbers that decide most, `count_max` at most, with their shares.
std::string influence_text(const SoilSpread& spread, std::size_t count_max);

}  // namespace regoplan
