#include "app/io/held_text.h"

#include <array>
#include <cstddef>

#include "terramech/basics/input_error.h"

namespace regoplan {

HeldText::HeldText() : file_(std::tmpfile(), std::fclose) {
  if (!file_) throw InputError("a temporary file cannot be made (disk full?)");
}

void HeldText::add(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size()) return;
  throw InputError("a temporary file cannot be written (disk full?)");
}

void HeldText::write_to(std::ostream& out) {
  const bool is_whole = std::fflush(file_.get()) == 0 && std::fseek(file_.get(), 0, SEEK_SET) == 0;
  if (!is_whole) throw InputError("a temporary file cannot be written (disk full?)");
  std::array<char, 65536> part;
  while (const std::size_t read = std::fread(part.data(), 1, part.size(), file_.get())) {
    out.write(part.data(), static_cast<std::streamsize>(read));
  }
  if (std::ferror(file_.get())) throw InputError("a temporary file cannot be read");
}

}  // namespace regoplan
