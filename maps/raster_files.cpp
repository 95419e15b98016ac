#include "maps/raster_files.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string_view>
#include <type_traits>

#include "maps/available_memory.h"
#include "maps/grid_table.h"
#include "maps/raster_opening.h"
#include "maps/raster_units.h"
#include "maps/undeclared_nodata.h"
#include "maps/warp_command.h"
#include "maps/whole_file.h"
#include "terramech/basics/input_error.h"

namespace regoplan {

namespace {

/// No elevation lies further from its datum; what does is a nodata value that nobody declared.
constexpr double kHeightMax_m = 1e6;
constexpr double kCellsMax = 1e9;

OGRSpatialReference crs_of(const std::string& wkt) {
  OGRSpatialReference crs;
  crs.importFromWkt(wkt.c_str());
  crs.StripVertical();
  return crs;
}

std::string crs_name(const std::string& wkt) {
  const OGRSpatialReference crs = crs_of(wkt);
  const char* name = crs.GetName();
  return name == nullptr ? "unnamed" : name;
}

/// A local projection in metres, true to scale about the middle of the raster, for any body.
std::string metric_crs(const OGRSpatialReference& crs, const std::array<double, 6>& transform,
                       int columns, int rows) {
  return fmt::format("+proj=tmerc +lat_0={:.4f} +lon_0={:.4f} +a={:.0f} +b={:.0f} +units=m",
                     transform[3] + 0.5 * rows * transform[5],
                     transform[0] + 0.5 * columns * transform[1], crs.GetSemiMajor(),
                     crs.GetSemiMinor());
}

/// Before anything is read: a small file may stand for any number of cells.
void require_bearable_size(const GridFrame& frame, const std::string& file) {
  constexpr const char* kRemedy =
      "remedy: cut out the part needed with gdal_translate -projwin, or make its cells larger with "
      "gdal_translate -tr";
  // Its cells as they are stored, their mask, and what is made of them afterwards.
  constexpr double kBytesACell = 16, kGigabyte = 1e9;
  const double cells = static_cast<double>(frame.columns) * frame.rows;
  if (cells > kCellsMax) {
    fail_raster(file, fmt::format("{} x {} cells are too many (allowed: {}); {}", frame.columns,
                                  frame.rows, kCellsMax, kRemedy));
  }
  const double available = available_memory_bytes();
  if (cells * kBytesACell > available) {
    fail_raster(file, fmt::format("{} x {} cells take {:.1f} GB of memory (there are {:.1f}); {}",
                                  frame.columns, frame.rows, cells * kBytesACell / kGigabyte,
                                  available / kGigabyte, kRemedy));
  }
}

/// \param resampling what suits its cells, for remedies
GridFrame read_frame(GDALDataset& dataset, const std::string& file, const char* resampling) {
  GridFrame frame;
  frame.columns = dataset.GetRasterXSize();
  frame.rows = dataset.GetRasterYSize();
  require_bearable_size(frame, file);
  std::array<double, 6> transform{};
  if (dataset.GetGeoTransform(transform.data()) != CE_None) {
    fail_raster(
        file,
        "says nowhere where its cells lie (no georeference); remedy: gdal_translate -a_ullr "
        "WEST NORTH EAST SOUTH in.tif out.tif");
  }
  if (!std::ranges::all_of(transform, [](double number) { return std::isfinite(number); })) {
    fail_raster(file, "says nowhere where its cells lie (its geotransform is not finite)");
  }
  const OGRSpatialReference* crs = dataset.GetSpatialRef();
  if (crs != nullptr && crs->IsGeocentric()) {
    fail_raster(
        file, fmt::format("its CRS \"{}\" is geocentric, a planar one is needed", crs->GetName()));
  }
  if (crs != nullptr && crs->IsGeographic()) {
    fail_raster(
        file, fmt::format("its CRS \"{}\" is geographic (degrees), metres are needed; remedy: {}",
                          crs->GetName(),
                          warp_command(file, metric_crs(*crs, transform, frame.columns, frame.rows),
                                       resampling)));
  }
  if (crs != nullptr) check_crs_unit(*crs, transform, frame, {file, resampling});
  // Below a thousandth of a cell over the whole raster, a rotation is rounding.
  const bool rotated = std::abs(transform[2]) * frame.rows > 1e-3 * std::abs(transform[1]) ||
                       std::abs(transform[4]) * frame.columns > 1e-3 * std::abs(transform[5]);
  if (rotated) {
    fail_raster(file, "is rotated against its CRS; remedy: " + warp_command(file, "", resampling));
  }
  if (!(transform[1] > 0 && transform[5] < 0)) {
    fail_raster(
        file,
        "is not north-up (its rows do not run from north to south, or its columns not from west to "
        "east); remedy: " +
            warp_command(file, "", resampling));
  }
  frame.west_m = transform[0];
  frame.north_m = transform[3];
  frame.cell_width_m = transform[1];
  frame.cell_height_m = -transform[5];
  if (crs != nullptr) {
    char* wkt = nullptr;
    const std::array<const char*, 2> options{"FORMAT=WKT2_2019", nullptr};
    if (crs->exportToWkt(&wkt, options.data()) == OGRERR_NONE) frame.crs_wkt = wkt;
    CPLFree(wkt);
  }
  return frame;
}

template <typename Number>
std::vector<Number> read_cells(GDALRasterBand& band, GDALDataType type, const std::string& file) {
  const int columns = band.GetXSize();
  const int rows = band.GetYSize();
  std::vector<Number> cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  if (band.RasterIO(GF_Read, 0, 0, columns, rows, cells.data(), columns, rows, type, 0, 0,
                    nullptr) != CE_None) {
    fail_with_gdal(file, "cannot be read to its end");
  }
  return cells;
}

/// Which cells count: empty where all do, or where the cells tell it themselves.
std::vector<std::uint8_t> read_mask(GDALRasterBand& band, const std::string& file) {
  if (band.GetMaskFlags() == GMF_ALL_VALID) return {};
  // A mask of NaN is what the cells say anyhow, and costs another reading of the file.
  if (band.GetMaskFlags() == GMF_NODATA && std::isnan(band.GetNoDataValue())) return {};
  return read_cells<std::uint8_t>(*band.GetMaskBand(), GDT_Byte, file);
}

std::string cell_place(std::size_t cell, const GridFrame& frame) {
  const auto columns = static_cast<std::size_t>(frame.columns);
  const std::size_t column = cell % columns;
  const std::size_t row = cell / columns;
  return fmt::format("column {}, row {}", column, row);
}

/// Reads the cells as `Stored`, applies scale and offset, and turns each into a `Cell`.
template <typename Stored, typename Cell, typename Convert>
std::vector<Cell> convert_cells(GDALRasterBand& band, GDALDataType type, const std::string& file,
                                const HeightReading& reading, Cell unknown, Convert convert) {
  std::vector<std::uint8_t> mask = read_mask(band, file);
  const double scale = reading.scale.value_or(band.GetScale());
  const double offset = reading.offset_m.value_or(band.GetOffset());
  const bool scaled = scale != 1 || offset != 0;
  std::optional<Stored> nodata;
  if (reading.nodata) nodata = static_cast<Stored>(*reading.nodata);
  std::vector<Stored> stored = read_cells<Stored>(band, type, file);
  const auto converted = [&](std::size_t i) {
    if (!mask.empty() && mask[i] == 0) return unknown;
    const auto value = static_cast<double>(stored[i]);
    if (std::isnan(value) || stored[i] == nodata) return unknown;
    return convert(scaled ? value * scale + offset : value, i);
  };
  if constexpr (std::is_same_v<Stored, Cell>) {
    for (std::size_t i = 0; i < stored.size(); ++i) stored[i] = converted(i);
    return stored;
  } else {
    std::vector<Cell> cells(stored.size());
    for (std::size_t i = 0; i < stored.size(); ++i) cells[i] = converted(i);
    return cells;
  }
}

template <typename Number>
struct Layer {
  const std::vector<Number>& cells;
  std::string description = {};
};

template <typename Number>
bool write_layer(GDALRasterBand& band, const Layer<Number>& layer, GDALDataType type,
                 double nodata) {
  const bool good = band.SetNoDataValue(nodata) == CE_None;
  if (!layer.description.empty()) band.SetDescription(layer.description.c_str());
  // GDAL takes the cells it writes through a pointer to non-const, and leaves them as they are.
  return good && band.RasterIO(GF_Write, 0, 0, band.GetXSize(), band.GetYSize(),
                               const_cast<Number*>(layer.cells.data()), band.GetXSize(),
                               band.GetYSize(), type, 0, 0, nullptr) == CE_None;
}

template <typename Number>
void write_raster(const GridFrame& frame, const std::vector<Layer<Number>>& layers,
                  GDALDataType type, double nodata, const char* predictor,
                  const std::string& file) {
  const QuietGdal quiet;
  const std::size_t count =
      static_cast<std::size_t>(frame.columns) * static_cast<std::size_t>(frame.rows);
  if (count == 0 || layers.empty() || std::ranges::any_of(layers, [&](const Layer<Number>& layer) {
        return layer.cells.size() != count;
      })) {
    fail_raster(file, "cannot be written: the cells do not fill the grid");
  }
  write_whole_file(file, [&](const std::string& unfinished) {
    // No side file: what a GeoTIFF cannot hold would stay behind under the unfinished name.
    const CPLConfigOptionSetter no_side_file("GDAL_PAM_ENABLED", "NO", false);
    CPLStringList options;
    options.SetNameValue("COMPRESS", "DEFLATE");
    options.SetNameValue("PREDICTOR", predictor);
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    GDALDatasetUniquePtr dataset(
        driver == nullptr ? nullptr
                          : driver->Create(unfinished.c_str(), frame.columns, frame.rows,
                                           static_cast<int>(layers.size()), type, options.List()));
    if (dataset == nullptr) fail_with_gdal(file, "cannot be written");
    std::array<double, 6> transform{frame.west_m,        frame.cell_width_m, 0, frame.north_m, 0,
                                    -frame.cell_height_m};
    bool good = dataset->SetGeoTransform(transform.data()) == CE_None;
    if (!frame.crs_wkt.empty()) {
      good = good && dataset->SetProjection(frame.crs_wkt.c_str()) == CE_None;
    }
    for (std::size_t i = 0; i < layers.size(); ++i) {
      good = good &&
             write_layer(*dataset->GetRasterBand(static_cast<int>(i) + 1), layers[i], type, nodata);
    }
    // Closing writes what is left, and says in its last remark only whether it could.
    dataset.reset();
    good = good && CPLGetLastErrorType() < CE_Failure;
    if (!good) fail_with_gdal(file, "cannot be written");
  });
}

}  // namespace

ElevationRaster read_elevation(const std::string& file, const HeightReading& reading) {
  if (is_grid_table(file) && std::filesystem::exists(file)) return read_grid_table(file, reading);
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = open_raster(file);
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  const GDALColorInterp colour = band.GetColorInterpretation();
  if (colour == GCI_RedBand || colour == GCI_PaletteIndex) {
    fail_raster(file, "is a picture of colours, heights in metres are needed");
  }
  check_height_unit(band, dataset->GetSpatialRef(), reading, file);
  ElevationRaster raster{.frame = read_frame(*dataset, file, "bilinear"), .height_m = {}};
  bool known = false;
  const auto height = [&](double value, std::size_t cell) {
    if (!(std::abs(value) <= kHeightMax_m)) {
      fail_raster(
          file, fmt::format("height {} m at {} is not valid (allowed: -{} to {}); remedy, where it "
                            "marks unknown cells: gdal_translate -a_nodata {} {}",
                            value, cell_place(cell, raster.frame), kHeightMax_m, kHeightMax_m,
                            value, from_and_to(file)));
    }
    known = true;
    return static_cast<float>(value);
  };
  constexpr float kNoHeight_m = std::numeric_limits<float>::quiet_NaN();
  // Through double only where float would lose digits or range before scale and nodata are seen.
  const bool float_holds_it = GDALGetDataTypeSizeBits(band.GetRasterDataType()) <= 16 ||
                              band.GetRasterDataType() == GDT_Float32;
  raster.height_m =
      float_holds_it
          ? convert_cells<float, float>(band, GDT_Float32, file, reading, kNoHeight_m, height)
          : convert_cells<double, float>(band, GDT_Float64, file, reading, kNoHeight_m, height);
  if (!known) fail_raster(file, "no cell is known: every cell is nodata");
  check_for_undeclared_nodata(raster, reading.scale.value_or(band.GetScale()),
                              reading.offset_m.value_or(band.GetOffset()), file);
  return raster;
}

ClassRaster read_classes(const std::string& file) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = open_raster(file);
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  ClassRaster raster{.frame = read_frame(*dataset, file, "near"), .code = {}};
  bool known = false;
  const auto code = [&](double value, std::size_t cell) {
    if (!(value > INT32_MIN && value <= INT32_MAX) || value != std::floor(value)) {
      fail_raster(file,
                  fmt::format("class code {} at {} is not valid (allowed: integers of 32 bits; "
                              "remedy, where it was resampled: gdalwarp -r near)",
                              value, cell_place(cell, raster.frame)));
    }
    known = true;
    return static_cast<std::int32_t>(value);
  };
  const GDALDataType type = band.GetRasterDataType();
  const bool int32_holds_it =
      GDALDataTypeIsInteger(type) && (GDALGetDataTypeSizeBits(type) <= 16 || type == GDT_Int32);
  raster.code = int32_holds_it ? convert_cells<std::int32_t, std::int32_t>(
                                     band, GDT_Int32, file, {}, ClassRaster::kNoData, code)
                               : convert_cells<double, std::int32_t>(band, GDT_Float64, file, {},
                                                                     ClassRaster::kNoData, code);
  if (!known) fail_raster(file, "no cell has a class: every cell is nodata");
  return raster;
}

std::string adopt_crs(ClassRaster& classes, const GridFrame& elevation,
                      const std::string& classes_file) {
  const QuietGdal quiet;
  const std::string own = classes.frame.crs_wkt;
  std::string notice;
  if (own.empty() && !elevation.crs_wkt.empty()) {
    notice = fmt::format("{}: names no CRS; taken to be the elevation's, \"{}\"", classes_file,
                         crs_name(elevation.crs_wkt));
  } else if (!own.empty() && elevation.crs_wkt.empty()) {
    notice = fmt::format("{}: the elevation names no CRS; taken to be the same as \"{}\"",
                         classes_file, crs_name(own));
  } else if (own != elevation.crs_wkt) {
    const OGRSpatialReference elevation_crs = crs_of(elevation.crs_wkt);
    if (!is_same_crs(crs_of(own), elevation_crs)) {
      fail_raster(classes_file,
                  fmt::format("its CRS \"{}\" is not the elevation's, \"{}\"; remedy: {}",
                              crs_name(own), crs_name(elevation.crs_wkt),
                              warp_command(classes_file, crs_word(elevation_crs), "near")));
    }
  }
  if (!overlap(classes.frame, elevation)) {
    fail_raster(
        classes_file,
        fmt::format("lies elsewhere than the elevation: x {} to {} m, y {} to {} m against x {} "
                    "to {} m, y {} to {} m",
                    classes.frame.west_m, classes.frame.east_m(), classes.frame.south_m(),
                    classes.frame.north_m, elevation.west_m, elevation.east_m(),
                    elevation.south_m(), elevation.north_m));
  }
  classes.frame.crs_wkt = elevation.crs_wkt;
  return notice;
}

void write_elevation(const ElevationRaster& elevation, const std::string& file) {
  write_raster<float>(elevation.frame, {{elevation.height_m}}, GDT_Float32,
                      std::numeric_limits<double>::quiet_NaN(), "3", file);
}

void write_classes(const ClassRaster& classes, const std::string& file) {
  write_raster<std::int32_t>(classes.frame, {{classes.code}}, GDT_Int32, ClassRaster::kNoData, "2",
                             file);
}

void write_bands(const GridFrame& frame, const std::vector<RasterBand>& bands,
                 const std::string& file) {
  std::vector<Layer<float>> layers;
  for (const RasterBand& band : bands) layers.push_back({band.values, band.description});
  write_raster(frame, layers, GDT_Float32, std::numeric_limits<double>::quiet_NaN(), "3", file);
}

}  // namespace regoplan
