// What goes wrong around the program: full disks, interrupts, pipes, other people's files, other
// languages.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <future>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/app/command_output.h"
#include "tests/app/flat_map.h"
#include "tests/app/program_run.h"
#include "tests/app/simulant_model.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

class Faults : public testing::Test {
 protected:
  Faults() {
    write_flat_scenario(folder_);
    folder_.write("m.yaml", kSimulantModel);
    folder_.write("c.csv", "load_n,slip_ratio,slip_angle_deg\n60,0.2,5\n");
  }

  std::string file(const std::string& name) const {
    return fmt::format(" '{}' ", folder_.path(name));
  }

  ProgramRun run(const std::string& arguments, const std::string& before = "") const {
    return run_program(folder_, arguments, before);
  }

  /// The status of a whole shell command in which `@` stands for the program; what it says on
  /// standard error goes to the file `errors`.
  int shell(std::string command, const std::string& errors = "errors") const {
    for (std::size_t at = command.find('@'); at != std::string::npos; at = command.find('@')) {
      command.replace(at, 1, "'" REGOPLAN_PROGRAM "'");
    }
    const int status =
        std::system(fmt::format("bash -c \"({}) 2>{}\"", command, file(errors)).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  ScratchFolder folder_;
};

TEST_F(Faults, AnEmptyNameOfAFileOrFolderIsTold) {
  for (const auto& [arguments, error] : {
           std::pair{"wheel c.csv --model m.yaml --out ''", "--out: empty, names no file"},
           std::pair{"compare a b --out ''", "--out: empty, names no folder"},
           std::pair{"compare a ''", "B: empty, names no folder"},
           std::pair{"evaluate s.yaml p.csv --out ''", "--out: empty, names no folder"},
           std::pair{"benchmark suite.yaml --out ''", "--out: empty, names no folder"},
           std::pair{"export plan --nav2 ''", "--nav2: empty, names no folder"},
           std::pair{"diagnose r.csv --setup '' --out o", "--setup: empty, names no file"},
       }) {
    const ProgramRun told = run(arguments);
    EXPECT_EQ(told.status, 1) << arguments;
    EXPECT_NE(told.errors.find(error), std::string::npos) << arguments << ": " << told.errors;
  }
}

TEST_F(Faults, AFolderWhereAFileIsWantedIsTold) {
  std::filesystem::create_directory(folder_.path("empty"));
  for (const std::string arguments :
       {"plan empty --out o", "plan --again empty --out o", "plan s.yaml --model empty --out o",
        "evaluate empty p.csv --out o", "evaluate s.yaml empty --out o",
        "evaluate s.yaml --manoeuvres empty --out o", "drive empty p.csv --out o",
        "drive s.yaml empty --out o", "drive s.yaml p.csv --truth empty --out o",
        "diagnose empty --setup s.yaml --out o", "diagnose r.csv --setup empty --out o",
        "diagnose r.csv --setup s.yaml --reference empty --out o",
        "diagnose r.csv --scenario empty --out o", "wheel empty --model m.yaml",
        "wheel c.csv --model empty", "wheel c.csv --model m.yaml --out empty",
        "map make --soils empty --out o", "benchmark empty --out o"}) {
    expect_refusal(run(arguments, "cd" + file("") + "&& "),
                   {"empty is a folder (allowed: a file, such as "});
    EXPECT_FALSE(std::filesystem::exists(folder_.path("o"))) << arguments;
  }
  // A folder that holds the file by its own name: that may be what was meant.
  expect_refusal(run("plan" + file("") + "--out o"),
                 {"SCENARIO.yaml: ",
                  "is a folder (allowed: a file, such as " + folder_.path("scenario.yaml") + ")"});
  expect_refusal(run("map info" + file("empty")),
                 {"empty: is a folder, and no raster that GDAL can read"});
}

TEST_F(Faults, AFileWhereAFolderIsWantedIsTold) {
  folder_.write("file", "");
  for (const std::string arguments :
       {"plan scenario.yaml --out file", "map make --out file", "demo --out file",
        "wheel --figures file", "export result --nav2 file",
        "diagnose r.csv --setup s --out file"}) {
    expect_refusal(run(arguments, "cd" + file("") + "&& "), {"file: not a folder"});
  }
  expect_refusal(run("export file --nav2 o", "cd" + file("") + "&& "),
                 {"RESULT: file: no result of plan (allowed: a folder with plan.json)"});
}

TEST_F(Faults, OutputThatIsLostIsAnError) {
  for (const std::string& arguments :
       {"wheel" + file("c.csv") + "--model" + file("m.yaml"), "map info" + file("dem.tif"),
        std::string("--help"), std::string("--version"),
        "wheel" + file("c.csv") + "--json --model" + file("m.yaml")}) {
    EXPECT_EQ(shell("@ " + arguments + " >/dev/full"), 1) << arguments;
    EXPECT_EQ(folder_.read("errors"), "regoplan: standard output: cannot be written (disk full?)\n")
        << arguments;
    EXPECT_EQ(shell("@ " + arguments + " >&-"), 1) << arguments;
  }
  // Nobody can be told; all the same it ends as it should.
  EXPECT_EQ(shell("@ map info none.tif 2>/dev/full"), 1);
}

TEST_F(Faults, AFileThatMayNotGrowIsAnError) {
  std::string rows = "load_n,slip_ratio,slip_angle_deg\n";
  for (int i = 0; i < 300; ++i) rows += "60,0.2,5\n";
  folder_.write("c.csv", rows);
  expect_refusal(run("wheel" + file("c.csv") + "--model" + file("m.yaml") + "--out" + file("o.csv"),
                     "ulimit -f 8; "),
                 {"cannot be written"});
  EXPECT_FALSE(std::filesystem::exists(folder_.path("o.csv")));
}

TEST_F(Faults, AnErrorIsOneLineThatATerminalObeysNothingOf) {
  folder_.write("s.yaml", replaced(flat_scenario(), "vehicle: lrv",
                                   "vehicle: \"lrv\\x1b[2J" + std::string(300000, 'x') + "\""));
  const ProgramRun refused = run("map info" + file("none\x1b[31m.tif"));
  expect_refusal(refused, {R"(none\x1b[31m.tif)"});
  const ProgramRun scenario = run("plan" + file("s.yaml") + "--out" + file("out"));
  expect_refusal(scenario, {"s.yaml:4: vehicle: ", R"(lrv\x1b[2Jxxx)"});
  EXPECT_LT(scenario.errors.size(), 2000);
  // More letters than a name may have.
  const ProgramRun name = run("map info" + file(std::string(300, 'n')));
  expect_refusal(name, {});
  EXPECT_EQ(name.errors.find("filesystem error"), std::string::npos) << name.errors;
  const ProgramRun deep = run("plan" + file(std::string(300, 'n')) + "--out" + file("out"));
  expect_refusal(deep, {"File name too long"});
  EXPECT_EQ(deep.errors.find("filesystem error"), std::string::npos) << deep.errors;
}

TEST_F(Faults, EditedFilesAreReplacedOnlyWhenForced) {
  folder_.write("one.yaml", kOneSoil);
  const std::string make = "map make --width-m 60 --height-m 60 --quiet --out" + file("map");
  ASSERT_EQ(run(make).status, 0);
  EXPECT_EQ(run(make).status, 0);
  folder_.write("map/scenario.yaml", folder_.read("map/scenario.yaml") + "# mine\n");
  const std::string before = folder_.read("map/scenario.yaml");
  expect_refusal(run(make + "--seed 5"), {"map/scenario.yaml: ", "changed since", "--force"});
  EXPECT_EQ(folder_.read("map/scenario.yaml"), before);
  expect_refusal(run("map import --gravity-mps2 1.62 --elevation" + file("dem.tif") + "--soils" +
                     file("one.yaml") + "--out" + file("map")),
                 {"--force"});
  EXPECT_EQ(run(make + "--force").status, 0);
  EXPECT_NE(folder_.read("map/scenario.yaml"), before);

  folder_.write("o.csv", "mine");
  const std::string wheel =
      "wheel" + file("c.csv") + "--model" + file("m.yaml") + "--out" + file("o.csv");
  expect_refusal(run(wheel), {"o.csv: ", "--force"});
  EXPECT_EQ(folder_.read("o.csv"), "mine");
  EXPECT_EQ(run(wheel + "--force").status, 0);
  EXPECT_EQ(run(wheel).status, 0);

  // Before anything is searched.
  std::filesystem::create_directory(folder_.path("out"));
  folder_.write("out/candidate-3.csv", "mine");
  expect_refusal(run("plan" + file("scenario.yaml") + "--quiet --time 600 --out" + file("out")),
                 {"candidate-3.csv: ", "--force"});
  folder_.write("out/report.html", "mine");
  folder_.write("p.csv", "x_m,y_m\n10,20\n20,20\n");
  expect_refusal(run("evaluate" + file("scenario.yaml") + file("p.csv") + "--out" + file("out")),
                 {"report.html: ", "--force"});
}

TEST_F(Faults, ModelsAndTablesComeThroughPipesToo) {
  EXPECT_EQ(shell(fmt::format("@ wheel <(cat {}) --model <(cat {}) --out {}", file("c.csv"),
                              file("m.yaml"), file("piped.csv"))),
            0)
      << folder_.read("errors");
  ASSERT_EQ(
      run("wheel" + file("c.csv") + "--model" + file("m.yaml") + "--out" + file("o.csv")).status,
      0);
  EXPECT_EQ(folder_.read("piped.csv"), folder_.read("o.csv"));
}

TEST_F(Faults, APipeThatNobodyWritesToCanBeInterrupted) {
  ASSERT_EQ(mkfifo(folder_.path("pipe").c_str(), 0600), 0);
  const std::string pipe = file("pipe");
  const std::vector<std::string> waiting = {
      "wheel" + pipe + "--model" + file("m.yaml"),
      "wheel" + file("c.csv") + "--model" + pipe,
      "evaluate" + file("scenario.yaml") + pipe + "--out" + file("evaluated"),
      "drive" + file("scenario.yaml") + pipe + "--out" + file("driven"),
      "diagnose" + pipe + "--setup" + file("m.yaml") + "--out" + file("diagnosed"),
      "map info" + pipe};
  // Each has a folder of its own: what a command leaves is nobody else's then. All wait at once.
  // They are interrupted late enough that they have started on a busy machine too. `--foreground`:
  // timeout sends SIGCONT after its signal else, which takes away the SIGSTOP by which the leak
  // check of the sanitizers attaches to a process that ends, and that check then waits for ever.
  std::vector<std::future<int>> statuses;
  for (const std::string& arguments : waiting) {
    statuses.push_back(std::async(std::launch::async, [&, i = statuses.size()] {
      return shell("timeout --foreground --preserve-status -k 20 -s INT 4 @ " + arguments,
                   fmt::format("errors {}", i));
    }));
  }
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    EXPECT_EQ(statuses[i].get(), 130) << waiting[i];
    EXPECT_EQ(folder_.read(fmt::format("errors {}", i)), "regoplan: interrupted\n") << waiting[i];
  }
  EXPECT_EQ(shell("timeout --foreground --preserve-status -k 20 -s TERM 1.5 @ map info" + pipe),
            143);
  // One that somebody holds open and writes nothing to.
  const std::string held = "exec 9<>" + pipe +
                           "; timeout --foreground --preserve-status -k 20 -s INT 1.5 @ wheel" +
                           pipe + "--model" + file("m.yaml");
  EXPECT_EQ(shell(held), 130);
  for (const char* out : {"evaluated", "driven", "diagnosed"}) {
    EXPECT_FALSE(std::filesystem::exists(folder_.path(out))) << out;
  }
}

TEST_F(Faults, AFolderThatDoesNotExistIsASlipWhereAFileIsNamed) {
  expect_refusal(
      run("wheel" + file("c.csv") + "--model" + file("m.yaml") + "--out" + file("no/such/o.csv")),
      {"--out: the folder ", "no/such does not exist"});
  EXPECT_FALSE(std::filesystem::exists(folder_.path("no")));
}

TEST_F(Faults, AMapBlamesWhatWasGiven) {
  const ProgramRun given = run("map make --cell-m 1 --out" + file("map"));
  expect_refusal(given, {"--cell-m: does not go with the default of --crater-diameter-min-m"});
  expect_refusal(run("map make --cell-m 1 --crater-diameter-min-m 2 --out" + file("map")),
                 {"regoplan: --crater-diameter-min-m: 2 is not valid (allowed: 4 to 5000)"});
}

TEST_F(Faults, TextOfOursIsNoFormulaAndColumnsOfTheirsAreAsTheyWere) {
  folder_.write("c.csv",
                "=note,load_n,slip_ratio,slip_angle_deg\n=1+1,60,0.2,5\n\"@a,b\",60,0.2,-5\n"
                "-x,60,-0.2,5\n");
  const ProgramRun wheel = run("wheel" + file("c.csv") + "--model" + file("m.yaml"));
  EXPECT_EQ(wheel.status, 0) << wheel.errors;
  EXPECT_TRUE(wheel.output.starts_with("=note,load_n,")) << wheel.output;
  EXPECT_NE(wheel.output.find("\n=1+1,60,0.2,5,"), std::string::npos) << wheel.output;
  EXPECT_NE(wheel.output.find("\n\"@a,b\",60,0.2,-5,"), std::string::npos) << wheel.output;
  EXPECT_NE(wheel.output.find("\n-x,60,-0.2,5,"), std::string::npos) << wheel.output;

  folder_.write("s.yaml", replaced(flat_scenario(), "{mare:", "{\"=HYPERLINK(1)\":"));
  EXPECT_EQ(
      run("evaluate" + file("s.yaml") + "--chart" + file("chart") + "--chart-slopes-deg 0 --quiet")
          .status,
      0);
  const std::string table = folder_.read("chart/side-slope.csv");
  EXPECT_NE(table.find("\n'=HYPERLINK(1),0,"), std::string::npos) << table;
}

TEST_F(Faults, OtherLanguagesChangeNothing) {
  const std::string locales = folder_.path("locales");
  for (const char* locale : {"de_DE", "tr_TR"}) {
    const std::string source = std::string("/usr/share/i18n/locales/") + locale;
    if (!std::filesystem::exists(source)) {
      GTEST_SKIP() << source << " is absent (Debian's package locales)";
    }
    std::filesystem::create_directories(locales);
    const std::string made =
        fmt::format("localedef -i {0} -f UTF-8 '{1}/{0}.UTF-8' 2>&1", locale, locales);
    const std::string said = output_of(made);
    ASSERT_TRUE(std::filesystem::exists(fmt::format("{}/{}.UTF-8/LC_NUMERIC", locales, locale)))
        << said;
  }
  folder_.write("p.csv", "x_m,y_m,speed_mps\n8.5,20.25,0\n20,20,1.5\n30,21,0\n");
  const std::string wheel = "wheel" + file("c.csv") + "--model" + file("m.yaml");
  const std::string evaluate =
      "evaluate" + file("scenario.yaml") + file("p.csv") + "--draws 20 --quiet --out" + file("out");
  const std::string info = "map info --json" + file("dem.tif");
  const std::string make =
      "map make --width-m 60 --height-m 60 --quiet --force --out" + file("map");
  const auto results = [&](const std::string& before) {
    EXPECT_EQ(run(evaluate, before).status, 0);
    EXPECT_EQ(run(make, before).status, 0);
    nlohmann::json json = nlohmann::json::parse(folder_.read("out/evaluation.json"));
    json.erase("evaluation_time_s");
    return std::vector<std::string>{run(wheel, before).output,
                                    run(info, before).output,
                                    json.dump(),
                                    folder_.read("map/scenario.yaml"),
                                    folder_.read("map/rocks.csv"),
                                    run("map info none.tif", before).errors};
  };
  const std::vector<std::string> plain = results("LC_ALL=C ");
  for (const char* locale : {"de_DE", "tr_TR"}) {
    EXPECT_EQ(results(fmt::format("LOCPATH='{}' LC_ALL={}.UTF-8 ", locales, locale)), plain)
        << locale;
  }
}

}  // namespace
}  // namespace regoplan
