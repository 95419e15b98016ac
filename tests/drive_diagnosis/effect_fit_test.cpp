// What is sought beside a zone, and what its borders say of it.
#include "drive_diagnosis/fit/effect_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drive_diagnosis/fit/zone_borders.h"
#include "tests/drive_diagnosis/compared_drive.h"

namespace regoplan {
namespace {

/// Of kphi, a soil's bearing.
std::size_t bearing() {
  const auto& numbers = soil_parameters();
  return static_cast<std::size_t>(std::ranges::find(numbers, &Soil::kphi, &SoilParameter::member) -
                                  numbers.begin());
}

/// What another bearing along each window changes of a drive straight ahead.
struct OtherBearing : Compared {
  OtherBearing()
      : Compared({.speed_mps = [](double, double) { return 1.2; },
                  .weave_1pm = [](double, double) { return 0.0; }}),
        base(comparison->predicted_as_said({})),
        along(soil_columns(*comparison, {bearing()}, {}, base, {}).front()) {}

  double torque_nm(const std::string& wheel, std::size_t other_along, std::size_t in) const {
    const auto channel = comparison->channel("torque_" + wheel + "_nm").value();
    return along[other_along](static_cast<Eigen::Index>(in), static_cast<Eigen::Index>(channel));
  }

  Eigen::MatrixXd base;
  std::vector<Eigen::MatrixXd> along;
};

TEST(SoilColumns, SoilAlongAWindowIsUnderFrontWheelsInTheOneBeforeAndUnderRearOnesInTheNext) {
  const OtherBearing drive;
  constexpr std::size_t kThere = 20;
  for (const std::string side : {"left", "right"}) {
    const std::string front = "front_" + side, rear = "rear_" + side;
    // Firmer soil is easier to roll on; wheels that are not on it yet, or no longer, pull less
    // hard against those that are.
    EXPECT_LT(drive.torque_nm(front, kThere, kThere), -0.1);
    EXPECT_LT(drive.torque_nm(rear, kThere, kThere), -0.1);
    EXPECT_LT(drive.torque_nm(front, kThere, kThere - 1), -0.1);
    EXPECT_GT(drive.torque_nm(rear, kThere, kThere - 1), 0);
    EXPECT_GT(drive.torque_nm(front, kThere, kThere + 1), 0);
    EXPECT_LT(drive.torque_nm(rear, kThere, kThere + 1), -0.1);
  }
}

TEST(SoilColumns, SoilAlongAllWindowsTogetherIsSoilEverywhere) {
  const OtherBearing drive;
  SoilNumbers other{};
  other.at(bearing()) = 1;
  const Eigen::MatrixXd everywhere =
      drive.comparison->predicted(drive.comparison->all(), {.soils = {other}}, {}, drive.base, {}) -
      drive.base;
  Eigen::MatrixXd sum = 0 * drive.base;
  for (const Eigen::MatrixXd& along : drive.along) sum += along;
  constexpr double kNonlinear = 0.02;
  EXPECT_LT((sum - everywhere).cwiseAbs().maxCoeff(),
            kNonlinear * everywhere.cwiseAbs().maxCoeff());
}

TEST(ZoneBorders, AreOpenWhereWheelsCrossThemAndTwiceAsFarWhereTheyAreKnownHalfAsWell) {
  const OverAStretch drive;
  const WindowSet crossing = windows_at_borders(*drive.comparison, {drive.zone});
  const auto std = [&drive](const EdgesErr& err) {
    return border_std(*drive.comparison, {{}, {drive.zone}}, err, {});
  };
  const Eigen::MatrixXd near = std({.windows = 0.1}), far = std({.windows = 0.2});
  for (std::size_t w = 0; w < drive.comparison->size(); ++w) {
    if (std::ranges::binary_search(crossing, w)) continue;
    EXPECT_EQ(far.row(static_cast<Eigen::Index>(w)).norm(), 0) << w;
  }
  EXPECT_NEAR(far.norm(), 2 * near.norm(), 0.2 * far.norm());
  for (const double edge : {drive.zone.begins, drive.zone.ends}) {
    EXPECT_GT(near.row(static_cast<Eigen::Index>(edge)).norm(), 0.2) << edge;
  }
  EXPECT_GT(std({.angle_rad = 0.2}).norm(), 0.1);
}

/// How large the drag of a wheel is found, or fitted, on a drive over a soft stretch that is known,
/// where that wheel's torques are told off by so much in the windows about a place.
double drag_nm(double off_nm, double off_at_m, bool is_fitted) {
  SimulatedDrive dragging;
  dragging.deviation.wheel_drag_nm[0] = 5;
  OverAStretch drive(dragging);
  const auto& channels = drive.drives[0].channels;
  const auto torque = std::ranges::find(channels, "torque_front_left_nm", &DriveChannel::name);
  for (DriveWindow& window : drive.windows) {
    constexpr double kNear_m = 6;
    if (std::abs(window.x_m - off_at_m) > kNear_m) continue;
    window.channels.at(static_cast<std::size_t>(torque - channels.begin())) += off_nm;
  }
  drive.comparison.emplace(drive.drives, drive.windows, drive.map, drive.vehicle, 1.62, 2);
  std::vector<VehicleTrial> trials =
      vehicle_trials(drive.vehicle, 1.62, {}, drive.map, drive.comparison->soils_driven(), false);
  std::erase_if(trials, [](const VehicleTrial& trial) { return trial.id != "wheel_drag"; });
  const std::stop_token stop;
  const std::vector<LikelySoil> likely;
  EffectFit fit(*drive.comparison, drive.map, trials, likely, stop);
  EffectFound zone{.is_zone = true, .begins = drive.zone.begins, .ends = drive.zone.ends};
  zone.share = shares_between(zone.begins, zone.ends, drive.comparison->size());
  fit.add(zone);
  EffectFound drag = fit.strongest(7);
  EXPECT_FALSE(drag.is_zone);
  EXPECT_EQ(drag.parameter, 0u);
  if (!is_fitted) return drag.size * trials[0].unit;
  fit.add(drag);
  fit.settle_with(drag);
  return fit.fit().parameters[0] * trials[0].unit;
}

TEST(EffectFit, WindowsInWhichWheelsCrossTheBorderOfAKnownZoneSayNothingOfAFault) {
  for (const bool is_fitted : {false, true}) {
    const double sound_nm = drag_nm(0, 0, is_fitted);
    const auto changed_nm = [&](double off_at_m) {
      return std::abs(drag_nm(1, off_at_m, is_fitted) - sound_nm);
    };
    const double elsewhere_nm = changed_nm(230);
    EXPECT_GT(elsewhere_nm, 0.05);
    for (const double border_m : {OverAStretch::kFrom_m, OverAStretch::kTo_m}) {
      EXPECT_LT(changed_nm(border_m), 0.01 * elsewhere_nm) << border_m;
    }
  }
}

/// The map with one soil west of a border and a weaker one east of it.
TerrainMap of_soils_beside(double border_m, double weakness_east) {
  const TerrainMap map = rolling_map();
  std::vector<MapSoil> soils{map.soils().front(), map.soils().front()};
  soils[1].name = "loose";
  soils[1].soil.mean = weaker(soils[0].soil, weakness_east);
  ClassRaster classes{.frame = map.elevation().frame, .code = {}};
  for (int row = 0; row < classes.frame.rows; ++row) {
    for (int column = 0; column < classes.frame.columns; ++column) {
      classes.code.push_back(column < border_m ? 1 : 2);
    }
  }
  return TerrainMap(map.elevation(), classes,
                    SoilCatalogue{.soils = soils, .classes = {{1, 0}, {2, 1}}}, {});
}

/// A zone is found with most of it on one of the map's soils, and its edges then leave most of it
/// on another: numbers told from the first had been taken for such of the second, and where wheels
/// sink that deep no step led back (kphi 8600 where 25000 was concealed, told to 8 %).
TEST(EffectFit, AZonesSoilStaysWhatItIsWhereItsEdgesMoveMostOfItToAnotherSoilOfTheMap) {
  constexpr double kWeak = 8, kEast = 5, kBorder_m = 150;
  SimulatedDrive over{.torque_scatter = 0, .sensor_noise = 0};
  over.weakness = [](double x_m) {
    if (x_m > OverAStretch::kFrom_m && x_m < OverAStretch::kTo_m) return kWeak;
    return x_m < kBorder_m ? 0.0 : kEast;
  };
  const TerrainMap map = of_soils_beside(kBorder_m, kEast);
  const Vehicle vehicle = preset_vehicle("lrv");
  const std::vector<DriveRecording> drives{record(over, rolling_map())};
  const std::vector<DriveWindow> windows = drive_windows(drives[0], 0, 5, 0.3);
  WindowComparison comparison(drives, windows, map, vehicle, 1.62, 2);
  const std::vector<VehicleTrial> trials =
      vehicle_trials(vehicle, 1.62, {}, map, comparison.soils_driven(), false);
  const std::vector<LikelySoil> likely;
  const std::stop_token stop;
  EffectFit fit(comparison, map, trials, likely, stop);
  fit.settle();
  EffectFound zone{.is_zone = true};
  for (std::size_t i = 0; i < comparison.size(); ++i) {
    const double x_m = windows[comparison.window(i)].x_m;
    if (x_m < OverAStretch::kFrom_m - 3) zone.begins = static_cast<double>(i);
    if (x_m < OverAStretch::kTo_m - 9) zone.ends = static_cast<double>(i + 1);
  }
  zone.share = shares_between(zone.begins, zone.ends, comparison.size());
  fit.add(zone);
  EXPECT_EQ(fit.soil_of(0), 0);
  fit.settle_with(zone);
  ASSERT_EQ(fit.soil_of(0), 1);
  SoilNumbers numbers = fit.numbers_of(fit.fit().zones[0]);
  numbers.at(bearing()) += fit.deviation().soils[1].at(bearing());
  const double found = deviating(map.soils()[1].soil, numbers).kphi;
  const double concealed = weaker(map.soils()[0].soil, kWeak).kphi;
  EXPECT_NEAR(std::log(found / concealed), 0, 0.3);
}

}  // namespace
}  // namespace regoplan
