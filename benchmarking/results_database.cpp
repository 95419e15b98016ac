#include "benchmarking/results_database.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <algorithm>
#include <memory>
#include <set>

#include "benchmarking/ompl_log.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

/// A database that throws where SQLite says no.
class Database {
 public:
  explicit Database(const std::filesystem::path& file) : file_(file) {
    sqlite3* raw = nullptr;
    const int code = sqlite3_open(file.c_str(), &raw);
    handle_.reset(raw);
    require(code == SQLITE_OK);
  }

  void run(const std::string& sql) {
    require(sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  }

  /// Inserts a row; empty text, `nan` and `inf` are NULL, all else gets its column's type.
  /// \returns its id
  sqlite3_int64 insert(const std::string& table, const std::vector<std::string>& columns,
                       const std::vector<std::string>& values, bool replace_nothing = false) {
    const std::vector<std::string_view> marks(columns.size(), "?");
    const std::string sql =
        fmt::format("INSERT {}INTO {} (\"{}\") VALUES ({})", replace_nothing ? "OR IGNORE " : "",
                    table, fmt::join(columns, "\",\""), fmt::join(marks, ","));
    sqlite3_stmt* raw = nullptr;
    require(sqlite3_prepare_v2(handle_.get(), sql.c_str(), -1, &raw, nullptr) == SQLITE_OK);
    const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement(raw,
                                                                               &sqlite3_finalize);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string& value = values[i];
      const int place = static_cast<int>(i) + 1;
      if (value.empty() || value == "nan" || value == "inf") {
        sqlite3_bind_null(raw, place);
      } else {
        sqlite3_bind_text(raw, place, value.c_str(), -1, SQLITE_STATIC);
      }
    }
    require(sqlite3_step(raw) == SQLITE_DONE);
    return sqlite3_last_insert_rowid(handle_.get());
  }

  static std::string quoted(const std::string& name) { return "\"" + name + "\""; }

 private:
  void require(bool well) {
    if (!well) {
      throw InputError(
          fmt::format("{}: cannot be written ({})", file_.string(), sqlite3_errmsg(handle_.get())));
    }
  }

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, decltype(&sqlite3_close)> handle_{nullptr, &sqlite3_close};
};

/// `path length m REAL` as a column's name and type.
struct Column {
  std::string name, type;
};

Column column_of(const std::string& property) {
  const std::size_t space = property.rfind(' ');
  std::string name = property.substr(0, space);
  std::replace(name.begin(), name.end(), ' ', '_');
  std::replace(name.begin(), name.end(), '.', '_');
  return {.name = name, .type = property.substr(space + 1)};
}

class Columns {
 public:
  Columns(Database& database, std::string table) : database_(database), table_(std::move(table)) {}

  /// The column's name, added to the table where it is new.
  std::string ensure(const std::string& property) {
    const Column column = column_of(property);
    if (known_.insert(column.name).second) {
      database_.run(fmt::format("ALTER TABLE {} ADD {} {}", table_, Database::quoted(column.name),
                                column.type));
    }
    return column.name;
  }

 private:
  Database& database_;
  std::string table_;
  std::set<std::string> known_;
};

constexpr const char* kTables = R"(
CREATE TABLE experiments (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512), totaltime REAL,
  timelimit REAL, memorylimit REAL, runcount INTEGER, version VARCHAR(128),
  hostname VARCHAR(1024), cpuinfo TEXT, date DATETIME, seed VARCHAR(24), setup TEXT);
CREATE TABLE plannerConfigs (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512) NOT NULL,
  settings TEXT);
CREATE TABLE enums (name VARCHAR(512), value INTEGER, description TEXT, PRIMARY KEY (name, value));
CREATE TABLE runs (id INTEGER PRIMARY KEY AUTOINCREMENT, experimentid INTEGER, plannerid INTEGER,
  FOREIGN KEY (experimentid) REFERENCES experiments(id) ON DELETE CASCADE,
  FOREIGN KEY (plannerid) REFERENCES plannerConfigs(id) ON DELETE CASCADE);
CREATE TABLE progress (runid INTEGER, time REAL, PRIMARY KEY (runid, time),
  FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE);
)";

/// Fills one database.
class Filling {
 public:
  explicit Filling(Database& database)
      : database_(database),
        experiment_columns_(database, "experiments"),
        run_columns_(database, "runs"),
        progress_columns_(database, "progress") {
    database.run(kTables);
    const std::vector<std::string> statuses = ompl_status_names();
    for (std::size_t i = 0; i < statuses.size(); ++i) {
      database.insert("enums", {"name", "value", "description"},
                      {"status", std::to_string(i), statuses[i]});
    }
  }

  void add(const BenchmarkExperiment& experiment) {
    const std::string id = std::to_string(add_head(experiment));
    for (const PlannerRuns& planner : experiment.planners) {
      const std::string planner_id = std::to_string(planner_config(planner));
      for (const RunRecord& run : planner.runs) add_run(run, planner, id, planner_id);
    }
  }

 private:
  sqlite3_int64 add_head(const BenchmarkExperiment& experiment) {
    const JournalOrigin& origin = experiment.origin;
    std::vector<std::string> columns{"name",     "totaltime", "timelimit", "memorylimit",
                                     "runcount", "version",   "hostname",  "cpuinfo",
                                     "date",     "seed",      "setup"};
    std::vector<std::string> values{
        experiment.name,
        fmt::format("{}", search_seconds(experiment)),
        fmt::format("{}", origin.bounds.time_s),
        fmt::format("{}", origin.bounds.memory_mb),
        std::to_string(runs_per_planner(experiment)),
        "OMPL " + ompl_version(),
        origin.host,
        origin.cpu,
        origin.started,
        std::to_string(experiment.planners.front().runs.front().key.seed),
        fmt::format("regoplan {}, suite {}", origin.version, origin.suite)};
    for (const auto& [name, value] : experiment.parameters) {
      columns.push_back(experiment_columns_.ensure(name));
      values.push_back(value);
    }
    return database_.insert("experiments", columns, values);
  }

  sqlite3_int64 planner_config(const PlannerRuns& planner) {
    std::string settings;
    for (const auto& [name, value] : planner.settings) {
      settings += fmt::format("{} = {}\n;", name, value);
    }
    const auto [place, is_new] = planners_.try_emplace({planner.planner, settings}, 0);
    if (is_new) {
      place->second =
          database_.insert("plannerConfigs", {"name", "settings"}, {planner.planner, settings});
    }
    return place->second;
  }

  void add_run(const RunRecord& run, const PlannerRuns& planner, const std::string& experiment_id,
               const std::string& planner_id) {
    std::vector<std::string> columns{"experimentid", "plannerid"};
    std::vector<std::string> values{experiment_id, planner_id};
    for (const auto& [name, value] : run.outcome.properties) {
      columns.push_back(run_columns_.ensure(name));
      values.push_back(value);
    }
    const std::string id = std::to_string(database_.insert("runs", columns, values));
    if (planner.progress_properties.empty()) return;
    std::vector<std::string> progress_columns{"runid", "time"};
    for (std::size_t i = 1; i < run.outcome.progress_names.size(); ++i) {
      progress_columns.push_back(progress_columns_.ensure(run.outcome.progress_names[i]));
    }
    for (const std::vector<std::string>& sample : run.outcome.progress) {
      std::vector<std::string> row{id};
      row.insert(row.end(), sample.begin(), sample.end());
      // Two samples of one moment: the first counts, as in OMPL's own reader.
      database_.insert("progress", progress_columns, row, /*replace_nothing=*/true);
    }
  }

  Database& database_;
  Columns experiment_columns_, run_columns_, progress_columns_;
  std::map<std::pair<std::string, std::string>, sqlite3_int64> planners_;
};

}  // namespace

void write_results_database(const std::filesystem::path& file,
                            const std::vector<BenchmarkExperiment>& experiments) {
  Database database(file);
  database.run("BEGIN");
  Filling filling(database);
  for (const BenchmarkExperiment& experiment : experiments) filling.add(experiment);
  database.run("COMMIT");
}

}  // namespace regoplan
