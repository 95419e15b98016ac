#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

namespace regoplan::challenge {

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
inline double log_uniform(Random& random, double low, double high) {
  return std::exp(uniform(random, std::log(low), std::log(high)));
}
inline double normal(Random& random) {
  return std::normal_distribution<double>()(random);
}
/// Standard normal within two standard deviations.
inline double bounded_normal(Random& random) {
  double x = normal(random);
  while (std::abs(x) > 2) x = normal(random);
  return x;
}
inline bool chance(Random& random, double probability) {
  return uniform(random, 0, 1) < probability;
}
inline double sign(Random& random) {
  return chance(random, 0.5) ? 1 : -1;
}
template <class T>
const T& one_of(Random& random, const std::vector<T>& values) {
  return values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
}

/// A seed of its own for everything that has a name and a number (FNV-1a, then splitmix64).
inline std::uint64_t seed_of(std::uint64_t master, std::string_view name, std::uint64_t index) {
  std::uint64_t x = 0xcbf29ce484222325ULL ^ master;
  for (const char c : name) x = (x ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  x += 0x9e3779b97f4a7c15ULL * (index + 1);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace regoplan::challenge
