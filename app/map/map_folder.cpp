#include "app/map/map_folder.h"

#include "app/io/staged_files.h"
#include "app/settings/soil_settings.h"
#include "maps/raster_files.h"

namespace regoplan {

std::vector<std::string> map_file_names() {
  return {"dem.tif", "classes.tif", "rocks.csv", "soils.yaml", "vehicle.yaml", "scenario.yaml"};
}

bool write_map_folder(const TerrainMap& map, const ScenarioStub& stub, const ResultFolder& folder,
                      const std::stop_token& stop) {
  const StubFiles beside = stub_files(map, stub);
  StagedFiles staged(folder);
  write_elevation(map.elevation(), staged.path("dem.tif"));
  if (stop.stop_requested()) return false;
  if (map.classes()) write_classes(*map.classes(), staged.path("classes.tif"));
  if (!map.rocks().empty()) write_rocks(map.rocks(), staged.path("rocks.csv"));
  if (stop.stop_requested()) return false;
  staged.write({.name = "soils.yaml", .content = soil_catalogue_text(map.catalogue())});
  if (beside.vehicle) staged.write(*beside.vehicle);
  staged.write(beside.scenario);
  staged.commit();
  return true;
}

}  // namespace regoplan
