// What the same rows cost in C++ alone, for the benchmark of the Python package: reads
// load, slip and slip angle as doubles, column after column, and prints the seconds of a batch.
#include <cstdio>
#include <ctime>
#include <fstream>
#include <vector>

#include "app/settings/model_settings.h"
#include "terramech/force_table/force_table.h"

namespace {

using namespace regoplan;

struct Rows {
  std::vector<double> load_n, slip, angle_rad;
};

Rows read_rows(const char* file, std::size_t count) {
  Rows rows;
  std::ifstream stream(file, std::ios::binary);
  for (auto* column : {&rows.load_n, &rows.slip, &rows.angle_rad}) {
    column->resize(count);
    stream.read(reinterpret_cast<char*>(column->data()),
                static_cast<std::streamsize>(count * sizeof(double)));
  }
  return rows;
}

/// Of the processor.
double seconds_since(std::clock_t begun) {
  return static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
}

/// All results in columns, as the package gives them.
template <class Source>
double seconds_of_forces(const Source& source, const Rows& rows) {
  const std::clock_t begun = std::clock();
  const std::size_t count = rows.load_n.size();
  std::vector<double> fx(count), fy(count), torque(count), sinkage(count);
  std::vector<unsigned char> status(count);
  for (std::size_t i = 0; i < count; ++i) {
    const WheelForces f = source.forces(rows.load_n[i], motion_at(rows.slip[i], rows.angle_rad[i]));
    fx[i] = f.fx_n;
    fy[i] = f.fy_n;
    torque[i] = f.torque_nm;
    sinkage[i] = f.sinkage_m;
    status[i] = static_cast<unsigned char>(f.status);
  }
  return seconds_since(begun);
}

double seconds_of_batch(const ForceTable& table, const Rows& rows) {
  const std::clock_t begun = std::clock();
  std::vector<WheelMotion> motions;
  motions.reserve(rows.slip.size());
  for (std::size_t i = 0; i < rows.slip.size(); ++i) {
    motions.push_back(motion_at(rows.slip[i], rows.angle_rad[i]));
  }
  const std::vector<PlaneForces> forces = table.plane_forces(rows.load_n, motions);
  const double seconds = seconds_since(begun);
  return forces.size() == rows.slip.size() ? seconds : -1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) return 1;
  const WheelModelSpec spec = read_model_file(argv[1]).spec;
  const Rows rows = read_rows(argv[2], std::stoul(argv[3]));
  const std::string method = argv[4];
  if (method == "direct" || method == "fast") {
    const WheelModel model(spec, method == "fast" ? WheelAccuracy::kFast : WheelAccuracy::kExact);
    std::printf("%.9f\n", seconds_of_forces(model, rows));
    return 0;
  }
  const ForceTable table =
      ForceTable::cached({.model = spec, .nominal_load_n = std::stod(argv[5]), .accuracy = {}});
  std::printf("%.9f\n",
              method == "table" ? seconds_of_forces(table, rows) : seconds_of_batch(table, rows));
  return 0;
}
