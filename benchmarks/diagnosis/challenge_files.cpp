#include "benchmarks/diagnosis/challenge_files.h"

#include <fmt/format.h>

#include <cmath>

#include "terramech/basics/angles.h"

namespace regoplan::challenge {

std::string recording_csv(const Recording& recording) {
  const RecordedColumns& has = recording.columns;
  const bool replicates = !recording.runs.empty() && recording.runs[0].replicate.has_value();
  std::string text = "run_id,load_n,slip_ratio,slip_angle_deg";
  if (has.day) text += ",day";
  if (replicates) text += ",replicate";
  if (has.pass) text += ",pass";
  if (has.speed) text += ",speed_mps";
  if (has.time) text += ",time_s";
  if (has.position) text += ",position_m";
  for (const Channel channel : recording.channels) text += fmt::format(",{}", name(channel));
  text += '\n';
  for (const WheelRun& run : recording.runs) {
    text += fmt::format("{},{:.6g},{:.6g},{:.3f}", run.run_id, run.load_n, run.slip_ratio,
                        run.slip_angle_rad / kDegree);
    if (has.day) text += fmt::format(",{:.6g}", run.day);
    if (replicates) text += fmt::format(",{}", run.replicate.value_or(1));
    if (has.pass) text += fmt::format(",{}", run.conditions.pass);
    if (has.speed) text += fmt::format(",{:.6g}", run.conditions.speed_mps);
    if (has.time) text += fmt::format(",{:.6g}", run.conditions.time_s);
    if (has.position) text += fmt::format(",{:.6g}", run.conditions.position_m);
    for (const Channel channel : recording.channels) {
      const double value = run.value(channel);
      text += std::isnan(value) ? "," : fmt::format(",{:.6g}", value);
    }
    text += '\n';
  }
  return text;
}

std::string setup_yaml(const DiagnosisSetup& setup) {
  const bool paper = setup.variant == WheelVariant::kYoshida2004;
  std::string text = fmt::format(
      "model: {}\nwheel: {{radius_m: {:.6g}, width_m: {:.6g}}}\ngravity_mps2: {:.6g}\nsoil:\n",
      paper ? "yoshida2004" : "ishigami2007", setup.wheel.radius_m, setup.wheel.width_m,
      setup.gravity_mps2);
  for (const SoilParameter& parameter : soil_parameters()) {
    if (parameter.member == &Soil::c0_m && !paper) continue;
    const double mean = setup.soil.mean.*parameter.member / parameter.file_unit;
    const double deviation = setup.soil.standard_deviation.*parameter.member / parameter.file_unit;
    text += deviation > 0 ? fmt::format("  {}: {{mean: {:.6g}, std: {:.6g}}}\n", parameter.name,
                                        mean, deviation)
                          : fmt::format("  {}: {:.6g}\n", parameter.name, mean);
  }
  if (!setup.noise_standard_deviation.empty()) text += "noise:\n";
  for (const auto& [channel, deviation] : setup.noise_standard_deviation) {
    text += fmt::format("  {}: {:.6g}\n", name(channel), deviation);
  }
  return text;
}

nlohmann::json truth_json(const Truth& truth) {
  nlohmann::json causes = nlohmann::json::array();
  for (const TrueCause& cause : truth.causes) {
    causes.push_back({{"id", cause.id},
                      {"form", cause.form},
                      {"accepted", cause.accepted},
                      {"instrument", cause.instrument},
                      {"amplitude", cause.amplitude},
                      {"shape", cause.shape},
                      {"signal", cause.signal}});
  }
  nlohmann::json soil;
  for (const SoilParameter& parameter : soil_parameters()) {
    soil[std::string(parameter.name)] = truth.soil.*parameter.member / parameter.file_unit;
  }
  return {{"stratum", name(truth.stratum)},
          {"index", truth.index},
          {"causes", causes},
          {"signal_before", truth.signal.before},
          {"signal_after", truth.signal.after},
          {"soil", soil},
          {"attempts", truth.attempts}};
}

Truth truth_from(const nlohmann::json& json) {
  Truth truth{
      .stratum = stratum_named(json.at("stratum").get<std::string>()),
      .index = json.at("index").get<std::uint64_t>(),
      .signal = {json.at("signal_before").get<double>(), json.at("signal_after").get<double>()},
      .attempts = json.at("attempts").get<int>()};
  for (const SoilParameter& parameter : soil_parameters()) {
    truth.soil.*parameter.member =
        json.at("soil").at(std::string(parameter.name)).get<double>() * parameter.file_unit;
  }
  for (const auto& cause : json.at("causes")) {
    truth.causes.push_back({.id = cause.at("id").get<std::string>(),
                            .form = cause.at("form").get<std::string>(),
                            .accepted = cause.at("accepted").get<std::vector<std::string>>(),
                            .instrument = cause.at("instrument").get<bool>(),
                            .amplitude = cause.at("amplitude").get<double>(),
                            .shape = cause.at("shape").get<double>(),
                            .signal = cause.at("signal").get<double>()});
  }
  return truth;
}

}  // namespace regoplan::challenge
