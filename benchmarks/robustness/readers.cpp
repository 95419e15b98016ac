#include "benchmarks/robustness/readers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/diagnose/diagnosis_setup.h"
#include "app/diagnose/recording_checks.h"
#include "app/diagnose/recording_file.h"
#include "app/diagnose_drive/drive_columns.h"
#include "app/diagnose_drive/drive_file.h"
#include "app/diagnose_drive/drive_setup.h"
#include "app/evaluate/path_files.h"
#include "app/settings/manoeuvre_settings.h"
#include "app/settings/model_settings.h"
#include "app/settings/scenario_settings.h"
#include "app/settings/sensor_settings.h"
#include "app/settings/soil_settings.h"
#include "app/settings/suite_settings.h"
#include "app/settings/truth_settings.h"
#include "app/settings/vehicle_settings.h"
#include "driving/true_world.h"
#include "maps/raster_files.h"
#include "maps/rock_files.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

constexpr const char* kScenario = R"(map:
  terrain: {width_m: 40, height_m: 40, cell_m: 1}
  soils: soils.yaml
vehicle: lrv
gravity_mps2: 1.62
start: {x_m: 10, y_m: 20, heading_deg: 0}
goal: {x_m: 30, y_m: 20, radius_m: 3}
speed_mps: {max: 3}
)";

constexpr const char* kSoils =
    "{soils: {mare: {source: assumed, cohesion_pa: 170, friction_angle_deg: 35, kc: 1400, "
    "kphi: 820000, n: 1, a0: 0.4, a1: 0.15, lambda: 0.9, density_kgpm3: 1500, kx0_m: 0.018, "
    "ky0_m: 0.013}}, classes: {1: mare}}\n";

void write(const std::string& file, std::string_view content) {
  std::ofstream(file, std::ios::binary) << content;
}

/// What paths and manoeuvres are read for; its soils and limits are those of any scenario.
const PlanningProblem& problem() {
  static const PlanningProblem flat = read_scenario("flat.yaml", {}).problem;
  return flat;
}

void read_path_file(const std::string& file) {
  read_path(file, problem(), problem().speed_max_mps);
}

}  // namespace

const std::vector<Reader>& readers() {
  static const std::vector<Reader> all{
      {"scenario", "in.yaml", [](const std::string& file) { read_scenario(file, {}); }},
      {"soils", "in.yaml",
       [](const std::string& file) {
         read_soil_catalogue(read_settings(file), WheelVariant::kIshigami2007);
       }},
      {"vehicle", "in.yaml", [](const std::string& file) { read_vehicle(read_settings(file)); }},
      {"model", "in.yaml", [](const std::string& file) { read_model_file(file); }},
      {"setup", "in.yaml", [](const std::string& file) { read_setup_file(file); }},
      {"suite", "in.yaml", [](const std::string& file) { read_suite(file); }},
      {"manoeuvres", "in.yaml", [](const std::string& file) { read_manoeuvres(file, problem()); }},
      {"truth", "in.yaml",
       [](const std::string& file) { TrueWorld(problem(), read_truth(file, problem())); }},
      {"sensors", "in.yaml", [](const std::string& file) { read_sensors(file); }},
      {"path", "in.csv", read_path_file},
      {"candidate", "in.csv", read_path_file},
      {"recording", "in.csv",
       [](const std::string& file) {
         static const SetupSettings setup = read_setup_file("setup.yaml");
         doubtful_values(read_recording(file), setup.setup);
       }},
      {"rocks", "in.csv", [](const std::string& file) { RockIndex(read_rocks(file)); }},
      {"drive", "in.csv", [](const std::string& file) { read_drive(file, {}); }},
      {"drive_columns", "in.yaml", [](const std::string& file) { read_drive_columns_file(file); }},
      {"drive_setup", "in.yaml",
       [](const std::string& file) { read_drive_setup("flat.yaml", file); }},
      {"points", "in.csv", [](const std::string& file) { read_elevation(file); }},
      {"raster", "in.tif", [](const std::string& file) {
         try {
           read_elevation(file);
         } catch (const InputError&) {
           read_classes(file);
         }
       }}};
  return all;
}

const Reader& reader_named(std::string_view name) {
  const auto found = std::ranges::find(readers(), name, &Reader::name);
  if (found != readers().end()) return *found;
  std::vector<std::string> names;
  for (const Reader& reader : readers()) names.push_back(reader.name);
  throw InputError(fmt::format("no reader {} (there are: {})", name, fmt::join(names, ", ")));
}

bool takes(const Reader& reader, const std::string& input) {
  write(reader.file, input);
  try {
    reader.read(reader.file);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

void enter_scratch_folder() {
  namespace fs = std::filesystem;
  // In memory where there is such a folder: a run then costs what reading costs.
  const fs::path memory = "/dev/shm";
  const fs::path folder = (fs::is_directory(memory) ? memory : fs::temp_directory_path()) /
                          fmt::format("regoplan-robustness-{}", getpid());
  fs::create_directories(folder);
  fs::current_path(folder);
  write("flat.yaml", kScenario);
  write("soils.yaml", kSoils);
  write(
      "dem.asc", "ncols 20\nnrows 20\nxllcorner 0\nyllcorner 0\ncellsize 2\n" + [] {
        std::string rows;
        for (int i = 0; i < 400; ++i) rows += i % 20 == 19 ? "1\n" : "1 ";
        return rows;
      }());
  write("rocks.csv", "x_m,y_m,radius_m,height_m\n20,30,0.5,0.4\n");
  write("setup.yaml",
        "model: ishigami2007\nwheel: {radius_m: 0.09, width_m: 0.10}\ngravity_mps2: 9.80665\n"
        "soil: {cohesion_pa: 800, friction_angle_deg: 37.2, kc: 1370, kphi: 814000, n: 1, a0: 0.4, "
        "a1: 0.15, lambda: 0.9, density_kgpm3: 1600, kx0_m: 0.036, kx1_m: 0.043, ky0_m: 0.013, "
        "ky1_m: 0.02}\n");
}

}  // namespace regoplan
