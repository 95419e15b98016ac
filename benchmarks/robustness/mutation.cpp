#include "benchmarks/robustness/mutation.h"

#include <array>
#include <cctype>

namespace regoplan {
namespace {

constexpr std::array kNumbers{"0",
                              "-0",
                              "1e-5",
                              "-1",
                              "1e308",
                              "-1e308",
                              "1e999",
                              "9.2e18",
                              "4e-324",
                              ".nan",
                              "nan",
                              ".inf",
                              "-.inf",
                              "2147483648",
                              "1e6",
                              "0.1",
                              "3.5",
                              "0x10",
                              "1,5",
                              "65536",
                              "1e-300",
                              "-2147483649",
                              "9223372036854775808",
                              "1e15",
                              "100000"};

constexpr std::array kWords{"&a",
                            "*a",
                            "<<: *a",
                            "? ",
                            "- ",
                            "- - - ",
                            ": ",
                            ",",
                            "\"",
                            "'",
                            "{",
                            "}",
                            "[",
                            "]",
                            "|\n",
                            ">\n",
                            "---\n",
                            "...\n",
                            "!!map ",
                            "!!binary ",
                            "#",
                            "%YAML 9.9\n",
                            "\t",
                            "\r\n",
                            "\n",
                            "\0",
                            "\xff",
                            "\xef\xbb\xbf",
                            "${HOME}",
                            "${REGOPLAN_X",
                            "/vsicurl/http://127.0.0.1/",
                            "../",
                            "/dev/zero",
                            "=1+1",
                            "\x1b[2J",
                            "true",
                            "null",
                            "~",
                            "x_m",
                            "name",
                            "map",
                            "terrain",
                            "dem.asc",
                            "rocks.csv",
                            "in.yaml",
                            "{mean: 1, std: 1}",
                            "[1, 2, 3]",
                            "[[[[[[[[[[[[[[[[[[[[[[[[[[",
                            "{a: {a: {a: {a: {a: {a: {a: {a: "};

}  // namespace

Mutator::Mutator(std::vector<std::string> seeds, std::uint64_t seed)
    : seeds_(std::move(seeds)), random_(seed) {}

std::size_t Mutator::below(std::size_t count) {
  return count == 0 ? 0 : random_() % count;
}

std::string Mutator::next() {
  std::string text = seeds_[below(seeds_.size())];
  const std::size_t steps = 1 + below(1U << below(5));
  for (std::size_t i = 0; i < steps; ++i) mutate(text);
  constexpr std::size_t kLongest = 1 << 16;
  if (text.size() > kLongest) text.resize(kLongest);
  return text;
}

std::string Mutator::part_of_a_seed() {
  const std::string& seed = seeds_[below(seeds_.size())];
  const std::size_t from = below(seed.size() + 1);
  return seed.substr(from, below(1 + std::min<std::size_t>(seed.size() - from, 200)));
}

void Mutator::mutate(std::string& text) {
  const std::size_t at = below(text.size() + 1);
  const std::size_t length = std::min(below(1U << below(9)) + 1, text.size() - at);
  switch (below(9)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
      break;
    case 1:
      if (at < text.size()) text[at] = static_cast<char>(below(256));
      break;
    case 2:
      text.erase(at, length);
      break;
    case 3:
      text.insert(at, text.substr(at, length));
      break;
    case 4:
      text.insert(at, part_of_a_seed());
      break;
    case 5:
      text.insert(at, kWords[below(kWords.size())]);
      break;
    case 6: {  // the same again and again
      const std::string part = text.substr(at, length);
      for (std::size_t i = below(100); i > 0 && text.size() < 1 << 16; --i) text.insert(at, part);
      break;
    }
    default: {  // a number
      const auto is_number = [&](std::size_t i) {
        const char c = text[i];
        return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
      };
      std::size_t from = at;
      while (from < text.size() && !is_number(from)) ++from;
      std::size_t to = from;
      while (to < text.size() && is_number(to)) ++to;
      text.replace(from, to - from, kNumbers[below(kNumbers.size())]);
    }
  }
}

}  // namespace regoplan
