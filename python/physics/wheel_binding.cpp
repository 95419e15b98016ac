#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <numbers>

#include "app/settings/scenario_settings.h"
#include "python/physics/bindings.h"
#include "python/physics/columns.h"
#include "python/physics/row_blocks.h"
#include "python/physics/wheel_source.h"
#include "terramech/wheel/cornering_force.h"

namespace regoplan::python {
namespace {

namespace py = pybind11;

constexpr ValueRange kLoad{.min = 0};
constexpr ValueRange kSlip{.min = -1, .max = 1};
// As `motion_at`: a quarter turn in degrees comes back a little larger.
constexpr double kQuarterTurn = std::numbers::pi / 2 * (1 + 1e-15);
constexpr ValueRange kAngle{.min = -kQuarterTurn, .max = kQuarterTurn};

Columns load_slip_angle(const py::array& load_n, const py::array& slip_ratio,
                        const py::array& slip_angle_rad) {
  return Columns({{{"load_n", load_n}, kLoad},
                  {{"slip_ratio", slip_ratio}, kSlip},
                  {{"slip_angle_rad", slip_angle_rad}, kAngle}});
}

/// Where results go.
struct ForceColumns {
  explicit ForceColumns(const Shape& shape)
      : arrays{new_array(shape), new_array(shape), new_array(shape), new_array(shape)},
        status(shape) {
    for (std::size_t i = 0; i < arrays.size(); ++i) to.at(i) = arrays.at(i).mutable_data();
    status_to = status.mutable_data();
  }

  void put(std::size_t row, const WheelForces& forces) {
    const bool any = has_forces(forces.status);
    to[0][row] = any ? forces.fx_n : kNone;
    to[1][row] = any ? forces.fy_n : kNone;
    to[2][row] = any ? forces.torque_nm : kNone;
    to[3][row] = any ? forces.sinkage_m : kNone;
    status_to[row] = static_cast<std::uint8_t>(forces.status);
  }

  py::tuple tuple() const {
    return py::make_tuple(arrays[0], arrays[1], arrays[2], arrays[3], status);
  }

  std::array<py::array_t<double>, 4> arrays;
  py::array_t<std::uint8_t> status;
  std::array<double*, 4> to{};
  std::uint8_t* status_to;
};

template <class Source>
void force_rows(const Source& source, const Columns& columns, int threads, ForceColumns& out) {
  for_each_block(columns.rows(), kWheelRows, threads, [&](std::size_t first, std::size_t count) {
    std::vector<double> values;
    columns.read(first, count, values);
    const double *load = values.data(), *slip = load + count, *angle = slip + count;
    for (std::size_t i = 0; i < count; ++i) {
      out.put(first + i, source.forces(load[i], motion_at(slip[i], angle[i])));
    }
  });
}

py::tuple forces(const WheelSource& wheel, const py::array& load_n, const py::array& slip_ratio,
                 const py::array& slip_angle_rad, int threads) {
  const Columns columns = load_slip_angle(load_n, slip_ratio, slip_angle_rad);
  ForceColumns out(columns.shape());
  if (wheel.table) {
    force_rows(*wheel.table, columns, threads, out);
  } else {
    force_rows(*wheel.direct, columns, threads, out);
  }
  return out.tuple();
}

/// In the plane only, many at once: what a table does fastest.
py::tuple plane_forces(const WheelSource& wheel, const py::array& load_n,
                       const py::array& slip_ratio, const py::array& slip_angle_rad, int threads) {
  const Columns columns = load_slip_angle(load_n, slip_ratio, slip_angle_rad);
  py::array_t<double> fx = new_array(columns.shape()), fy = new_array(columns.shape());
  double *fx_n = fx.mutable_data(), *fy_n = fy.mutable_data();
  for_each_block(columns.rows(), kWheelRows, threads, [&](std::size_t first, std::size_t count) {
    std::vector<double> values;
    columns.read(first, count, values);
    const double *load = values.data(), *slip = load + count, *angle = slip + count;
    std::vector<WheelMotion> motions(count);
    for (std::size_t i = 0; i < count; ++i) motions[i] = motion_at(slip[i], angle[i]);
    const std::vector<PlaneForces> found = wheel.table->plane_forces({load, count}, motions);
    for (std::size_t i = 0; i < count; ++i) {
      fx_n[first + i] = found[i].fx_n;
      fy_n[first + i] = found[i].fy_n;
    }
  });
  return py::make_tuple(fx, fy);
}

/// What some mechanisms need to know beside load and motion, in the order of the arguments.
constexpr std::array<std::pair<const char*, ValueRange>, 7> kCircumstances{
    {{"speed_mps", kAtLeast0},
     {"position_m", kAnyNumber},
     {"time_s", kAnyNumber},
     {"heading_rad", kAnyNumber},
     {"wheel_angle_rad", kAnyNumber},
     {"sinkage_offset_m", kAnyNumber},
     {"pass_number", {.min = 1, .max = 1e6}}}};

std::vector<std::string> condition_names() {
  std::vector<std::string> names;
  for (const auto& [name, allowed] : kCircumstances) names.emplace_back(name);
  return names;
}

WheelConditions conditions_of(std::span<const double> values, std::size_t row, std::size_t count) {
  const auto at = [&](std::size_t column) { return values[(3 + column) * count + row]; };
  return {.pass = static_cast<int>(at(6)),
          .speed_mps = at(0),
          .position_m = at(1),
          .time_s = at(2),
          .heading_rad = at(3),
          .wheel_angle_rad = at(4),
          .sinkage_offset_m = at(5)};
}

py::tuple channels(const WheelSource& wheel, const std::vector<py::array>& arguments, int threads) {
  std::vector<Columns::Column> given{{{"load_n", arguments.at(0)}, kLoad},
                                     {{"slip_ratio", arguments.at(1)}, kSlip},
                                     {{"slip_angle_rad", arguments.at(2)}, kAngle}};
  for (std::size_t i = 0; i < kCircumstances.size(); ++i) {
    given.push_back(
        {{kCircumstances.at(i).first, arguments.at(3 + i)}, kCircumstances.at(i).second});
  }
  const Columns columns(std::move(given));
  ForceColumns out(columns.shape());
  std::array<py::array_t<double>, 3> more{new_array(columns.shape()), new_array(columns.shape()),
                                          new_array(columns.shape())};
  const std::array<double*, 3> to{more[0].mutable_data(), more[1].mutable_data(),
                                  more[2].mutable_data()};
  for_each_block(columns.rows(), kWheelRows, threads, [&](std::size_t first, std::size_t count) {
    std::vector<double> values;
    columns.read(first, count, values);
    const double *load = values.data(), *slip = load + count, *angle = slip + count;
    for (std::size_t i = 0; i < count; ++i) {
      const WheelChannels all = wheel.direct->channels(load[i], motion_at(slip[i], angle[i]),
                                                       conditions_of(values, i, count));
      out.put(first + i, all.forces);
      const bool any = has_forces(all.forces.status);
      to[0][first + i] = any ? all.rut_left_m : kNone;
      to[1][first + i] = any ? all.rut_right_m : kNone;
      to[2][first + i] = any ? all.roll_moment_nm : kNone;
    }
  });
  return out.tuple() + py::make_tuple(more[0], more[1], more[2]);
}

/// Cornering and drag force, eqs. (18) and (19) of the paper.
py::tuple cornering_and_drag(const py::array& fx_n, const py::array& fy_n,
                             const py::array& slip_angle_rad) {
  const std::vector<NamedArray> arguments{
      {"fx_n", fx_n}, {"fy_n", fy_n}, {"slip_angle_rad", slip_angle_rad}};
  const Shape shape = common_shape(arguments);
  const NumberReader read_fx(arguments[0], shape), read_fy(arguments[1], shape),
      read_angle(arguments[2], shape);
  py::array_t<double> fc = new_array(shape), fb = new_array(shape);
  double *fc_n = fc.mutable_data(), *fb_n = fb.mutable_data();
  for_each_block(rows_of(shape), kWheelRows, 1, [&](std::size_t first, std::size_t count) {
    std::vector<double> fx(count), fy(count), angle(count);  // NaN: a wheel without forces
    read_fx.read(first, fx);
    read_fy.read(first, fy);
    read_angle.read(first, angle);
    for (std::size_t i = 0; i < count; ++i) {
      const TravelForces travel = travel_forces(fx[i], fy[i], angle[i]);
      fc_n[first + i] = travel.cornering_n;
      fb_n[first + i] = travel.drag_n;
    }
  });
  return py::make_tuple(fc, fb);
}

py::list mechanism_list() {
  py::list list;
  for (const MechanismForm& form : mechanism_forms()) {
    py::list parameters;
    for (const MechanismParameter& p : form.parameters) {
      py::dict parameter;
      parameter["name"] = std::string(p.name);
      parameter["usual_range"] = py::make_tuple(p.low, p.high);
      parameter["allowed_range"] = py::make_tuple(p.least, p.most);
      parameter["default"] = p.typical;
      parameters.append(parameter);
    }
    py::dict entry;
    entry["id"] = std::string(form.id);
    entry["form"] = std::string(form.form);
    entry["formula"] = std::string(form.formula);
    entry["source"] = std::string(form.source);
    entry["parameters"] = parameters;
    list.append(entry);
  }
  return list;
}

py::dict table_facts(const WheelSource& wheel) {
  py::dict facts;
  facts["error_999_permille"] = wheel.table->error().at_999_permille;
  facts["error_worst"] = wheel.table->error().at_worst;
  facts["load_min_n"] = wheel.table->load_min_n();
  facts["load_max_n"] = wheel.table->load_max_n();
  facts["bytes"] = wheel.table->bytes();
  return facts;
}

std::vector<std::string> status_names() {
  std::vector<std::string> names;
  for (int i = 0; i <= static_cast<int>(WheelStatus::kLifted); ++i) {
    names.emplace_back(name(static_cast<WheelStatus>(i)));
  }
  return names;
}

}  // namespace

void bind_wheels(py::module_& module) {
  py::class_<WheelSource>(module, "WheelSource")
      .def(py::init(&wheel_source), py::call_guard<py::gil_scoped_release>())
      .def("forces", &forces)
      .def("plane_forces", &plane_forces)
      .def("channels", &channels)
      .def("table_facts", &table_facts);
  module.def("cornering_and_drag", &cornering_and_drag);
  module.def("mechanisms", &mechanism_list);
  module.def("status_names", &status_names);
  module.def("condition_names", &condition_names);
  module.def("method_names", &method_names);
  module.def("variant_names", &variant_names);
  module.attr("THREADS_MAX") = kThreadsMax;
  module.def("checked_soil", &checked_soil);
  module.def("model_file_settings", &model_file_settings);
  module.def("soils_file_settings", &soils_file_settings);
  module.def("preset_soil_settings", &preset_soil_settings);
  module.def("paper_wheel_settings", &paper_wheel_settings);
}

}  // namespace regoplan::python
