#include "app/io/staged_files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <iostream>
#include <optional>

#include "app/io/page_command.h"
#include "tests/error_text.h"
#include "tests/scratch_folder.h"

namespace regoplan {
namespace {

TEST(StagedFiles, AreThereWholeAfterCommit) {
  const ScratchFolder folder;
  {
    StagedFiles staged({folder.path("a/b")});
    staged.write({.name = "one", .content = "1"});
    staged.write({.name = "two", .content = "2"});
    EXPECT_FALSE(std::filesystem::exists(folder.path("a/b/one")));
    staged.commit();
  }
  EXPECT_EQ(folder.read("a/b/one"), "1");
  EXPECT_EQ(folder.read("a/b/two"), "2");
  EXPECT_EQ(folder.count(), 5);  // a, b, both files and what is known of them
}

TEST(StagedFiles, LeaveNoTraceWithoutCommit) {
  const ScratchFolder folder;
  {
    StagedFiles staged({folder.path("a/b/")});
    staged.write({.name = "one", .content = "1"});
  }
  EXPECT_EQ(folder.count(), 0);
}

TEST(StagedFiles, ReplaceNothingWhereOneCannotBeReplaced) {
  const ScratchFolder folder;
  folder.write("one", "old");
  std::filesystem::create_directory(folder.path("two"));
  EXPECT_NE(error_text([&] {
              StagedFiles staged({folder.path("")});
              staged.write({.name = "one", .content = "new"});
              staged.write({.name = "two", .content = "new"});
              staged.commit();
            }),
            "");
  EXPECT_EQ(folder.read("one"), "old");
  EXPECT_EQ(folder.count(), 2);
}

void put(const ResultFolder& folder, const std::string& content) {
  StagedFiles staged(folder);
  staged.write({.name = "one", .content = content});
  staged.write({.name = "two", .content = content});
  staged.commit();
}

/// The page of a command.
void put_page(const ResultFolder& folder, const std::string& command, const std::string& content) {
  StagedFiles staged(folder);
  staged.write({.name = "report.html", .content = page_mark(command) + content});
  staged.commit();
}

TEST(StagedFiles, KeepThePageOfAnotherCommandAndReplaceThatOfTheirOwn) {
  const ScratchFolder folder;
  const ResultFolder results{folder.path("")};
  put_page(results, "plan", "1");
  put_page(results, "plan", "2");
  EXPECT_FALSE(std::filesystem::exists(folder.path("plan-report.html")));
  put_page(results, "drive", "3");
  put_page(results, "drive", "4");
  EXPECT_EQ(folder.read("plan-report.html"), page_mark("plan") + "2");
  EXPECT_EQ(folder.read("report.html"), page_mark("drive") + "4");
  // The plan's next page makes what was kept of it out of date.
  put_page(results, "plan", "5");
  EXPECT_EQ(folder.read("report.html"), page_mark("plan") + "5");
  EXPECT_EQ(folder.read("drive-report.html"), page_mark("drive") + "4");
  EXPECT_FALSE(std::filesystem::exists(folder.path("plan-report.html")));
}

TEST(StagedFiles, KeepNoPageOverAFileThatSomebodyElseWrote) {
  const ScratchFolder folder;
  put_page({folder.path("")}, "plan", "1");
  folder.write("plan-report.html", "mine");
  EXPECT_NE(error_text([&] { put_page({folder.path("")}, "drive", "2"); }).find("plan-report.html"),
            std::string::npos);
  EXPECT_EQ(folder.read("plan-report.html"), "mine");
  EXPECT_EQ(folder.read("report.html"), page_mark("plan") + "1");
}

TEST(StagedFiles, ReplaceWhatTheyWroteAndNothingElse) {
  const ScratchFolder folder;
  put({folder.path("")}, "1");
  put({folder.path("")}, "2");
  EXPECT_EQ(folder.read("one"), "2");

  folder.write("two", "edited");
  const std::string refused = folder.path("two") +
                              ": was not written by regoplan, or was changed since; --force "
                              "replaces it";
  EXPECT_EQ(error_text([&] { put({folder.path("")}, "3"); }), refused);
  EXPECT_EQ(error_text([&] { require_results_fit({folder.path("")}, {"one", "two"}); }), refused);
  EXPECT_EQ(error_text([&] { require_results_fit({folder.path("")}, {"one", "three"}); }), "");
  EXPECT_EQ(folder.read("one"), "2");
  EXPECT_EQ(folder.read("two"), "edited");

  put({folder.path(""), true}, "3");
  EXPECT_EQ(folder.read("two"), "3");
  put({folder.path("")}, "4");
  EXPECT_EQ(folder.read("two"), "4");
}

TEST(StagedFiles, WhatAnotherCommandPutThereStaysKnown) {
  const ScratchFolder folder;
  put({folder.path("")}, "1");
  {
    StagedFiles staged({folder.path("")});
    staged.write({.name = "three", .content = "3"});
    staged.commit();
    folder.write("mine", "");
    EXPECT_FALSE(staged.remove("mine"));
    EXPECT_TRUE(staged.remove("three"));
  }
  put({folder.path("")}, "2");
  EXPECT_EQ(folder.count(), 4);
}

TEST(StagedFiles, WhatAKilledProcessLeftIsSwept) {
  const ScratchFolder folder;
  // Its own number too may have been that of a killed one; a person's file looks different.
  for (const std::string& name : {std::string("99999999"), std::to_string(getpid())}) {
    std::filesystem::create_directory(folder.path(".regoplan-" + name));
    folder.write(".regoplan-" + name + "/half", "x");
  }
  folder.write(".regoplan-notes", "mine");
  put({folder.path("")}, "1");
  EXPECT_EQ(folder.count(), 4);
  EXPECT_EQ(folder.read(".regoplan-notes"), "mine");

  std::filesystem::create_directories(folder.path(".regoplan-99999999/half"));
  put({folder.path("new")}, "1");
  std::filesystem::create_directories(folder.path(".regoplan-99999999/half"));
  put({folder.path("new")}, "2");
  EXPECT_FALSE(std::filesystem::exists(folder.path(".regoplan-99999999")));
}

TEST(StagedFiles, OfAProcessThatIsStillAtItAreLeftAlone) {
  const ScratchFolder folder;
  StagedFiles other({folder.path("")});
  other.write({.name = "half", .content = "x"});
  put({folder.path("")}, "1");
  EXPECT_TRUE(std::filesystem::exists(other.path("half")));
}

TEST(StagedFiles, OfTwoThatAreGivenUpInOneNewFolderLeaveNoTrace) {
  const ScratchFolder folder;
  for (const bool first_ends_first : {true, false}) {
    std::optional<StagedFiles> first, second;
    first.emplace(ResultFolder{folder.path("new/deeper")});
    second.emplace(ResultFolder{folder.path("new/deeper")});
    first->write({.name = "one", .content = "1"});
    (first_ends_first ? first : second).reset();
    (first_ends_first ? second : first).reset();
    EXPECT_EQ(folder.count(), 0) << first_ends_first;
  }
}

TEST(StagedFiles, GivenUpLeaveWhatAnotherPutIntoTheSameNewFolder) {
  const ScratchFolder folder;
  {
    const StagedFiles given_up({folder.path("new")});
    put({folder.path("new")}, "1");
  }
  EXPECT_EQ(folder.read("new/one"), "1");
  EXPECT_EQ(folder.count(), 4);  // the folder, both files and what is known of them
}

TEST(StagedFiles, ThatCannotBeMovedTakeTheFolderAwayThatTheyMade) {
  const ScratchFolder folder;
  StagedFiles staged({folder.path("new/deeper")});
  const std::string file = staged.path("one");
  std::filesystem::create_directory(
      std::filesystem::path(file).replace_filename(".regoplan-files"));
  EXPECT_NE(error_text([&] { staged.commit(); }), "");
  EXPECT_FALSE(std::filesystem::exists(folder.path("new")));
}

/// Starts processes that put files into one new folder at once, give up every other time, and ask
/// whether it takes files in between. \returns those that failed
int failures_side_by_side(const ResultFolder& folder, int processes, int rounds) {
  for (int process = 0; process < processes; ++process) {
    if (fork() != 0) continue;
    const std::string error = error_text([&] {
      for (int round = 0; round < rounds; ++round) {
        const StagedFiles given_up(folder);
        require_results_fit(folder, {"one", "two"});
        put(folder, std::to_string(process));
      }
    });
    if (!error.empty()) std::cerr << error << '\n';
    _exit(error.empty() ? 0 : 1);
  }
  int failed = 0;
  for (int status = 0; wait(&status) > 0;) failed += status == 0 ? 0 : 1;
  return failed;
}

TEST(StagedFiles, OfProcessesThatEndAtOnceAreThoseOfOneAndStayKnown) {
  const ScratchFolder folder;
  for (int repeat = 0; repeat < 10; ++repeat) {
    EXPECT_EQ(failures_side_by_side({folder.path("new")}, 8, 10), 0);
    EXPECT_EQ(folder.read("new/one"), folder.read("new/two"));
    EXPECT_EQ(folder.count(), 4);
    EXPECT_EQ(error_text([&] { put({folder.path("new")}, "next"); }), "");
    std::filesystem::remove_all(folder.path("new"));
  }
}

TEST(StagedFiles, AFolderThatIsAFileIsAnErrorBeforeAnyWork) {
  const ScratchFolder folder;
  folder.write("file", "");
  EXPECT_EQ(error_text([&] { require_writable_folder({folder.path("file")}); }),
            "--out: " + folder.path("file") + ": not a folder");
  EXPECT_EQ(error_text([&] { require_writable_folder({folder.path("file/deeper")}); }),
            "--out: " + folder.path("file") + ": not a folder");
  EXPECT_EQ(error_text([&] { require_writable_folder({folder.path("new/deeper")}); }), "");
  EXPECT_EQ(error_text([] { require_writable_folder({""}); }), "--out: empty, names no folder");
}

TEST(StagedFiles, AFolderThatTheSystemRefusesIsAnErrorThatLeavesNothing) {
  const ScratchFolder folder;
  const auto refusal = [](const ResultFolder& asked) {
    return error_text([&] { require_writable_folder(asked); });
  };
  EXPECT_TRUE(refusal({"/proc/x"}).starts_with("--out: /proc/x: cannot be made: "));
  EXPECT_TRUE(
      refusal({"/proc", false, "--chart"}).starts_with("--chart: /proc: cannot be written to: "));
  const std::string too_long = folder.path("new/" + std::string(300, 'n'));
  EXPECT_EQ(refusal({too_long}), "--out: " + too_long + ": cannot be made: File name too long");
  const std::string astray = folder.path("astray");
  std::filesystem::create_symlink("/proc/no-such-folder", astray);
  EXPECT_EQ(refusal({astray}), "--out: " + astray + ": cannot be made: File exists");
  std::filesystem::remove(astray);
  EXPECT_EQ(folder.count(), 0);
}

TEST(StagedFiles, AFolderThatCannotBeLockedIsAnErrorThatLeavesNothing) {
  const ScratchFolder folder;
  // Where no file can be opened any more, folders can still be made and not be locked.
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit none{.rlim_cur = 0, .rlim_max = before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  const std::string refusal = error_text([&] { require_writable_folder({folder.path("")}); });
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_TRUE(refusal.ends_with(": cannot be locked")) << refusal;
  EXPECT_EQ(folder.count(), 0);
}

TEST(StagedFiles, AskingWhetherAFolderTakesFilesLeavesItAsItWas) {
  const ScratchFolder folder;
  put({folder.path("mine")}, "1");
  const long files = folder.count();
  for (const char* name : {"mine", "mine/new/deeper", "new"}) {
    EXPECT_EQ(error_text([&] { require_writable_folder({folder.path(name)}); }), "") << name;
    EXPECT_EQ(folder.count(), files) << name;
  }
}

}  // namespace
}  // namespace regoplan
