#include "terramech/basics/input_error.h"

#include <fmt/format.h>

#include <utility>

namespace regoplan {

ValueError::ValueError(std::string field, double value, std::string allowed)
    : InputError(fmt::format("{}: {} is not valid (allowed: {})", field, value, allowed)),
      field_(std::move(field)),
      value_(value),
      allowed_(std::move(allowed)) {}

}  // namespace regoplan
