#include "benchmarks/diagnosis/outcome.h"

#include <algorithm>
#include <cmath>

namespace regoplan::challenge {
namespace {

/// JSON has no infinities; what is not finite is absent.
nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}
double number_from(const nlohmann::json& json) {
  return json.is_null() ? std::nan("") : json.get<double>();
}

}  // namespace

Outcome outcome_of(const Diagnosis& diagnosis, std::size_t rows, double seconds) {
  Outcome outcome{.method = "diagnosis",
                  .verdict = std::string(name(diagnosis.verdict)),
                  .rows = rows,
                  .share_explained = diagnosis.share_explained,
                  .p_before = diagnosis.before.p_value,
                  .p_after = diagnosis.after.p_value,
                  .tests = std::string(name(diagnosis.support.tests)),
                  .best_gain_nats = diagnosis.support.best_gain_nats,
                  .log_odds = diagnosis.support.log_odds,
                  .seconds = seconds,
                  .sentence = diagnosis.sentence,
                  .notes = diagnosis.notes};
  for (const Claim& claim : diagnosis.claims) {
    OutcomeClaim said{.ids = {claim.id}, .probability = claim.probability};
    for (const std::string& id : claim.equivalent) {
      if (id != claim.id) said.ids.push_back(id);
    }
    outcome.claims.push_back(std::move(said));
  }
  for (const ChannelFit& fit : diagnosis.fit) {
    outcome.fit.push_back(
        {std::string(name(fit.channel)), fit.noise_floor, fit.calibrated_rmse, fit.corrected_rmse});
  }
  for (const MismatchRegion& region : diagnosis.where) {
    for (const auto& [column, range] : region.region) outcome.located_in.push_back(column);
    for (const char* column : {"slip_angle_deg", "abs_slip_angle_deg"}) {
      const auto angles = region.region.find(column);
      if (angles == region.region.end()) continue;
      const auto [low, high] = angles->second;
      const double from = low > 0 ? low : (high < 0 ? -high : 0);
      outcome.largest_angle_from_deg = std::max(outcome.largest_angle_from_deg, from);
    }
  }
  for (const Experiment& experiment : diagnosis.next_experiments) {
    if (experiment.further_sensor) {
      outcome.further_sensors.emplace_back(name(*experiment.further_sensor));
    }
  }
  return outcome;
}

nlohmann::json outcome_json(const Outcome& o) {
  nlohmann::json claims = nlohmann::json::array(), fit = nlohmann::json::array();
  for (const OutcomeClaim& claim : o.claims) {
    claims.push_back({{"ids", claim.ids}, {"probability", number(claim.probability)}});
  }
  for (const OutcomeFit& f : o.fit) {
    fit.push_back({{"channel", f.channel},
                   {"noise_floor", number(f.noise_floor)},
                   {"calibrated_rmse", number(f.calibrated_rmse)},
                   {"corrected_rmse", number(f.corrected_rmse)}});
  }
  return {{"method", o.method},
          {"verdict", o.verdict},
          {"claims", claims},
          {"fit", fit},
          {"rows", o.rows},
          {"largest_angle_from_deg", o.largest_angle_from_deg},
          {"located_in", o.located_in},
          {"further_sensors", o.further_sensors},
          {"share_explained", number(o.share_explained)},
          {"p_before", number(o.p_before)},
          {"p_after", number(o.p_after)},
          {"tests", o.tests},
          {"best_gain_nats", number(o.best_gain_nats)},
          {"log_odds", number(o.log_odds)},
          {"seconds", o.seconds},
          {"sentence", o.sentence},
          {"notes", o.notes}};
}

Outcome outcome_from(const nlohmann::json& json) {
  Outcome o{.method = json.at("method").get<std::string>(),
            .verdict = json.at("verdict").get<std::string>(),
            .rows = json.at("rows").get<std::size_t>(),
            .largest_angle_from_deg = json.at("largest_angle_from_deg").get<double>(),
            .located_in = json.at("located_in").get<std::vector<std::string>>(),
            .further_sensors = json.at("further_sensors").get<std::vector<std::string>>(),
            .share_explained = number_from(json.at("share_explained")),
            .p_before = number_from(json.at("p_before")),
            .p_after = number_from(json.at("p_after")),
            .tests = json.at("tests").get<std::string>(),
            .best_gain_nats = number_from(json.at("best_gain_nats")),
            .log_odds = number_from(json.at("log_odds")),
            .seconds = json.at("seconds").get<double>(),
            .sentence = json.at("sentence").get<std::string>(),
            .notes = json.at("notes").get<std::vector<std::string>>()};
  for (const auto& claim : json.at("claims")) {
    o.claims.push_back({.ids = claim.at("ids").get<std::vector<std::string>>(),
                        .probability = number_from(claim.at("probability"))});
  }
  for (const auto& fit : json.at("fit")) {
    o.fit.push_back({.channel = fit.at("channel").get<std::string>(),
                     .noise_floor = number_from(fit.at("noise_floor")),
                     .calibrated_rmse = number_from(fit.at("calibrated_rmse")),
                     .corrected_rmse = number_from(fit.at("corrected_rmse"))});
  }
  return o;
}

}  // namespace regoplan::challenge
