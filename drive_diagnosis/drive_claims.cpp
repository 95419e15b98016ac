#include "drive_diagnosis/drive_claims.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "drive_diagnosis/comparison/soil_deviation.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr double kTwoSided95 = 1.96;  ///< standard deviations of a normal number

/// An angle of the attitude sensor, and how it goes with the ground's.
struct Axis {
  const char* name;
  const std::optional<DriveEstimate> Mounting::*of;
  const double Mounting::*slope;
  const double Mounting::*scatter_rad;
  const double Mounting::*ground_scatter_rad;
  const DriveEstimate& prior;
};

/// What is to be told of an angle that hardly follows the ground. In another unit, or stuck, it
/// hardly changes at all; one that changes as the ground does is off another ground.
DriveFinding off_ground_finding(const Axis& axis, const Mounting& day) {
  constexpr double kHardlyChanges = 0.25;  // of the ground
  const double scatter_rad = day.*axis.scatter_rad, ground_rad = day.*axis.ground_scatter_rad;
  const std::string_view when = day.day.empty() ? "not said" : std::string_view(day.day);
  const double slope = day.*axis.slope;
  if (scatter_rad < kHardlyChanges * ground_rad) {
    return {.id = "unit",
            .drive = "",
            .text = fmt::format("{} rises {:.0f} times less than the ground (day {}): radians in a "
                                "column of degrees, or a sensor that stands still?",
                                axis.name, 1 / std::max(std::abs(slope), 1e-3), when),
            .value = slope};
  }
  return {.id = "other_ground",
          .drive = "",
          .text = fmt::format(
              "{} changes by {:.1f} deg where the map's ground does by {:.1f}, but not with it "
              "(day {}): the map's slopes are not those of the ground that was driven, as where "
              "positions lie off or the map smooths what wheels stand on; no claim of how the "
              "sensor sits in {} counts this day, of which only the middle of readings less the "
              "map's is told",
              axis.name, scatter_rad / kDegree, ground_rad / kDegree, when, axis.name),
          .value = slope};
}

/// Where on the map a zone lies that a drive went through.
DriveMismatch mismatch_of(const DriveDiagnosis& result, const std::vector<DriveRecording>& drives,
                          const VehicleFinding& finding) {
  const SoilZoneFound& zone = *finding.zone;
  std::array<double, 2> x_m{1e18, -1e18}, y_m{1e18, -1e18};
  for (std::size_t i = zone.first; i <= zone.last; ++i) {
    const DriveWindow& window = result.windows[i];
    x_m = {std::min(x_m[0], window.x_m), std::max(x_m[1], window.x_m)};
    y_m = {std::min(y_m[0], window.y_m), std::max(y_m[1], window.y_m)};
  }
  return {
      .channel = "soil",
      .where = fmt::format("drive {}, {:.1f} s ({:.1f} to {:.1f}) to {:.1f} s ({:.1f} to {:.1f})",
                           drives[zone.drive].drive_id, zone.starts_s, zone.start_s[0],
                           zone.start_s[1], zone.ends_s, zone.end_s[0], zone.end_s[1]),
      .region = {{"x_m", x_m},
                 {"y_m", y_m},
                 {"time_s", {zone.starts_s, zone.ends_s}},
                 {"start_s", zone.start_s},
                 {"end_s", zone.end_s}},
      .effect = finding.size,
      .ci95 = {finding.size - kTwoSided95 * finding.std, finding.size + kTwoSided95 * finding.std},
      .p_value = chance_of(finding)};
}

std::string resistance_text(const VehicleFinding& finding) {
  const DriveEstimate& resistance = finding.zone->resistance;
  const double low = 100 * (resistance.value - kTwoSided95 * resistance.std);
  const double high = 100 * (resistance.value + kTwoSided95 * resistance.std);
  const bool open = low < 0 && high > 0;
  return fmt::format("{} {:.1f} % of its load {} to roll there (95 %: {:.1f} to {:.1f}{})",
                     open ? "a wheel may take" : "a wheel takes", 100 * std::abs(resistance.value),
                     resistance.value < 0 ? "less" : "more", low, high,
                     open ? ", so that by this number alone it may be none" : "");
}

std::string zone_text(const VehicleFinding& finding, const TerrainMap& map,
                      const std::string& where) {
  const SoilZoneFound& zone = *finding.zone;
  const std::vector<MapSoil>& soils = map.soils();
  const std::string& said = soils[static_cast<std::size_t>(zone.soil)].name;
  const std::string what =
      zone.like ? fmt::format("{} in place of", soils[static_cast<std::size_t>(*zone.like)].name)
                : "other soil than";
  // Whether it is there is told by all channels together, how far by one number of its soil.
  return fmt::format(
      "{} {} in {}: by chance alone {} would show as much; of the soil that is there, {}", what,
      said, where, chance_text(finding), resistance_text(finding));
}

std::string size_text(const std::string& parameter, const DriveEstimate& size) {
  return fmt::format("{} = {:.3g} (95 %: {:.3g} to {:.3g})", parameter, size.value,
                     size.value - kTwoSided95 * size.std, size.value + kTwoSided95 * size.std);
}

/// Other numbers of the vehicle that these drives hardly tell from the one that is claimed.
std::string instead_text(const VehicleFinding& finding) {
  std::vector<std::string> numbers;
  for (const FaultEstimate& other : finding.instead) {
    const std::string id = other.id == finding.id ? "" : other.id + ", ";
    numbers.push_back(id + size_text(other.parameter, other.size));
  }
  if (numbers.empty()) return "";
  return fmt::format("; hardly told from {}", fmt::join(numbers, " or from "));
}

/// A wheel that follows another law is nothing to mend at the vehicle.
std::string_view law_text(const VehicleFinding& finding) {
  if (std::ranges::find(finding.equivalent, "wheel_law") == finding.equivalent.end()) return "";
  return "; wheel_law is wheel physics that the model lacks and no fault of the vehicle: nothing "
         "of it is handed back";
}

}  // namespace

double chance_of(const VehicleFinding& finding) {
  // Beyond what one contest in a thousand gains, gains fall off as exp(-gain / 2).
  return 1e-3 * std::exp((finding.chance - finding.gain) / 2);
}

std::string chance_text(const VehicleFinding& finding) {
  constexpr double kRarest = 1e-6;
  const double chance = chance_of(finding);
  if (chance < kRarest) return "fewer than one of a million drives";
  const double digit = std::pow(10, std::floor(-std::log10(chance)));
  return fmt::format("one of {:.0f} drives", digit * std::floor(1 / chance / digit));
}

std::string fault_text(const VehicleFinding& finding) {
  return fmt::format("{}, {:.1f} standard deviations from nothing",
                     size_text(finding.parameter, {finding.size, finding.std}), finding.sigmas);
}

void judge_mounting(const DriveSetup& setup, DriveDiagnosis& result) {
  const std::array<Axis, 2> axes{
      {{"pitch", &Mounting::pitch_rad, &Mounting::pitch_slope, &Mounting::pitch_scatter_rad,
        &Mounting::pitch_ground_scatter_rad, setup.mounting_pitch_rad},
       {"roll", &Mounting::roll_rad, &Mounting::roll_slope, &Mounting::roll_scatter_rad,
        &Mounting::roll_ground_scatter_rad, setup.mounting_roll_rad}}};
  // Radians in a column of degrees rise by .017 of what the ground does.
  constexpr double kHardlyFollows = 0.1;
  DriveClaim claim{.id = "attitude_mounting", .equivalent = {"attitude_mounting"}};
  for (const Axis& axis : axes) {
    double sum = 0, weights = 0;
    for (const Mounting& day : result.mountings) {
      if (day.*axis.slope < -0.5) {
        result.findings.push_back(
            {.id = "sign",
             .drive = "",
             .text = fmt::format("{} falls where the ground rises (day {}): its sign is wrong, or "
                                 "the sensor looks backward",
                                 axis.name, day.day.empty() ? "not said" : day.day),
             .value = day.*axis.slope});
      } else if (std::abs(day.*axis.slope) < kHardlyFollows) {
        result.findings.push_back(off_ground_finding(axis, day));
        continue;  // no ground for a claim of how the sensor sits
      }
      const std::optional<DriveEstimate>& estimate = day.*axis.of;
      if (!estimate) continue;
      const double weight = 1 / std::max(estimate->std * estimate->std, 1e-8);
      sum += weight * estimate->value;
      weights += weight;
    }
    if (weights == 0) continue;
    const DriveEstimate mean{sum / weights, 1 / std::sqrt(weights)};
    constexpr double kSigmas = 4.5, kMapErr_rad = 0.5 * kDegree;
    const double sigmas = std::abs(mean.value - axis.prior.value) /
                          std::hypot(mean.std, std::hypot(axis.prior.std, kMapErr_rad));
    if (sigmas < kSigmas) continue;
    claim.sigmas = std::max(claim.sigmas, sigmas);
    claim.parameters[fmt::format("{}_deg", axis.name)] = {mean.value / kDegree, mean.std / kDegree};
    claim.channels.push_back(fmt::format("{}_deg", axis.name));
  }
  if (claim.parameters.empty()) return;
  claim.text = "the attitude sensor does not sit as it is said to: its readings less the ground's";
  for (const auto& [name, angle] : claim.parameters) {
    claim.text +=
        fmt::format("{} {} {:.2f} deg", name == claim.parameters.begin()->first ? "," : " and",
                    name.substr(0, name.size() - std::string_view("_deg").size()), angle.value);
  }
  result.claims.push_back(std::move(claim));
}

std::string no_better_text(const HeldOutCurrents& held_out) {
  return fmt::format(
      "the model of the currents is off by {:.2f} A RMS, each {} held out, a constant by {:.2f} A: "
      "it does no better beyond chance",
      held_out.both_rms_a, held_out.held_out, held_out.both_constant_rms_a);
}

void judge_currents(DriveDiagnosis& result) {
  const CurrentDiagnosis& currents = *result.currents;
  if (!currents.held_out.beats_constant) {
    result.findings.push_back(
        {.id = "currents_not_predicted",
         .drive = "",
         .text = "nothing is concluded from the currents: " + no_better_text(currents.held_out)});
  }
  if (!currents.side_drag) return;
  const bool left = currents.left_excess_a.value > 0;
  const double sign = left ? 1 : -1;
  std::array<double, 2> interval{sign * currents.left_excess_ci95_a[0],
                                 sign * currents.left_excess_ci95_a[1]};
  std::ranges::sort(interval);
  result.claims.push_back(
      {.id = "side_drag",
       .parameters = {{"excess_a",
                       {sign * currents.left_excess_a.value, currents.left_excess_a.std}}},
       .equivalent = currents.equivalent,
       .channels = {"current_left_a", "current_right_a"},
       .sigmas = std::abs(currents.left_excess_a.value) / currents.left_excess_a.std,
       .text = fmt::format("the {} side takes {:.1f} A ({:.1f} to {:.1f}) more than the other "
                           "straight ahead on the level",
                           left ? "left" : "right", sign * currents.left_excess_a.value,
                           interval[0], interval[1])});
  result.where.push_back({.channel = left ? "current_left_a" : "current_right_a",
                          .where = "straight ahead on the level, all days",
                          .effect = sign * currents.left_excess_a.value,
                          .ci95 = interval,
                          .p_value = std::erfc(result.claims.back().sigmas / std::sqrt(2.0))});
}

void claim_effects(const DriveSetup& setup, const std::vector<DriveRecording>& drives,
                   DriveDiagnosis& result) {
  const VehicleEffects& effects = *result.effects;
  for (const VehicleFinding& finding : effects.found) {
    DriveClaim claim{.id = finding.id,
                     .parameters = {{finding.parameter, {finding.size, finding.std}}},
                     .equivalent = finding.equivalent,
                     .instead = finding.instead,
                     .channels = effects.channels,
                     .sigmas = finding.sigmas};
    claim.text =
        fmt::format("{}{}{}", fault_text(finding), instead_text(finding), law_text(finding));
    if (finding.zone) {
      if (finding.zone->at_border &&
          std::ranges::find(claim.equivalent, "zone_border") == claim.equivalent.end()) {
        claim.equivalent.emplace_back("zone_border");
      }
      DriveMismatch where = mismatch_of(result, drives, finding);
      claim.text = zone_text(finding, setup.map, where.where);
      result.where.push_back(std::move(where));
    }
    result.claims.push_back(std::move(claim));
  }
}

void claim_soils(const DriveSetup& setup, DriveDiagnosis& result) {
  // As of the soil of a single wheel: within it is no finding.
  constexpr double kPulled = 4.5, kTold = 3;
  for (const SoilFitted& fitted : result.effects->soils_fitted) {
    const MapSoil& said = setup.map.soils()[fitted.soil];
    const SoilNumbers pulls = deviations_between(said.soil, fitted.estimate.mean);
    DriveClaim claim{
        .id = "soil_change", .equivalent = {"soil_change"}, .channels = result.effects->channels};
    std::vector<std::string> numbers;
    for (std::size_t k = 0; k < kSoilNumbers; ++k) {
      const double pull = std::abs(pulls.at(k));
      if (pull < kTold) continue;
      const SoilParameter& number = soil_parameters().at(k);
      const auto in_file = [&number](const Soil& of) {
        return of.*number.member / number.file_unit;
      };
      const DriveEstimate estimate{in_file(fitted.estimate.mean),
                                   in_file(fitted.estimate.standard_deviation)};
      claim.parameters[fmt::format("{}.{}", said.name, number.name)] = estimate;
      claim.sigmas = std::max(claim.sigmas, pull);
      numbers.push_back(fmt::format(
          "{} {:.3g} +- {:.2g} where the map says {:.3g} +- {:.2g}", number.name, estimate.value,
          estimate.std, in_file(said.soil.mean), in_file(said.soil.standard_deviation)));
    }
    if (claim.sigmas < kPulled || !fitted.is_handed_back()) continue;
    claim.text = fmt::format(
        "{} is another soil than the map says wherever it was driven on: {} ({:.1f} standard "
        "deviations of the map's); stretches held out are likelier with it by {:.0f} nats; wheel "
        "physics that the model lacks may look so too",
        said.name, fmt::join(numbers, ", "), claim.sigmas, fitted.held_out_nats);
    result.claims.push_back(std::move(claim));
  }
}

std::optional<DriveFinding> slopes_finding(const VehicleEffects& effects) {
  // Rough ground and maps of coarse cells stay below.
  constexpr double kFar_rad = 2 * kDegree;
  const double along_rad = std::atan(effects.slope_errors[0]);
  const double across_rad = std::atan(effects.slope_errors[1]);
  const double most_rad = std::max(along_rad, across_rad);
  if (most_rad < kFar_rad) return std::nullopt;
  return DriveFinding{
      .id = "map_slopes",
      .drive = "",
      .text =
          fmt::format("the ground's slopes are {:.1f} deg off the map's along the way and {:.1f} "
                      "deg across it, root mean square: the map is not of the ground that was "
                      "driven, or positions lie off; it is handed back as it was",
                      along_rad / kDegree, across_rad / kDegree),
      .value = most_rad / kDegree,
      .unit = "deg"};
}

namespace {

/// Why a size cannot be.
std::string_view impossible_text(const VehicleFinding& unnamed) {
  if (unnamed.id == "cg_offset") {
    return "no vehicle stands with its centre of gravity beside its wheels or below the ground";
  }
  if (unnamed.parameter.ends_with("_share")) return "nothing loses more than all of it";
  return "nothing drags by less than nothing";
}

}  // namespace

DriveFinding unnamed_finding(const VehicleFinding& unnamed) {
  return {
      .id = "no_name",
      .drive = "",
      .text = fmt::format(
          "something stands out that has no name: it would be {} of {}, and {}; a sensor of torque "
          "that reads less than there is may look so, or a part that sits askew",
          unnamed.id, size_text(unnamed.parameter, {unnamed.size, unnamed.std}),
          impossible_text(unnamed)),
      .value = unnamed.size};
}

DriveFinding zone_within_law_finding(const VehicleFinding& zone,
                                     const std::vector<DriveRecording>& drives) {
  return {.id = "zone_within_law",
          .drive = drives[zone.zone->drive].drive_id,
          .text = fmt::format(
              "from {:.1f} to {:.1f} s {}; the wheel law that is claimed does as much to a wheel "
              "that bears a quarter more than the others: no zone of other soil is claimed",
              zone.zone->starts_s, zone.zone->ends_s, resistance_text(zone)),
          .value = zone.size};
}

std::string withheld_text(const SoilFitted& fitted, const MapSoil& said) {
  return fmt::format(
      "{} stays as the map has it: its numbers, fitted to the rest of what was driven on it, make "
      "the stretches that were held out no likelier than the map's do ({:.2g} times as likely)",
      said.name, std::exp(fitted.held_out_nats));
}

}  // namespace regoplan
