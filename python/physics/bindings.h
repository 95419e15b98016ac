#pragma once

#include <pybind11/pybind11.h>

namespace regoplan::python {

void bind_wheels(pybind11::module_& module);
void bind_vehicles(pybind11::module_& module);

}  // namespace regoplan::python
