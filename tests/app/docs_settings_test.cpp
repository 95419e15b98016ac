// Every key that the program reads stands in docs/. The keys are those that the readers themselves
// tell: each answers a key that it does not know with those that it does.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <functional>
#include <regex>

#include "app/diagnose/diagnosis_setup.h"
#include "app/settings/manoeuvre_settings.h"
#include "app/settings/model_settings.h"
#include "app/settings/scenario_settings.h"
#include "app/settings/sensor_settings.h"
#include "app/settings/suite_settings.h"
#include "app/settings/truth_settings.h"
#include "terramech/mechanisms/mechanism.h"
#include "tests/app/documents.h"
#include "tests/app/flat_map.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

using Keys = std::set<std::string>;
using Pages = std::vector<std::string>;

constexpr const char* kNobodyKnows = "zzzzzzzzzzzzzzzzzzzzzzzzzzzzzz";

/// What a reader says that it knows, of a mapping with a key that it does not.
Keys known_keys(const std::string& error) {
  const std::string lead = "unknown key (known: ";
  const std::size_t at = error.find(lead);
  if (at == std::string::npos) return {};
  Keys keys;
  std::stringstream list(error.substr(at + lead.size(), error.rfind(')') - at - lead.size()));
  for (std::string key; std::getline(list >> std::ws, key, ',');) keys.insert(key);
  return keys;
}

/// The keys that `read` knows of every mapping of a text that it accepts.
Keys keys_read(const std::string& text, const std::function<void(const std::string&)>& read) {
  const YAML::Node root = YAML::Load(text);
  EXPECT_EQ(error_text([&] { read(YAML::Dump(root)); }), "");
  Keys keys;
  const std::function<void(YAML::Node)> visit = [&](YAML::Node node) {
    if (node.IsMap()) {
      node[kNobodyKnows] = 1;
      const std::string error = error_text([&] { read(YAML::Dump(root)); });
      EXPECT_NE(error, "") << "accepted: " << YAML::Dump(node);
      keys.merge(known_keys(error));
      node.remove(kNobodyKnows);
      for (auto entry : node) visit(entry.second);
    } else if (node.IsSequence()) {
      for (auto item : node) visit(item);
    }
  };
  visit(root);
  return keys;
}

constexpr const char* kSoilNumbers =
    "cohesion_pa: {mean: 170, std: 10}, friction_angle_deg: 35, kc: 1400, kphi: 820000, n: 1, "
    "a0: 0.4, a1: 0.15, lambda: 0.9, density_kgpm3: 1500, kx0_m: 0.018, ky0_m: 0.013";

constexpr const char* kVehicle = R"(vehicle:
  name: box
  source: made up
  mass_kg: 600
  yaw_inertia_kgm2: 400
  cg_height_m: 0.6
  turn_centre_x_m: 0
  speed_max_mps: 3
  acceleration_max_mps2: 0.4
  curvature_max_1pm: 0.2
  curvature_rate_max_1pms: 0.2
  steer_angle_max_deg: 30
  slip_angle_max_deg: 16
  slip_max: 0.6
  sinkage_max_m: 0.1
  slope_max_deg: 25
  step_max_m: 0.1
  wheel: {radius_m: 0.41, width_m: 0.23}
  wheels:
    - {name: a, x_m: 1.2, y_m: 0.9, steered: true, driven: true}
    - {name: b, x_m: 1.2, y_m: -0.9, steered: true, driven: true}
    - {name: c, x_m: -1.2, y_m: 0.9, steered: true, driven: true}
    - {name: d, x_m: -1.2, y_m: -0.9, steered: true, driven: true}
  body: {x_min_m: -1.5, x_max_m: 1.5, y_min_m: -1, y_max_m: 1, clearance_m: 0.3, height_m: 1}
)";

std::string soils_text() {
  return std::string("{classes: {1: mare}, soils: {mare: {source: assumed, ") + kSoilNumbers +
         "}}}";
}

/// A scenario that states its terrain, with every optional mapping there is.
std::string whole_scenario(const std::string& soils, const std::string& vehicle) {
  return "map:\n  soils: " + soils + R"(
  terrain:
    width_m: 40
    height_m: 40
    cell_m: 1
    craters: [{x_m: 5, y_m: 35, diameter_m: 3, depth_m: 0.1}]
    dunes: {wavelength_m: 20, height_m: 0}
    zones: [{code: 1, west_m: 0, east_m: 5, south_m: 0, north_m: 5}]
    rocks: [{x_m: 2, y_m: 2, radius_m: 0.2, height_m: 0.1}]
    rock_rows: [{from: {x_m: 3, y_m: 3}, to: {x_m: 3, y_m: 6}, spacing_m: 3, radius_m: 0.2, height_m: 0.1}]
)" + vehicle +
         R"(gravity_mps2: 1.62
start: {x_m: 10, y_m: 20, heading_deg: 0}
goal: {x_m: 30, y_m: 20, radius_m: 3, speed_mps: {max: 1}}
speed_mps: {max: 2}
limits: {margin_min: 0.1}
planner: {iterations: 200, objective: {per_s: 1}}
expectation: feasible
)";
}

class DocsOfSettings : public testing::Test {
 protected:
  void expect_documented(const Keys& keys, const Pages& pages, std::size_t at_least) const {
    EXPECT_GE(keys.size(), at_least) << "the readers have told less than they know";
    EXPECT_EQ(undocumented(keys, pages), Keys{});
  }
  void read_as_scenario(const std::string& text) const {
    read_scenario(folder_.write("s.yaml", text), {});
  }

  ScratchFolder folder_;
};

TEST_F(DocsOfSettings, HoldEveryKeyOfAScenario) {
  write_flat_scenario(folder_);
  folder_.write("soils.yaml", soils_text());
  const auto read = [this](const std::string& text) { read_as_scenario(text); };
  expect_documented(keys_read(whole_scenario("soils.yaml", "vehicle: lrv\n"), read),
                    {"scenario.md", "map.md"}, 50);
  Keys inlined = keys_read(whole_scenario(soils_text(), kVehicle), read);
  inlined.merge(keys_read(flat_scenario(), read));
  expect_documented(inlined, {"scenario.md", "map.md", "vehicle-and-soil.md"}, 100);
}

TEST_F(DocsOfSettings, HoldEveryKeyOfAModelFile) {
  const std::string text = std::string("{model: ishigami2007, wheel: {radius_m: 0.09, width_m: ") +
                           "0.1}, gravity_mps2: 9.81, soil: {" + kSoilNumbers + R"(}, mechanisms: [
  {id: slip_sinkage, form: exponent, parameters: {n1: 0.3}},
  {id: generic, form: gaussian_bumps, parameters: {slip_scale: 0.3, slip_angle_scale_deg: 8,
   log_load_scale: 1, region: {slip_ratio: [-0.4, 0.6], slip_angle_deg: [0, 20], load_n: [100, 600]},
   nodes: [{slip_ratio: 0.05, slip_angle_deg: 10, load_n: 290, fy_n: -60}]}}]})";
  expect_documented(
      keys_read(text, [](const std::string& t) { read_model(parse_settings(t, "m.yaml")); }),
      {"wheel.md", "vehicle-and-soil.md"}, 35);
}

TEST_F(DocsOfSettings, HoldEveryKeyOfASetup) {
  const std::string text = std::string("{model: ishigami2007, wheel: {radius_m: 0.09, width_m: ") +
                           "0.1}, gravity_mps2: 9.81, soil: {" + kSoilNumbers + "}}";
  expect_documented(
      keys_read(text, [](const std::string& t) { read_setup(parse_settings(t, "setup.yaml")); }),
      {"diagnosis.md", "vehicle-and-soil.md"}, 20);
}

TEST_F(DocsOfSettings, HoldEveryKeyOfAManoeuvre) {
  const PlanningProblem problem = read_scenario(write_flat_scenario(folder_), {}).problem;
  const std::string text = R"(
- {kind: steady_turn, radius_m: 12, angle_deg: 90, speed_mps: 1}
- {kind: slope_traverse}
- {kind: lane_change, offset_m: 2, length_m: 12}
- {kind: slalom, amplitude_m: 0.5, wavelength_m: 20}
- {kind: braking_in_a_turn, radius_m: 15}
- {kind: point_turn, vehicle: curiosity}
)";
  expect_documented(keys_read(text,
                              [&](const std::string& t) {
                                read_manoeuvres(folder_.write("m.yaml", t), problem);
                              }),
                    {"evaluation.md"}, 15);
}

TEST_F(DocsOfSettings, HoldEveryKeyOfATruth) {
  const PlanningProblem problem = read_scenario(write_flat_scenario(folder_), {}).problem;
  const std::string text = R"(
soils: {mare: {friction_angle_deg: {std: 0}}}
zones: [{name: dune, like: mare, soil: {n: 1.1}, corners_m: [[0, 0], [9, 0], [9, 9]]}]
mechanisms: [{id: slip_sinkage, form: exponent, wheels: [front_left]}]
vehicle: {payload_kg: 1, wheels: {front_left: {drag_nm: 1}}}
map: {east_m: 1}
soil_border: {east_m: 1}
ruts: {stiffening: 1}
)";
  expect_documented(
      keys_read(text,
                [&](const std::string& t) { read_truth(folder_.write("t.yaml", t), problem); }),
      {"drive.md", "vehicle-and-soil.md", "mechanisms.md", "wheel.md"}, 35);
}

TEST_F(DocsOfSettings, HoldEveryKeyOfSensors) {
  std::string text = "steering_noise_deg: 1\nground_scatter: {drift_deg: 1}\n";
  for (const char* channel :
       {"position", "yaw", "attitude", "wheel_speed", "torque", "sinkage", "yaw_rate"}) {
    text += std::string(channel) + ": {rate_hz: 1}\n";
  }
  expect_documented(
      keys_read(text, [this](const std::string& t) { read_sensors(folder_.write("s.yaml", t)); }),
      {"drive.md"}, 30);
}

TEST_F(DocsOfSettings, HoldEveryKeyOfASuite) {
  const std::string scenario = write_flat_scenario(folder_);
  const std::string text = "{name: suite, scenarios: [{name: flat, file: " + scenario +
                           "}], planners: [{planner: RRT}], seeds: 1, time_s: 1}";
  expect_documented(
      keys_read(text, [this](const std::string& t) { read_suite(folder_.write("suite.yaml", t)); }),
      {"benchmark.md"}, 13);
}

TEST_F(DocsOfSettings, HoldEveryMechanismWithItsFormsAndParameters) {
  Keys keys;
  for (const MechanismForm& form : mechanism_forms()) {
    keys.emplace(form.id);
    keys.emplace(form.form);
    for (const MechanismParameter& parameter : form.parameters) keys.emplace(parameter.name);
  }
  expect_documented(keys, {"mechanisms.md"}, 60);
}

TEST_F(DocsOfSettings, SayOfEveryMechanismWhatItChangesAndWhatItsNumbersCanBe) {
  std::ifstream stream("docs/mechanisms.md");
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  for (const MechanismForm& form : mechanism_forms()) {
    std::string row = fmt::format("| `{}` | `{}` | ", form.id, form.form);
    for (const char letter : form.formula) row += letter == '|' ? "\\|" : std::string(1, letter);
    row += " | ";
    for (const MechanismParameter& p : form.parameters) {
      row += fmt::format("{}`{}` {:g} to {:g} ({:g} to {:g})",
                         &p == &form.parameters.front() ? "" : "; ", p.name, p.low, p.high, p.least,
                         p.most);
    }
    if (form.parameters.empty()) row += "none";
    EXPECT_NE(page.find(row + " | "), std::string::npos) << row;
  }
}

/// What the readers above do not come by: any key that stands in the code of a reader.
TEST_F(DocsOfSettings, HoldEveryKeyThatAReaderAsksFor) {
  static const std::regex asked(R"re(\.(?:required|optional|number|number_or|has)\(\s*"(\w+)")re");
  Keys keys;
  for (const auto& entry : std::filesystem::recursive_directory_iterator("app")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string source = page(entry.path());
    for (std::sregex_iterator at(source.begin(), source.end(), asked), end; at != end; ++at) {
      keys.insert((*at)[1].str());
    }
  }
  Pages pages;
  for (const auto& entry : std::filesystem::directory_iterator("docs")) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path().filename().string());
  }
  expect_documented(keys, pages, 80);
}

}  // namespace
}  // namespace regoplan
