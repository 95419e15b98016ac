#include "driving/drive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "driving/true_world.h"
#include "planner/evaluation/manoeuvres.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "tests/terramech/named_soils.h"

namespace regoplan {
namespace {

UncertainSoil regolith() {
  return {.mean = named_soils::firm_regolith()};
}

/// A traverse of a side slope by the lunar rover, ready to be driven.
struct Traverse {
  explicit Traverse(double slope_deg = 10, double speed_mps = 1.5)
      : prepared(made(slope_deg, speed_mps)),
        planned(prepared.problem, WorldUse::kVerdict, 1),
        path(std::get<ReferencePath>(prepared.course)) {}

  static PreparedManoeuvre made(double slope_deg, double speed_mps) {
    const Vehicle lrv = preset_vehicle("lrv");
    ElevationRaster flat{
        .frame = {.columns = 2, .rows = 2, .north_m = 2, .cell_width_m = 1, .cell_height_m = 1},
        .height_m = {0, 0, 0, 0}};
    const MapSoil soil{"regolith", "", regolith()};
    const PlanningProblem base{
        .map = TerrainMap(flat, std::nullopt, {.soils = {soil}, .classes = {}, .unmapped = 0}, {}),
        .vehicle = lrv,
        .gravity_mps2 = 1.62,
        .speed_max_mps = 3,
        .limits = default_limits(lrv)};
    return prepare({.kind = ManoeuvreKind::kSlopeTraverse,
                    .vehicle = lrv,
                    .soil = soil,
                    .speed_mps = speed_mps,
                    .slope_rad = slope_deg * kDegree,
                    .slope_heading_rad = 90 * kDegree,
                    .length_m = 25},
                   base.limits, base);
  }

  DriveResult driven(const DriveTruth& truth, const DriveSettings& settings) const {
    const TrueWorld world(prepared.problem, truth);
    return drive(planned, world, path, false, settings);
  }

  PreparedManoeuvre prepared;
  World planned;
  ReferencePath path;
};

SensorSuite noisy() {
  const SensorChannel once{.rate_hz = 1, .noise = 0.02};
  return {.position = once, .yaw = once, .wheel_speed = SensorChannel{.noise = 0.01}};
}

TEST(Drive, CompensationTakesTheOffsetOnASideSlopeAway) {
  const Traverse traverse(15);
  const DriveResult plain = traverse.driven({}, {.follower = {FollowerKind::kPursuit, {}}});
  const DriveResult fed = traverse.driven({}, {.follower = {FollowerKind::kCompensated, {}}});
  ASSERT_TRUE(plain.reached);
  ASSERT_TRUE(fed.reached);
  // Beyond the first metres, in which both take up their slip angle.
  const double plain_m = plain.moments[plain.moments.size() * 3 / 4].offset_m;
  const double fed_m = fed.moments[fed.moments.size() * 3 / 4].offset_m;
  EXPECT_GT(std::abs(plain_m), 0.02);
  EXPECT_LT(std::abs(fed_m), 0.5 * std::abs(plain_m));
}

/// A slalom on soft soil, as fast as its margins allow.
PreparedManoeuvre fast_slalom() {
  PreparedManoeuvre slope = Traverse::made(0, 2.6);
  UncertainSoil soft = regolith();
  soft.mean.friction_angle_rad = 30 * kDegree;
  soft.mean.kphi = 2e5;
  soft.mean.kx0_m = soft.mean.ky0_m = 0.025;
  return prepare({.kind = ManoeuvreKind::kSlalom,
                  .vehicle = preset_vehicle("lrv"),
                  .soil = {"soft", "", soft},
                  .speed_mps = 2.6,
                  .amplitude_m = 2,
                  .wavelength_m = 30,
                  .waves = 6},
                 slope.problem.limits, slope.problem);
}

TEST(Drive, AFollowerOfOnesOwnIsAskedBeforeEachStepAndHeldToTheVehiclesRange) {
  const Traverse traverse(5);
  std::vector<double> asked_s;
  const auto own = [&](const FollowerView& view) {
    asked_s.push_back(view.time_s);
    return VehicleControl{.speed_target_mps = view.path_speed_mps,
                          .curvature_target_1pm = view.path_curvature_1pm - view.offset_m / 9 -
                                                  view.heading_error_rad / 1.5};
  };
  const DriveResult run =
      traverse.driven({}, {.follower = {.kind = FollowerKind::kOwn, .own = own}});
  ASSERT_TRUE(run.reached);
  EXPECT_LT(run.cross_track_max_m, 0.3);
  EXPECT_EQ(asked_s.front(), 0);
  EXPECT_TRUE(std::ranges::is_sorted(asked_s, std::ranges::less_equal()));

  const auto beyond = [](const FollowerView&) {
    return VehicleControl{.speed_target_mps = 1, .curvature_target_1pm = 9};
  };
  EXPECT_THROW(traverse.driven({}, {.follower = {.kind = FollowerKind::kOwn, .own = beyond}}),
               InputError);
}

TEST(Drive, FeedbackDoesNotSwingOnSoftSoil) {
  const PreparedManoeuvre slalom = fast_slalom();
  const World planned(slalom.problem, WorldUse::kVerdict, 1);
  const TrueWorld world(slalom.problem, {});
  const DriveResult run = drive(planned, world, std::get<ReferencePath>(slalom.course), false,
                                {.follower = {FollowerKind::kCompensated, {}}});
  ASSERT_TRUE(run.reached) << (run.reason ? name(*run.reason) : "");
  EXPECT_LT(run.cross_track_max_m, 0.25);
}

/// As fast as may be, then down to rest at the rate of the rims, as plans brake.
ReferencePath braked_to_rest(ReferencePath path, double speed_mps, double rate_mps2) {
  PathLeg& leg = path.legs.front();
  const double length_m = leg.curve.length_m();
  std::vector<SpeedProfile::Node> nodes{{0, speed_mps}};
  constexpr int kParts = 20;
  for (int i = 0; i <= kParts; ++i) {
    const double speed = speed_mps * (kParts - i) / kParts;
    nodes.push_back({length_m - speed * speed / (2 * rate_mps2), speed});
  }
  leg.speed = SpeedProfile(std::move(nodes));
  return path;
}

TEST(Drive, AVehicleThatBrakesAsHardAsItsRimsCanStopsWhereItsPathEnds) {
  const Traverse level(0, 3);
  const ReferencePath path =
      braked_to_rest(level.path, 3, level.prepared.problem.vehicle.acceleration_max_mps2);
  const TrueWorld world(level.prepared.problem, {});
  for (const FollowerKind kind : {FollowerKind::kPursuit, FollowerKind::kCompensated}) {
    const DriveResult run = drive(level.planned, world, path, false, {.follower = {kind, {}}});
    const CurvePlace end = path.legs.front().curve.at(path.length_m());
    const auto& stands = run.moments.back().state;
    EXPECT_LT(std::hypot(stands.x_m - end.x_m, stands.y_m - end.y_m), 0.1) << name(kind);
  }
}

TEST(Drive, FeedbackLooksAheadByTheWaitForAFix) {
  const Traverse traverse;
  SensorSuite late = noisy();
  late.position->latency_s = 0.5;
  const double exact_s = traverse.driven({}, {}).law.lookahead_s;
  EXPECT_EQ(exact_s, SteeringLaw{}.lookahead_s);
  EXPECT_EQ(traverse.driven({}, {.sensors = noisy()}).law.lookahead_s, exact_s + 1);
  EXPECT_EQ(traverse.driven({}, {.sensors = late}).law.lookahead_s, exact_s + 1.5);
}

TEST(Drive, TheSameSeedGivesTheSameBits) {
  const Traverse traverse;
  const DriveSettings settings{.sensors = noisy(), .seed = 7};
  const DriveResult a = traverse.driven({}, settings), b = traverse.driven({}, settings);
  DriveSettings other = settings;
  other.seed = 8;
  const DriveResult c = traverse.driven({}, other);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    EXPECT_EQ(a.moments[i].state.x_m, b.moments[i].state.x_m);
    EXPECT_EQ(a.moments[i].state.y_m, b.moments[i].state.y_m);
    if (std::isfinite(a.rows[i].x_m)) {
      EXPECT_EQ(a.rows[i].x_m, b.rows[i].x_m);
    }
  }
  EXPECT_NE(a.moments.back().state.y_m, c.moments.back().state.y_m);
}

TEST(Drive, FollowersSeeNothingOfTheTruthBesideWhatIsSensed) {
  const Traverse traverse;
  const DriveResult run = traverse.driven({}, {.sensors = noisy()});
  double largest_m = 0;
  for (const DriveMoment& moment : run.moments) {
    largest_m = std::max(largest_m, std::hypot(moment.seen.x_m - moment.state.x_m,
                                               moment.seen.y_m - moment.state.y_m));
  }
  EXPECT_GT(largest_m, 0.005);
  EXPECT_LT(largest_m, 0.3);  // and the filter keeps to what is sensed
}

TEST(Drive, SamplesComeAtTheirRates) {
  const Traverse traverse;
  SensorSuite suite = noisy();
  suite.torque = std::nullopt;
  const DriveResult run = traverse.driven({}, {.sensors = suite});
  int placed = 0;
  for (const SensedRow& row : run.rows) {
    placed += std::isfinite(row.x_m);
    EXPECT_TRUE(row.torque_nm.empty());
    if (&row != &run.rows.back()) {  // which need not fall on a sample
      EXPECT_EQ(row.wheel_speed_rad_s.size(), 4u);
    }
  }
  EXPECT_NEAR(placed, run.duration_s, 2);
}

TEST(Drive, AWeakerZoneSlowsAndItsWheelsSlipMore) {
  const Traverse traverse(0);
  DriveTruth truth;
  Soil weak = regolith().mean;
  weak.kphi = 2e5;
  weak.friction_angle_rad = 28 * kDegree;
  truth.zones = {
      {.name = "weak", .soil = weak, .corners = {{10, -50}, {20, -50}, {20, 50}, {10, 50}}}};
  const DriveResult run = traverse.driven(truth, {});
  ASSERT_TRUE(run.reached);
  double inside = 0, outside = 0;
  int rows_inside = 0, rows_outside = 0;
  for (const DriveMoment& moment : run.moments) {
    const double x = moment.state.x_m;
    const bool in_zone = x > 12 && x < 18;
    if (!in_zone && (x < 3 || x > 8)) continue;
    (in_zone ? inside : outside) += moment.wheels[0].sinkage_m;
    (in_zone ? rows_inside : rows_outside) += 1;
  }
  ASSERT_GT(rows_inside, 10);
  ASSERT_GT(rows_outside, 10);
  EXPECT_GT(inside / rows_inside, 1.5 * outside / rows_outside);
}

TEST(Drive, ADraggingWheelShowsInItsTorqueAlone) {
  const Traverse traverse(0);
  DriveTruth truth;
  truth.wheels.resize(4);
  truth.wheels[1].drag_nm = 5;
  const DriveResult plain = traverse.driven({}, {}), dragged = traverse.driven(truth, {});
  const std::size_t row = plain.rows.size() / 2;
  EXPECT_NEAR(dragged.rows[row].torque_nm[1], plain.rows[row].torque_nm[1] + 5, 0.01);
  EXPECT_NEAR(dragged.rows[row].torque_nm[0], plain.rows[row].torque_nm[0], 1e-6);
  EXPECT_NEAR(dragged.moments.back().state.y_m, plain.moments.back().state.y_m, 1e-9);
}

TEST(Drive, ASteeringOffsetTurnsTheVehicleToItsSide) {
  const Traverse traverse(0);
  DriveTruth truth;
  truth.wheels.resize(4);
  truth.wheels[0].steer_offset_rad = truth.wheels[1].steer_offset_rad = 2 * kDegree;
  const DriveResult run = traverse.driven(truth, {});
  ASSERT_TRUE(run.reached);
  EXPECT_GT(run.moments[run.moments.size() / 2].offset_m, 0.01);
  // The feedback holds against it.
  EXPECT_LT(run.moments[run.moments.size() / 2].state.curvature_1pm, -0.005);
}

TEST(Drive, AnOffsetCentreOfGravityIsToldOfTheKnownPoint) {
  const Traverse traverse(0);
  DriveTruth truth;
  truth.cg_forward_m = 0.2;
  const DriveResult run = traverse.driven(truth, {});
  ASSERT_TRUE(run.reached);
  EXPECT_NEAR(run.rows.front().x_m, 0, 1e-9);
  EXPECT_LT(run.cross_track_max_m, 0.05);
  const std::size_t row = run.moments.size() / 2;
  EXPECT_GT(run.moments[row].wheels[0].load_n, 1.1 * run.moments[row].wheels[2].load_n);
}

TEST(Drive, WheelsInTheRutsOfOthersSinkLess) {
  const Traverse traverse(0);
  DriveTruth truth;
  truth.rut_stiffness = 2;
  const DriveResult run = traverse.driven(truth, {});
  const DriveMoment& moment = run.moments[run.moments.size() / 2];
  EXPECT_LT(moment.wheels[2].sinkage_m, 0.9 * moment.wheels[0].sinkage_m);
}

TEST(Drive, WheelsThatCreepAtRestHaveNoSlip) {
  const Traverse traverse(15);
  const TrueWorld world(traverse.prepared.problem, {});
  VehicleState state = start_of(traverse.path, world.known_vehicle());
  state.rim_speed_mps = 0;
  state.motion = {.vx_mps = 1e-5, .vy_mps = -4e-4};
  for (const WheelNow& wheel : world.wheels(state)) {
    EXPECT_GT(wheel.load_n, 0);
    EXPECT_EQ(wheel.slip, 0);
    EXPECT_EQ(wheel.slip_angle_rad, 0);
  }
  state.motion.vy_mps = -4e-3;  // it slides
  for (const WheelNow& wheel : world.wheels(state)) EXPECT_LT(wheel.slip_angle_rad, -1);
}

TEST(Drive, WhoStraysFartherThanAllowedIsStopped) {
  const Traverse traverse(15);
  const DriveResult run = traverse.driven({}, {.deviation_max_m = 0.001});
  EXPECT_FALSE(run.reached);
  EXPECT_EQ(run.reason, Rejection::kDeviation);
  ASSERT_TRUE(run.exceeded);
  EXPECT_GT(run.exceeded->found, 0.001);
}

TEST(Drive, SlowSoilBreaksLimitsThatAreNamed) {
  const Traverse traverse(10);
  DriveTruth truth;
  Soil weak = regolith().mean;
  weak.cohesion_pa = 0;
  weak.kc = 0;
  weak.kphi = 6e3;
  truth.soils = {weak};
  const DriveResult run = traverse.driven(truth, {});
  ASSERT_FALSE(run.broken.empty());
  EXPECT_FALSE(run.within_limits());
  EXPECT_TRUE(run.reason);
  EXPECT_GT(run.broken.front().time_s, 0);
}

}  // namespace
}  // namespace regoplan
