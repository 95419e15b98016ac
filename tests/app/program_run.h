#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "tests/app/scratch_folder.h"

namespace regoplan {

struct ProgramRun {
  int status = -1;
  std::string output;
  std::string errors;
};

/// Runs the program as a person does. `arguments` goes through the shell.
inline ProgramRun run_program(const ScratchFolder& folder, const std::string& arguments) {
  const std::string command = std::string("'" REGOPLAN_PROGRAM "' ") + arguments + " >'" +
                              folder.path(".output") + "' 2>'" + folder.path(".errors") + "'";
  const int status = std::system(command.c_str());
  ProgramRun run{.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                 .output = folder.read(".output"),
                 .errors = folder.read(".errors")};
  std::filesystem::remove(folder.path(".output"));
  std::filesystem::remove(folder.path(".errors"));
  return run;
}

}  // namespace regoplan
