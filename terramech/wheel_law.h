#pragma once

#include "terramech/wheel_model.h"

namespace regoplan {

/// A view of whatever gives the forces of one wheel on one soil: the direct model, a table of it.
/// Does not own; the source must outlive it.
class WheelLaw {
 public:
  template <class Source>
  explicit WheelLaw(const Source& source)
      : source_(&source), forces_([](const void* self, double load_n, const WheelMotion& motion) {
          return static_cast<const Source*>(self)->forces(load_n, motion);
        }) {}

  /// \param load_n above 0
  WheelForces forces(double load_n, const WheelMotion& motion) const {
    return forces_(source_, load_n, motion);
  }

 private:
  const void* source_;
  WheelForces (*forces_)(const void*, double, const WheelMotion&);
};

}  // namespace regoplan
