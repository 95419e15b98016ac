#include "app/settings/carried_mechanisms.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace regoplan {
namespace {

struct OfTestBed {
  std::string_view id;
  bool is_left_out;  ///< else it stays and changes nothing
  std::string_view words;
  std::string_view form = {};  ///< where not all forms of it are of a test bed
};

constexpr std::array kOfTestBed{
    OfTestBed{"slope_tilt", true, "a tilt of the test bed; slopes are those of the map"},
    OfTestBed{"load_transfer", true,
              "a load of the test bed told wrongly; loads are the vehicle's own"},
    OfTestBed{"slip_scale", true,
              "a rim speed of the test bed told wrongly; the vehicle's is its own"},
    OfTestBed{"soil_zone", true, "a place along the test bed; soils lie where the map says"},
    OfTestBed{"multi_pass", false,
              "soil that wheels have passed already; a plan has one pass of each wheel"},
    OfTestBed{"soil_change", true, "some time on the test bed; soils lie where the map says",
              "for_a_time"},
    OfTestBed{"cohesion_drift", true, "some time on the test bed; soils lie where the map says",
              "for_a_time"},
    OfTestBed{"cohesion_drift", false,
              "a course over time; a plan has the soil of the course's beginning"},
};

}  // namespace

std::vector<std::string> leave_test_bed_behind(std::vector<Mechanism>& mechanisms,
                                               const std::string& file) {
  std::vector<std::string> notices;
  std::erase_if(mechanisms, [&](const Mechanism& mechanism) {
    const auto* of_bed = std::ranges::find_if(kOfTestBed, [&](const OfTestBed& known) {
      return known.id == mechanism.id && (known.form.empty() || known.form == mechanism.form);
    });
    if (of_bed == kOfTestBed.end()) return false;
    notices.push_back(fmt::format("{}: {} {}: {}", file, mechanism.id,
                                  of_bed->is_left_out ? "is left out" : "changes nothing here",
                                  of_bed->words));
    return of_bed->is_left_out;
  });
  return notices;
}

}  // namespace regoplan
