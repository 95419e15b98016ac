#include "planner/stages/draws_stage.h"

#include <algorithm>
#include <map>
#include <utility>

#include "planner/certificate/least_duration.h"
#include "planner/chart/margin_rasters.h"
#include "planner/driving/margin_draws.h"
#include "planner/runtime/plain_bytes.h"

namespace regoplan {
namespace {

/// Draws of the soils that are judged in one go.
constexpr int kDrawsAtOnce = 10;

class DrawsStage {
 public:
  DrawsStage(const PlanUnderway& plan, std::vector<VerifiedPath>& chosen, PlanResult& result)
      : plan_(plan), chosen_(chosen), result_(result) {}

  void run() {
    const int draws = plan_.problem.search.soil_draws;
    std::vector<std::map<int, std::vector<double>>> drawn(chosen_.size());
    const int draws_first = std::min(draws, 20);  // of every candidate, before anything else
    // Where every soil number is known there is nothing to draw.
    const bool varies = has_uncertain_soil(plan_.problem);
    std::vector<int> given(chosen_.size(), varies ? 0 : draws);
    bool bounded = false, mapped = false, weighed = false;
    const double half_left_s = plan_.budget.left_s(kDrawsShare) / 2;
    work_off(plan_, [&]() -> std::optional<Piece> {
      if (!std::exchange(bounded, true)) return bound_piece();
      // A path without draws ranks behind all that have some: each gets its first before the
      // rasters take a thread for long, unless that left them no time.
      const bool is_late = plan_.budget.left_s(kDrawsShare) <= half_left_s;
      if (!given.empty() && (is_late ? given.front() : *std::ranges::min_element(given)) > 0 &&
          !std::exchange(mapped, true)) {
        return rasters_piece();
      }
      if (!given.empty() && *std::ranges::min_element(given) >= draws_first &&
          !std::exchange(weighed, true)) {
        return probability_piece();
      }
      const auto least = std::min_element(given.begin(), given.end());
      const double left_s = plan_.budget.left_s(kDrawsShare);
      if (least == given.end() || *least >= draws || left_s <= 0) return std::nullopt;
      plan_.announcements.stage("drawing soils", static_cast<double>(*least) / draws);
      const auto i = static_cast<std::size_t>(least - given.begin());
      const DrawRange range{.first = *least, .count = std::min(kDrawsAtOnce, draws - *least)};
      *least += range.count;
      return Piece{.work =
                       [this, i, range] {
                         ByteWriter writer;
                         writer(smallest_margins(plan_.problem, chosen_[i].replay, range,
                                                 plan_.problem.search.seed, 1));
                         return writer.take();
                       },
                   .time_limit_s = plan_.budget.left_s(TimeBudget::kAnswerShare),
                   .take =
                       [&drawn, i, range](const std::optional<std::vector<char>>& bytes) {
                         if (!bytes) return;
                         ByteReader reader(*bytes);
                         reader(drawn[i][range.first]);
                       }};
    });
    if (result_.rasters) result_.rasters->probability = std::move(probability_);
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      Candidate& candidate = chosen_[i].candidate;
      const double margin_min = plan_.problem.limits.margin_min;
      if (!varies) {
        candidate.spread = known_margin(candidate.margin_min, margin_min);
        continue;
      }
      std::vector<double> smallest;
      for (const auto& [first, margins] : drawn[i]) {
        smallest.insert(smallest.end(), margins.begin(), margins.end());
      }
      if (smallest.empty()) continue;
      candidate.spread = margin_spread(smallest, margin_min);
    }
  }

 private:
  Piece bound_piece() {
    return {.work =
                [this] {
                  ByteWriter writer;
                  writer(least_duration_s(plan_.problem));
                  return writer.take();
                },
            .time_limit_s = plan_.budget.left_s(TimeBudget::kAnswerShare),
            .take =
                [this](const std::optional<std::vector<char>>& bytes) {
                  if (!bytes) return;
                  ByteReader reader(*bytes);
                  reader(result_.least_duration_s.emplace());
                }};
  }

  Piece rasters_piece() {
    return {.work = [this] { return bytes_of(terrain_rasters(plan_.problem)); },
            .time_limit_s = plan_.budget.left_s(TimeBudget::kAnswerShare),
            .take =
                [this](const std::optional<std::vector<char>>& bytes) {
                  if (bytes) result_.rasters = from_bytes<TerrainRasters>(*bytes);
                }};
  }

  Piece probability_piece() {
    return {.work =
                [this] {
                  ByteWriter writer;
                  writer(straight_on_probability(plan_.problem));
                  return writer.take();
                },
            .time_limit_s = plan_.budget.left_s(kDrawsShare),
            .take =
                [this](const std::optional<std::vector<char>>& bytes) {
                  if (!bytes) return;
                  ByteReader reader(*bytes);
                  reader(probability_);
                }};
  }

  const PlanUnderway& plan_;
  std::vector<VerifiedPath>& chosen_;
  PlanResult& result_;
  std::vector<float> probability_;  ///< of the rasters
};

}  // namespace

void draw_soils(const PlanUnderway& plan, std::vector<VerifiedPath>& chosen, PlanResult& result) {
  DrawsStage(plan, chosen, result).run();
}

}  // namespace regoplan
