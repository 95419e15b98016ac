#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/scratch_folder.h"

namespace regoplan {

struct ProgramRun {
  int status = -1;
  std::string output;
  std::string errors;
};

/// Runs the program as a person does. `arguments` goes through the shell, `before` as well.
inline ProgramRun run_program(const ScratchFolder& folder, const std::string& arguments,
                              const std::string& before = "") {
  const std::string command = before + "'" REGOPLAN_PROGRAM "' " + arguments + " >'" +
                              folder.path(".output") + "' 2>'" + folder.path(".errors") + "'";
  const int status = std::system(command.c_str());
  ProgramRun run{.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                 .output = folder.read(".output"),
                 .errors = folder.read(".errors")};
  std::filesystem::remove(folder.path(".output"));
  std::filesystem::remove(folder.path(".errors"));
  return run;
}

/// Expects bad input to be refused: one line that holds all of `words`, status 1, no output.
inline void expect_refusal(const ProgramRun& run, const std::vector<std::string>& words) {
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.output, "");
  EXPECT_TRUE(run.errors.starts_with("regoplan: ")) << run.errors;
  EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
  for (const std::string& word : words) {
    EXPECT_NE(run.errors.find(word), std::string::npos) << word << " in: " << run.errors;
  }
}

}  // namespace regoplan
