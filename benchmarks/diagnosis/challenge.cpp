#include "benchmarks/diagnosis/challenge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "terramech/basics/input_error.h"

namespace regoplan::challenge {
namespace {

constexpr double kOneEffectSigma = 5, kClearSigma = 8, kWrongSoilSigma = 10;
constexpr std::size_t kFewestRunsKept = 20;
constexpr int kTriesOfOneEffect = 25;  // then the next of the list has its turn

struct NamedStratum {
  Stratum stratum;
  std::string_view name;
};
constexpr std::array<NamedStratum, 13> kNames{{{Stratum::kNulls, "nulls"},
                                               {Stratum::kParameters, "parameters"},
                                               {Stratum::kInstruments, "instruments"},
                                               {Stratum::kOneEffect, "one_effect"},
                                               {Stratum::kTwoEffects, "two_effects"},
                                               {Stratum::kUnlisted, "unlisted"},
                                               {Stratum::kRutHidden, "rut_hidden"},
                                               {Stratum::kRutShown, "rut_shown"},
                                               {Stratum::kDrift, "drift"},
                                               {Stratum::kLargeFaults, "large_faults"},
                                               {Stratum::kDriftByRun, "drift_by_run"},
                                               {Stratum::kNullsByRun, "nulls_by_run"},
                                               {Stratum::kNullsOfFew, "nulls_of_few"}}};

/// Everything that makes a recording, before it is recorded.
struct Plan {
  Rig rig;
  MeasurementNoise noise;
  std::vector<DrawnEffect> effects;
  std::vector<InstrumentFault> faults;
  Truth truth;
};

double as_in_file(double value) {
  return std::stod(fmt::format("{:.6g}", value));
}

/// The setup with its numbers as they stand in the file.
DiagnosisSetup written(const Rig& rig, const MeasurementNoise& noise, Random& random) {
  DiagnosisSetup setup = rig.setup;
  for (const SoilParameter& parameter : soil_parameters()) {
    for (Soil* soil : {&setup.soil.mean, &setup.soil.standard_deviation}) {
      double& value = soil->*parameter.member;
      value = as_in_file(value / parameter.file_unit) * parameter.file_unit;
    }
  }
  if (rig.replicates > 1) return setup;
  for (const Channel channel : rig.channels) {
    const bool is_force = channel == Channel::kFx || channel == Channel::kFy;
    const double typical = is_force ? 0.3 * rig.middle_load_n
                           : channel == Channel::kTorque
                               ? 0.3 * rig.middle_load_n * rig.setup.wheel.radius_m
                               : rig.middle_sinkage_m;
    setup.noise_standard_deviation[channel] =
        as_in_file(uniform(random, 0.95, 1.1) * noise_sigma(noise, channel, typical));
  }
  return setup;
}

DrawnEffect drawn(Random& random, const TruthEffect& effect) {
  const double size = uniform(random, effect.low, effect.high);
  return {&effect, effect.either_sign ? sign(random) * size : size, uniform(random, 0, 1)};
}

TrueCause cause_of(const DrawnEffect& effect, double signal) {
  return {.id = std::string(effect.effect->id),
          .form = std::string(effect.effect->form),
          .accepted = {std::string(effect.effect->id)},
          .amplitude = effect.amplitude,
          .shape = effect.shape,
          .signal = signal};
}

/// What a bias is a share of.
double unit(const Rig& rig, Channel channel) {
  if (channel == Channel::kTorque) return rig.middle_load_n * rig.setup.wheel.radius_m;
  return channel == Channel::kSinkage ? 3 * rig.middle_sinkage_m : rig.middle_load_n;
}

/// Faults of one kind and how large they are: shares, or rad where a sensor is turned.
struct FaultRange {
  std::string_view id;
  double low, high;
};
constexpr std::array<FaultRange, 6> kUsualFaults{{{"sensor_bias", 0.03, 0.12},
                                                  {"sensor_bias", 0.03, 0.12},
                                                  {"sensor_gain", 0.06, 0.25},
                                                  {"sensor_crosstalk", 0.04, 0.2},
                                                  {"slip_scale", 0.02, 0.08},
                                                  {"load_cell", 0.06, 0.25}}};
constexpr std::array<FaultRange, 6> kLargeFaults{{{"sensor_bias", 0.12, 0.3},
                                                  {"sensor_gain", 0.25, 0.5},
                                                  {"sensor_crosstalk", 0.2, 0.4},
                                                  {"slip_scale", 0.08, 0.15},
                                                  {"load_cell", 0.25, 0.4},
                                                  {"sensor_turned", 0.04, 0.3}}};

/// Crosstalk is of force into force, or of torque into drawbar pull where no side force is
/// measured.
InstrumentFault draw_fault(Random& random, const Rig& rig, const FaultRange& range) {
  using enum Channel;
  InstrumentFault fault{.id = std::string(range.id), .channel = one_of(random, rig.channels)};
  fault.from = fault.channel;
  const double s = sign(random);
  fault.amount = s * uniform(random, range.low, range.high);
  if (range.id == "sensor_bias") fault.amount *= unit(rig, fault.channel);
  if (range.id == "sensor_turned") {
    fault.channel = kFx;
    fault.from = kFy;
  }
  if (range.id == "sensor_crosstalk") {
    const bool side = std::ranges::count(rig.channels, kFy) > 0;
    fault.channel = side && chance(random, 0.6) ? kFy : kFx;
    fault.from = fault.channel == kFy ? kFx : (side ? kFy : kTorque);
    if (fault.from == kTorque) fault.amount /= rig.setup.wheel.radius_m;
  }
  return fault;
}

/// Moves one or two soil numbers out of what the tests say.
Plan with_wrong_soil(Random& random, Plan plan) {
  std::vector<SoilParameter> known_by_tests;
  for (const SoilParameter& parameter : soil_parameters()) {
    if (plan.rig.setup.soil.standard_deviation.*parameter.member > 0) {
      known_by_tests.push_back(parameter);
    }
  }
  std::shuffle(known_by_tests.begin(), known_by_tests.end(), random);
  known_by_tests.resize(chance(random, 0.5) ? 1 : 2);
  for (const SoilParameter& parameter : known_by_tests) {
    const double deviation = plan.rig.setup.soil.standard_deviation.*parameter.member;
    const double off = sign(random) * uniform(random, 2, 4);
    plan.rig.soil.*parameter.member = plan.rig.setup.soil.mean.*parameter.member + off * deviation;
    plan.truth.causes.push_back({.id = "parameters",
                                 .form = std::string(parameter.name),
                                 .accepted = {"parameters"},
                                 .amplitude = off});
  }
  return plan;
}

const TruthEffect& in_turn(const std::vector<TruthEffect>& effects, std::uint64_t turn) {
  // a stride that is prime to the length spreads neighbours of the list
  return effects[turn * 11 % effects.size()];
}

std::vector<TruthEffect> rut_effects() {
  std::vector<TruthEffect> ruts;
  for (const TruthEffect& effect : listed_effects()) {
    if (effect.id != "rut_asymmetry") continue;
    ruts.push_back(effect);
    ruts.back().needs.torque = ruts.back().needs.sinkage = true;
  }
  return ruts;
}

Plan planned(Random& random, const Needs& needs) {
  Plan plan{.rig = draw_rig(random, needs)};
  plan.noise = draw_noise(random, plan.rig);
  return plan;
}

/// Runs at times of their own, over days with or without nights between them; what the recording
/// tells of it differs.
Plan planned_by_run(Random& random, const Needs& needs) {
  constexpr double kNight_s = 16 * 3600;
  Plan plan = planned(random, needs);
  plan.rig.own_times = true;
  plan.rig.overnight_s = chance(random, 0.5) ? kNight_s : 0;
  plan.rig.columns.time = chance(random, 0.5);
  plan.rig.columns.day = chance(random, 0.7);
  plan.noise.memory = chance(random, 0.5) ? uniform(random, 0.1, 0.3) : 0;
  const bool tells_days =
      plan.rig.columns.day || (plan.rig.columns.time && plan.rig.overnight_s > 0);
  if (!tells_days)
    plan.noise.day_offset = plan.noise.day_gain = 0;  // what they do has no time else
  return plan;
}

/// Both edges of the rut are measured.
Plan planned_with_ruts(Random& random, const Needs& needs) {
  Plan plan = planned(random, needs);
  plan.rig.channels.push_back(Channel::kRutLeft);
  plan.rig.channels.push_back(Channel::kRutRight);
  return plan;
}

std::optional<Plan> with_effect(Random& random, const TruthEffect& effect, double least_sigma,
                                Plan (*planned_for)(Random&, const Needs&) = planned) {
  Plan plan = planned_for(random, effect.needs);
  plan.effects = {drawn(random, effect)};
  const auto signal = signal_of(plan.rig, plan.noise, plan.effects, {});
  if (!signal || !(signal->after >= least_sigma)) return std::nullopt;
  plan.truth.causes = {cause_of(plan.effects[0], signal->after)};
  plan.truth.signal = *signal;
  return plan;
}

std::optional<Plan> with_two_effects(Random& random, const TruthEffect& first) {
  const TruthEffect& second = one_of(random, listed_effects());
  if (first.id == second.id) return std::nullopt;
  Plan plan = planned(random, first.needs | second.needs);
  plan.effects = {drawn(random, first), drawn(random, second)};
  const auto signal = signal_of(plan.rig, plan.noise, plan.effects, {});
  if (!signal) return std::nullopt;
  plan.truth.signal = *signal;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto share =
        share_of_signal(plan.rig, plan.noise, plan.effects[i], {plan.effects[1 - i]});
    if (!share || !(*share >= kClearSigma)) return std::nullopt;
    plan.truth.causes.push_back(cause_of(plan.effects[i], *share));
  }
  return plan;
}

std::vector<std::string> accepted_for(const std::string& fault) {
  if (fault == "load_cell") return {"load_transfer", "sensor_gain"};
  if (fault == "sensor_turned") return {"sensor_crosstalk"};
  return {fault};
}

std::optional<Plan> with_fault(Random& random, bool large, std::uint64_t turn) {
  Plan plan = planned(random, {.torque = chance(random, 0.5), .sinkage = chance(random, 0.5)});
  const auto& kinds = large ? kLargeFaults : kUsualFaults;
  const InstrumentFault fault = draw_fault(random, plan.rig, kinds.at(turn % kinds.size()));
  plan.faults = {fault};
  const bool of_two = fault.id == "sensor_crosstalk" || fault.id == "sensor_turned";
  if (of_two && !std::ranges::count(plan.rig.channels, fault.from)) return std::nullopt;
  const auto signal = signal_of(plan.rig, plan.noise, {}, plan.faults);
  if (!signal || !(signal->after >= kOneEffectSigma)) return std::nullopt;
  plan.truth.causes = {{.id = fault.id,
                        .form = std::string(regoplan::name(fault.channel)),
                        .accepted = accepted_for(fault.id),
                        .instrument = true,
                        .amplitude = fault.amount,
                        .signal = signal->after}};
  plan.truth.signal = *signal;
  return plan;
}

/// A gain that settles or drifts and a zero that jumps are an instrument's; a bed that was prepared
/// otherwise is other soil; what a bed remembers has no name.
void accept_in_course(TrueCause& cause) {
  if (cause.id == "bed_memory") cause.accepted = {};
  if (cause.id == "bed_preparation") cause.accepted = {"soil_change"};
  if (cause.id != "warm_up" && cause.id != "gain_drift" && cause.id != "zero_jump") return;
  cause.accepted = {"sensor_gain", "sensor_bias"};
  cause.instrument = true;
}

/// One draw; nothing where it does not meet the stratum's terms.
std::optional<Plan> attempt(Random& random, Stratum stratum, std::uint64_t turn) {
  switch (stratum) {
    case Stratum::kNulls:
      return planned(random, {});
    case Stratum::kParameters: {
      Plan plan = with_wrong_soil(random, planned(random, {}));
      if (!is_valid(plan.rig.soil)) return std::nullopt;
      const auto signal = signal_of(plan.rig, plan.noise, {}, {});
      if (!signal || signal->before < kWrongSoilSigma) return std::nullopt;
      plan.truth.signal = *signal;
      return plan;
    }
    case Stratum::kInstruments:
    case Stratum::kLargeFaults:
      return with_fault(random, stratum == Stratum::kLargeFaults, turn);
    case Stratum::kOneEffect:
      return with_effect(random, in_turn(listed_effects(), turn), kOneEffectSigma);
    case Stratum::kTwoEffects:
      return with_two_effects(random, in_turn(listed_effects(), turn));
    case Stratum::kUnlisted:
      return with_effect(random, in_turn(unlisted_effects(), turn), kClearSigma);
    case Stratum::kDrift: {
      auto plan = with_effect(random, in_turn(drift_effects(), turn), kClearSigma);
      if (plan) accept_in_course(plan->truth.causes.front());
      return plan;
    }
    case Stratum::kDriftByRun: {
      auto plan =
          with_effect(random, in_turn(effects_in_days(), turn), kClearSigma, planned_by_run);
      if (plan) accept_in_course(plan->truth.causes.front());
      return plan;
    }
    case Stratum::kNullsByRun:
      return planned_by_run(random, {});
    case Stratum::kNullsOfFew: {
      Plan plan = planned(random, {});
      if (plan.rig.replicates < 2) return std::nullopt;
      return plan;
    }
    case Stratum::kRutHidden:
    case Stratum::kRutShown: {
      static const std::vector<TruthEffect> kRuts = rut_effects();
      return with_effect(random, kRuts[turn % kRuts.size()], kClearSigma,
                         stratum == Stratum::kRutShown ? planned_with_ruts : planned);
    }
  }
  return std::nullopt;
}

/// Keeps a third to a half of the runs, so that only some conditions keep a replicate.
void thin_out(Random& random, Recording& recording) {
  const double kept = uniform(random, 0.33, 0.5);
  std::erase_if(recording.runs, [&](const WheelRun&) { return !chance(random, kept); });
}

}  // namespace

bool is_null(Stratum stratum) {
  using enum Stratum;
  return stratum == kNulls || stratum == kNullsByRun || stratum == kNullsOfFew;
}

const std::vector<Stratum>& strata() {
  static const std::vector<Stratum> all = [] {
    std::vector<Stratum> list;
    for (const NamedStratum& named : kNames) list.push_back(named.stratum);
    return list;
  }();
  return all;
}

std::string_view name(Stratum stratum) {
  return kNames[static_cast<std::size_t>(stratum)].name;
}

Stratum stratum_named(std::string_view text) {
  std::vector<std::string_view> names;
  for (const NamedStratum& named : kNames) {
    if (named.name == text) return named.stratum;
    names.push_back(named.name);
  }
  throw InputError(fmt::format("stratum: {} is none of {}", text, fmt::join(names, ", ")));
}

Challenge generate(Stratum stratum, std::uint64_t seed, std::uint64_t index) {
  Random random(seed_of(seed, name(stratum), index));
  for (int tries = 0;; ++tries) {
    auto plan =
        attempt(random, stratum, index + static_cast<std::uint64_t>(tries / kTriesOfOneEffect));
    if (!plan) continue;
    auto recording = record(random, plan->rig, plan->noise, plan->effects, plan->faults);
    if (!recording) continue;
    if (stratum == Stratum::kNullsOfFew) {
      thin_out(random, *recording);
      if (recording->runs.size() < kFewestRunsKept) continue;
    }
    plan->truth.stratum = stratum;
    plan->truth.index = index;
    plan->truth.soil = plan->rig.soil;
    plan->truth.attempts = tries + 1;
    return {.recording = std::move(*recording),
            .setup = written(plan->rig, plan->noise, random),
            .truth = std::move(plan->truth)};
  }
}

}  // namespace regoplan::challenge
