#include "maps/warp_command.h"

#include <cpl_conv.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace regoplan {
namespace {

/// What `write` writes; empty where it cannot.
template <typename Write>
std::string written_by(Write write) {
  char* text = nullptr;
  const bool good = write(&text) == OGRERR_NONE && text != nullptr;
  std::string result = good ? text : "";
  CPLFree(text);
  return result;
}

}  // namespace

bool is_same_crs(const OGRSpatialReference& a, const OGRSpatialReference& b) {
  const std::array<const char*, 4> options{
      "IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", "IGNORE_COORDINATE_EPOCH=YES",
      "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", nullptr};
  return a.IsSame(&b, options.data()) != 0;
}

std::string crs_word(const OGRSpatialReference& crs) {
  const char* authority = crs.GetAuthorityName(nullptr);
  const char* code = crs.GetAuthorityCode(nullptr);
  const std::string proj = written_by([&crs](char** text) { return crs.exportToProj4(text); });
  for (const std::string& word :
       {authority && code ? fmt::format("{}:{}", authority, code) : std::string(), proj}) {
    OGRSpatialReference read;
    if (!word.empty() && read.SetFromUserInput(word.c_str()) == OGRERR_NONE &&
        is_same_crs(read, crs)) {
      return word;
    }
  }
  const std::array<const char*, 2> options{"FORMAT=WKT2_2019", nullptr};
  return written_by([&](char** text) { return crs.exportToWkt(text, options.data()); });
}

std::string warp_command(const std::string& file, const std::string& target,
                         const std::string& resampling) {
  const std::string to = target.empty() ? "" : " -t_srs " + shell_word(target);
  return fmt::format("gdalwarp -r {}{} {}", resampling, to, from_and_to(file));
}

std::string from_and_to(const std::string& file) {
  const std::string from = file.starts_with('-') ? "./" + file : file;
  const bool is_taken = std::filesystem::path(file).filename() == "out.tif";
  return shell_word(from) + (is_taken ? " out-mended.tif" : " out.tif");
}

std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain = "+-./:=_@%,";
  const auto is_plain = [&](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
           (letter >= '0' && letter <= '9') || kPlain.find(letter) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string word = "'";
  for (const char letter : text) {
    if (letter == '\'') {
      word += "'\\''";
    } else {
      word += letter;
    }
  }
  return word + "'";
}

}  // namespace regoplan
