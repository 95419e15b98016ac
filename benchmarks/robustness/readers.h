#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace regoplan {

/// One reader of input from elsewhere, as a target of mutated input.
struct Reader {
  std::string name;
  std::string file;  ///< what its input is called
  /// Reads the file in the current folder. What it refuses ends in an InputError; anything else
  /// that it throws is a fault.
  std::function<void(const std::string& file)> read;
};

const std::vector<Reader>& readers();

/// \throws InputError where there is none
const Reader& reader_named(std::string_view name);

/// Whether the reader took the input. Faults are what it throws and does besides.
bool takes(const Reader& reader, const std::string& input);

/// Makes an empty folder current, with the files that scenarios and suites name.
void enter_scratch_folder();

}  // namespace regoplan
