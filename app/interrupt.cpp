#include "app/interrupt.h"

#include <csignal>

namespace regoplan {
namespace {

// A signal handler has nothing but the statics of its file. The source outlives every handler call,
// and nothing registers callbacks on it, so that asking it to stop is a few atomic operations.
std::stop_source& source() {
  static std::stop_source stop;
  return stop;
}

void request_stop(int) {
  source().request_stop();
}

}  // namespace

std::stop_token stop_on_interrupt() {
  std::stop_token token = source().get_token();  // made before a signal can come
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return token;
}

}  // namespace regoplan
