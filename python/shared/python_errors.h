#pragma once

namespace regoplan::python {

/// From now on bad input that C++ refuses (`InputError`, `ValueError`) is the Python package's
/// `InputError`.
void translate_errors();

}  // namespace regoplan::python
