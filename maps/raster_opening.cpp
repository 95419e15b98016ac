#include "maps/raster_opening.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <cpl_vsi_virtual.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "maps/network_rasters.h"
#include "maps/vrt_sources.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

/// Formats of terrain that lie in local files and say of themselves where their cells are. What is
/// not among them may take a name for an address: of a web service, a database, memory.
constexpr std::array kLocalFormats{
    "GTiff",    "COG",         "VRT",     "AAIGrid",   "GRASSASCIIGrid",
    "EHdr",     "ENVI",        "HFA",     "ISIS2",     "ISIS3",
    "PDS",      "PDS4",        "VICAR",   "PNG",       "JPEG",
    "BMP",      "GIF",         "WEBP",    "PNM",       "BT",
    "USGSDEM",  "SRTMHGT",     "DTED",    "NITF",      "SAGA",
    "GSAG",     "GSBG",        "GS7BG",   "XYZ",       "RRASTER",
    "RST",      "ILWIS",       "PCIDSK",  "SDTS",      "Terragen",
    "Leveller", "ERS",         "NWT_GRD", "NWT_GRC",   "ZMap",
    "ROI_PAC",  "GFF",         "AIG",     "LAN",       "GXF",
    "GRIB",     "JP2OpenJPEG", "HDF5",    "HDF5Image", "BAG",
    "SNODAS",   "IDA",         "SIGDEM",  "FIT",       "PAux",
    "DOQ1",     "DOQ2",        "GenBin",  "MFF",       "KRO",
    "NGSGEOID", "PRF",         "TGA"};

constexpr std::array<std::string_view, 5> kLocalFileSystems{"/vsizip/", "/vsigzip/", "/vsitar/",
                                                            "/vsimem/", "/vsisubfile/"};

constexpr const char* kClosed = "network file systems are read with --allow-network only";

/// In the place of a file system that is off: whatever names it, however deep, finds nothing there.
class ClosedFileSystem : public VSIFilesystemHandler {
 public:
  using VSIFilesystemHandler::Open;
  VSIVirtualHandle* Open(const char*, const char*, bool, CSLConstList) override {
    CPLError(CE_Failure, CPLE_NotSupported, "%s", kClosed);
    errno = EACCES;
    return nullptr;
  }
  int Stat(const char*, VSIStatBufL*, int) override {
    errno = EACCES;
    return -1;
  }
};

bool is_local(std::string_view file_system) {
  return std::ranges::find(kLocalFileSystems, file_system) != kLocalFileSystems.end() ||
         !file_system.starts_with("/vsi");
}

void close_network() {
  const CPLStringList file_systems(VSIGetFileSystemsPrefixes());
  for (int i = 0; i < file_systems.size(); ++i) {
    // GDAL's manager of file systems owns them.
    if (!is_local(file_systems[i])) {
      VSIFileManager::InstallHandler(file_systems[i], new ClosedFileSystem);
    }
  }
  GDALDriverManager& drivers = *GetGDALDriverManager();
  for (int i = drivers.GetDriverCount() - 1; i >= 0; --i) {
    GDALDriver* driver = drivers.GetDriver(i);
    const bool local = std::ranges::any_of(kLocalFormats, [&](const char* name) {
      return std::strcmp(name, driver->GetDescription()) == 0;
    });
    if (local) continue;
    drivers.DeregisterDriver(driver);
    delete driver;
  }
}

/// A file system other than local ones that a name mentions, at any depth; empty where none.
std::string_view closed_part(std::string_view file) {
  for (std::size_t at = file.find("/vsi"); at != std::string_view::npos;
       at = file.find("/vsi", at + 1)) {
    const std::string_view rest = file.substr(at);
    if (std::ranges::none_of(kLocalFileSystems,
                             [&](auto local) { return rest.starts_with(local); }))
      return rest.substr(0, rest.find('/', 1));
  }
  return {};
}

}  // namespace

QuietGdal::QuietGdal() {
  static const bool prepared = [] {
    GDALAllRegister();
    CPLSetConfigOption("GDAL_VRT_ENABLE_PYTHON", "NO");
    if (!network_rasters_allowed()) close_network();
    return true;
  }();
  static_cast<void>(prepared);
  CPLPushErrorHandler(CPLQuietErrorHandler);
  CPLErrorReset();
}

QuietGdal::~QuietGdal() {
  CPLPopErrorHandler();
}

void fail_raster(const std::string& file, std::string_view what) {
  throw InputError(fmt::format("{}: {}", file, what));
}

void fail_with_gdal(const std::string& file, std::string_view what) {
  std::string words = CPLGetLastErrorMsg();
  std::ranges::replace(words, '\n', ' ');
  fail_raster(file, words.empty() ? std::string(what) : fmt::format("{} ({})", what, words));
}

GDALDatasetUniquePtr open_raster(const std::string& file) {
  std::error_code ignored;
  if (file.starts_with("/vsi")) {
    if (!network_rasters_allowed() && !closed_part(file).empty()) {
      fail_raster(file, fmt::format("{}: {}", closed_part(file), kClosed));
    }
  } else if (!std::filesystem::exists(file, ignored)) {
    fail_raster(file, "no such file");
  }
  auto* driver = GDALIdentifyDriverEx(file.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
  if (driver != nullptr && std::strcmp(GDALGetDescription(driver), "VRT") == 0) {
    require_own_sources(file);
  }
  GDALDatasetUniquePtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  if (dataset == nullptr) {
    if (std::filesystem::is_directory(file, ignored)) {
      fail_raster(file, "is a folder, and no raster that GDAL can read");
    }
    fail_with_gdal(file, network_rasters_allowed()
                             ? "is not a raster that GDAL can read"
                             : "is not a raster that GDAL can read (formats that also take "
                               "addresses, as netCDF, with --allow-network only)");
  }
  if (dataset->GetRasterCount() == 0) fail_raster(file, "holds no raster band");
  if (GDALDataTypeIsComplex(dataset->GetRasterBand(1)->GetRasterDataType())) {
    fail_raster(file, "holds complex numbers");
  }
  return dataset;
}

}  // namespace regoplan
