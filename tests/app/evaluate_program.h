#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/flat_map.h"
#include "tests/app/program_run.h"

namespace regoplan {

/// `evaluate` on flat ground of one soil.
class Evaluate : public testing::Test {
 protected:
  Evaluate() { write_flat_scenario(folder_); }

  ProgramRun evaluate(const std::string& arguments) const {
    return run_program(folder_, "evaluate '" + folder_.path("scenario.yaml") + "' --out '" +
                                    folder_.path("out") + "' --draws 20 " + arguments);
  }
  std::string file(const std::string& name, const std::string& text) const {
    std::string quoted("'");
    quoted.append(folder_.write(name, text)).append("'");
    return quoted;
  }
  nlohmann::json result() const {
    return nlohmann::json::parse(folder_.read("out/evaluation.json"));
  }

  /// Expects one line that holds all of `words`, status 1 and nothing written.
  void expect_refused(const std::string& arguments, const std::vector<std::string>& words) const {
    expect_refusal(evaluate(arguments), words);
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));
  }

  ScratchFolder folder_;
};

}  // namespace regoplan
