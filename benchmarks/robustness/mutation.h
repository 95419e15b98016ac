#pragma once

#include <random>
#include <string>
#include <vector>

namespace regoplan {

/// Makes bad input out of good: bytes flipped, parts cut out, doubled, moved between seeds, numbers
/// replaced by such as break readers, and words of the formats put where they do not belong.
class Mutator {
 public:
  /// \param seeds not empty
  Mutator(std::vector<std::string> seeds, std::uint64_t seed);

  /// The next input; the same for the same seeds, seed and number of calls.
  std::string next();

 private:
  void mutate(std::string& text);
  std::size_t below(std::size_t count);
  std::string part_of_a_seed();

  std::vector<std::string> seeds_;
  std::mt19937_64 random_;
};

}  // namespace regoplan
