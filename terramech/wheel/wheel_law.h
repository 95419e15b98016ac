#pragma once

#include <concepts>

#include "terramech/wheel/sloped_forces.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// A view of whatever gives the forces of one wheel on one soil: the direct model, a table of it.
/// Does not own; the source must outlive it.
class WheelLaw {
 public:
  /// A source that also has `forces_with_slopes` saves its users differences.
  template <class Source>
  explicit WheelLaw(const Source& source)
      : source_(&source), forces_([](const void* self, double load_n, const WheelMotion& motion) {
          return static_cast<const Source*>(self)->forces(load_n, motion);
        }) {
    if constexpr (requires { source.forces_with_slopes(1.0, WheelMotion{}); }) {
      forces_with_slopes_ = [](const void* self, double load_n, const WheelMotion& motion) {
        return static_cast<const Source*>(self)->forces_with_slopes(load_n, motion);
      };
    }
  }

  template <class Source>
  requires(!std::same_as<Source, WheelLaw>) explicit WheelLaw(const Source&& gone) = delete;

  /// \param load_n above 0
  WheelForces forces(double load_n, const WheelMotion& motion) const {
    return forces_(source_, load_n, motion);
  }

  bool has_slopes() const { return forces_with_slopes_ != nullptr; }

  /// \pre `has_slopes()`
  SlopedForces forces_with_slopes(double load_n, const WheelMotion& motion) const {
    return forces_with_slopes_(source_, load_n, motion);
  }

 private:
  const void* source_;
  WheelForces (*forces_)(const void*, double, const WheelMotion&);
  SlopedForces (*forces_with_slopes_)(const void*, double, const WheelMotion&) = nullptr;
};

}  // namespace regoplan
