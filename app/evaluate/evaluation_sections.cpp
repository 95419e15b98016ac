#include "app/evaluate/evaluation_sections.h"

#include <fmt/format.h>

#include "app/evaluate/evaluation_words.h"
#include "app/page/report_page.h"

namespace regoplan {
namespace {

std::string cell(std::string_view text, bool number = false) {
  return fmt::format("<td{}>{}</td>", number ? " class=\"number\"" : "", html_escaped(text));
}

std::string verdict_text(const PathEvaluation& e) {
  return e.feasible ? "feasible" : "not feasible: " + as_words(name(e.refusal->reason));
}

std::string table_row(const EvaluatedPath& path) {
  const PathEvaluation& e = path.evaluation;
  const Probability& holds = e.spread.feasible;
  return fmt::format("<tr><th scope=\"row\">{} {}</th>", e.rank, html_escaped(short_name(path))) +
         cell(verdict_text(e)) + cell(influence_text(e.spread, 1)) +
         cell(as_words(name(e.limiting.margin))) + cell(fmt::format("{:.3f}", e.margin_min), true) +
         cell(fmt::format("{:.3f}", e.spread.margin.p05), true) +
         cell(fmt::format("{:.1f} % ({:.1f} to {:.1f})", 100 * holds.share, 100 * holds.low,
                          100 * holds.high),
              true) +
         cell(fmt::format("{:.2f} m", e.tracking.deviation_max_m), true) +
         cell(fmt::format("{:.1f} m", e.length_m), true) +
         cell(fmt::format("{:.1f} s", e.duration_s), true) +
         cell(fmt::format("{:.1f} kJ", e.tracking.energy_j / 1000), true) + "</tr>\n";
}

std::string course_html(const EvaluatedPath& path) {
  const PathEvaluation& e = path.evaluation;
  const std::string verdict =
      e.feasible ? "is feasible" : "is not feasible: " + sentence(*e.refusal);
  return fmt::format(
      "<article class=\"panel\"><div class=\"course\"></div>"
      "<p>Path {} {}.</p><p>Smallest margin {:.3f}: {}.</p><p>Soil numbers that decide: {}.</p>"
      "</article>\n",
      e.rank, html_escaped(verdict), e.margin_min, html_escaped(limiting_text(e)),
      html_escaped(influence_text(e.spread, 3)));
}

/// How the draws of a path were judged.
std::string draws_text(const EvaluatedPath& path) {
  const SoilSpread& spread = path.evaluation.spread;
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
       {"Path", "Verdict", "Decided by", "Limited by", "Smallest margin", "5 % margin",
        "P(margins hold)", "Deviation", "Length", "Duration", "Energy"}) {
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
      "Feasible where both hold. P is the probability that the margins hold over what is known of "
      "the soils, speeds and curvatures held, with Wilson's interval; every path sees the same "
      "draws.");
  item(
      "The soil number that decides is the one whose spread explains most of the margin's "
      "variance; the per cent are its share.");
  for (const EvaluatedPath& path : result.paths) {
    if (path.evaluation.spread.draws > 0) item(draws_text(path));
  }
  return html + "</ul></section>\n";
}

}  // namespace regoplan
