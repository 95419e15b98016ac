// Suites as Slurm job arrays, against a real controller and node on this machine.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>
#include <utility>

#include "tests/app/command_output.h"
#include "tests/app/flat_map.h"
#include "tests/app/listener.h"
#include "tests/app/program_run.h"

namespace regoplan {
namespace {

using namespace std::chrono_literals;

bool succeeds(const std::string& command) {
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

std::string text_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

template <class Condition>
bool within(std::chrono::seconds time, Condition condition) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(200ms);
  }
  return true;
}

/// Ports at which nobody answers.
std::pair<int, int> free_ports() {
  const Listener one, other;
  return {one.port(), other.port()};
}

/// A cluster of one node of two processors, its own munge and its own folders, for one test.
class Slurm : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* program : {"slurmctld", "slurmd", "munged", "sbatch"}) {
      if (!succeeds(fmt::format("command -v {}", program))) {
        GTEST_SKIP() << program << " is not installed (Debian's slurm-wlm and munge)";
      }
    }
    if (geteuid() != 0) GTEST_SKIP() << "a cluster of its own can only be started by root";
    folder_ = std::make_unique<ScratchFolder>();
    for (const char* name : {"state", "spool", "munge"}) {
      std::filesystem::create_directories(folder_->path(name));
    }
    std::filesystem::permissions(std::filesystem::path(folder_->path("munge")),
                                 std::filesystem::perms(0755));
    const std::string key = folder_->write("munge/key", std::string(1024, 'k'));
    std::filesystem::permissions(key, std::filesystem::perms(0600));
    const std::string munge = folder_->path("munge");
    const bool munged = succeeds(
        fmt::format("munged --force --key-file={0}/key --socket={0}/socket --pid-file={0}/pid "
                    "--log-file={0}/log --seed-file={0}/seed",
                    munge));
    const std::string host = output_of("hostname -s");
    const auto [controller_port, node_port] = free_ports();
    folder_->write(
        "slurm.conf",
        fmt::format("ClusterName=test\nSlurmctldHost={0}(127.0.0.1)\nSlurmUser=root\n"
                    "SlurmdUser=root\nAuthType=auth/munge\nAuthInfo=socket={1}/munge/socket\n"
                    "CredType=cred/munge\nStateSaveLocation={1}/state\nSlurmdSpoolDir={1}/spool\n"
                    "SlurmctldPidFile={1}/ctld.pid\nSlurmdPidFile={1}/d.pid\n"
                    "SlurmctldLogFile={1}/ctld.log\nSlurmdLogFile={1}/d.log\n"
                    "SlurmctldPort={2}\nSlurmdPort={3}\nProctrackType=proctrack/pgid\n"
                    "TaskPlugin=task/none\nSelectType=select/cons_tres\n"
                    "SelectTypeParameters=CR_CPU\nReturnToService=2\nMpiDefault=none\n"
                    "SlurmdTimeout=10\nKillWait=2\nMinJobAge=300\nSchedulerParameters="
                    "batch_sched_delay=1,sched_interval=2\n"
                    "NodeName={0} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN\n"
                    "PartitionName=all Nodes={0} Default=YES MaxTime=INFINITE State=UP\n",
                    host.substr(0, host.find('\n')),
                    folder_->path("").substr(0, folder_->path("").size() - 1), controller_port,
                    node_port));
    environment_ = fmt::format("SLURM_CONF='{}' ", folder_->path("slurm.conf"));
    const bool started = munged && succeeds(environment_ + "slurmctld -i") && start_node();
    if (!started || !within(30s, [this] {
          return output_of(environment_ + "sinfo -h -o %T").starts_with("idle");
        })) {
      const std::string said = output_of(environment_ + "sinfo 2>&1") +
                               folder_->read("ctld.log").substr(0, 600) +
                               folder_->read("d.log").substr(0, 600);
      // Only what a machine forbids is its own; whatever else Slurm says, we have caused.
      const auto says = [&](const char* cause) { return said.find(cause) != std::string::npos; };
      ASSERT_TRUE(says("not permitted") || says("ermission denied") || says("annot allocate"))
          << said;
      GTEST_SKIP() << "Slurm does not start here: " << said;
    }
  }

  void TearDown() override {
    if (!folder_) return;
    if (!environment_.empty()) succeeds(environment_ + "scancel --user=root");
    for (const char* pid : {"d.pid", "ctld.pid", "munge/pid"}) end(pid, SIGTERM);
    std::this_thread::sleep_for(500ms);
  }

  bool start_node() { return succeeds(environment_ + "slurmd"); }

  void end(const std::string& pid_file, int signal) const {
    std::istringstream text(folder_->read(pid_file));
    pid_t pid = 0;
    if (text >> pid && pid > 1) kill(pid, signal);
  }

  /// The node dies with everything on it.
  void kill_node(const std::string& out) {
    end("d.pid", SIGKILL);
    for (const auto& process : std::filesystem::directory_iterator("/proc")) {
      const std::string of = process.path().string();
      if (text_of(of + "/comm") != "slurmstepd\n") continue;
      if (text_of(of + "/environ").find(folder_->path("slurm.conf")) == std::string::npos) continue;
      kill(std::stoi(process.path().filename()), SIGKILL);
    }
    succeeds(fmt::format("pkill -9 -f '{}/shard-'", out));
  }

  /// Requeued jobs are held back for two minutes; no need to wait that long. What the node refuses
  /// while it buries the last run of a job goes on when the administrator says so.
  bool ends(const std::string& job) {
    return within(120s, [&] {
      succeeds(
          fmt::format("{0}scontrol update NodeName=$(hostname -s) State=RESUME", environment_));
      succeeds(fmt::format("{}scontrol release {}", environment_, job));
      succeeds(fmt::format("{}scontrol update JobId={} StartTime=now", environment_, job));
      return queue_is_empty();
    });
  }

  bool queue_is_empty() { return output_of(environment_ + "squeue -h -r").empty(); }

  std::unique_ptr<ScratchFolder> folder_;
  std::string environment_;
};

std::multiset<std::string> journal_keys(const ScratchFolder& folder, const std::string& out) {
  std::istringstream lines(folder.read(out + "/runs.jsonl"));
  std::multiset<std::string> keys;
  for (std::string line; std::getline(lines, line) && !lines.eof();) {
    const nlohmann::json run = nlohmann::json::parse(line);
    if (run.contains("origin")) continue;
    keys.insert(run.at("planner").get<std::string>() + run.at("seed").dump());
  }
  return keys;
}

TEST_F(Slurm, LosesNothingToRequeuesAndDeadNodes) {
  write_flat_scenario(*folder_);
  folder_->write("suite.yaml",
                 "name: array\nscenarios: [scenario.yaml]\nplanners: [RRT, KPIECE1, EST]\n"
                 "seeds: 12\ntime_s: 30\niterations: 200\nsoil_draws: 40\n");
  const std::string out = folder_->path("out");
  const std::string submit = fmt::format(
      "{}REGOPLAN='{}' sbatch --parsable --array=1-4 --output='{}/%a.txt' "
      "'{}/benchmarks/slurm_array.sh' '{}' '{}'",
      environment_, REGOPLAN_PROGRAM, folder_->path("."), REGOPLAN_SOURCE_DIR,
      folder_->path("suite.yaml"), out);
  const std::string submitted = output_of(submit);
  const std::string job = submitted.substr(0, submitted.find_first_of("; \n"));
  ASSERT_FALSE(job.empty());
  const auto lines_of = [&](int shard) {
    const std::string text = folder_->read(fmt::format("out/shard-{}/runs.jsonl", shard));
    return std::count(text.begin(), text.end(), '\n');
  };
  ASSERT_TRUE(within(60s, [&] { return lines_of(1) >= 2; })) << folder_->read("1.txt");
  EXPECT_TRUE(succeeds(fmt::format("{}scontrol requeue {}_1", environment_, job)));
  ASSERT_TRUE(within(90s, [&] { return lines_of(2) >= 2; })) << folder_->read("2.txt");
  kill_node(out);
  std::this_thread::sleep_for(1s);
  ASSERT_TRUE(start_node());
  ASSERT_TRUE(ends(job)) << output_of(environment_ + "squeue -r");
  // Slurm fails what it launched while the node was dead. The same array again goes on.
  const std::string again = output_of(submit);
  ASSERT_TRUE(ends(again.substr(0, again.find_first_of("; \n"))));

  std::string last_words = output_of(environment_ + "scontrol show job");
  for (const char* file : {"1.txt", "2.txt", "3.txt", "4.txt", "d.log"}) {
    last_words += folder_->read(file);
  }
  const ProgramRun merge =
      run_program(*folder_, fmt::format("benchmark merge '{0}/shard-1' '{0}/shard-2' '{0}/shard-3' "
                                        "'{0}/shard-4' --out '{0}/whole' --json",
                                        out));
  ASSERT_EQ(merge.status, 0) << merge.errors << last_words;
  const std::multiset<std::string> keys = journal_keys(*folder_, "out/whole");
  EXPECT_EQ(keys.size(), 36U) << last_words;
  EXPECT_EQ(std::set<std::string>(keys.begin(), keys.end()).size(), 36U);
}

}  // namespace
}  // namespace regoplan
