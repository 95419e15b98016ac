#pragma once

#include <stdexcept>
#include <string>

namespace regoplan {

/// Bad input: the message is one line that a person can act on. Whoever knows the file and the line
/// puts them in front.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One field whose value lies outside its valid range.
class ValueError : public InputError {
 public:
  /// \param field name as it stands in files, unit included (`friction_angle_deg`)
  /// \param value in that unit
  /// \param allowed the valid range in words ("0 to 60")
  ValueError(std::string field, double value, std::string allowed);

  const std::string& field() const { return field_; }
  double value() const { return value_; }
  const std::string& allowed() const { return allowed_; }

 private:
  std::string field_;
  double value_;
  std::string allowed_;
};

}  // namespace regoplan
