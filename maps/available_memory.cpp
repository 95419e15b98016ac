#include "maps/available_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace regoplan {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// The one number that a file of the kernel holds; unlimited where there is none (`max`).
double number_in(const char* file) {
  double value = 0;
  return std::ifstream(file) >> value ? value : kUnlimited;
}

double machine_bytes() {
  std::ifstream stream("/proc/meminfo");
  for (std::string key, unit; stream >> key;) {
    double kilobytes = 0;
    if (!(stream >> kilobytes)) break;
    std::getline(stream, unit);
    if (key == "MemAvailable:") return 1024 * kilobytes;
  }
  return kUnlimited;
}

/// Of both versions of control groups; what they cannot say does not limit.
double control_group_bytes() {
  const auto left = [](double limit, double used) {
    return used < kUnlimited ? std::max(0.0, limit - used) : limit;
  };
  return std::min(
      left(number_in("/sys/fs/cgroup/memory.max"), number_in("/sys/fs/cgroup/memory.current")),
      left(number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes"),
           number_in("/sys/fs/cgroup/memory/memory.usage_in_bytes")));
}

double own_limit_bytes() {
  struct rlimit limit {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
  const double pages = number_in("/proc/self/statm");
  const double used = pages < kUnlimited ? pages * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0;
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - used);
}

}  // namespace

double available_memory_bytes() {
  return std::min({machine_bytes(), control_group_bytes(), own_limit_bytes()});
}

}  // namespace regoplan
