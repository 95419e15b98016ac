#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "planner/problem/limits.h"
#include "python/physics/bindings.h"
#include "python/physics/columns.h"
#include "python/physics/row_blocks.h"
#include "python/physics/vehicle_on_soil.h"

namespace regoplan::python {
namespace {

namespace py = pybind11;

constexpr ValueRange kSlope{.min = -1.4, .max = 1.4};  // 80 deg: a tangent that is a number

/// The arguments of every function of a moment, in this order.
constexpr std::array<const char*, 5> kMoment{"speed_mps", "curvature_1pm", "acceleration_mps2",
                                             "slope_forward_rad", "slope_left_rad"};

/// A curvature beyond 1/|x_c| has no turn centre.
Columns moment_columns(const VehicleOnSoil& vehicle, const std::vector<py::array>& arguments) {
  const double most_1pm = vehicle.vehicle().curvature_max_1pm;
  const std::array<ValueRange, kMoment.size()> allowed{
      kAtLeast0, {.min = -most_1pm, .max = most_1pm}, kAnyNumber, kSlope, kSlope};
  std::vector<Columns::Column> columns;
  for (std::size_t i = 0; i < kMoment.size(); ++i) {
    columns.push_back({{kMoment.at(i), arguments.at(i)}, allowed.at(i)});
  }
  return Columns(std::move(columns));
}

/// One of `count` rows, which stand in `values` column after column.
Moment moment_at(std::span<const double> values, std::size_t row, std::size_t count) {
  const auto at = [&](std::size_t column) { return values[column * count + row]; };
  return {.speed_mps = at(0),
          .curvature_1pm = at(1),
          .acceleration_mps2 = at(2),
          .slope_forward_rad = at(3),
          .slope_left_rad = at(4)};
}

/// Rows one by one: each is a manoeuvre that is solved, tens of microseconds or more.
template <class Work>
void for_each_moment(const Columns& columns, int threads, const Work& work) {
  for_each_block(columns.rows(), kManoeuvres, threads, [&](std::size_t first, std::size_t count) {
    std::vector<double> values;
    columns.read(first, count, values);
    for (std::size_t i = 0; i < count; ++i) {
      work(first + i, moment_at(values, i, count));
    }
  });
}

class Outputs {
 public:
  Outputs(std::size_t columns, const Shape& shape) {
    for (std::size_t i = 0; i < columns; ++i) {
      arrays_.push_back(new_array(shape));
      to_.push_back(arrays_.back().mutable_data());
    }
  }
  double& at(std::size_t column, std::size_t row) const { return to_[column][row]; }
  py::tuple tuple() const { return py::tuple(py::cast(arrays_)); }

 private:
  std::vector<py::array_t<double>> arrays_;
  std::vector<double*> to_;
};

py::tuple margins(const VehicleOnSoil& vehicle, const std::vector<py::array>& arguments,
                  int threads) {
  const Columns columns = moment_columns(vehicle, arguments);
  const Outputs out(7, columns.shape());
  for_each_moment(columns, threads, [&](std::size_t row, const Moment& moment) {
    const StateMargins m = vehicle.margins(moment);
    out.at(0, row) = m.demand_n;
    out.at(1, row) = m.supply ? m.supply->right_n : kNone;
    out.at(2, row) = m.supply ? m.supply->left_n : kNone;
    // Without supply nothing tells by how much it fails; with it the chart's number does.
    const double traction = m.supply ? m.counted_traction() : kNone;
    out.at(3, row) = m.cornering.value_or(kNone);
    out.at(4, row) = m.tip_over;
    out.at(5, row) = traction;
    out.at(6, row) = m.supply ? std::min({*m.cornering, m.tip_over, traction}) : kNone;
  });
  return out.tuple();
}

py::tuple largest_safe_curvature(const VehicleOnSoil& vehicle, const py::array& speed_mps,
                                 const py::array& slope_left_rad, double margin_min, int threads) {
  const auto limit = std::ranges::find(limit_keys(), "margin_min", &LimitKey::key);
  require(std::string(limit->key), margin_min, limit->shown_range);
  const Columns columns({{{"speed_mps", speed_mps}, kAtLeast0},
                         {{"slope_left_rad", slope_left_rad}, {.min = 0, .max = 1.4}}});
  const Outputs out(2, columns.shape());
  std::vector<std::string> limits(columns.rows());
  for_each_block(columns.rows(), kManoeuvres, threads, [&](std::size_t first, std::size_t count) {
    std::vector<double> values;
    columns.read(first, count, values);
    for (std::size_t i = 0; i < count; ++i) {
      const SafeCurvature found =
          vehicle.largest_safe_curvature(values[i], values[count + i], margin_min);
      out.at(0, first + i) = found.curvature_1pm;
      out.at(1, first + i) = found.supply_n;
      limits[first + i] = found.limit;
    }
  });
  return out.tuple() + py::make_tuple(limits);
}

py::dict end_dict(const SupplyEnd& end, const Vehicle& vehicle) {
  py::dict dict;
  dict["force_n"] = end.force_n;
  dict["limit"] = std::string(name(end.limit));
  dict["wheel"] = end.wheel < 0
                      ? py::object(py::none())
                      : py::cast(vehicle.wheels[static_cast<std::size_t>(end.wheel)].name);
  dict["fold_n"] = end.fold_n;
  dict["understeer_1pm"] = end.understeer_1pm;
  return dict;
}

Moment one_moment(const Columns& columns) {
  std::vector<double> values;
  columns.read(0, 1, values);
  return moment_at(values, 0, 1);
}

py::dict supply(const VehicleOnSoil& vehicle, const std::vector<py::array>& arguments) {
  const Moment moment = one_moment(moment_columns(vehicle, arguments));
  const SupplyResult result = vehicle.supply(moment);
  py::dict dict;
  if (result.supply) {
    dict["right"] = end_dict(result.supply->right, vehicle.vehicle());
    dict["left"] = end_dict(result.supply->left, vehicle.vehicle());
    dict["reason"] = py::none();
  } else {
    dict["right"] = py::none();
    dict["left"] = py::none();
    dict["reason"] = name(result.reason);
  }
  return dict;
}

py::dict wheel_dict(const TrimmedWheel& wheel, const std::string& name_of_wheel) {
  py::dict dict;
  dict["wheel"] = name_of_wheel;
  dict["load_n"] = wheel.load_n;
  dict["steer_rad"] = wheel.steer_rad;
  dict["slip_ratio"] = wheel.slip;
  dict["slip_angle_rad"] = wheel.slip_angle_rad;
  dict["fx_n"] = wheel.forces.fx_n;
  dict["fy_n"] = wheel.forces.fy_n;
  dict["torque_nm"] = wheel.forces.torque_nm;
  dict["sinkage_m"] = wheel.forces.sinkage_m;
  dict["status"] = std::string(name(wheel.forces.status));
  return dict;
}

py::dict trim(const VehicleOnSoil& vehicle, const std::vector<py::array>& arguments) {
  const TrimAnswer answer = vehicle.trim(one_moment(moment_columns(vehicle, arguments)));
  const std::vector<WheelMount>& mounts = vehicle.vehicle().wheels;
  py::dict dict;
  dict["found"] = answer.trim.has_value();
  dict["limit"] = answer.trim ? py::object(py::none()) : py::cast(answer.limit);
  dict["wheel"] = answer.wheel < 0 ? py::object(py::none())
                                   : py::cast(mounts[static_cast<std::size_t>(answer.wheel)].name);
  if (!answer.trim) return dict;
  dict["forward_n"] = answer.trim->force.forward_n;
  dict["left_n"] = answer.trim->force.left_n;
  dict["body_slip_angle_rad"] = answer.trim->body_slip_angle_rad;
  dict["steer_curvature_1pm"] = answer.trim->steer_curvature_1pm;
  dict["drive_factor"] = answer.trim->drive_factor;
  py::list wheels;
  for (std::size_t i = 0; i < mounts.size(); ++i) {
    wheels.append(wheel_dict(answer.trim->wheels[i], mounts[i].name));
  }
  dict["wheels"] = wheels;
  return dict;
}

std::vector<std::string> moment_names() {
  return {kMoment.begin(), kMoment.end()};
}

}  // namespace

void bind_vehicles(py::module_& module) {
  py::class_<Vehicle>(module, "VehicleSource").def("settings", &vehicle_settings);
  module.def("vehicle_from", &vehicle_from);
  module.def("vehicle_from_file", &vehicle_from_file);
  module.def("preset_vehicle", &preset_vehicle);
  module.def("preset_vehicle_names", &preset_vehicle_names);
  module.def("moment_names", &moment_names);
  module.attr("MARGIN_MIN") = default_limits({}).margin_min;
  py::class_<VehicleOnSoil>(module, "VehicleOnSoil")
      .def(py::init<Vehicle, WheelSource, double>())
      .def("margins", &margins)
      .def("largest_safe_curvature", &largest_safe_curvature)
      .def("supply", &supply)
      .def("trim", &trim);
}

}  // namespace regoplan::python
