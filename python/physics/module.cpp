#include <pybind11/pybind11.h>

#include "python/physics/bindings.h"
#include "python/shared/python_errors.h"

PYBIND11_MODULE(_physics, module) {
  module.doc() = "Wheels, soils and vehicles of regoplan; use the package regoplan instead.";
  regoplan::python::translate_errors();
  regoplan::python::bind_wheels(module);
  regoplan::python::bind_vehicles(module);
}
