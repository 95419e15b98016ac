#include "app/map/map_folder.h"

#include "app/io/staged_files.h"
#include "app/settings/map_files.h"

namespace regoplan {

std::vector<std::string> map_folder_names() {
  std::vector<std::string> names = map_file_names();
  names.insert(names.end(), {"vehicle.yaml", "scenario.yaml"});
  return names;
}

bool write_map_folder(const TerrainMap& map, const ScenarioStub& stub, const ResultFolder& folder,
                      const std::stop_token& stop) {
  const StubFiles beside = stub_files(map, stub);
  StagedFiles staged(folder);
  if (!write_map_files(map, staged, stop)) return false;
  if (beside.vehicle) staged.write(*beside.vehicle);
  staged.write(beside.scenario);
  staged.commit();
  return true;
}

}  // namespace regoplan
