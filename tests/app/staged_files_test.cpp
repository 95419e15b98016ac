#include "app/staged_files.h"

#include <gtest/gtest.h>

#include "tests/app/error_text.h"
#include "tests/app/scratch_folder.h"

namespace regoplan {
namespace {

TEST(StagedFiles, AreThereWholeAfterCommit) {
  const ScratchFolder folder;
  {
    StagedFiles staged(folder.path("a/b"));
    staged.write({.name = "one", .content = "1"});
    staged.write({.name = "two", .content = "2"});
    EXPECT_FALSE(std::filesystem::exists(folder.path("a/b/one")));
    staged.commit();
  }
  EXPECT_EQ(folder.read("a/b/one"), "1");
  EXPECT_EQ(folder.read("a/b/two"), "2");
  EXPECT_EQ(folder.count(), 4);
}

TEST(StagedFiles, LeaveNoTraceWithoutCommit) {
  const ScratchFolder folder;
  {
    StagedFiles staged(folder.path("a/b/"));
    staged.write({.name = "one", .content = "1"});
  }
  EXPECT_EQ(folder.count(), 0);
}

TEST(StagedFiles, ReplaceNothingWhereOneCannotBeReplaced) {
  const ScratchFolder folder;
  folder.write("one", "old");
  std::filesystem::create_directory(folder.path("two"));
  EXPECT_NE(error_text([&] {
              StagedFiles staged(folder.path(""));
              staged.write({.name = "one", .content = "new"});
              staged.write({.name = "two", .content = "new"});
              staged.commit();
            }),
            "");
  EXPECT_EQ(folder.read("one"), "old");
  EXPECT_EQ(folder.count(), 2);
}

TEST(StagedFiles, AFolderThatIsAFileIsAnErrorBeforeAnyWork) {
  const ScratchFolder folder;
  folder.write("file", "");
  EXPECT_EQ(error_text([&] { require_writable_folder(folder.path("file")); }),
            folder.path("file") + ": not a folder");
  EXPECT_EQ(error_text([&] { require_writable_folder(folder.path("file/deeper")); }),
            folder.path("file") + ": not a folder");
  EXPECT_EQ(error_text([&] { require_writable_folder(folder.path("new/deeper")); }), "");
}

}  // namespace
}  // namespace regoplan
