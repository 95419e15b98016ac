// libFuzzer's way in: one program a reader, whose name REGOPLAN_READER gives.
#include <cstddef>
#include <cstdint>
#include <string>

#include "benchmarks/robustness/readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const regoplan::Reader& reader = [] -> const regoplan::Reader& {
    regoplan::enter_scratch_folder();
    return regoplan::reader_named(REGOPLAN_READER);
  }();
  regoplan::takes(reader, std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
