#include "maps/network_rasters.h"

#include <atomic>

namespace regoplan {
namespace {

std::atomic<bool> allowed = false;

}  // namespace

void allow_network_rasters() {
  allowed = true;
}

bool network_rasters_allowed() {
  return allowed;
}

}  // namespace regoplan
