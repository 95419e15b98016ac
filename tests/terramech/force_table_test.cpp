#include "terramech/force_table/force_table.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <random>

#include "terramech/basics/input_error.h"
#include "tests/terramech/wheel_specs.h"

namespace regoplan {
namespace {

ForceTableSpec table_spec(const wheel_specs::NamedSpec& named) {
  return {.model = named.spec, .nominal_load_n = named.nominal_load_n, .accuracy = {}};
}

ForceTableSpec simulant() {
  return table_spec(wheel_specs::all().front());
}

const ForceTable& simulant_table() {
  static const ForceTable table(simulant());
  return table;
}

/// An empty folder that is removed again.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("force-table-test-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path only_file() const {
    return std::filesystem::directory_iterator(path_)->path();
  }

 private:
  std::filesystem::path path_;
};

}  // namespace

TEST(ForceTable, StaysWithinItsBoundOnStatesItWasNotCheckedWith) {
  for (const auto& named : wheel_specs::all()) {
    const ForceTableSpec spec = table_spec(named);
    const ForceTable table(spec);
    EXPECT_TRUE(table.error().within(spec.accuracy)) << named.name;
    const TableError fresh = table.check(60000, 20000, 99);
    EXPECT_GT(fresh.states, 70000u) << named.name;
    EXPECT_LE(fresh.at_999_permille, spec.accuracy.at_999_permille) << named.name;
    EXPECT_LE(fresh.at_worst, spec.accuracy.at_worst) << named.name;
    EXPECT_LE(fresh.at_worst, 2 * table.error().at_worst) << named.name;
  }
}

TEST(ForceTable, HoldsItsBoundForEveryWheelAndSoilThatComesWithTheProgram) {
  for (const auto& pair : named_soils::shipped_pairs()) {
    const ForceTableSpec spec{.model = pair.spec, .nominal_load_n = pair.nominal_load_n};
    const ForceTable table(spec);
    EXPECT_EQ(table.load_min_n(), 0.02 * pair.nominal_load_n) << pair.name;
    EXPECT_EQ(table.load_max_n(), 3 * pair.nominal_load_n) << pair.name;
    const TableError fresh = table.check(5000, 2000, 17);
    EXPECT_LE(fresh.at_999_permille, spec.accuracy.at_999_permille) << pair.name;
    EXPECT_LE(fresh.at_worst, spec.accuracy.at_worst) << pair.name;
  }
}

TEST(ForceTable, RefinesUntilTheBoundAskedHolds) {
  ForceTableSpec spec = table_spec(wheel_specs::all()[5]);
  ASSERT_EQ(spec.model.soil.kx1_m, 0);
  const ForceTable coarse(spec);
  spec.accuracy = {.at_999_permille = 1e-4, .at_worst = 5e-4};
  const ForceTable fine(spec);
  EXPECT_TRUE(fine.error().within(spec.accuracy));
  EXPECT_GT(fine.bytes(), coarse.bytes());
}

TEST(ForceTable, AnAccuracyOutOfReachIsAnError) {
  ForceTableSpec spec = simulant();
  spec.accuracy = {.at_999_permille = 1e-9, .at_worst = 1e-9};
  EXPECT_THROW(ForceTable{spec}, InputError);
}

TEST(ForceTable, CoversTheTrustedMotionsAndTwoToThreeHundredPercentOfTheLoad) {
  const ForceTable& table = simulant_table();
  for (const double load_n : {0.0201 * 60, 60.0, 2.99 * 60}) {
    for (const double slip : {-0.9, -0.001, 0.0, 0.4, 0.95}) {
      for (const double angle_deg : {-60.0, 0.0, 60.0}) {
        EXPECT_TRUE(table.covers(load_n, motion_at(slip, angle_deg * kDegree)));
      }
    }
  }
  EXPECT_FALSE(table.covers(0.01 * 60, motion_at(0, 0)));
  EXPECT_FALSE(table.covers(4 * 60, motion_at(0, 0)));
  EXPECT_FALSE(table.covers(60, motion_at(0, 70 * kDegree)));
  EXPECT_FALSE(table.covers(60, motion_at(0.99, 0)));
  EXPECT_FALSE(table.covers(60, motion_at(-0.99, 0)));
  EXPECT_FALSE(table.covers(60, {0, 0, 0}));
  EXPECT_FALSE(table.covers(60, {1, 0, -1}));
}

TEST(ForceTable, BeyondItsDomainTheDirectModelAnswers) {
  const ForceTable& table = simulant_table();
  for (const WheelMotion& motion : {motion_at(0.99, 0.2), motion_at(-1, 0.2), motion_at(0, 1.4),
                                    WheelMotion{0, 0, 0}, WheelMotion{1, 0.1, -1}}) {
    const WheelForces forces = table.forces(60, motion);
    const WheelForces direct = table.direct().forces(60, motion);
    EXPECT_EQ(forces.status, direct.status);
    EXPECT_EQ(forces.fx_n, direct.fx_n);
    EXPECT_EQ(forces.fy_n, direct.fy_n);
  }
  EXPECT_EQ(table.forces(1e7, motion_at(0.1, 0)).status, WheelStatus::kSinksToAxle);
  EXPECT_THROW(table.forces(-1, motion_at(0.1, 0)), ValueError);
  EXPECT_THROW(table.forces(60, {std::nan(""), 0, 1}), ValueError);
}

TEST(ForceTable, KeepsTheSymmetriesOfTheModel) {
  const ForceTable& table = simulant_table();
  for (const double slip : {-0.6, 0.0, 0.3}) {
    const WheelMotion m = motion_at(slip, 0.3);
    const WheelForces forces = table.forces(60, m);
    EXPECT_EQ(table.forces(60, {m.vx_mps, -m.vy_mps, m.rim_speed_mps}).fy_n, -forces.fy_n);
    const WheelForces reverse = table.forces(60, {-m.vx_mps, m.vy_mps, -m.rim_speed_mps});
    EXPECT_EQ(reverse.fx_n, -forces.fx_n);
    EXPECT_EQ(reverse.torque_nm, -forces.torque_nm);
    EXPECT_EQ(reverse.fy_n, forces.fy_n);
    EXPECT_EQ(table.forces(60, motion_at(slip, 0)).fy_n, 0);
  }
}

TEST(ForceTable, TorqueSinkageAndStatusFollowTheDirectModel) {
  const ForceTable& table = simulant_table();
  for (const double load_n : {10.0, 60.0, 150.0}) {
    for (const double slip : {-0.9, -0.3, 0.2, 0.95, 0.96}) {
      const WheelMotion motion = motion_at(slip, 0.4);
      const WheelForces forces = table.forces(load_n, motion);
      const WheelForces direct = table.direct().forces(load_n, motion);
      EXPECT_NEAR(forces.torque_nm, direct.torque_nm, 1e-3 * load_n * 0.09);
      EXPECT_NEAR(forces.sinkage_m, direct.sinkage_m, 1e-3 * direct.sinkage_m);
      EXPECT_EQ(forces.status, direct.status);
    }
  }
}

TEST(ForceTable, SlopesAreThoseOfTheDirectModel) {
  const ForceTable& table = simulant_table();
  const WheelModel& direct = table.direct();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> slips(-0.8, 0.8), angles(-0.9, 0.9), loads(10, 150);
  for (int i = 0; i < 300; ++i) {
    const double load_n = loads(random);
    const double slip = slips(random);
    if (std::abs(slip) < 0.02) continue;
    WheelMotion m = motion_at(slip, angles(random));
    if (i % 2 == 1) m = {-m.vx_mps, m.vy_mps, -m.rim_speed_mps};
    const SlopedForces sloped = table.forces_with_slopes(load_n, m);
    EXPECT_NEAR(sloped.fx.value_n, table.forces(load_n, m).fx_n, 1e-5 * load_n);
    EXPECT_NEAR(sloped.fy.value_n, table.forces(load_n, m).fy_n, 1e-5 * load_n);
    constexpr double kStep = 1e-4;
    const auto expect_slope = [&](double SlopedForce::*member, double load_step, WheelMotion d,
                                  double allowed) {
      const auto moved = [&](double sign) {
        return direct.forces(load_n + sign * load_step,
                             {m.vx_mps + sign * d.vx_mps, m.vy_mps + sign * d.vy_mps,
                              m.rim_speed_mps + sign * d.rim_speed_mps});
      };
      const double width = 2 * (load_step + d.vx_mps + d.vy_mps + d.rim_speed_mps);
      const double fx = (moved(1).fx_n - moved(-1).fx_n) / width;
      const double fy = (moved(1).fy_n - moved(-1).fy_n) / width;
      const double scale = std::abs(fx) + std::abs(fy);
      EXPECT_NEAR(sloped.fx.*member, fx, allowed + 0.03 * scale) << slip << " " << m.vy_mps;
      EXPECT_NEAR(sloped.fy.*member, fy, allowed + 0.03 * scale) << slip << " " << m.vy_mps;
    };
    expect_slope(&SlopedForce::by_load, kStep * load_n, {}, 0.01);
    expect_slope(&SlopedForce::by_vx_nspm, 0, {.vx_mps = kStep}, 0.02 * load_n);
    expect_slope(&SlopedForce::by_vy_nspm, 0, {.vy_mps = kStep}, 0.02 * load_n);
    expect_slope(&SlopedForce::by_rim_speed_nspm, 0, {.rim_speed_mps = kStep}, 0.02 * load_n);
  }
}

/// Where forces turn from braking to driving they bend: slopes are those of either side, to 10 %.
TEST(ForceTable, SlopesOverTheSlipStandNextToNoSlip) {
  const ForceTable& table = simulant_table();
  for (const double slip : {-1e-3, -1e-4, -1e-5, -1e-6, 0.0, 1e-6, 1e-5, 1e-4, 1e-3}) {
    for (const double beta : {0.0, 0.05, 0.3}) {
      const WheelMotion at = motion_at(slip, beta);
      constexpr double kStep = 1e-3;
      const double away = slip < 0 ? kStep : -kStep;  // of vx
      const auto fx = [&](double step) {
        return table.direct().forces(60, {at.vx_mps + step, at.vy_mps, at.rim_speed_mps}).fx_n;
      };
      const double slope = (fx(2 * away) - fx(away)) / away;
      const double found = table.forces_with_slopes(60, at).fx.by_vx_nspm;
      EXPECT_NEAR(found, slope, 0.1 * std::abs(slope)) << slip << ' ' << beta;
    }
  }
}

TEST(ForceTable, SideSlopeStandsAtSlipAngleZeroAndBeyondTheTable) {
  const ForceTable& table = simulant_table();
  EXPECT_GT(table.forces_with_slopes(60, motion_at(0.2, 0)).fy.by_vy_nspm, 10);
  EXPECT_GT(table.forces_with_slopes(60, motion_at(0.99, 0)).fy.by_vy_nspm, 1);
}

TEST(ForceTable, ManyStatesAtOnceAreTheSameStates) {
  const ForceTable& table = simulant_table();
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> slips(-1, 1), angles(-1.5, 1.5), loads(0.5, 200);
  std::vector<double> loads_n;
  std::vector<WheelMotion> motions;
  for (int i = 0; i < 1003; ++i) {
    loads_n.push_back(loads(random));
    const double slip = slips(random);
    motions.push_back(motion_at(slip, angles(random)));
  }
  const std::vector<PlaneForces> many = table.plane_forces(loads_n, motions);
  ASSERT_EQ(many.size(), motions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const WheelForces one = table.forces(loads_n[i], motions[i]);
    EXPECT_NEAR(many[i].fx_n, one.fx_n, 2e-6 * loads_n[i]);
    EXPECT_NEAR(many[i].fy_n, one.fy_n, 2e-6 * loads_n[i]);
  }
  loads_n.pop_back();
  EXPECT_THROW(table.plane_forces(loads_n, motions), InputError);
}

TEST(ForceTable, DecidesLikeTheDirectModelExceptWithinItsBound) {
  const ForceTable& table = simulant_table();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> slips(-0.9, 0.95), angles(-1, 1), demands(-1, 1);
  int disagree = 0;
  constexpr int kStates = 100000;
  for (int i = 0; i < kStates; ++i) {
    const double slip = slips(random);
    const double beta = angles(random);
    const double load_n = 60;
    const WheelMotion motion = motion_at(slip, beta);
    const WheelForces t = table.forces(load_n, motion), d = table.direct().forces(load_n, motion);
    const auto fc = [&](const WheelForces& f) {
      return f.fx_n * std::sin(beta) + f.fy_n * std::cos(beta);
    };
    const double demand_n = demands(random) * load_n;
    if ((fc(t) >= demand_n) == (fc(d) >= demand_n)) continue;
    ++disagree;
    EXPECT_LE(std::abs(fc(d) - demand_n), 2 * table.error().at_worst * load_n);
  }
  EXPECT_LE(disagree, kStates / 1000);
}

TEST(ForceTable, IsKeptOnDiskAndReadBackTheSame) {
  const Folder folder;
  const ForceTable built = ForceTable::cached(simulant(), folder.path());
  const auto file = folder.only_file();
  const auto written = std::filesystem::last_write_time(file);
  const ForceTable read = ForceTable::cached(simulant(), folder.path());
  EXPECT_EQ(std::filesystem::last_write_time(file), written);
  EXPECT_EQ(read.error().at_worst, built.error().at_worst);
  for (const double slip : {-0.5, 0.0, 0.7}) {
    EXPECT_EQ(read.forces(60, motion_at(slip, 0.2)).fy_n,
              built.forces(60, motion_at(slip, 0.2)).fy_n);
  }
  ForceTableSpec other = simulant();
  other.model.soil.cohesion_pa += 1;
  ForceTable::cached(other, folder.path());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(ForceTable, ACorruptFileIsBuiltAgain) {
  const Folder folder;
  const ForceTable built = ForceTable::cached(simulant(), folder.path());
  const auto file = folder.only_file();
  const auto size = std::filesystem::file_size(file);
  {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(size / 2));
    stream.write("garbage", 7);
  }
  const ForceTable again = ForceTable::cached(simulant(), folder.path());
  EXPECT_EQ(again.forces(60, motion_at(0.3, 0.2)).fy_n, built.forces(60, motion_at(0.3, 0.2)).fy_n);
  std::filesystem::resize_file(file, size / 3);
  EXPECT_NO_THROW(ForceTable::cached(simulant(), folder.path()));
  EXPECT_EQ(std::filesystem::file_size(file), size);
}

TEST(ForceTable, WhatAKilledProcessLeftHalfWrittenIsSwept) {
  const Folder folder;
  std::filesystem::create_directories(folder.path());
  const pid_t ended = fork();
  if (ended == 0) _exit(0);
  waitpid(ended, nullptr, 0);
  const auto file = [&](const std::string& name) {
    std::ofstream(folder.path() / name) << "half";
    return folder.path() / name;
  };
  const auto left = file("0123456789abcdef.force-table." + std::to_string(ended));
  const auto of_a_neighbour = file("0123456789abcdef.force-table." + std::to_string(getppid()));
  const auto of_somebody = file("notes.force-table.txt");
  ForceTable::cached(simulant(), folder.path());
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::exists(of_a_neighbour));
  EXPECT_TRUE(std::filesystem::exists(of_somebody));
}

TEST(ForceTable, AFolderThatCannotBeWrittenOnlyCostsTime) {
  EXPECT_GT(ForceTable::cached(simulant(), "/proc/no/such/folder").bytes(), 0u);
}

TEST(ForceTable, NamesTheLoadThatCannotBe) {
  ForceTableSpec spec = simulant();
  for (const double load_n : {0.0, -1.0, std::nan("")}) {
    spec.nominal_load_n = load_n;
    EXPECT_THROW(ForceTable{spec}, ValueError);
  }
}

}  // namespace regoplan
