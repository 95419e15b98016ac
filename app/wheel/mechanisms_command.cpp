#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/command/command.h"
#include "app/command/plan_options.h"
#include "app/settings/model_settings.h"
#include "app/wheel/other_names.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/nearest_name.h"
#include "terramech/mechanisms/mechanism.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;

struct MechanismsOptions {
  std::optional<std::string> id;
  std::optional<std::string> model;
  bool json = false;
  bool quiet = false;
};

constexpr std::array kSlips{-0.6, -0.3, 0.0, 0.2, 0.4, 0.6, 0.8};
constexpr double kSlipAngle_rad = 15 * kDegree;
constexpr double kLoad_n = 60;

/// The wheel and dry sand that the pictures are made with.
WheelModelSpec pictured() {
  return {.wheel = {.radius_m = 0.09, .width_m = 0.1},
          .soil = {.cohesion_pa = 300,
                   .friction_angle_rad = 30 * kDegree,
                   .kc = 0,
                   .kphi = 9e5,
                   .n = 1.1,
                   .a0 = 0.4,
                   .a1 = 0.15,
                   .lambda = 0.3,
                   .density_kgpm3 = 1500,
                   .kx0_m = 0.012,
                   .ky0_m = 0.012},
          .gravity_mps2 = 9.80665};
}

/// Second pass, fast, late, in the zone: where mechanisms of circumstances act.
constexpr WheelConditions kWhereMechanismsAct{
    .pass = 2, .speed_mps = 0.2, .position_m = 0.5, .time_s = 3e4, .heading_rad = 0};

struct Change {
  double fx = 0, fy = 0, torque = 0;  // over the load, and load times radius
  double sinkage = 0;                 // over the base model's
};

/// At the slips of kSlips; nothing where the wheel has no forces.
std::vector<std::optional<Change>> changes_of(const MechanismForm& form) {
  WheelModelSpec spec = pictured();
  const WheelModel base(spec);
  spec.mechanisms = {{std::string(form.id), std::string(form.form), {}}};
  // A changed soil is not changed by default: it is shown at the low ends of its ranges.
  for (const MechanismParameter& parameter : form.parameters) {
    if (form.id == "soil_change" && form.form != "for_a_time") {
      spec.mechanisms[0].parameters[std::string(parameter.name)] = parameter.low;
    }
  }
  const WheelModel with(spec);
  std::vector<std::optional<Change>> changes;
  for (const double slip : kSlips) {
    const WheelMotion motion = motion_at(slip, kSlipAngle_rad);
    const WheelForces a = base.forces(kLoad_n, motion);
    const WheelForces b = with.channels(kLoad_n, motion, kWhereMechanismsAct).forces;
    if (!has_forces(a.status) || !has_forces(b.status)) {
      changes.emplace_back();
      continue;
    }
    changes.push_back(Change{.fx = (b.fx_n - a.fx_n) / kLoad_n,
                             .fy = (b.fy_n - a.fy_n) / kLoad_n,
                             .torque = (b.torque_nm - a.torque_nm) / (kLoad_n * 0.09),
                             .sinkage = (b.sinkage_m - a.sinkage_m) / a.sinkage_m});
  }
  return changes;
}

/// One character a slip: much less, less, alike, more, much more.
std::string picture(const std::vector<std::optional<Change>>& changes, double Change::*channel) {
  constexpr double kSmall = 0.005, kLarge = 0.05;
  std::string text;
  for (const auto& change : changes) {
    if (!change) {
      text += 'x';
      continue;
    }
    const double by = (*change).*channel;
    const bool large = std::abs(by) > kLarge;
    if (std::abs(by) < kSmall) {
      text += '.';
    } else if (by > 0) {
      text += large ? '#' : '+';
    } else {
      text += large ? '=' : '-';
    }
  }
  return text;
}

/// The unit that a parameter's name ends in.
std::string unit_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 13> kEndings{{
      {"kx1_m", "m/rad"},
      {"ky1_m", "m/rad"},
      {"_per_rad", "1/rad"},
      {"per_n", "1/N"},
      {"per_s", "1/s"},
      {"_mps", "m/s"},
      {"_nms", "N m s"},
      {"_nm", "N m"},
      {"_pa", "Pa"},
      {"_rad", "rad"},
      {"_m", "m"},
      {"_n", "N"},
      {"_s", "s"},
  }};
  for (const auto& [ending, unit] : kEndings) {
    if (name.ends_with(ending)) return std::string(unit);
  }
  return "";
}

Json form_json(const MechanismForm& form) {
  Json parameters = Json::array();
  for (const MechanismParameter& p : form.parameters) {
    parameters.push_back({{"name", p.name},
                          {"unit", unit_of(p.name)},
                          {"usual_range", {p.low, p.high}},
                          {"allowed_range", {p.least, p.most}},
                          {"default", p.typical}});
  }
  const auto changes = changes_of(form);
  const auto channel = [&](double Change::*member) {
    Json values = Json::array();
    for (const auto& change : changes) {
      values.push_back(change ? Json((*change).*member) : Json(nullptr));
    }
    return values;
  };
  return {{"id", form.id},
          {"form", form.form},
          {"formula", form.formula},
          {"source", form.source},
          {"parameters", parameters},
          {"effect",
           {{"slip_ratio", kSlips},
            {"slip_angle_deg", 15},
            {"fx_over_load", channel(&Change::fx)},
            {"fy_over_load", channel(&Change::fy)},
            {"torque_over_load_radius", channel(&Change::torque)},
            {"sinkage_share", channel(&Change::sinkage)}}}};
}

std::string form_text(const MechanismForm& form) {
  std::string text =
      fmt::format("  {}: {}\n    source: {}\n", form.form, form.formula, form.source);
  for (const MechanismParameter& p : form.parameters) {
    const std::string unit = unit_of(p.name);
    text += fmt::format("    {:<14} {:.3g} to {:.3g}{}{}, default {:.3g}, at all {:g} to {:g}\n",
                        p.name, p.low, p.high, unit.empty() ? "" : " ", unit, p.typical, p.least,
                        p.most);
  }
  const auto changes = changes_of(form);
  return text + fmt::format("    Fx {}  Fy {}  torque {}  sinkage {}\n",
                            picture(changes, &Change::fx), picture(changes, &Change::fy),
                            picture(changes, &Change::torque), picture(changes, &Change::sinkage));
}

/// What a model file says of its mechanisms, and what it leaves to defaults.
/// \throws InputError where it names a mechanism, form or parameter that is not known
ExitStatus check_model(const std::string& file) {
  const ModelSettings settings = read_model_file(file);
  const std::optional<GenericCorrection>& unnamed = settings.spec.generic;
  if (settings.spec.mechanisms.empty()) {
    fmt::print("{}: the base model, no mechanism{}\n", file, unnamed ? " with a name" : "");
  }
  for (const Mechanism& mechanism : settings.spec.mechanisms) {
    const MechanismForm& form = form_of(mechanism);
    fmt::print("{}: {} {}\n", file, form.id, form.form);
    for (const MechanismParameter& p : form.parameters) {
      const auto given = mechanism.parameters.find(std::string(p.name));
      if (given == mechanism.parameters.end()) {
        fmt::print("  {} = {:.3g} (default)\n", p.name, p.typical);
      } else {
        const bool usual = given->second >= p.low && given->second <= p.high;
        fmt::print("  {} = {:.3g}{}\n", p.name, given->second,
                   usual ? "" : fmt::format(" (usual: {:.3g} to {:.3g})", p.low, p.high));
      }
    }
  }
  if (unnamed) {
    fmt::print(
        "{}: a correction without a name (generic), {} bumps\n"
        "  slip ratio {:.3g} to {:.3g}, slip angle to either side {:.3g} to {:.3g} deg, load "
        "{:.3g} to {:.3g} N; elsewhere the wheel is `outside_correction`\n",
        file, unnamed->nodes.size(), unnamed->slip_ratio_region[0], unnamed->slip_ratio_region[1],
        degrees(unnamed->slip_angle_rad_region[0]), degrees(unnamed->slip_angle_rad_region[1]),
        unnamed->load_n_region[0], unnamed->load_n_region[1]);
  }
  return kYes;
}

Json other_json(const OtherName& other) {
  Json numbers = Json::array();
  for (const NamedNumber& number : other.numbers) {
    numbers.push_back({{"name", number.name}, {"unit", number.unit}});
  }
  return {{"id", other.id},
          {"of", other.of},
          {"what", other.what},
          {"columns", other.columns},
          {"parameters", numbers}};
}

std::string other_text(const OtherName& other) {
  std::string text =
      fmt::format("{}\n  no mechanism of a wheel; {} of {}\n  {}\n", other.id,
                  other.numbers.empty() ? "a word" : "a fault", other.of, other.what);
  if (!other.columns.empty()) text += fmt::format("  columns: {}\n", other.columns);
  for (const NamedNumber& number : other.numbers) {
    text += fmt::format("    {:<14} {}\n", number.name,
                        number.unit.empty() ? "a share" : "unit: " + std::string(number.unit));
  }
  return text;
}

ExitStatus tell_other(const OtherName& other, bool json) {
  fmt::print("{}", json ? Json::array({other_json(other)}).dump(2) + "\n" : other_text(other));
  return kYes;
}

std::string ids_of_others() {
  std::string ids;
  for (const OtherName& other : other_names())
    ids += (ids.empty() ? "" : ", ") + std::string(other.id);
  return ids;
}

/// \throws InputError with the id that is likely meant, or all that are known
[[noreturn]] void refuse(const std::string& id) {
  if (id.empty()) throw InputError("ID: empty, names no mechanism");
  std::vector<std::string> ids = mechanism_ids();
  for (const OtherName& other : other_names()) {
    // Whoever misspells a mechanism does not mean that nothing is missing.
    if (other.id != "none") ids.emplace_back(other.id);
  }
  throw InputError(fmt::format("mechanism id: {} is not known ({})", id, name_hint(id, ids)));
}

ExitStatus run_mechanisms(const MechanismsOptions& options) {
  if (options.model) return check_model(*options.model);
  const bool tells_all = !options.id;
  if (options.id) {
    if (const OtherName* other = other_name(*options.id)) return tell_other(*other, options.json);
  }
  Json all = Json::array();
  std::string text, last;
  for (const MechanismForm& form : mechanism_forms()) {
    if (!tells_all && form.id != *options.id) continue;
    if (options.json) {
      all.push_back(form_json(form));
      continue;
    }
    if (last != form.id) text += fmt::format("{}{}\n", text.empty() ? "" : "\n", form.id);
    last = form.id;
    text += form_text(form);
  }
  if (all.empty() && text.empty()) refuse(*options.id);
  if (options.json) {
    // Who reads the whole vocabulary finds every id that diagnosis.json may hold.
    for (const OtherName& other : other_names()) {
      if (tells_all) all.push_back(other_json(other));
    }
    fmt::print("{}\n", all.dump(2));
    return kYes;
  }
  fmt::print("{}", text);
  if (!options.quiet && tells_all) {
    fmt::print("\nBeside these, no physics of a wheel (regoplan mechanisms ID tells what): {}\n",
               ids_of_others());
  }
  if (!options.quiet) {
    fmt::print(
        "\nPictures: change at slip -0.6 -0.3 0 0.2 0.4 0.6 0.8, slip angle 15 deg, at the "
        "defaults (soil_change:\nthe low ends of its ranges), on dry sand (second pass, 0.2 m/s, "
        "8 h, inside a zone); forces over the\nload, sinkage over its own: # above +5 %, + above "
        "+0.5 %, . less, - below -0.5 %, = below -5 %,\nx no equilibrium.\n");
  }
  return kYes;
}

}  // namespace

Command add_mechanisms_command(CLI::App& program) {
  const auto options = std::make_shared<MechanismsOptions>();
  CLI::App* parser = program.add_subcommand(
      "mechanisms",
      "The vocabulary of diagnose: every mechanism with its forms, parameters (unit, usual range,\n"
      "default, what they can be at all), source, and a small picture of what it does to Fx, Fy, "
      "torque and sinkage.");
  CLI::Option* id = parser->add_option(
      "ID", options->id,
      "one only; faults of instruments and vehicles that diagnose names as well");
  parser
      ->add_option("--model", options->model,
                   "instead: the mechanisms of a model file, and what it leaves to defaults")
      ->type_name("FILE.yaml")
      ->excludes(id);
  add_output_flags(*parser, options->json, options->quiet);
  parser->get_option("--model")->excludes(parser->get_option("--json"));
  return {parser, [options] { return run_mechanisms(*options); }};
}

}  // namespace regoplan
