#pragma once

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "terramech/basics/input_error.h"
#include "tests/scratch_folder.h"

namespace regoplan {

/// A raster of 2 x 2 cells in a file, that tests of readers begin with.
struct Tiff {
  GDALDataType type = GDT_Float32;
  std::array<double, 6> transform{100, 1, 0, 200, 0, -1};
  std::string crs = {};
  std::vector<double> cells{1, 2, 3, 4};  // 2 x 2
  std::optional<double> nodata = {};
  double scale = 1;
  double offset = 0;
  std::string unit = {};
};

inline std::string wkt(const std::string& crs) {
  OGRSpatialReference reference;
  reference.SetFromUserInput(crs.c_str());
  char* text = nullptr;
  reference.exportToWkt(&text);
  std::string result = text;
  CPLFree(text);
  return result;
}

inline std::string write(const ScratchFolder& folder, const Tiff& tiff,
                         const std::string& name = "in.tif") {
  GDALAllRegister();
  std::string file = folder.path(name);
  GDALDatasetUniquePtr dataset(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      file.c_str(), 2, 2, 1, tiff.type, nullptr));
  std::array<double, 6> transform = tiff.transform;
  dataset->SetGeoTransform(transform.data());
  if (!tiff.crs.empty()) dataset->SetProjection(wkt(tiff.crs).c_str());
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  if (tiff.nodata) band.SetNoDataValue(*tiff.nodata);
  if (tiff.scale != 1) band.SetScale(tiff.scale);
  if (tiff.offset != 0) band.SetOffset(tiff.offset);
  if (!tiff.unit.empty()) band.SetUnitType(tiff.unit.c_str());
  std::vector<double> cells = tiff.cells;
  EXPECT_EQ(band.RasterIO(GF_Write, 0, 0, 2, 2, cells.data(), 2, 2, GDT_Float64, 0, 0, nullptr),
            CE_None);
  return file;
}

/// Whether an action throws an InputError of one line that says all these words.
template <typename Action>
testing::AssertionResult refuses(Action action, const std::vector<std::string>& words) {
  try {
    action();
  } catch (const InputError& error) {
    const std::string message = error.what();
    for (const std::string& word : words) {
      if (message.find(word) == std::string::npos) {
        return testing::AssertionFailure() << message << "\n  does not say: " << word;
      }
    }
    if (message.find('\n') != std::string::npos) {
      return testing::AssertionFailure() << message << "\n  is more than one line";
    }
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << "no error";
}

}  // namespace regoplan
