#include "drive_diagnosis/instruments/steering_sign.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "drive_diagnosis/instruments/column_factors.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr std::size_t kFewestWindows = 12;
constexpr double kPerRadian = 1 / kDegree;  ///< degrees
constexpr std::string_view kCurvature = "curvature_1pm";

std::string steer_of(const WheelMount& wheel) {
  return fmt::format("steer_{}_rad", wheel.name);
}

/// Some columns of steering are to be multiplied by a factor.
struct SteeringGuess {
  double factor = 1;
  std::vector<std::string> columns;
  Eigen::RowVectorXd by_wheel;  ///< the factor of each wheel
};

/// What the columns of a drive may be: all of them, those of an axle, or one, told otherwise.
std::vector<SteeringGuess> guesses_of(const DriveRecording& drive, const Vehicle& vehicle) {
  const auto wheels = static_cast<Eigen::Index>(vehicle.wheels.size());
  std::vector<SteeringGuess> guesses;
  const auto add = [&](double factor, const auto& is_its) {
    SteeringGuess guess{
        .factor = factor, .columns = {}, .by_wheel = Eigen::RowVectorXd::Ones(wheels)};
    for (Eigen::Index i = 0; i < wheels; ++i) {
      const WheelMount& wheel = vehicle.wheels[static_cast<std::size_t>(i)];
      if (!wheel.steered || !is_its(wheel)) continue;
      guess.by_wheel[i] = factor;
      if (drive.channel(steer_of(wheel))) guess.columns.push_back(steer_of(wheel));
    }
    const bool is_new = std::ranges::none_of(
        guesses, [&guess](const SteeringGuess& other) { return other.by_wheel == guess.by_wheel; });
    if (is_new) guesses.push_back(std::move(guess));
  };
  const auto all = [](const WheelMount&) { return true; };
  const bool by_curvature = std::ranges::any_of(vehicle.wheels, [&](const WheelMount& wheel) {
    return wheel.steered && !drive.channel(steer_of(wheel));
  });
  if (by_curvature) {
    add(-1, all);
    guesses.back().columns.emplace_back(kCurvature);
    return guesses;
  }
  for (const double factor : {-1.0, kPerRadian, -kPerRadian, kDegree, -kDegree}) {
    add(factor, all);
    for (const WheelMount& one : vehicle.wheels) {
      constexpr double kOneAxle_m = 0.1;
      if (!one.steered) continue;
      add(factor,
          [&one](const WheelMount& wheel) { return std::abs(wheel.x_m - one.x_m) < kOneAxle_m; });
      add(factor, [&one](const WheelMount& wheel) { return wheel.name == one.name; });
    }
  }
  return guesses;
}

/// Window by window, angles that are told of the wheels, and how the vehicle goes.
struct SteeringSamples {
  Eigen::MatrixXd told_rad;  ///< a column a wheel
  Eigen::MatrixXd goes;      ///< at which angle, rad, and on which curvature, 1/m
  Eigen::VectorXd roll_rad;
};

SteeringSamples samples_of(const DriveRecording& drive, std::size_t index,
                           const std::vector<DriveWindow>& windows, const Vehicle& vehicle) {
  const auto wheels = static_cast<Eigen::Index>(vehicle.wheels.size());
  std::vector<Eigen::RowVectorXd> told;
  std::vector<const DriveWindow*> of;
  for (const DriveWindow& window : windows) {
    if (window.drive != index || !(std::abs(window.forward_mps) > kMoving_mps * window.pace)) {
      continue;
    }
    Eigen::RowVectorXd angles = Eigen::RowVectorXd::Zero(wheels);
    for (Eigen::Index i = 0; i < wheels; ++i) {
      const WheelMount& wheel = vehicle.wheels[static_cast<std::size_t>(i)];
      if (!wheel.steered) continue;
      angles[i] = channel_mean(drive, window, steer_of(wheel));
      if (!std::isnan(angles[i])) continue;
      angles[i] = steer_angle_rad(vehicle, wheel, channel_mean(drive, window, kCurvature));
    }
    if (!std::isfinite(angles.sum() + window.left_mps + window.yaw_rate_rad_s)) continue;
    told.push_back(std::move(angles));
    of.push_back(&window);
  }
  const auto rows = static_cast<Eigen::Index>(of.size());
  SteeringSamples samples{.told_rad = Eigen::MatrixXd(rows, wheels),
                          .goes = Eigen::MatrixXd(rows, 2),
                          .roll_rad = Eigen::VectorXd(rows)};
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto at = static_cast<std::size_t>(i);
    samples.told_rad.row(i) = told[at];
    samples.goes.row(i) << std::atan(of[at]->left_mps / of[at]->forward_mps),
        of[at]->yaw_rate_rad_s / of[at]->forward_mps;
    samples.roll_rad[i] = of[at]->roll_rad;
  }
  return samples;
}

/// Angle and curvature at which wheels that are steered by small angles go least aside (least
/// squares): each goes at the vehicle's angle and the curvature times how far ahead it is.
Eigen::MatrixXd goes_as_steered(const Vehicle& vehicle) {
  Eigen::MatrixXd ahead =
      Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(vehicle.wheels.size()), 2);
  for (Eigen::Index i = 0; i < ahead.rows(); ++i) {
    ahead(i, 1) = vehicle.wheels[static_cast<std::size_t>(i)].x_m;
  }
  return ahead.completeOrthogonalDecomposition().pseudoInverse();
}

/// What neither a constant nor, where it is known throughout, the roll explains.
Eigen::MatrixXd left_of(const Eigen::MatrixXd& all, const Eigen::VectorXd& roll_rad) {
  Eigen::MatrixXd known = Eigen::MatrixXd::Ones(all.rows(), 2);
  known.col(1) = roll_rad;
  if (!known.allFinite()) known.col(1).setZero();
  return all - known * known.completeOrthogonalDecomposition().solve(all);
}

/// The guess that comes far nearer to how a drive goes than what is told; one of no columns where
/// none does. Nothing where the drive is too short or too straight to say.
std::optional<SteeringGuess> likely_guess(const DriveRecording& drive, std::size_t index,
                                          const std::vector<DriveWindow>& windows,
                                          const Vehicle& vehicle) {
  constexpr double kShare = 0.25, kNats = 12, kStraight_rad = 0.2 * kDegree;
  const SteeringSamples samples = samples_of(drive, index, windows, vehicle);
  const auto rows = static_cast<double>(samples.goes.rows());
  if (rows < kFewestWindows) return std::nullopt;
  const Eigen::MatrixXd told = left_of(samples.told_rad, samples.roll_rad);
  const Eigen::MatrixXd goes = left_of(samples.goes, samples.roll_rad);
  const Eigen::MatrixXd by_angles = goes_as_steered(vehicle).transpose();
  const double turns_rad = goes.col(1).norm() * longest_arm_m(vehicle);
  if (std::max(goes.col(0).norm(), turns_rad) < kStraight_rad * std::sqrt(rows)) {
    return std::nullopt;
  }
  // Squares of both multiply, as how far each scatters is not known; less than that is exact.
  constexpr double kExact_rad = 0.02 * kDegree;
  const double exact = rows * kExact_rad * kExact_rad;
  const double arm_m = longest_arm_m(vehicle);
  const auto squares = [&](const Eigen::RowVectorXd& by_wheel) {
    const Eigen::MatrixXd off =
        goes - (told.array().rowwise() * by_wheel.array()).matrix() * by_angles;
    return (off.col(0).squaredNorm() + exact) *
           (off.col(1).squaredNorm() + exact / (arm_m * arm_m));
  };
  const auto wheels = static_cast<Eigen::Index>(vehicle.wheels.size());
  const double as_told = squares(Eigen::RowVectorXd::Ones(wheels));
  const double straight_on = squares(Eigen::RowVectorXd::Zero(wheels));
  SteeringGuess best;
  double least = as_told;
  for (SteeringGuess& guess : guesses_of(drive, vehicle)) {
    const double off = squares(guess.by_wheel);
    if (off >= least) continue;
    least = off;
    best = std::move(guess);
  }
  const double nats = rows / 2 * std::log(as_told / least);
  if (least > kShare * std::min(as_told, straight_on) || nats < kNats) return SteeringGuess{};
  return best;
}

DriveFinding steering_finding(const FactoredColumns& group, std::size_t columns_there) {
  const double factor = group.factor();
  const bool is_unit = std::abs(factor) != 1;
  std::string text;
  if (is_unit) {
    text = fmt::format(
        "wheels go {:.0f} times {} off straight ahead than they are told to be steered{}: {}, "
        "taken so",
        kPerRadian, std::abs(factor) > 1 ? "farther" : "less far",
        factor < 0 ? ", and to the other side" : "",
        std::abs(factor) > 1 ? "radians in a column of degrees"
                             : "degrees that were taken for radians once more");
  } else {
    text = fmt::format(
        "wheels go to the other side than they are told to be steered: taken with "
        "the other sign{}",
        group.channels.size() == columns_there && columns_there > 2
            ? " (or front and rear are exchanged)"
            : "");
  }
  DriveFinding finding{
      .id = is_unit ? "unit" : "sign",
      .text = fmt::format("{}: {}", fmt::join(without_units(group.channels), ", "), text),
      .mended = true};
  if (is_unit) {
    finding.value = std::abs(factor);
    finding.unit = "deg/rad";
  }
  return finding;
}

}  // namespace

std::vector<DriveFinding> mend_steering(std::vector<DriveRecording>& drives,
                                        const std::vector<DriveWindow>& windows,
                                        const Vehicle& vehicle) {
  if (!any_has(drives, "steer_") && !any_has(drives, kCurvature)) return {};
  std::vector<std::string> columns{std::string(kCurvature)};
  for (const WheelMount& wheel : vehicle.wheels) {
    if (wheel.steered) columns.push_back(steer_of(wheel));
  }
  if (columns.size() == 1) return {};
  std::erase_if(columns, [&](const std::string& column) { return !any_has(drives, column); });
  std::vector<ColumnFactors> factors(columns.size(), ColumnFactors(drives.size()));
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const std::optional<SteeringGuess> guess = likely_guess(drives[i], i, windows, vehicle);
    for (std::size_t k = 0; k < columns.size() && guess; ++k) {
      if (drives[i].channel(columns[k]) == nullptr) continue;
      const bool is_its = std::ranges::find(guess->columns, columns[k]) != guess->columns.end();
      factors[k][i] = is_its ? guess->factor : 1;
    }
  }
  std::vector<FactoredColumns> groups;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    FactoredColumns::add(columns[k], with_others_followed(factors[k]), groups);
  }
  std::vector<DriveFinding> findings;
  for (const FactoredColumns& group : groups) {
    if (group.factor() == 1) continue;
    for (const std::string& name : group.channels) multiply_column(name, group.factors, drives);
    std::ranges::move(findings_of(group, steering_finding(group, columns.size()), drives),
                      std::back_inserter(findings));
  }
  return findings;
}

}  // namespace regoplan
