#pragma once

#include <array>
#include <stop_token>
#include <streambuf>
#include <string>

namespace regoplan {

/// A file or pipe that is read while it comes, and ends early when a stop is requested: reading of
/// the standard library waits for a pipe whatever signals come.
class PolledInput : public std::streambuf {
 public:
  /// \throws InputError where it cannot be opened
  PolledInput(const std::string& file, std::stop_token stop);
  ~PolledInput() override;
  PolledInput(const PolledInput&) = delete;
  PolledInput& operator=(const PolledInput&) = delete;

 protected:
  int_type underflow() override;

 private:
  int file_;
  std::stop_token stop_;
  std::array<char, 65536> part_{};
};

}  // namespace regoplan
