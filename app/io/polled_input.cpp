#include "app/io/polled_input.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "terramech/basics/input_error.h"

namespace regoplan {

// O_NONBLOCK: else opening a pipe would wait until somebody writes.
PolledInput::PolledInput(const std::string& file, std::stop_token stop)
    : file_(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)), stop_(std::move(stop)) {
  if (file_ < 0) throw InputError(file + ": cannot be read");
}

PolledInput::~PolledInput() {
  close(file_);
}

PolledInput::int_type PolledInput::underflow() {
  constexpr int kPatience_ms = 100;
  while (!stop_.stop_requested()) {
    pollfd ready{.fd = file_, .events = POLLIN, .revents = 0};
    if (poll(&ready, 1, kPatience_ms) <= 0) continue;
    const ssize_t count = read(file_, part_.data(), part_.size());
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (count <= 0) break;
    setg(part_.data(), part_.data(), part_.data() + count);
    return traits_type::to_int_type(part_.front());
  }
  return traits_type::eof();
}

}  // namespace regoplan
