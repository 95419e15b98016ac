#pragma once

#include <string>
#include <vector>

#include "planner/course/path_curve.h"
#include "planner/course/speed_profile.h"
#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan {

/// A moment of a leg that was driven before, with what was commanded there.
struct RecordedMoment {
  double s_m = 0;     ///< along the leg's curve
  double time_s = 0;  ///< from the start of the whole path
  VehicleState state;
};

/// A curve and the speed along it, driven in one direction. The commanded curvature is the curve's,
/// or that of a record, where there is one.
struct PathLeg {
  PathCurve curve;
  SpeedProfile speed;
  std::vector<RecordedMoment> recorded = {};
  bool reverse = false;  ///< all of it is driven backwards
  double stands_s = 0;   ///< before it, while the wheels are steered

  double length_m() const { return curve.length_m(); }
  double duration_s() const { return stands_s + speed.duration_s(curve.length_m()); }
  /// 1 ahead, -1 in reverse.
  int direction() const { return reverse ? -1 : 1; }
  /// Commanded curvature, as the vehicle counts it: in reverse a curve that bends to the left of
  /// the way lies to the right of the vehicle.
  double curvature_1pm(double s_m) const;
  /// The record's state there, linear between its moments. \pre there is a record
  VehicleState recorded_at(double s_m) const;
  /// The vehicle on the curve at s_m, slip-free: it heads where Ackermann steering has it head.
  VehicleState state_at(const Vehicle& vehicle, double s_m) const;
};

/// What is to be driven: legs between which the vehicle stands and changes its direction.
struct ReferencePath {
  /// A place of the whole, told by the way from the start of the first leg.
  struct Place {
    const PathLeg& leg;
    double leg_start_s = 0;  ///< time to the leg's start
    double s_m = 0;          ///< along the leg
    CurvePlace on_curve() const { return leg.curve.at(s_m); }
    SpeedProfile::Value speed() const { return leg.speed.at(s_m); }
    double time_s() const { return leg_start_s + leg.stands_s + leg.speed.duration_s(s_m); }
  };

  std::string name;           ///< of a file or a manoeuvre
  std::vector<PathLeg> legs;  ///< at least one; each begins about where the one before ends
  bool goes_on = false;  ///< a piece of a drive: where it ends at speed, no room to stop is asked

  double length_m() const { return leg_start_m(legs.size()); }
  double duration_s() const;
  double speed_max_mps() const;
  /// Whoever takes longer does not get on: twice its time, and what starts and short steps take.
  double patience_s(double step_s) const { return 2 * duration_s() + 20 + 200 * step_s; }
  /// Way to the start of a leg; of one beyond the last, the whole.
  double leg_start_m(std::size_t leg) const;
  /// Where one leg ends and another begins, a place is of the latter.
  Place place(double s_m) const;
  CurvePlace end() const { return legs.back().curve.at(legs.back().length_m()); }
};

/// \throws ValueError for a path without legs, or a leg whose speeds end before its curve does
void validate(const ReferencePath& path);

/// Where a drive along the path begins: the first moment of its record, or its first place.
VehicleState start_of(const ReferencePath& path, const Vehicle& vehicle);

/// Distance between the foremost and the rearmost axle.
double wheelbase_m(const Vehicle& vehicle);

/// The place of a curve nearest to a position, not far from where it was.
double nearest_m(const PathCurve& curve, double x_m, double y_m, double s_m);

/// How far to the left of a place of the path a position lies.
double offset_m(const CurvePlace& place, double x_m, double y_m);

}  // namespace regoplan
