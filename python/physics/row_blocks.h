#pragma once

#include <cstddef>
#include <functional>

namespace regoplan::python {

/// Rows of one wheel that are worked off at once, and manoeuvres, which take a thousand times
/// longer.
inline constexpr std::size_t kWheelRows = 1024, kManoeuvres = 4;

/// Calls work(first, count) for all rows, a block at a time, from several threads, without
/// Python's lock; now and then Python handles its signals. Of what work throws, that for the lowest
/// rows is thrown; a signal's exception (KeyboardInterrupt) likewise.
/// \pre called with Python's lock
void for_each_block(std::size_t rows, std::size_t block, int threads,
                    const std::function<void(std::size_t first, std::size_t count)>& work);

}  // namespace regoplan::python
