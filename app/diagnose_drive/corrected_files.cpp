#include "app/diagnose_drive/corrected_files.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/settings/map_files.h"
#include "app/settings/settings_json.h"
#include "app/settings/vehicle_settings.h"
#include "drive_diagnosis/corrected_world.h"

namespace regoplan {
namespace {

/// The scenario, with map and vehicle from the files beside it. JSON is YAML.
std::string scenario_text(const DriveDiagnosisRun& run, bool with_rocks) {
  nlohmann::ordered_json scenario = to_json(read_settings(run.scenario_file));
  nlohmann::ordered_json map = {
      {"elevation", "dem.tif"}, {"soil_class", "classes.tif"}, {"soils", "soils.yaml"}};
  if (with_rocks) map["rocks"] = "rocks.csv";
  scenario["map"] = std::move(map);
  scenario["vehicle"] = "vehicle.yaml";
  return "# " + run.scenario_file + " with map and vehicle as a diagnosis of drives tells them.\n" +
         scenario.dump(2) + "\n";
}

}  // namespace

ResultFolder corrected_folder(const ResultFolder& results) {
  return {results.path / "corrected-map", results.force};
}

bool has_corrected_map(const DriveDiagnosisRun& run) {
  const DriveDiagnosis& diagnosis = run.diagnosis;
  return diagnosis.effects.has_value() && diagnosis.verdict != DriveVerdict::kUndecided &&
         !diagnosis.interrupted;
}

std::vector<std::string> corrected_file_names() {
  std::vector<std::string> names = map_file_names();
  names.insert(names.end(), {"vehicle.yaml", "scenario.yaml"});
  return names;
}

void write_corrected_map(const DriveDiagnosisRun& run, const ResultFolder& folder) {
  const VehicleEffects& effects = *run.diagnosis.effects;
  const DriveSetup& setup = run.setup.setup;
  const TerrainMap map = corrected_map(setup.map, effects, run.diagnosis.windows);
  StagedFiles files(folder);
  write_map_files(map, files);
  files.write({"vehicle.yaml", vehicle_text(corrected_vehicle(*setup.vehicle, effects))});
  files.write({"scenario.yaml", scenario_text(run, !map.rocks().empty())});
  files.commit();
}

void remove_corrected_map(const ResultFolder& folder) {
  if (!std::filesystem::exists(folder.path)) return;
  StagedFiles files(folder);
  for (const std::string& name : corrected_file_names()) files.remove(name);
}

}  // namespace regoplan
