#pragma once

#include <array>
#include <optional>

#include "terramech/wheel/wheel_contact.h"

namespace regoplan::wheel_contact {

/// A contact that carries the load with Q = 1. The resultant belongs to the very entry angle at
/// which Fz equals the load.
struct Equilibrium {
  Contact contact;
  Resultant resultant;
};

/// Finds the entry angle whose contact carries a load: the smallest at which Fz rises through it.
///
/// Starts from a small table made at construction (a few hundredths of a millisecond), in which the
/// smallest root was looked up; secant steps in (ln theta_f, ln Fz), where Fz is nearly a power,
/// end after two or three integrals. Where they do not end on a rising branch, a sure search.
class SinkageSolver {
 public:
  explicit SinkageSolver(const Ground& ground);
  /// Starts from the table of another soil under the same wheel.
  SinkageSolver(const Ground& ground, const SinkageSolver& near);

  /// Nothing where no sinkage below the radius carries the load.
  std::optional<Equilibrium> solve(const Ground& ground, double load_n, const Ratios& ratios,
                                   WheelAccuracy accuracy) const;

 private:
  static constexpr std::size_t kSlips = 11;  ///< slip = t |t|, t uniform in [-1, 1]
  static constexpr std::size_t kLoads = 24;  ///< uniform in ln(load)

  /// ln theta_f over slip and ln(load) at one shear modulus.
  struct Table {
    double kx_m = 0;
    double log_load_min = 0, log_load_step = 1;
    std::array<std::array<double, kLoads>, kSlips> log_theta_f{};
  };

  struct Guess {
    double log_theta_f;
    double slope;  ///< d ln Fz / d ln theta_f
  };
  static Table tabulate(const Ground& ground, double beta_abs_rad);
  Guess look_up(const Table& table, double log_load, const Ratios& ratios, double kx_m) const;
  Guess guess(const Ground& ground, double load_n, const Ratios& ratios) const;

  double power_ = 3;  ///< of Fz in theta_f where the contact is shallow
  bool kx_varies_ = false;
  Table straight_;       ///< at slip angle 0
  Table at_slip_angle_;  ///< at 1 rad, where kx depends on the slip angle
};

}  // namespace regoplan::wheel_contact
