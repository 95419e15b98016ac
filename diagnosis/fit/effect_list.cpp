#include "diagnosis/fit/effect_list.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "diagnosis/bed/span.h"
#include "diagnosis/fit/zone_edges.h"

namespace regoplan {
namespace {

/// Spread of conditions along one column.
Span span_of(const TestBed& bed, const auto& column) {
  Span span;
  for (const Condition& at : bed.conditions) {
    span.take(static_cast<double>(column(at)));
  }
  return span;
}

Coordinate positive(std::string name, double low, double high) {
  return {.name = std::move(name),
          .scale = Scale::kLogarithmic,
          .centre = std::log(low * high) / 2,
          .spread = std::max(std::log(high / low) / 2, 0.3)};
}

/// A share of at most `most`, its odds lognormal: its middle that of the usual range, one standard
/// deviation below it the low end.
Coordinate share(std::string name, double low, double high, double most) {
  const auto log_odds = [most](double value) { return std::log(value / (most - value)); };
  const double middle = log_odds(std::sqrt(low * high));
  return {.name = std::move(name),
          .scale = Scale::kShare,
          .centre = middle,
          .spread = std::max(middle - log_odds(low), 0.3),
          .max = most};
}

/// Prior of a mechanism's parameter: lognormal, one standard deviation either way covering the
/// usual range; the odds of a share; normal about 0 where the range is symmetric.
Coordinate prior_of(const MechanismParameter& parameter) {
  const std::string name(parameter.name);
  if (parameter.low < 0) return {.name = name, .spread = parameter.high / 1.5};
  constexpr double kSmallShare = 30;  // of a range that begins at 0
  const double low = parameter.low > 0 ? parameter.low : parameter.high / kSmallShare;
  if (parameter.is_share) return share(name, low, parameter.high, parameter.most);
  return positive(name, low, parameter.high);
}

/// No fit of a mechanism leaves what its numbers can be. Faults of instruments have no bounds.
void keep_within_bounds(Effect& effect) {
  for (const MechanismForm& form : mechanism_forms()) {
    if (form.id != effect.id || form.form != effect.form) continue;
    for (Coordinate& coordinate : effect.coordinates) {
      const auto parameter =
          std::ranges::find(form.parameters, coordinate.name, &MechanismParameter::name);
      if (parameter == form.parameters.end() || parameter->is_share) continue;
      coordinate.min = parameter->least;
      coordinate.max = parameter->most;
    }
  }
}

std::map<std::string, double> window(const Span& time_s) {
  return {{"from_s", time_s.low}, {"to_s", time_s.high}};
}

struct Columns {
  bool pass = false, speed = false, position = false, time = false, skid = false, driving = false,
       angle = false, lugs = true, part = false, difference = false, times_apart = false;
  double first_time_s = 0;
};

bool can_bear(const MechanismForm& form, const Columns& columns) {
  const std::string_view id = form.id;
  // Of a soil that differs the other soil is recorded: by a reference, or by other times.
  if (form.form == "for_a_time") return columns.times_apart && !columns.difference;
  if (form.form == "drifting") return columns.time && !columns.difference;
  if (id == "soil_change") return columns.difference;
  if (id == "multi_pass") return columns.pass;
  if (id == "rate_dependence") return columns.speed;
  if (id == "soil_zone") return columns.position;
  if (id == "cohesion_drift") return columns.time;
  if (id == "skid_branch") return columns.skid;
  if (id == "slip_sinkage") return columns.driving;
  // Of a wheel that only drives straight ahead it is slip_sinkage.
  if (id == "sliding_sinkage") return columns.angle || columns.skid;
  if (id == "grousers") return columns.lugs;
  const std::set<std::string_view> kSideways{
      "lateral_digging", "rut_asymmetry",    "shear_modulus_slip_angle", "coupled_shear",
      "side_pileup",     "max_stress_angle", "flank_friction",           "side_surcharge"};
  return columns.angle || !kSideways.contains(id);
}

class EffectList {
 public:
  EffectList(const TestBed& bed, const Columns& columns) : bed_(bed), columns_(columns) {}

  void add_mechanism(const MechanismForm& form) {
    Effect effect{.id = std::string(form.id), .form = std::string(form.form)};
    effect.slow = form.id == "coupled_shear" || form.id == "shear_hump" ||
                  form.id == "layered_soil" || form.id == "rut_asymmetry";
    for (const MechanismParameter& parameter : form.parameters) {
      const std::string name(parameter.name);
      if (const auto told = told_by_setup(name)) {
        effect.fixed[name] = *told;
      } else if (is_fixed(name)) {
        effect.fixed[name] = name == "ripple" || name == "t2_nms" ? 0 : parameter.typical;
      } else {
        effect.coordinates.push_back(prior_of(parameter));
      }
    }
    if (form.id == "shear_hump" && form.form == "wong") {
      // the hump's modulus is where the peak lies, some times the exponential's
      effect.own_modulus = true;
      effect.coordinates.push_back({.name = "modulus_factor",
                                    .scale = Scale::kLogarithmic,
                                    .centre = std::log(2.5),
                                    .spread = 0.5});
    }
    if (form.id == "soil_zone") {
      for (Coordinate& c : effect.coordinates) c.centre = 0;
      for (const auto& [from, to] : ZoneEdges(bed_).eighths()) {
        effect.fixed["from_m"] = from;
        effect.fixed["to_m"] = to;
        push(effect);
      }
    } else if (form.form == "for_a_time") {
      std::erase_if(effect.coordinates, [](const Coordinate& c) { return c.name.ends_with("_s"); });
      for (Coordinate& c : effect.coordinates) c.centre = 0;
      for (const Span& time_s : bed_.times_apart_s) {
        effect.fixed = window(time_s);
        push(effect);
      }
    } else if (form.id == "slope_tilt") {
      // along x and y apart: the heading of a test bed's wheel is not recorded
      effect.coordinates = {Coordinate{.name = "tilt_rad", .spread = 0.06}};
      for (const double direction : {0.0, 1.5707963267948966}) {
        effect.fixed["direction_rad"] = direction;
        push(effect);
      }
    } else if (form.form == "drifting") {
      const Span time = span_of(bed_, [](const auto& at) { return at.conditions.time_s; });
      effect.coordinates = {
          Coordinate{.name = "per_s", .spread = 0.1 / (time.high - columns_.first_time_s)}};
      effect.fixed["first_time_s"] = columns_.first_time_s;
      push(effect);
    } else if (form.id == "cohesion_drift") {
      const Span time = span_of(bed_, [](const auto& at) { return at.conditions.time_s; });
      const double lasts_s = time.high - columns_.first_time_s;
      effect.coordinates = form.form == "linear"
                               ? std::vector{Coordinate{.name = "per_s", .spread = 0.5 / lasts_s}}
                               : std::vector{effect.coordinates.front(),
                                             positive("tau_s", 0.1 * lasts_s, 2 * lasts_s)};
      effect.fixed["first_time_s"] = columns_.first_time_s;
      push(effect);
    } else if (form.id == "flexible_wheel") {
      effect.coordinates = {positive("per_n", 0.02 / largest_load_n(), 0.3 / largest_load_n())};
      push(effect);
    } else if (form.id == "load_transfer") {
      for (Coordinate& c : effect.coordinates) {
        if (c.name == "added_n") c.spread = 0.1 * largest_load_n();
      }
      push(effect);
    } else {
      push(effect);
    }
  }

  void add_instruments() {
    for (std::size_t c = 0; c < bed_.channels.size(); ++c) {
      const double rms = signal(c);
      push({.id = "sensor_bias",
            .form = std::string(name(bed_.channels[c].channel)),
            .kind = EffectKind::kBias,
            .coordinates = {bias_of(c)},
            .to = c});
      push({.id = "sensor_gain",
            .form = std::string(name(bed_.channels[c].channel)),
            .kind = EffectKind::kGain,
            .coordinates = {gain()},
            .to = c});
      add_changing("sensor_bias", {c});
      add_changing("sensor_gain", {c});
      for (std::size_t k = 0; k < bed_.channels.size(); ++k) {
        if (k == c || !crosses(bed_.channels[c].channel) || !crosses(bed_.channels[k].channel)) {
          continue;
        }
        push({.id = "sensor_crosstalk",
              .form = std::string(name(bed_.channels[k].channel)) + " into " +
                      std::string(name(bed_.channels[c].channel)),
              .kind = EffectKind::kCrosstalk,
              .coordinates = {{.name = "share",
                               .spread = 0.08 * std::min(arm(c) / arm(k), rms / signal(k)) +
                                         0.02 * rms / signal(k)}},
              .to = c,
              .from = k});
      }
    }
    // One transducer measures both forces.
    std::vector<std::size_t> forces;
    for (const Channel channel : {Channel::kFx, Channel::kFy}) {
      if (const auto c = index_of(channel)) forces.push_back(*c);
    }
    if (forces.size() < 2) return;
    add_changing("sensor_gain", forces);
    push({.id = "sensor_crosstalk",
          .form = "turned about z",
          .kind = EffectKind::kTurn,
          .coordinates = {{.name = "turn_rad", .spread = 0.1}},
          .to = forces[0],
          .from = forces[1]});
  }

  std::vector<Effect> take() { return std::move(effects_); }

 private:
  double largest_load_n() const {
    return span_of(bed_, [](const auto& at) { return at.load_n; }).high;
  }

  /// By what a force at the wheel's rim is multiplied in a channel: the radius for a torque.
  double arm(std::size_t c) const {
    return bed_.channels[c].channel == Channel::kTorque ? bed_.setup.wheel.radius_m : 1;
  }

  std::optional<std::size_t> index_of(Channel channel) const {
    for (std::size_t c = 0; c < bed_.channels.size(); ++c) {
      if (bed_.channels[c].channel == channel) return c;
    }
    return std::nullopt;
  }

  /// A zero lies off by a share of what the sensor is made for: the largest load, its moment about
  /// the axle, a sinkage of half the radius. What is measured would say too little: the bias is in
  /// it.
  Coordinate bias_of(std::size_t c) const {
    const Channel channel = bed_.channels[c].channel;
    const bool of_load =
        channel == Channel::kFx || channel == Channel::kFy || channel == Channel::kTorque;
    const double full_scale = of_load ? largest_load_n() * arm(c) : bed_.setup.wheel.radius_m / 2;
    return {.name = "bias", .spread = std::max(0.1 * full_scale, 3 * bed_.channels[c].scale)};
  }

  /// Wide enough for a bridge or an amplifier on another range.
  static Coordinate gain() { return {.name = "gain", .spread = 0.2}; }

  static bool crosses(Channel channel) {
    return channel == Channel::kFx || channel == Channel::kFy || channel == Channel::kTorque;
  }

  /// What the recording cannot tell: at all, without a column, or without a reference whose wheel
  /// has no lugs.
  bool is_fixed(std::string_view parameter) const {
    const std::set<std::string_view> kNever{"lugs",   "v0_mps", "ripple",
                                            "from_m", "to_m",   "direction_rad"};
    const std::set<std::string_view> kByReference{"digging", "grip", "held"};
    if (parameter == "t2_nms") return !columns_.speed;
    return kNever.contains(parameter) || (kByReference.contains(parameter) && !columns_.difference);
  }

  std::optional<double> told_by_setup(const std::string& parameter) const {
    const DiagnosisSetup& setup = bed_.setup;
    if (parameter == "lug_height_m") return setup.lug_height_m;
    if (parameter == "lugs" && setup.lug_count) return *setup.lug_count;
    return std::nullopt;
  }

  /// A bias or gain of these channels that settles, drifts or is there in the time apart, where the
  /// recording tells the time.
  void add_changing(const std::string& id, const std::vector<std::size_t>& channels) {
    if (!columns_.time || columns_.difference) return;
    const Span time = span_of(bed_, [](const auto& at) { return at.conditions.time_s; });
    const bool bias = id == "sensor_bias";
    Effect effect{.id = id,
                  .kind = bias ? EffectKind::kBias : EffectKind::kGain,
                  .coordinates = {bias ? bias_of(channels.front()) : gain()},
                  .fixed = {{"first_time_s", time.low}, {"last_time_s", time.high}},
                  .to = channels.front(),
                  .also = {channels.begin() + 1, channels.end()}};
    std::string names;
    for (const std::size_t c : channels) names += " " + std::string(name(bed_.channels[c].channel));
    for (const Span& time_s : bed_.times_apart_s) {
      Effect for_a_time = effect;
      for_a_time.form = "for_a_time" + names;
      for_a_time.course = FaultCourse::kForATime;
      for_a_time.fixed = window(time_s);
      push(for_a_time);
    }
    effect.form = "drifting" + names;
    effect.course = FaultCourse::kDrifting;
    push(effect);
    effect.form = "settling" + names;
    effect.course = FaultCourse::kSettling;
    effect.coordinates.push_back(positive("settling_time_s", 0.05 * time.width(), time.width()));
    // Without a fault, the time in which it settles would change nothing.
    effect.start = {0.5, 0};
    effects_.push_back(effect);
  }

  double signal(std::size_t c) const {
    const Eigen::VectorXd& y = bed_.channels[c].mean;
    return std::sqrt(y.squaredNorm() / static_cast<double>(y.size())) + bed_.channels[c].scale;
  }

  void push(Effect effect) {
    keep_within_bounds(effect);
    effect.start.assign(effect.coordinates.size(), 0.0);
    effects_.push_back(std::move(effect));
  }

  const TestBed& bed_;
  Columns columns_;
  std::vector<Effect> effects_;
};

/// When a course of time begins: at the first run, wherever the clock stood then. Conditions stand
/// at the mean of their replicates' times, and those of a reference may be earlier.
double first_time_s(const TestBed& bed, const Recording& recording) {
  double first = span_of(bed, [](const auto& at) { return at.conditions.time_s; }).low;
  for (const WheelRun& run : recording.runs) first = std::min(first, run.conditions.time_s);
  return first;
}

}  // namespace

std::vector<Effect> effects_for(const TestBed& bed, const Recording& recording, EffectsOf of) {
  const auto varied = [&](const auto& column) { return span_of(bed, column).width() > 0; };
  const Span slip = span_of(bed, [](const Condition& at) { return at.slip_ratio; });
  const Span angle = span_of(bed, [](const Condition& at) { return std::abs(at.slip_angle_rad); });
  const Columns columns{
      .pass = recording.columns.pass && varied([](const auto& at) { return at.conditions.pass; }),
      .speed =
          recording.columns.speed && varied([](const auto& at) { return at.conditions.speed_mps; }),
      .position = recording.columns.position &&
                  varied([](const auto& at) { return at.conditions.position_m; }),
      .time = varied([](const auto& at) { return at.conditions.time_s; }),
      .skid = slip.low<-0.03, .driving = slip.high> 0.03,
      .angle = angle.high > 0.03,
      .lugs = bed.setup.lug_height_m.value_or(1) > 0,
      .part = of != EffectsOf::kRecording,
      .difference = of == EffectsOf::kDifference,
      .times_apart = !bed.times_apart_s.empty(),
      .first_time_s = first_time_s(bed, recording)};
  EffectList list(bed, columns);
  for (const MechanismForm& form : mechanism_forms()) {
    if (form.form == "carried_soil" && !columns.part) continue;
    if (can_bear(form, columns)) list.add_mechanism(form);
  }
  list.add_instruments();
  return list.take();
}

}  // namespace regoplan
