#include "app/settings/carried_mechanisms.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace regoplan {
namespace {

struct Reason {
  std::string_view id;
  std::string_view words;
};

constexpr std::array kOfTestBed{
    Reason{"slope_tilt", "a tilt of the test bed; slopes are those of the map"},
    Reason{"load_transfer", "a load of the test bed told wrongly; loads are the vehicle's own"},
    Reason{"slip_scale", "a rim speed of the test bed told wrongly; the vehicle's is its own"},
    Reason{"soil_zone", "a place along the test bed; soils lie where the map says"},
};

constexpr std::array kIdle{
    Reason{"multi_pass", "soil that wheels have passed already; a plan has one pass of each wheel"},
    Reason{"cohesion_drift", "a course over time; a plan has the soil of the course's beginning"},
};

template <std::size_t N>
const Reason* reason_for(const std::array<Reason, N>& reasons, const Mechanism& mechanism) {
  for (const Reason& reason : reasons) {
    if (reason.id == mechanism.id) return &reason;
  }
  return nullptr;
}

}  // namespace

std::vector<std::string> leave_test_bed_behind(std::vector<Mechanism>& mechanisms,
                                               const std::string& file) {
  std::vector<std::string> notices;
  std::erase_if(mechanisms, [&](const Mechanism& mechanism) {
    const Reason* reason = reason_for(kOfTestBed, mechanism);
    if (reason == nullptr) return false;
    notices.push_back(fmt::format("{}: {} is left out: {}", file, mechanism.id, reason->words));
    return true;
  });
  for (const Mechanism& mechanism : mechanisms) {
    const Reason* reason = reason_for(kIdle, mechanism);
    if (reason == nullptr) continue;
    notices.push_back(
        fmt::format("{}: {} changes nothing here: {}", file, mechanism.id, reason->words));
  }
  return notices;
}

}  // namespace regoplan
