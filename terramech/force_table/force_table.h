#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "terramech/force_table/force_table_values.h"
#include "terramech/wheel/sloped_forces.h"
#include "terramech/wheel/wheel_model.h"

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
/// A generic correction is no part of the splines: it is added to what they give.
/// It covers slips from -0.92 to 0.97 and slip angles to 62 deg (force_table_axes.h); beyond, and
/// beyond its loads, the direct model answers.
class ForceTable {
 public:
  /// Refines the axes, each by its own error, until the check against the direct model is within
  /// the accuracy asked; where the largest loads are barely carried and stay out of reach of that,
  /// the table covers fewer loads.
  /// \throws ValueError naming a field of the model out of range, or a nominal load that is not
  /// positive \throws InputError where no table reaches the accuracy, or where the forces depend on
  /// the speed itself, as with some mechanisms
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

  /// Many states at once. Not carried: zero forces, as in WheelForces.
  /// \throws InputError for arrays of different length
  std::vector<PlaneForces> plane_forces(std::span<const double> loads_n,
                                        std::span<const WheelMotion> motions) const;

  const TableError& error() const { return error_; }
  double load_min_n() const { return values_.axes.load_min_n; }
  double load_max_n() const { return values_.axes.load_max_n; }
  std::size_t bytes() const;
  const WheelModel& direct() const { return direct_; }

  /// Compares with the direct model (kExact) in random states and in as many near the corners of
  /// the domain: loads at both ends, slip near 0 and the ends, slip angle near 0 and the end.
  TableError check(std::size_t random_states, std::size_t corner_states, std::uint64_t seed) const;

 private:
  ForceTable(const ForceTableSpec& spec, force_table::Values values, const TableError& error);
  bool refine(const WheelModel& model, const force_table::Axes& axes,
              const force_table::ConstantShares& constant, const TableAccuracy& accuracy);
  double excess_along(std::size_t force_table::Sizes::*axis, const TableAccuracy& accuracy,
                      std::mt19937_64& random) const;
  force_table::Axes with_fewer_loads(force_table::Axes axes) const;
  double error_in(double load_n, const WheelMotion& motion) const;
  static std::optional<ForceTable> read(std::istream& stream, const ForceTableSpec& spec);
  void write(std::ostream& stream) const;

  ForceTableSpec spec_;
  WheelModel direct_;
  force_table::Values values_;
  TableError error_;
};

}  // namespace regoplan
