#include "app/io/interrupt.h"

#include <unistd.h>

#include <csignal>

namespace regoplan {
namespace {

volatile std::sig_atomic_t last_signal = SIGINT;

// A signal handler has nothing but the statics of its file. The source outlives every handler call,
// and nothing registers callbacks on it, so that asking it to stop is a few atomic operations.
std::stop_source& source() {
  static std::stop_source stop;
  return stop;
}

void request_stop(int signal) {
  last_signal = signal;
  source().request_stop();
}

void end(int signal) {
  constexpr char kWord[] = "regoplan: interrupted\n";
  // Nothing can be done where standard error takes no word.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kWord, sizeof kWord - 1);
  _exit(128 + signal);
}

void handle(void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

void end_on_interrupt() {
  handle(end, 0);
}

std::stop_token stop_on_interrupt() {
  std::stop_token token = source().get_token();  // made before a signal can come
  handle(request_stop, static_cast<int>(SA_RESETHAND | SA_RESTART));
  return token;
}

int interrupted_status() {
  return 128 + last_signal;
}

}  // namespace regoplan
