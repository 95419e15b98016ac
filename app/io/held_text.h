#pragma once

#include <cstdio>
#include <memory>
#include <ostream>
#include <string_view>

namespace regoplan {

/// Text that goes out whole or not at all, held back in a file without a name: it may be longer
/// than memory.
class HeldText {
 public:
  /// \throws InputError where no temporary file can be made
  HeldText();
  /// \throws InputError where the disk is full
  void add(std::string_view text);
  /// \throws InputError where the held text cannot be read back; what `out` cannot take it says
  void write_to(std::ostream& out);

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace regoplan
