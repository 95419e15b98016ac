#include "app/settings/preset_soils.h"

#include "app/settings/soil_settings.h"
#include "terramech/wheel/paper_figures.h"

namespace regoplan {

std::vector<MapSoil> preset_soils(const std::string& demo_soils) {
  std::vector<MapSoil> soils =
      read_soil_catalogue(read_settings(demo_soils), WheelVariant::kIshigami2007).soils;
  soils.push_back({.name = "simulant_2004",
                   .source = "Yoshida & Ishigami 2004, Table I, in consistent units; a0, a1, "
                             "lambda and density from Ishigami et al. 2007",
                   .soil = {.mean = paper_model().soil}});
  return soils;
}

}  // namespace regoplan
