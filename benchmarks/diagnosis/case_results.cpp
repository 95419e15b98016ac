#include "benchmarks/diagnosis/case_results.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

#include "benchmarks/diagnosis/challenge_files.h"
#include "terramech/basics/input_error.h"

namespace regoplan::challenge {
namespace {

void append_line(const std::filesystem::path& file, const std::string& line) {
  const int handle = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  const std::string text = line + '\n';
  const bool written =
      handle >= 0 && write(handle, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      fsync(handle) == 0;
  if (handle >= 0) close(handle);
  if (!written) throw InputError(fmt::format("{}: cannot be written", file.string()));
}

CaseResult result_from(const nlohmann::json& json) {
  CaseResult result{.truth = truth_from(json.at("truth")), .outcomes = {}};
  for (const auto& outcome : json.at("outcomes")) result.outcomes.push_back(outcome_from(outcome));
  return result;
}

}  // namespace

ResultLog::ResultLog(std::filesystem::path file, const std::string& label)
    : file_(std::move(file)) {
  std::ifstream in(file_);
  std::string line;
  std::uintmax_t whole = 0;
  bool has_label = false;
  while (std::getline(in, line) && !in.eof()) {
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (json.is_discarded()) break;
    whole += line.size() + 1;
    if (!has_label) {
      if (json.value("label", "") != label) {
        throw InputError(fmt::format("{}: results of {}, not of {}; choose another folder",
                                     file_.string(), json.value("label", "?"), label));
      }
      has_label = true;
      continue;
    }
    CaseResult result = result_from(json);
    done_.insert({result.truth.stratum, result.truth.index});
    results_.push_back(std::move(result));
  }
  in.close();
  if (std::filesystem::exists(file_)) std::filesystem::resize_file(file_, whole);
  if (!has_label) append_line(file_, nlohmann::json{{"label", label}}.dump());
}

void ResultLog::append(const CaseResult& result) {
  nlohmann::json outcomes = nlohmann::json::array();
  for (const Outcome& outcome : result.outcomes) outcomes.push_back(outcome_json(outcome));
  append_line(file_,
              nlohmann::json{{"truth", truth_json(result.truth)}, {"outcomes", outcomes}}.dump());
  done_.insert({result.truth.stratum, result.truth.index});
  results_.push_back(result);
}

}  // namespace regoplan::challenge
