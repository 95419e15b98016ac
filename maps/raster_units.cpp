#include "maps/raster_units.h"

#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <string_view>

#include "maps/warp_command.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

/// A unit of length as files name it.
struct LengthUnit {
  std::string_view name;
  double metres;
};
constexpr double kFoot_m = 0.3048, kSurveyFoot_m = 1200.0 / 3937.0;
constexpr std::array<LengthUnit, 31> kUnits{{{"", 1},
                                             {"m", 1},
                                             {"metre", 1},
                                             {"meter", 1},
                                             {"metres", 1},
                                             {"meters", 1},
                                             {"mm", 1e-3},
                                             {"millimetre", 1e-3},
                                             {"millimeter", 1e-3},
                                             {"cm", 1e-2},
                                             {"centimetre", 1e-2},
                                             {"centimeter", 1e-2},
                                             {"centimetres", 1e-2},
                                             {"centimeters", 1e-2},
                                             {"dm", 0.1},
                                             {"decimetre", 0.1},
                                             {"decimeter", 0.1},
                                             {"km", 1e3},
                                             {"kilometre", 1e3},
                                             {"kilometer", 1e3},
                                             {"kilometres", 1e3},
                                             {"kilometers", 1e3},
                                             {"ft", kFoot_m},
                                             {"foot", kFoot_m},
                                             {"feet", kFoot_m},
                                             {"international foot", kFoot_m},
                                             {"us-ft", kSurveyFoot_m},
                                             {"ftus", kSurveyFoot_m},
                                             {"us survey foot", kSurveyFoot_m},
                                             {"us survey feet", kSurveyFoot_m},
                                             {"foot_us", kSurveyFoot_m}}};

/// Metres a unit; nothing of a unit that is not known.
std::optional<double> metres_of(const std::string& unit) {
  const auto* known = std::ranges::find_if(
      kUnits, [&unit](const LengthUnit& u) { return EQUAL(unit.c_str(), u.name.data()); });
  return known == kUnits.end() ? std::nullopt : std::optional(known->metres);
}

bool is_metre(double metres) {
  return std::abs(metres - 1) <= 1e-9;
}

/// How to say on the command line what a unit is worth, the file's own scale included.
std::string import_remedy(GDALRasterBand& band, double metres) {
  std::string remedy = fmt::format("regoplan map import --scale {:.10g}", metres * band.GetScale());
  if (band.GetOffset() != 0) {
    remedy += fmt::format(" --offset {:.10g}", metres * band.GetOffset());
  }
  return remedy;
}

/// Whether the format is one of photographs, whose steps are shades and not metres.
bool is_picture(GDALRasterBand& band) {
  const GDALDataType type = band.GetRasterDataType();
  if (type != GDT_Byte && type != GDT_UInt16) return false;
  if (band.GetDataset() == nullptr || band.GetDataset()->GetDriver() == nullptr) return false;
  const std::string driver = band.GetDataset()->GetDriver()->GetDescription();
  for (const char* of_pictures : {"PNG", "JPEG", "BMP", "GIF", "WEBP", "JP2OpenJPEG"}) {
    if (driver == of_pictures) return band.GetScale() == 1 && band.GetOffset() == 0;
  }
  return false;
}

/// The same projection in metres, as PROJ writes it; empty where PROJ cannot.
std::string projection_in_metres(const OGRSpatialReference& crs) {
  if (!crs.IsProjected()) return "";
  char* text = nullptr;
  const bool good = crs.exportToProj4(&text) == OGRERR_NONE && text != nullptr;
  std::string proj = good ? text : "";
  CPLFree(text);
  proj = std::regex_replace(proj, std::regex(R"(\s*\+(units|to_meter|vunits|vto_meter)=\S+)"), "");
  return proj.empty() ? "" : proj + " +units=m";
}

}  // namespace

void check_height_unit(GDALRasterBand& band, const OGRSpatialReference* crs,
                       const HeightReading& reading, const std::string& file) {
  if (reading.scale) return;
  if (is_picture(band)) {
    throw InputError(fmt::format(
        "{}: is a picture of {} bits and does not say what a step of it is in metres; remedy: "
        "regoplan map import --scale METRES_A_STEP --offset METRES_OF_0",
        file, GDALGetDataTypeSizeBits(band.GetRasterDataType())));
  }
  const std::string unit = band.GetUnitType();
  const std::optional<double> metres = metres_of(unit);
  if (!metres) {
    throw InputError(fmt::format(
        "{}: its heights are in \"{}\", metres are needed; remedy: regoplan map import --scale "
        "METRES_A_UNIT",
        file, unit));
  }
  if (!is_metre(*metres)) {
    throw InputError(fmt::format("{}: its heights are in \"{}\", metres are needed; remedy: {}",
                                 file, unit, import_remedy(band, *metres)));
  }
  if (crs == nullptr || !unit.empty()) return;
  const char* vertical = nullptr;
  const double vertical_m = crs->GetTargetLinearUnits("VERT_CS", &vertical);
  if (vertical_m > 0 && !is_metre(vertical_m)) {
    throw InputError(fmt::format(
        "{}: its heights are in \"{}\" by its vertical CRS, metres are needed; remedy: {}", file,
        vertical == nullptr ? "" : vertical, import_remedy(band, vertical_m)));
  }
}

void check_crs_unit(const OGRSpatialReference& crs, const std::array<double, 6>& transform,
                    const GridFrame& frame, const RasterInWords& raster) {
  const char* name = nullptr;
  const double metres = crs.GetLinearUnits(&name);
  if (is_metre(metres)) return;
  const std::string proj = projection_in_metres(crs);
  const std::string remedy =
      proj.empty()
          ? fmt::format(
                "gdal_translate -a_srs 'LOCAL_CS[\"metres\",UNIT[\"metre\",1]]' -a_ullr "
                "{:.10g} {:.10g} {:.10g} {:.10g} {}",
                metres * transform[0], metres * transform[3],
                metres * (transform[0] + frame.columns * transform[1]),
                metres * (transform[3] + frame.rows * transform[5]), from_and_to(raster.file))
          : warp_command(raster.file, proj, raster.resampling);
  throw InputError(
      fmt::format("{}: the unit of its CRS \"{}\" is {} ({:.10g} m), metres are needed; remedy: {}",
                  raster.file, crs.GetName() == nullptr ? "" : crs.GetName(),
                  name == nullptr ? "unnamed" : name, metres, remedy));
}

}  // namespace regoplan
