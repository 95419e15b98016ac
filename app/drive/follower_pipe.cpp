#include "app/drive/follower_pipe.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <nlohmann/json.hpp>

#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kOption = "--follower-fds";

struct Descriptors {
  int out = -1, in = -1;
};

Descriptors descriptors_of(const std::string& text) {
  Descriptors found;
  const char* const end = text.data() + text.size();
  const auto out = std::from_chars(text.data(), end, found.out);
  const bool comma = out.ec == std::errc() && out.ptr != end && *out.ptr == ',';
  const auto in = std::from_chars(comma ? out.ptr + 1 : end, end, found.in);
  const bool open = comma && in.ec == std::errc() && in.ptr == end &&
                    fcntl(found.out, F_GETFD) != -1 && fcntl(found.in, F_GETFD) != -1;
  if (!open) {
    throw InputError(
        fmt::format("{}: {} is not valid (allowed: OUT,IN, two file descriptors that are open)",
                    kOption, text));
  }
  return found;
}

std::string line_of(const FollowerView& view) {
  const VehicleState& seen = view.seen;
  const Json told{{"time_s", view.time_s},
                  {"x_m", seen.x_m},
                  {"y_m", seen.y_m},
                  {"yaw_rad", seen.yaw_rad},
                  {"forward_mps", seen.motion.vx_mps},
                  {"left_mps", seen.motion.vy_mps},
                  {"yaw_rate_rad_s", seen.motion.yaw_rate_rad_s},
                  {"rim_speed_mps", seen.rim_speed_mps},
                  {"curvature_1pm", seen.curvature_1pm},
                  {"crab_rad", seen.crab_rad},
                  {"s_m", view.s_m},
                  {"length_m", view.length_m},
                  {"offset_m", view.offset_m},
                  {"heading_error_rad", view.heading_error_rad},
                  {"path_speed_mps", view.path_speed_mps},
                  {"path_curvature_1pm", view.path_curvature_1pm}};
  return told.dump() + "\n";
}

/// \returns whether all of it was taken
bool write_all(int file, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

VehicleControl control_of(const std::string& line) {
  try {
    const Json command = Json::parse(line);
    VehicleControl control{.speed_target_mps = command.at("speed_mps").get<double>(),
                           .curvature_target_1pm = command.at("curvature_1pm").get<double>()};
    if (command.contains("crab_rad"))
      control.crab_target_rad = command.at("crab_rad").get<double>();
    for (const auto& [key, value] : command.items()) {
      if (key == "speed_mps" || key == "curvature_1pm" || key == "crab_rad") continue;
      throw InputError(
          fmt::format("follower: {}: unknown key (known: speed_mps, curvature_1pm, "
                      "crab_rad)",
                      key));
    }
    return control;
  } catch (const Json::exception&) {
    throw InputError(fmt::format(
        "follower: {} is no command (allowed: {{\"speed_mps\": ..., \"curvature_1pm\": ...}})",
        line.substr(0, 200)));
  }
}

}  // namespace

FollowerPipe::FollowerPipe(const std::string& descriptors, std::stop_token stop)
    : out_(descriptors_of(descriptors).out),
      buffer_(fmt::format("/proc/self/fd/{}", descriptors_of(descriptors).in), stop),
      in_(&buffer_),
      stop_(std::move(stop)) {
  std::signal(SIGPIPE, SIG_IGN);  // a follower that has gone is an error, not the end of this
}

VehicleControl FollowerPipe::operator()(const FollowerView& view) {
  const bool told = write_all(out_, line_of(view));
  std::string line;
  if (told && std::getline(in_, line)) return control_of(line);
  if (stop_.stop_requested()) return {};  // the step that follows is not taken
  throw InputError("follower: it has ended without a command");
}

}  // namespace regoplan
