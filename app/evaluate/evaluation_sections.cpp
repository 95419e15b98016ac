#include "app/evaluate/evaluation_sections.h"

#include <fmt/format.h>

#include "app/evaluate/evaluation_words.h"
#include "app/io/quantity_text.h"
#include "app/page/report_page.h"

namespace regoplan {
namespace {

std::string cell(std::string_view text, bool number = false) {
  return fmt::format("<td{}>{}</td>", number ? " class=\"number\"" : "", html_escaped(text));
}

std::string verdict_text(const PathEvaluation& e) {
  return e.feasible ? "feasible" : "not feasible: " + as_words(name(e.refusal->reason));
}

std::string per_cent_text(const std::optional<SoilSpread>& spread) {
  if (!spread) return std::string(kNotKnown);
  const Probability& holds = spread->feasible;
  return fmt::format("{:.1f} % ({:.1f} to {:.1f})", 100 * holds.share, 100 * holds.low,
                     100 * holds.high);
}

std::string table_row(const EvaluatedPath& path) {
  const PathEvaluation& e = path.evaluation;
  return fmt::format("<tr><th scope=\"row\">{} {}</th>", e.rank, html_escaped(short_name(path))) +
         cell(verdict_text(e)) + cell(limited_by(e)) + cell(margin_text(e, e.margin_min), true) +
         cell(influence_text(e.spread, 1)) +
         cell(margin_text(e, e.spread ? e.spread->margin.p05 : 0), true) +
         cell(per_cent_text(e.spread), true) +
         cell(driven_text(e, length_text(e.tracking.deviation_max_m)), true) +
         cell(fmt::format("{:.1f} m", e.length_m), true) +
         cell(fmt::format("{:.1f} s", e.duration_s), true) +
         cell(driven_text(e, energy_text(e.tracking.energy_j)), true) + "</tr>\n";
}

std::string course_html(const EvaluatedPath& path) {
  const PathEvaluation& e = path.evaluation;
  std::string verdict = e.feasible ? "is feasible at the mean soils"
                                   : "is not feasible at the mean soils: " + sentence(*e.refusal);
  const std::string doubt = too_doubtful_text(path);
  if (!doubt.empty()) verdict += ", but " + doubt;
  const std::string margins =
      e.spread ? fmt::format(
                     "<p>Smallest margin at the mean soils {:.3f}: {}.</p>"
                     "<p>Over the draws of the soils it varies most with: {}.</p>",
                     e.margin_min, html_escaped(limiting_text(e)),
                     html_escaped(influence_text(e.spread, 3)))
               : "<p>It has no margins: not all of it can be judged.</p>";
  return fmt::format(
      "<article class=\"panel\"><div class=\"course\"></div><p>Path {} {}.</p>{}</article>\n",
      e.rank, html_escaped(verdict), margins);
}

/// How the draws of a path were judged.
std::string draws_text(const EvaluatedPath& path, const SoilSpread& spread) {
  const PathMargins& error = spread.surrogate_error;
  const std::string others =
      spread.direct_draws == spread.draws
          ? ""
          : fmt::format(
                ", the others by a quadratic surrogate less its largest overestimate on draws it "
                "was not made from (cornering {:.4f}, tip-over {:.4f}, traction {:.4f})",
                error.cornering, error.tip_over, error.traction);
  return fmt::format(
      "{}: {} draws at {} places, {} by the wheel model{}; a linear regression explains {:.0f} % "
      "of the margin's variance.",
      short_name(path), spread.draws, spread.places, spread.direct_draws, others,
      100 * spread.explained);
}

}  // namespace

std::string side_by_side_html(const EvaluationResult& result) {
  std::string html =
      "<section><h2>Side by side</h2><div id=\"spreads\" class=\"spreads\"></div>"
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Table of the paths\">"
      "<table class=\"one-line\">\n<thead><tr>";
  for (const char* head :
       {"Path", "Verdict at mean soils", "Limited by", "Margin at mean soils", "Varies most with",
        "5 % margin", "P(margins hold)", "Deviation", "Length", "Duration", "Energy"}) {
    html += fmt::format("<th scope=\"col\">{}</th>", head);
  }
  html += "</tr></thead><tbody>\n";
  for (const EvaluatedPath& path : result.paths) html += table_row(path);
  return html + "</tbody></table></div></section>\n";
}

std::string courses_html(const EvaluationResult& result) {
  std::string html = "<section><h2>Each path</h2><div class=\"panels\">\n";
  for (const EvaluatedPath& path : result.paths) html += course_html(path);
  return html + "</div></section>\n";
}

std::string method_html(const EvaluationResult& result) {
  std::string html = "<section><h2>How this was decided</h2><ul>\n";
  const auto item = [&html](const std::string& text) {
    html += fmt::format("<li>{}</li>\n", html_escaped(text));
  };
  item(
      "Commanded path: at stations at most 0.5 m apart (a candidate: at the moments of its record) "
      "the demand of the steady manoeuvre is held against the supply of the direct wheel model.");
  item(
      "Driven path: the vehicle's dynamics track it in closed loop, slip, slip angle, sinkage, "
      "slope, obstacles and deviation limited at every step. Steering law: " +
      steering_law_text(result.settings.follower.law) + ".");
  item(
      "Feasible where both hold at the mean soils: the draws do not change that verdict. P is the "
      "probability that the margins hold over what is known of the soils, speeds and curvatures "
      "held, with Wilson's interval; every path sees the same draws.");
  item(
      "The soil number that a margin varies most with is the one whose spread explains most of its "
      "variance over the draws; the per cent are its share. Few draws decide P with a wide "
      "interval, but cannot name such a number.");
  item(
      "A margin of -1 stands for a place where the soil bears no steady drive at all, or for the "
      "open end of an interval.");
  for (const EvaluatedPath& path : result.paths) {
    const auto& spread = path.evaluation.spread;
    if (spread && spread->draws > 0) item(draws_text(path, *spread));
  }
  return html + "</ul></section>\n";
}

}  // namespace regoplan
