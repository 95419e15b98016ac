// Whenever it is asked to stop, a diagnosis ends at once with the stages that are complete.
#include "terramech/basics/interruption.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

#include "diagnosis/difference.h"
#include "synthetic_bed.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

using Clock = std::chrono::steady_clock;
using Work = std::function<Diagnosis(const DiagnosisOptions&)>;

constexpr double kLongest_s = 1;

double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

std::vector<std::string> names_in(const Diagnosis& diagnosis) {
  std::vector<std::string> names;
  for (const Claim& claim : diagnosis.claims) names.push_back(claim.id);
  return names;
}

/// What a diagnosis says that is asked to stop when it comes to a stage.
Diagnosis stopped_at(std::string_view stage, const Work& work) {
  std::stop_source source;
  return work({.stop = source.get_token(), .progress = [&](std::string_view at, double) {
                 if (at == stage) source.request_stop();
               }});
}

/// What a diagnosis says that is asked to stop after some time.
Diagnosis stopped_after(double time_s, const Work& work) {
  std::stop_source source;
  Clock::time_point asked;
  std::jthread alarm([&](const std::stop_token& over) {
    const Clock::time_point begun = Clock::now();
    while (seconds_since(begun) < time_s && !over.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    asked = Clock::now();
    source.request_stop();
  });
  Diagnosis found = work({.stop = source.get_token()});
  const Clock::time_point ended = Clock::now();
  alarm.request_stop();
  alarm.join();
  if (found.interrupted) {
    EXPECT_LT(std::chrono::duration<double>(ended - asked).count(), kLongest_s)
        << "asked after " << time_s << " s";
  }
  return found;
}

void expect_to_stop_whenever_asked(const Work& work) {
  const Clock::time_point begun = Clock::now();
  const Diagnosis whole = work({});
  const double whole_s = seconds_since(begun);
  EXPECT_FALSE(whole.interrupted);
  int interrupted = 0;
  for (const double share : {0.0, 0.03, 0.2, 0.5, 0.85}) {
    const Diagnosis found = stopped_after(share * whole_s, work);
    if (!found.interrupted) continue;  // faster than the first time
    ++interrupted;
    if (found.verdict != Verdict::kUndecided) {
      EXPECT_EQ(found.verdict, whole.verdict);
      EXPECT_EQ(names_in(found), names_in(whole));
      continue;
    }
    EXPECT_EQ(found.sentence, "The diagnosis was interrupted before it had a verdict.");
    EXPECT_TRUE(found.claims.empty());
    EXPECT_TRUE(found.residuals.empty());
  }
  EXPECT_GE(interrupted, 3);
  const Diagnosis decided = stopped_at("choosing the next experiment", work);
  EXPECT_EQ(decided.interrupted, !whole.next_experiments.empty());
  EXPECT_EQ(decided.verdict, whole.verdict) << "what was decided before the stop is kept";
  EXPECT_EQ(names_in(decided), names_in(whole));
  EXPECT_EQ(decided.fit.size(), whole.fit.size());
  EXPECT_TRUE(decided.next_experiments.empty());
  const Diagnosis located = stopped_at("proving it on held-out conditions", work);
  EXPECT_EQ(located.verdict, Verdict::kUndecided);
  EXPECT_EQ(located.before.f, whole.before.f);
  EXPECT_EQ(located.where.size(), whole.where.size());
  EXPECT_FALSE(located.ranking.empty());
}

TrueWheel digging() {
  TrueWheel wheel;
  wheel.sinkage = [](const WheelRun& run, double h) {
    return h * (1 + 0.8 * (1 - std::exp(-2.5 * std::max(run.slip_ratio, 0.0))));
  };
  return wheel;
}

TEST(Interruption, EndsADiagnosisWithinASecondAtAnyTime) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording = record(digging(), setup, setup.soil.mean, {.conditions = 16}, 3);
  expect_to_stop_whenever_asked(
      [&](const DiagnosisOptions& options) { return diagnose(recording, setup, options); });
}

TEST(Interruption, EndsADiagnosisAgainstAReferenceWithinASecondAtAnyTime) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording test = record(digging(), setup, setup.soil.mean, {.conditions = 16}, 3);
  const Recording reference = record({}, setup, setup.soil.mean, {.conditions = 16}, 4);
  expect_to_stop_whenever_asked([&](const DiagnosisOptions& options) {
    return diagnose_difference(test, setup, {{"reference", reference, setup}}, options);
  });
}

TEST(Interruption, LeavesWorkOfSeveralThreadsAtOnce) {
  std::stop_source source;
  std::atomic<int> begun = 0;
  const auto work = [&](std::size_t i) {
    ++begun;
    if (i == 3) source.request_stop();
    throw_if_stopped(source.get_token());
  };
  EXPECT_THROW(parallel_for(1000000, 4, work), Interrupted);
  EXPECT_LT(begun, 1000000);
}

}  // namespace
}  // namespace regoplan
