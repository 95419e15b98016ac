#include "app/io/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <ctime>

namespace regoplan {
namespace {

volatile std::sig_atomic_t last_signal = SIGINT;

// A signal handler has nothing but the statics of its file. The source outlives every handler call,
// also one while the program ends (`timeout` sends a signal twice): it is never destroyed. Nothing
// registers callbacks on it, so that asking it to stop is a few atomic operations.
std::stop_source& source() {
  static auto& stop = *new std::stop_source;
  return stop;
}

double now_s() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);  // may be called in a signal handler
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
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
  sigaddset(&action.sa_mask, SIGINT);
  sigaddset(&action.sa_mask, SIGTERM);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

double asked_at_s = 0;

/// `timeout` and others send one signal to the process and again to its group: what comes so soon
/// is no second request.
void request_stop(int signal) {
  constexpr double kSameRequest_s = 0.3;
  if (source().stop_requested()) {
    if (now_s() - asked_at_s < kSameRequest_s) return;
    handle(SIG_DFL, 0);
    raise(signal);  // comes when this handler has returned
    return;
  }
  asked_at_s = now_s();
  last_signal = signal;
  source().request_stop();
}

}  // namespace

void end_on_interrupt() {
  handle(end, 0);
}

std::stop_token stop_on_interrupt() {
  std::stop_token token = source().get_token();  // made before a signal can come
  handle(request_stop, SA_RESTART);
  return token;
}

int interrupted_status() {
  return 128 + last_signal;
}

}  // namespace regoplan
