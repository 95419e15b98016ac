#pragma once

#include <optional>

#include "terramech/wheel/mechanism_contact.h"

namespace regoplan {

/// A wheel in a rut that is deeper on the inner side (towards the centre of the turn): strips
/// across its width, h(y) = h + y tan(psi), each in contact on its own.
class RutStrips {
 public:
  /// \param ground, ratios must outlive it
  RutStrips(const wheel_contact::Ground& ground, const wheel_contact::Ratios& ratios,
            const wheel_contact::StressLaw& law, double tilt_rad, WheelAccuracy accuracy)
      : ground_(ground),
        ratios_(ratios),
        law_(law),
        tilt_rad_(tilt_rad),
        count_(tilt_rad == 0 ? 1 : kStrips),
        accuracy_(accuracy) {}

  /// All strips together, the wheel's middle at a depth.
  wheel_contact::LawIntegrals together(double sinkage_m) const;

  /// The entry angle of the wheel's middle at which the strips together carry the load with Q = 1:
  /// the first crossing outward from a guess. Nothing where none carries it.
  std::optional<double> entry_angle(double load_n, double guess_rad) const;

  struct Sideways {
    double force_n = 0;  ///< |Fy|
    double roll_nm = 0;  ///< of the vertical force, positive: more on the inner side
  };
  /// Side force and roll moment where the strips carry the load with the factor Q.
  Sideways sideways(double sinkage_m, double q, double load_n) const;

 private:
  static constexpr std::size_t kStrips = 7;

  struct Strip {
    double inner_m = 0;  ///< from the wheel's middle, towards the centre of the turn
    wheel_contact::Contact contact;
    wheel_contact::LawIntegrals integrals;
  };
  Strip strip(std::size_t i, double sinkage_m) const;

  /// The base model's integrals serve, strip by strip; theirs of the side force come as a whole.
  bool is_base_law() const {
    return law_.shear == ShearLaw::kSeparate && law_.layering.kind == Layering::Kind::kNone;
  }

  const wheel_contact::Ground& ground_;
  const wheel_contact::Ratios& ratios_;
  wheel_contact::StressLaw law_;
  double tilt_rad_;
  std::size_t count_;
  WheelAccuracy accuracy_;
};

}  // namespace regoplan
