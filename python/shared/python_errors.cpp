#include "python/shared/python_errors.h"

#include <pybind11/pybind11.h>

#include "terramech/basics/input_error.h"

namespace regoplan::python {

namespace py = pybind11;

void translate_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& bad) {
      const py::object kind = py::module_::import("regoplan._errors").attr("InputError");
      PyErr_SetObject(kind.ptr(), kind(bad.what()).ptr());
    }
  });
}

}  // namespace regoplan::python
