#include "app/map_folder.h"

#include "app/soil_settings.h"
#include "app/staged_files.h"
#include "maps/raster_files.h"

namespace regoplan {

void write_map_folder(const TerrainMap& map, const ScenarioStub& stub,
                      const std::filesystem::path& folder) {
  const StubFiles beside = stub_files(map, stub);
  StagedFiles staged(folder);
  write_elevation(map.elevation(), staged.path("dem.tif"));
  if (map.classes()) write_classes(*map.classes(), staged.path("classes.tif"));
  if (!map.rocks().empty()) write_rocks(map.rocks(), staged.path("rocks.csv"));
  staged.write({.name = "soils.yaml", .content = soil_catalogue_text(map.catalogue())});
  if (beside.vehicle) staged.write(*beside.vehicle);
  staged.write(beside.scenario);
  staged.commit();
}

}  // namespace regoplan
