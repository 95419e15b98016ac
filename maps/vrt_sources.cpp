#include "maps/vrt_sources.h"

#include <cpl_error.h>
#include <cpl_minixml.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <string_view>

#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

namespace fs = std::filesystem;

bool is_virtual(std::string_view name) {
  return name.starts_with("/vsi");
}

/// Links followed where there is a file system of the machine's own to ask.
fs::path resolved(const fs::path& file) {
  if (is_virtual(file.native())) return file.lexically_normal();
  std::error_code failed;
  const fs::path whole = fs::weakly_canonical(fs::absolute(file), failed);
  return failed ? fs::absolute(file).lexically_normal() : whole;
}

bool is_within(const fs::path& folder, const fs::path& file) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
         folder.end();
}

/// Whether an element or a piece of metadata of this name says where something else lies:
/// SourceFilename, SourceDataset, OVERVIEW_FILE, X_DATASET, RPC_DEM, ...
bool names_a_source(std::string_view name) {
  std::string upper(name);
  std::ranges::transform(upper, upper.begin(), [](unsigned char c) {
    return static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  });
  return std::ranges::any_of(
      std::initializer_list<const char*>{"FILE", "DATASET", "DEM", "CONNECTION", "URL"},
      [&](const char* part) { return upper.find(part) != std::string::npos; });
}

/// Reads VRTs, one naming the other, and checks what each names.
class SourceCheck {
 public:
  explicit SourceCheck(const std::string& first) : folder_(resolved(first).parent_path()) {}

  void read(const std::string& vrt) {
    if (!seen_.insert(resolved(vrt).string()).second) return;
    constexpr vsi_l_offset kBytesMax = 64 << 20;
    VSIStatBufL there;
    if (VSIStatL(vrt.c_str(), &there) == 0 &&
        static_cast<vsi_l_offset>(there.st_size) > kBytesMax) {
      throw InputError(fmt::format("{}: too long for a VRT (allowed: {} bytes)", vrt, kBytesMax));
    }
    const std::unique_ptr<CPLXMLNode, void (*)(CPLXMLNode*)> tree(CPLParseXMLFile(vrt.c_str()),
                                                                  CPLDestroyXMLNode);
    if (!tree) throw InputError(vrt + ": is no VRT that can be read");
    check(*tree, vrt);
  }

 private:
  void check(const CPLXMLNode& first, const std::string& vrt) {
    for (const CPLXMLNode* node = &first; node != nullptr; node = node->psNext) {
      if (node->eType != CXT_Element) continue;
      const char* key = CPLGetXMLValue(node, "key", "");
      if (names_a_source(node->pszValue) || names_a_source(key)) {
        const char* named = CPLGetXMLValue(node, nullptr, "");
        const bool to_vrt = std::strcmp(CPLGetXMLValue(node, "relativeToVRT", "0"), "1") == 0 ||
                            std::strcmp(CPLGetXMLValue(node, "relativetoVRT", "0"), "1") == 0;
        if (*named != '\0') check_source(named, to_vrt, vrt);
      }
      if (node->psChild != nullptr) check(*node->psChild, vrt);
    }
  }

  void check_source(const std::string& named, bool to_vrt, const std::string& vrt) {
    const fs::path file = to_vrt ? resolved(vrt).parent_path() / named : fs::path(named);
    // A colon may make it something else than a file: a driver's name, an address, a part.
    const bool plain = named.find(':') == std::string::npos && !named.starts_with('<');
    if (!plain || !is_within(folder_, resolved(file))) {
      throw InputError(fmt::format(
          "{}: names \"{}\"; a VRT may name files of its own folder only; remedy: gdal_translate "
          "it to a GeoTIFF",
          vrt, named));
    }
    auto* driver = GDALIdentifyDriverEx(file.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
    if (driver != nullptr && std::strcmp(GDALGetDescription(driver), "VRT") == 0) {
      read(file.string());
    }
  }

  fs::path folder_;
  std::set<std::string> seen_;
};

}  // namespace

void require_own_sources(const std::string& vrt) {
  SourceCheck(vrt).read(vrt);
}

}  // namespace regoplan
