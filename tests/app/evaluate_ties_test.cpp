#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/app/flat_map.h"
#include "tests/app/program_run.h"

namespace regoplan {
namespace {

TEST(EvaluateTies, OfFeasiblePathsAreSaidOnTerminalAndPage) {
  const ScratchFolder folder;
  write_flat_scenario(folder);
  for (const char* name : {"one.csv", "other.csv"}) {
    folder.write(name, "x_m,y_m,speed_mps\n8,20,0\n20,20,1\n30,21,0\n");
  }
  folder.write("off.csv", "x_m,y_m\n30,20\n38,20\n50,20\n");
  const auto evaluate = [&](const std::vector<std::string>& paths) {
    std::string command = "evaluate '" + folder.path("scenario.yaml") + "' --draws 20 --out '" +
                          folder.path("out") + "'";
    for (const std::string& path : paths) command += " '" + folder.path(path) + "'";
    return run_program(folder, command);
  };
  const std::string tied = "Ranks 1 and 2 are tied: ";
  const ProgramRun both = evaluate({"one.csv", "other.csv", "off.csv"});
  ASSERT_EQ(both.status, 0) << both.errors;
  EXPECT_NE(both.output.find(tied), std::string::npos) << both.output;
  EXPECT_NE(folder.read("out/report.html").find(tied), std::string::npos);
  ASSERT_EQ(evaluate({"one.csv", "off.csv"}).status, 0);
  EXPECT_EQ(folder.read("out/report.html").find(tied), std::string::npos);
}

}  // namespace
}  // namespace regoplan
