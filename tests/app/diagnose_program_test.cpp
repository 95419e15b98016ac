// `diagnose` as a person meets it.
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/app/json_schema.h"
#include "tests/app/program_run.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

const std::string kScenario = REGOPLAN_SOURCE_DIR "/scenarios/diagnosis/";

class Diagnose : public testing::Test {
 protected:
  std::string quoted(const std::string& name) const { return " '" + folder_.path(name) + "' "; }

  ProgramRun diagnose(const std::string& recording, const std::string& setup,
                      const std::string& more = "") const {
    return run_program(folder_, "diagnose '" + recording + "' --setup '" + setup + "' --out" +
                                    quoted("out") + more);
  }

  /// Expects one line that holds all of `words`, status 1 and nothing written.
  void expect_refused(const ProgramRun& run, const std::vector<std::string>& words) const {
    expect_refusal(run, words);
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));
  }

  /// The built-in recording with a part of its text replaced.
  std::string changed(const std::string& from, const std::string& to) const {
    std::ifstream stream(kScenario + "recording.csv");
    std::stringstream text;
    text << stream.rdbuf();
    return folder_.write("changed.csv", replaced(text.str(), from, to));
  }

  /// Every name of a ranking is one that `mechanisms` knows, with its columns and units.
  void expect_every_name_told(const nlohmann::json& ranking) const {
    std::set<std::string> names;
    for (const auto& candidate : ranking) {
      std::stringstream ids(candidate.at("id").get<std::string>());
      for (std::string id; std::getline(ids, id, '+');) names.insert(id);
    }
    EXPECT_TRUE(names.contains("sensor_gain"));
    for (const std::string& id : names) {
      const ProgramRun told = run_program(folder_, "mechanisms --json " + id);
      ASSERT_EQ(told.status, 0) << told.errors;
      for (const auto& form : nlohmann::json::parse(told.output)) EXPECT_EQ(form.at("id"), id);
    }
  }

  ScratchFolder folder_;
};

/// The person reads one probability of a claim.
void expect_one_probability(const std::string& summary) {
  for (const char* words :
       {"the data say slip_sinkage, over 99 %", "what: slip_sinkage, over 99 %; share ",
        // What is scored is the whole of what is missing: this name and no other.
        "% slip_sinkage alone\n"}) {
    EXPECT_NE(summary.find(words), std::string::npos) << words << " in: " << summary;
  }
}

TEST_F(Diagnose, TheBuiltInRecordingIsExplainedTheSameWhateverTheThreadsAndToldInWords) {
  const ProgramRun run =
      diagnose(kScenario + "recording.csv", kScenario + "setup.yaml", "--json --threads 2");
  ASSERT_EQ(run.status, 0) << run.errors;
  const auto d = nlohmann::json::parse(run.output);
  EXPECT_EQ(folder_.read("out/diagnosis.json"), run.output);
  EXPECT_EQ(schema("diagnosis").errors(d), std::vector<std::string>());
  EXPECT_TRUE(d["verdict"] == "named" || d["verdict"] == "class") << d["verdict"];
  ASSERT_EQ(d["mechanisms"].size(), 1u);
  std::vector<std::string> ids = d["mechanisms"][0]["equivalent"];
  ids.push_back(d["mechanisms"][0]["id"]);
  EXPECT_NE(std::ranges::find(ids, "slip_sinkage"), ids.end()) << d["mechanisms"].dump();
  double sum = 0, with_the_name = 0;
  for (const auto& candidate : d["ranking"]) {
    const double probability = candidate["probability"];
    sum += probability;
    for (const std::string& id : ids) {
      if (candidate["id"].get<std::string>().find(id) == std::string::npos) continue;
      with_the_name += probability;
      break;
    }
  }
  EXPECT_NEAR(sum, 1, 1e-9);
  expect_every_name_told(d["ranking"]);
  EXPECT_NEAR(d["mechanisms"][0]["probability"].get<double>(), with_the_name, 1e-9);
  const auto& share = d["mechanisms"][0]["share"];
  EXPECT_GT(share["explained"], 0.9);
  EXPECT_LE(share["low"], share["explained"]);
  EXPECT_GE(share["high"], share["explained"]);
  for (const auto& [channel, fit] : d["fit"].items()) {
    EXPECT_LT(fit["corrected_rmse"], 1.3 * fit["noise_floor"].get<double>()) << channel;
  }

  folder_.write("c.csv", "load_n,slip_ratio,slip_angle_deg\n64.7,0.6,8\n");
  const ProgramRun wheel = run_program(
      folder_, "wheel" + quoted("c.csv") + "--model" + quoted("out/corrected-model.yaml"));
  EXPECT_EQ(wheel.status, 0) << wheel.errors;
  EXPECT_NE(wheel.output.find(",ok\n"), std::string::npos) << wheel.output;

  std::filesystem::rename(folder_.path("out"), folder_.path("two"));
  const ProgramRun told =
      diagnose(kScenario + "recording.csv", kScenario + "setup.yaml", "--threads 1");
  ASSERT_EQ(told.status, 0) << told.errors;
  expect_one_probability(told.output);
  for (const char* name :
       {"diagnosis.json", "corrected-model.yaml", "residuals.csv", "report.html"}) {
    EXPECT_EQ(folder_.read(std::string("two/") + name), folder_.read(std::string("out/") + name))
        << name;
  }
}

TEST_F(Diagnose, ARowOutOfRangeIsLeftOutAndNamedInNoticesFilesAndOnThePage) {
  const std::string recording = changed("r002,1,64.78,-0.0999,7.96", "r002,1,64.78,-0.0999,90.04");
  const ProgramRun run = diagnose(recording, kScenario + "setup.yaml", "--json");
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_NE(run.errors.find("changed.csv:3: slip_angle_deg: 90.04 is not valid (allowed: -90 to "
                            "90): the row is left out\n"),
            std::string::npos)
      << run.errors;
  const auto d = nlohmann::json::parse(run.output);
  EXPECT_EQ(d["runs"], 89);
  ASSERT_EQ(d["left_out"].size(), 1u);
  EXPECT_EQ(d["left_out"][0]["line"], 3);
  EXPECT_EQ(d["left_out"][0]["run_id"], "r002");
  EXPECT_NE(folder_.read("out/report.html").find(d["left_out"][0].dump()), std::string::npos);
  EXPECT_EQ(folder_.read("out/residuals.csv").find("r002"), std::string::npos);
}

TEST_F(Diagnose, BadInputIsOneLineAndLeavesNothing) {
  const std::string setup = kScenario + "setup.yaml";
  expect_refused(diagnose("none.csv", setup), {"none.csv: no such file"});
  expect_refused(diagnose(kScenario + "recording.csv", "none.yaml"), {"none.yaml: no such file"});
  expect_refused(diagnose(changed("slip_ratio", "slip"), setup),
                 {"changed.csv:1: column slip_ratio is missing"});
  const std::string head = "run_id,load_n,slip_ratio,slip_angle_deg,fx_n,sinkage_m\n";
  expect_refused(diagnose(folder_.write("one.csv", head + "a,64.7,0.1,0,3,0.012\n"), setup),
                 {"one.csv: "});
  expect_refused(diagnose(folder_.write("percent.csv", head + "a,64.7,30,0,3,0.012\n"), setup),
                 {"percent.csv:2: slip_ratio: 30 is not valid (allowed: -1 to 1)", "per cent"});
  expect_refused(diagnose(folder_.write("nan.csv", head + "a,64.7,0.3,0,nan,0.012\n"), setup),
                 {"nan.csv:2: fx_n: nan is not valid"});
  expect_refused(diagnose(folder_.write("mm.csv", head + "a,64.7,0.3,0,4,12.5\n"), setup),
                 {"mm.csv:2: sinkage_m: 12.5 is not valid", "suspected: sinkage_m in mm"});
}

TEST_F(Diagnose, AnOptionThatDoesNotGoWithDrivesIsRefusedBeforeAnythingIsRead) {
  const ProgramRun run =
      run_program(folder_, "diagnose drive.csv --scenario s.yaml --reference none.csv --out '" +
                               folder_.path("out") + "'");
  expect_refused(run, {"--reference", "--scenario"});
}

TEST_F(Diagnose, AReferenceThatIsGivenTwiceIsRefused) {
  const std::string recording = kScenario + "recording.csv", reference = "--reference " + recording;
  expect_refused(diagnose(recording, kScenario + "setup.yaml", reference + " " + reference),
                 {"the same runs as", "each counts once"});
}

TEST_F(Diagnose, ReplicatesThatAreAllTheSameAreNoNoise) {
  std::string text = "run_id,load_n,slip_ratio,slip_angle_deg,fx_n\n";
  for (const char* replicate : {"a", "b", "c"}) {
    for (int i = 0; i < 12; ++i) {
      text += std::string(replicate) + std::to_string(i) + ",64.7," + std::to_string(i * 0.05) +
              ",0," + std::to_string(i) + ".5\n";
    }
  }
  expect_refused(diagnose(folder_.write("same.csv", text), kScenario + "setup.yaml"),
                 {"same.csv: ", "identical"});
}

TEST_F(Diagnose, ColumnsThatAreNotKnownAreMentionedOnce) {
  const ProgramRun run =
      diagnose(folder_.write("wide.csv",
                             "run_id,load_n,slip_ratio,slip_angle_deg,fx_n,oven_deg,operator\n"
                             "a,64.7,0.1,0,3,21,x\nb,64.7,0.2,0,4,22,y\n"),
               kScenario + "setup.yaml");
  EXPECT_EQ(run.status, 1);  // two runs are no recording
  const std::string notice = "wide.csv: oven_deg, operator kept and not used\n";
  ASSERT_NE(run.errors.find(notice), std::string::npos) << run.errors;
  EXPECT_EQ(run.errors.find("oven_deg"), run.errors.rfind("oven_deg"));
}

TEST_F(Diagnose, CtrlCLeavesWholeFilesMarkedInterrupted) {
  // progress is shown on a terminal only: Ctrl-C comes when it tells that scoring has begun
  const std::string recording = kScenario + "recording.csv", setup = kScenario + "setup.yaml",
                    out = folder_.path("out");
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  ASSERT_GE(child, 0);
  if (child == 0) {
    execl(REGOPLAN_PROGRAM, "regoplan", "diagnose", recording.c_str(), "--setup", setup.c_str(),
          "--threads", "1", "--out", out.c_str(), nullptr);
    _exit(127);
  }
  std::string shown;
  std::array<char, 256> text;
  bool told = false;
  for (ssize_t n = 0; (n = read(terminal, text.data(), text.size())) > 0;) {
    shown.append(text.data(), static_cast<std::size_t>(n));
    if (told || shown.find("scoring") == std::string::npos) continue;
    told = true;
    EXPECT_EQ(kill(child, SIGINT), 0);
  }
  close(terminal);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(told) << shown;
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  const auto d = nlohmann::json::parse(folder_.read("out/diagnosis.json"));
  EXPECT_EQ(d["interrupted"], true);
  EXPECT_NE(folder_.read("out/report.html").find("The diagnosis was interrupted"),
            std::string::npos);
  EXPECT_FALSE(folder_.read("out/corrected-model.yaml").empty());
}

TEST_F(Diagnose, NamesTheGrousersThatOneOfTwoMeasuredWheelsHas) {
  const std::string bed = REGOPLAN_SOURCE_DIR "/benchmarks/measured/granular_bed/";
  const ProgramRun run =
      diagnose(bed + "grousered.csv", bed + "setup.yaml", "--reference '" + bed + "smooth.csv'");
  EXPECT_EQ(run.status, 0) << run.errors;
  const auto result = nlohmann::json::parse(folder_.read("out/diagnosis.json"));
  EXPECT_EQ(result.at("verdict"), "partly");
  const auto& claim = result.at("mechanisms").at(0);
  EXPECT_EQ(claim.at("id"), "grousers");
  EXPECT_GT(claim.at("share").at("explained"), 0.75);
}

}  // namespace
}  // namespace regoplan
