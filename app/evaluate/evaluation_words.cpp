#include "app/evaluate/evaluation_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/io/quantity_text.h"
#include "app/page/tie_sentence.h"

namespace regoplan {

std::string as_words(std::string_view file_name) {
  std::string text(file_name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string short_name(const EvaluatedPath& path) {
  return path.plane ? path.evaluation.name
                    : std::filesystem::path(path.evaluation.name).filename().string();
}

std::string limited_by(const PathEvaluation& evaluation) {
  const auto& refusal = evaluation.refusal;
  const bool too_deep = refusal && refusal->reason == Rejection::kSinkage &&
                        evaluation.margin_min <= MarginSpread::kBroken;
  if (!refusal || (evaluation.spread && !too_deep)) {
    return as_words(name(evaluation.limiting.margin));
  }
  return as_words(name(refusal->reason));
}

std::string margin_text(const PathEvaluation& evaluation, double margin) {
  return evaluation.spread ? fmt::format("{:.3f}", margin) : std::string(kNotKnown);
}

std::string driven_text(const PathEvaluation& evaluation, const std::string& text) {
  return evaluation.tracking.duration_s > 0 ? text : std::string(kNotKnown);
}

std::string limiting_text(const PathEvaluation& evaluation) {
  const LimitingPlace& place = evaluation.limiting;
  std::string text = fmt::format("{} at ({:.1f}, {:.1f}), {:.1f} s", as_words(name(place.margin)),
                                 place.x_m, place.y_m, place.time_s);
  if (const auto& limit = evaluation.cornering_limit) {
    text +=
        fmt::format("; supply ends by {}{} at {:.0f} N", name(limit->limit),
                    limit->wheel.empty() ? "" : " of " + as_words(limit->wheel), limit->supply_n);
  }
  return text;
}

std::string influence_text(const std::optional<SoilSpread>& spread, std::size_t count_max) {
  if (!spread) return std::string(kNotKnown);
  if (spread->draws > 0 && spread->influences.empty()) return "too few draws to name one";
  constexpr double kShareMin = 0.01;
  std::string text;
  for (std::size_t i = 0; i < std::min(count_max, spread->influences.size()); ++i) {
    const SoilInfluence& influence = spread->influences[i];
    if (influence.share < kShareMin) break;
    text += fmt::format("{}{} of {} {:.0f} %", text.empty() ? "" : ", ", influence.parameter,
                        influence.soil, 100 * influence.share);
  }
  if (!text.empty()) return text;
  return spread->draws == 0 ? "soil numbers known" : "no uncertain number";
}

std::string tie_sentence(const EvaluationResult& result) {
  std::vector<Standing> standings;  // those that are feasible stand first
  for (const EvaluatedPath& path : result.paths) {
    if (path.evaluation.feasible) standings.push_back(standing_of(path.evaluation));
  }
  return tie_sentence(tied_ranks(standings), [&](int rank) {
    const auto& spread = result.paths.at(static_cast<std::size_t>(rank) - 1).evaluation.spread;
    return spread && spread->draws > 0;
  });
}

std::string too_doubtful_text(const EvaluatedPath& path) {
  const PathEvaluation& e = path.evaluation;
  const double asked = path.limits.probability_min;
  if (!e.feasible || !e.spread || e.spread->feasible.low >= asked) return "";
  return fmt::format(
      "plan would not count it: shown to hold in {:.1f} % of the draws "
      "(limits.probability_min: at least {:.4g} %)",
      100 * e.spread->feasible.low, 100 * asked);
}

}  // namespace regoplan
