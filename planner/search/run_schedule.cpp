#include "planner/search/run_schedule.h"

#include <algorithm>
#include <vector>

namespace regoplan {
namespace {

std::string planner_of(const Search& search, int number) {
  if (search.planner != "auto") return search.planner;
  // The lattice is by far the fastest, and each way of its own makes another path of it. The trees
  // fill in where it does not reach.
  static const std::vector<std::string> kPortfolio{
      "Lattice", "Lattice", "StableSparse", "Lattice", "Lattice",   "RRT",
      "Lattice", "Lattice", "StableSparse", "Lattice", "SyclopRRT", "KPIECE1"};
  return kPortfolio[static_cast<std::size_t>(number) % kPortfolio.size()];
}

/// Margin to spare. Some runs ask for a lot, so that there are calm paths to choose from; some for
/// hardly any, so that a way through a narrow place is found.
double reserve_of(int number) {
  static const std::vector<double> kReserves{0.10, 0.01, 0.15, 0.05, 0.03};
  return kReserves[static_cast<std::size_t>(number) % kReserves.size()];
}

/// Ways that differ: the first run follows the cheapest, others what chance makes cheapest.
double variety_of(int number) {
  constexpr double kMost = 3;
  return number == 0 ? 0 : kMost * (1 + number % 2) / 2;
}

}  // namespace

std::optional<SearchRun> RunSchedule::next(int found, double left_s) {
  // Each kind of run twice where soils are doubtful: at the means, then off them.
  const int kind = has_doubtful_soils_ ? number_ / 2 : number_;
  SearchRun run{.planner = planner_of(search_, kind),
                .guidance = {.seed = search_.seed * 1000003 + static_cast<std::uint64_t>(number_),
                             .margin_min = margin_min_ + reserve_of(kind),
                             .variety = variety_of(kind)},
                .off_doubtful_soils = has_doubtful_soils_ && number_ % 2 == 1};
  if (search_.iterations) {
    if (number_ >= wanted()) return std::nullopt;
    run.iterations = search_.iterations;
  } else {
    constexpr double kTooShort_s = 0.05;
    if (found >= wanted() || left_s < kTooShort_s) return std::nullopt;
    const double share = *search_.time_s * search_.threads / wanted();
    run.time_s = std::min(left_s, std::max(2 * share, kTooShort_s));
  }
  ++number_;
  return run;
}

}  // namespace regoplan
