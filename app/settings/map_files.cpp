#include "app/settings/map_files.h"

#include "app/settings/soil_settings.h"
#include "maps/raster_files.h"

namespace regoplan {

bool write_map_files(const TerrainMap& map, StagedFiles& files, const std::stop_token& stop) {
  write_elevation(map.elevation(), files.path("dem.tif"));
  if (stop.stop_requested()) return false;
  if (map.classes()) {
    write_classes(*map.classes(), files.path("classes.tif"));
  } else {
    files.remove("classes.tif");
  }
  if (map.rocks().empty()) {
    files.remove("rocks.csv");
  } else {
    write_rocks(map.rocks(), files.path("rocks.csv"));
  }
  files.write({.name = "soils.yaml", .content = soil_catalogue_text(map.catalogue())});
  return !stop.stop_requested();
}

std::vector<std::string> map_file_names() {
  return {"dem.tif", "classes.tif", "rocks.csv", "soils.yaml"};
}

}  // namespace regoplan
