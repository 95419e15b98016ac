// Writes sealed challenges: what a diagnosis may see into one folder, the truth into another.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>

#include "benchmarks/diagnosis/challenge_files.h"
#include "terramech/basics/input_error.h"

namespace {

using namespace regoplan;
using namespace regoplan::challenge;

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw InputError(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> names;
  for (const Stratum stratum : strata()) names.emplace_back(name(stratum));
  std::string stratum, out, sealed;
  std::uint64_t seed = 1, first = 0, count = 1;
  CLI::App app{"Challenges for the diagnosis"};
  CLI::App* make =
      app.add_subcommand("generate", "recording.csv, setup.yaml and a sealed truth.json");
  make->add_option("--stratum", stratum, fmt::format("{}", fmt::join(names, ", ")))->required();
  make->add_option("--seed", seed, "of the series")->capture_default_str();
  make->add_option("--first", first, "index of the first case")->capture_default_str();
  make->add_option("--count", count, "cases")->capture_default_str();
  make->add_option("--out", out, "folder of what a diagnosis may see")->required();
  make->add_option("--sealed", sealed, "folder of the truths; default: OUT-sealed");
  app.require_subcommand(1);
  CLI11_PARSE(app, argc, argv);
  try {
    if (sealed.empty()) sealed = out + "-sealed";
    const Stratum of = stratum_named(stratum);
    for (std::uint64_t index = first; index < first + count; ++index) {
      const Challenge challenge = generate(of, seed, index);
      const std::string id = fmt::format("{}-{:03}", stratum, index);
      const std::filesystem::path folder = std::filesystem::path(out) / id;
      write(folder / "recording.csv", recording_csv(challenge.recording));
      write(folder / "setup.yaml", setup_yaml(challenge.setup));
      write(std::filesystem::path(sealed) / id / "truth.json", truth_json(challenge.truth).dump(2));
      fmt::print("{}\n", folder.string());
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "diagnosis_challenge: {}\n", error.what());
    return 1;
  }
  return 0;
}
