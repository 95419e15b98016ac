#pragma once

#include <functional>
#include <string>

namespace regoplan {

/// Writes `file` so that it is there whole or not at all: `write` fills a new file beside it, whose
/// name it is given, which then takes the place of `file`. Where `write` throws, nothing is left.
/// \throws InputError where the folder does not exist or the file cannot be put there
void write_whole_file(const std::string& file,
                      const std::function<void(const std::string& unfinished)>& write);

}  // namespace regoplan
