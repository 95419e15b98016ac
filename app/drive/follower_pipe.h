#pragma once

#include <iosfwd>
#include <stop_token>
#include <string>

#include "app/io/polled_input.h"
#include "planner/following/follower.h"

namespace regoplan {

/// Asks a follower that runs in another process, a line of JSON each way before every step; keys in
/// docs/drive.md.
class FollowerPipe {
 public:
  /// \param descriptors `OUT,IN`: file descriptors that are open, for what is seen and for what is
  /// commanded \throws InputError where they are not so
  FollowerPipe(const std::string& descriptors, std::stop_token stop);

  /// \throws InputError where the other end has gone, or its line is no command
  VehicleControl operator()(const FollowerView& view);

 private:
  int out_ = -1;
  PolledInput buffer_;
  std::istream in_;
  std::stop_token stop_;
};

}  // namespace regoplan
