#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <vector>

#include "terramech/sloped_forces.h"
#include "terramech/wheel_model.h"

namespace regoplan {

/// How far a table may differ from the direct model: of |dFx| and |dFy| over max(load, 10 % of the
/// nominal load).
struct TableAccuracy {
  double at_999_permille = 1e-3;  ///< 99.9 % of states are within this
  double at_worst = 5e-3;         ///< all are
};

/// What a table is built from.
struct ForceTableSpec {
  WheelModelSpec model;
  double nominal_load_n = 0;  ///< the table covers 2 to 300 % of it, as far as they are carried
  TableAccuracy accuracy = {};
};

/// What a check of a table against the direct model measured.
struct TableError {
  double at_999_permille = 0;
  double at_worst = 0;
  std::size_t states = 0;

  bool within(const TableAccuracy& accuracy) const {
    return at_999_permille <= accuracy.at_999_permille && at_worst <= accuracy.at_worst;
  }
};

/// The two forces in the plane of the ground, signs as in WheelForces.
struct PlaneForces {
  double fx_n = 0;
  double fy_n = 0;
};

/// The wheel model of one wheel on one soil as cubic splines, immutable: a fiftieth of the direct
/// model's time, with slopes, and with a measured bound on its error.
///
/// Axes: ln(load); the root of |slip|, braking and driving apart, because the forces have a corner
/// at slip 0; for Fx and T v = beta/(beta + kx0/kx1), in which they are cubics; for Fy the lateral
/// displacement as y = u/(u + 3 ky/(r dtheta)), in which Fy has no corners. It covers slips from
/// -0.92 to 0.97 and slip angles to 62 deg; beyond, and beyond its loads, the direct model answers.
/// A generic correction is no part of the splines: it is added to what they give.
class ForceTable {
 public:
  /// Refines until the check against the direct model is within the accuracy asked; where the
  /// largest loads are barely carried and stay out of reach of that, the table covers fewer loads.
  /// \throws ValueError naming a field of the model out of range, or a nominal load that is not
  /// positive \throws InputError where no table reaches the accuracy
  explicit ForceTable(const ForceTableSpec& spec);

  /// The table from the cache folder, or a new one that is put there. The file is named by a hash
  /// of all that the table depends on; one that cannot be read or is corrupt is built again, and
  /// nothing is said where the folder cannot be written: the cache only saves time.
  static ForceTable cached(const ForceTableSpec& spec,
                           const std::filesystem::path& folder = default_cache_folder());

  /// $XDG_CACHE_HOME/regoplan, or ~/.cache/regoplan; empty where neither is known: no cache.
  static std::filesystem::path default_cache_folder();

  /// Whether the table itself answers.
  bool covers(double load_n, const WheelMotion& motion) const;

  /// As WheelModel::forces; where the table answers, without the contact's angles (they are 0).
  /// \throws ValueError as WheelModel::forces
  WheelForces forces(double load_n, const WheelMotion& motion) const;

  /// Forces in the plane with their slopes; outside the table by differences of the direct model.
  SlopedForces forces_with_slopes(double load_n, const WheelMotion& motion) const;

  /// The forces in the plane alone, the fastest answer to one state.
  PlaneForces plane_forces(double load_n, const WheelMotion& motion) const;

  /// Many states at once. Not carried: zero forces, as in WheelForces.
  /// \throws InputError for arrays of different length
  std::vector<PlaneForces> plane_forces(std::span<const double> loads_n,
                                        std::span<const WheelMotion> motions) const;

  const TableError& error() const { return error_; }
  double load_min_n() const { return load_min_n_; }
  double load_max_n() const { return load_max_n_; }
  std::size_t bytes() const;
  const WheelModel& direct() const { return direct_; }

  /// Compares with the direct model (kExact) in random states and in as many near the corners of
  /// the domain: loads at both ends, slip near 0 and the ends, slip angle near 0 and the end.
  TableError check(std::size_t random_states, std::size_t corner_states, std::uint64_t seed) const;

 private:
  struct Grid {
    std::size_t loads = 0, slips = 0, laterals = 0;
  };
  /// Coefficients [load][slip][4 powers of v] and [load][slip][y] on one side of slip 0.
  struct Side {
    std::vector<float> fx, torque, sinkage, fy;
  };
  struct Place;
  struct Sloped;

  ForceTable(const ForceTableSpec& spec, const Grid& grid);
  static std::optional<ForceTable> read(std::istream& stream, const ForceTableSpec& spec);
  void write(std::ostream& stream) const;
  void fill();
  void scale_loads();
  Side fill_side(const WheelModel& model, bool driving) const;
  void limit_loads();
  double lateral_scale(double angle_rad) const;
  double v_at(double tangent) const;
  WheelMotion motion_with_lateral(double slip, double y) const;
  bool place(double load_n, const WheelMotion& motion, Place& place) const;

  ForceTableSpec spec_;
  WheelModel direct_;
  Grid grid_;
  double load_min_n_ = 0, load_max_n_ = 0;
  double ky_scale_ = 0;      ///< 3/(r dtheta) at the nominal load
  double kx_angle_rad_ = 0;  ///< kx0/kx1
  double log_load_min_ = 0, loads_per_log_ = 0;
  std::array<Side, 2> sides_;  ///< braking, driving
  TableError error_;
};

}  // namespace regoplan
