#include "app/io/staged_files.h"

#include <gtest/gtest.h>

#include "tests/app/error_text.h"
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
}

TEST(StagedFiles, OfAProcessThatIsStillAtItAreLeftAlone) {
  const ScratchFolder folder;
  StagedFiles other({folder.path("")});
  const std::string half = other.path("half");
  std::filesystem::rename(folder.path(".regoplan-" + std::to_string(getpid())),
                          folder.path(".regoplan-99999999"));
  put({folder.path("")}, "1");
  EXPECT_TRUE(std::filesystem::exists(folder.path(".regoplan-99999999")));
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
