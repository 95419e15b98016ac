#pragma once

#include <string>
#include <vector>

#include "planner/course/path_curve.h"
#include "planner/course/speed_profile.h"
#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan {

/// A moment of a path that was driven before, with what was commanded there.
struct RecordedMoment {
  double s_m = 0;  ///< along the curve
  double time_s = 0;
  VehicleState state;
};

/// What is to be driven: a curve and the speed along it. The commanded curvature is the curve's, or
/// that of a record, where there is one.
struct ReferencePath {
  std::string name;  ///< of a file or a manoeuvre
  PathCurve curve;
  SpeedProfile speed;
  std::vector<RecordedMoment> recorded = {};
  bool reverse = false;  ///< all of it is driven backwards
  bool goes_on = false;  ///< a piece of a drive: where it ends at speed, no room to stop is asked

  /// Commanded curvature, as the vehicle counts it: in reverse a path that bends to the left of the
  /// way lies to the right of the vehicle.
  double curvature_1pm(double s_m) const;
  /// The record's state there, linear between its moments. \pre there is a record
  VehicleState recorded_at(double s_m) const;
  /// The vehicle on the path at s_m, slip-free: it heads where Ackermann steering has it head.
  VehicleState state_at(const Vehicle& vehicle, double s_m) const;
};

/// Where a drive along the path begins: the first moment of its record, or its first place.
VehicleState start_of(const ReferencePath& path, const Vehicle& vehicle);

/// Distance between the foremost and the rearmost axle.
double wheelbase_m(const Vehicle& vehicle);

/// The place of the path nearest to a position, not far from where it was.
double nearest_m(const PathCurve& curve, double x_m, double y_m, double s_m);

/// How far to the left of a place of the path a position lies.
double offset_m(const CurvePlace& place, double x_m, double y_m);

}  // namespace regoplan
