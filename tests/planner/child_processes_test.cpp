#include "planner/runtime/child_processes.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

std::vector<char> text(std::string_view words) {
  return {words.begin(), words.end()};
}

/// Runs tasks and collects what they come to.
std::vector<ChildAnswer> answers(const std::vector<ChildTask>& tasks, int processes,
                                 AnswerOrder order) {
  std::vector<ChildAnswer> all;
  std::size_t next = 0;
  run_in_children(
      processes, order,
      [&]() -> std::optional<ChildTask> {
        if (next == tasks.size()) return std::nullopt;
        return tasks[next++];
      },
      [&](const ChildAnswer& answer) { all.push_back(answer); }, {});
  return all;
}

ChildTask task(std::function<std::vector<char>()> work) {
  return {.work = std::move(work)};
}

TEST(Children, GiveTheirAnswersWhole) {
  const std::vector<char> large(3000000, 'x');
  const auto all = answers({task([&] { return large; }), task([] { return text(""); })}, 2,
                           AnswerOrder::kAsGiven);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].bytes, large);
  EXPECT_EQ(all[1].bytes, text(""));
}

TEST(Children, CostOneTaskWhenTheyCrashThrowOrHang) {
  const auto all =
      answers({task([]() -> std::vector<char> {
                 kill(getpid(), SIGKILL);
                 return {};
               }),
               task([]() -> std::vector<char> { throw std::runtime_error("no way"); }),
               task([]() -> std::vector<char> { throw InputError("goal_bias: 2 is not valid"); }),
               {.work =
                    [] {
                      std::this_thread::sleep_for(std::chrono::minutes(5));
                      return text("late");
                    },
                .time_limit_s = 0.2},
               task([] { return text("well"); })},
              2, AnswerOrder::kAsGiven);
  ASSERT_EQ(all.size(), 5U);
  EXPECT_FALSE(all[0].bytes);
  EXPECT_NE(all[0].failure.find("signal 9"), std::string::npos) << all[0].failure;
  EXPECT_EQ(all[1].failure, "no way");
  EXPECT_FALSE(all[1].bad_input);
  EXPECT_EQ(all[2].failure, "goal_bias: 2 is not valid");
  EXPECT_TRUE(all[2].bad_input);
  EXPECT_EQ(all[3].failure, "took longer than it may");
  EXPECT_EQ(all[4].bytes, text("well"));
}

TEST(Children, CostOneTaskWhenTheyTakeTooMuchMemory) {
  const auto taking = [](std::size_t megabytes) {
    return ChildTask{.work =
                         [megabytes] {
                           const std::vector<char> taken(megabytes << 20, 'x');
                           return text(taken.back() == 'x' ? "had it" : "");
                         },
                     .memory_limit_mb = 500};
  };
  const auto all = answers({taking(1000), taking(100)}, 1, AnswerOrder::kAsGiven);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_FALSE(all[0].bytes);
  EXPECT_NE(all[0].failure, "");
  EXPECT_EQ(all[1].bytes, text("had it"));
}

TEST(Children, AnswerInTheOrderOfTheTasksOrOfTheirEnds) {
  const auto slow = task([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    return text("slow");
  });
  const auto quick = task([] { return text("quick"); });
  const auto given = answers({slow, quick}, 2, AnswerOrder::kAsGiven);
  EXPECT_EQ(given.front().task, 0U);
  const auto ended = answers({slow, quick}, 2, AnswerOrder::kAsEnded);
  EXPECT_EQ(ended.front().task, 1U);
}

TEST(Children, EndAtOnceWhenStopIsRequestedAndWhatHadEndedIsKept) {
  std::stop_source stop;
  std::vector<std::size_t> answered;
  std::size_t next = 0;
  const auto begin = std::chrono::steady_clock::now();
  run_in_children(
      2, AnswerOrder::kAsEnded,
      [&]() -> std::optional<ChildTask> {
        return ChildTask{.work = [number = next++] {
          if (number > 0) std::this_thread::sleep_for(std::chrono::minutes(5));
          return text("done");
        }};
      },
      [&](const ChildAnswer& answer) {
        answered.push_back(answer.task);
        stop.request_stop();
      },
      stop.get_token());
  EXPECT_EQ(answered, std::vector<std::size_t>{0});
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

}  // namespace
}  // namespace regoplan
