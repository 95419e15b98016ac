#include "planner/soils/soil_surrogate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "planner/problem/world.h"

namespace regoplan {
namespace {

Eigen::RowVectorXd terms_of(const Eigen::RowVectorXd& z) {
  const Eigen::Index n = z.size();
  Eigen::RowVectorXd terms(1 + n + n * (n + 1) / 2);
  terms[0] = 1;
  terms.segment(1, n) = z;
  Eigen::Index next = 1 + n;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = i; k < n; ++k) terms[next++] = z[i] * z[k];
  }
  return terms;
}

/// Solves least squares with a pull toward 0 of all but the constant.
Eigen::MatrixXd ridge(const Eigen::MatrixXd& terms, const Eigen::MatrixXd& values, double pull) {
  Eigen::MatrixXd normal = terms.transpose() * terms;
  normal.diagonal().tail(normal.rows() - 1).array() += pull;
  return normal.ldlt().solve(terms.transpose() * values);
}

}  // namespace

SoilNumbers uncertain_numbers(const PlanningProblem& problem,
                              const std::vector<VehicleState>& states) {
  const GroundFinder ground(problem.map, problem.vehicle);
  std::set<std::size_t> soils;
  for (const VehicleState& state : states) {
    const GroundPatch patch = ground.at(state.x_m, state.y_m, state.yaw_rad);
    for (std::size_t i = 0; i < problem.vehicle.wheels.size(); ++i) {
      soils.insert(static_cast<std::size_t>(patch.soil.at(i)));
    }
  }
  SoilNumbers numbers;
  for (const std::size_t soil : soils) {
    const UncertainSoil& known = problem.map.soils()[soil].soil;
    for (std::size_t k = 0; k < soil_parameters().size(); ++k) {
      if (known.standard_deviation.*soil_parameters()[k].member > 0) numbers.push_back({soil, k});
    }
  }
  return numbers;
}

Eigen::MatrixXd standard_deviations(const std::vector<MapSoil>& soils, const SoilNumbers& numbers,
                                    const std::vector<SoilDraw>& draws) {
  Eigen::MatrixXd deviations(static_cast<Eigen::Index>(draws.size()),
                             static_cast<Eigen::Index>(numbers.size()));
  for (std::size_t i = 0; i < draws.size(); ++i) {
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const auto member = soil_parameters()[numbers[k].parameter].member;
      const UncertainSoil& known = soils[numbers[k].soil].soil;
      deviations(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          (draws[i][numbers[k].soil].*member - known.mean.*member) /
          known.standard_deviation.*member;
    }
  }
  return deviations;
}

std::vector<WheelModel> models_of(const PlanningProblem& problem, const SoilDraw& soils) {
  std::vector<WheelModel> models;
  for (const Soil& soil : soils) {
    models.emplace_back(wheel_model_spec(problem, soil), WheelAccuracy::kFast);
  }
  return models;
}

PlaceProbe::PlaceProbe(const PlanningProblem& problem, const VehicleState& state)
    : vehicle_(problem.vehicle) {
  SoilDraw means;
  for (const MapSoil& soil : problem.map.soils()) means.push_back(soil.soil.mean);
  const std::vector<WheelModel> models = models_of(problem, means);
  const GroundFinder ground(problem.map, vehicle_);
  const GroundPatch patch = ground.at(state.x_m, state.y_m, state.yaw_rad);
  std::vector<WheelLaw> laws;
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    laws.emplace_back(models[static_cast<std::size_t>(patch.soil.at(i))]);
  }
  const VehicleDynamics dynamics(
      vehicle_, laws, [&patch](double, double, double) { return patch; }, problem.gravity_mps2);
  const SupplyQuestion question = question_of(dynamics, state, patch);
  if (!(question.normal_n > 0)) return;  // off the ground, whatever the soil
  const SteadyManoeuvre manoeuvre = manoeuvre_of(vehicle_, dynamics.sharing(), laws, question);
  const auto add = [&](Eigen::Index number, const Trim& trim) {
    for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
      const TrimmedWheel& wheel = trim.wheels[i];
      if (!(wheel.load_n > 0)) continue;
      wheels_.push_back({.trim = number,
                         .mount = i,
                         .soil = static_cast<std::size_t>(patch.soil.at(i)),
                         .steered = {.cos_steer = std::cos(wheel.steer_rad),
                                     .sin_steer = std::sin(wheel.steer_rad)},
                         .load_n = wheel.load_n,
                         .motion = wheel.motion});
    }
  };
  const TrimLimits limits = trim_limits(problem.vehicle, strain_limits(problem.limits));
  constexpr double kBeyondReach = 20;
  const double normal = question.normal_n;
  const auto along = [&](const PathForce& direction) {
    return ForceLine{.from = {.forward_n = question.force.forward_n, .left_n = 0},
                     .per_unit = {.forward_n = normal * direction.forward_n,
                                  .left_n = normal * direction.left_n,
                                  .yaw_nm = normal * direction.yaw_nm}};
  };
  const ForceLine lines[] = {along({.left_n = 1}), along({.left_n = -1}), along(manoeuvre.ahead())};
  const auto start = manoeuvre.solve_from_rolling(lines[0]);
  if (!start) return;
  for (Eigen::Index k = 0; k < kTrims; ++k) {
    const BranchEnd end = follow_branch(manoeuvre, *start, lines[k], kBeyondReach, limits);
    add(k, manoeuvre.trim(end.point, lines[k]));
  }
}

PlaceProbe::Features PlaceProbe::features(const std::vector<WheelModel>& models) const {
  std::array<BodyForce, kTrims> sums{};
  Features features = Features::Zero();
  for (const Wheel& wheel : wheels_) {
    const WheelForces forces = models[wheel.soil].forces(wheel.load_n, wheel.motion);
    const bool sunk = !has_forces(forces.status);
    const double sinkage = sunk ? vehicle_.wheel.radius_m : forces.sinkage_m;
    double& deepest = features[kOfTrim * wheel.trim + 3];
    deepest = std::max(deepest, sinkage);
    if (!sunk) {
      sums.at(static_cast<std::size_t>(wheel.trim))
          .add(vehicle_.wheels[wheel.mount], wheel.steered, forces);
    }
  }
  for (Eigen::Index k = 0; k < kTrims; ++k) {
    const BodyForce& sum = sums.at(static_cast<std::size_t>(k));
    features.segment<3>(kOfTrim * k) << sum.forward_n, sum.left_n, sum.yaw_nm;
  }
  return features;
}

SoilSurrogate::SoilSurrogate(const std::vector<std::vector<PlaceProbe::Features>>& features,
                             const std::vector<std::vector<PathMargins>>& judged,
                             std::size_t draws) {
  constexpr double kPull = 0.3;
  const auto rows = static_cast<Eigen::Index>(draws);
  for (std::size_t k = 0; k < features.size(); ++k) {
    Eigen::Matrix<double, Eigen::Dynamic, PlaceProbe::kFeatures> here(rows, PlaceProbe::kFeatures);
    for (Eigen::Index i = 0; i < rows; ++i) here.row(i) = features[k][static_cast<std::size_t>(i)];
    Place place{.mean = here.colwise().mean(), .scale = {}, .coefficients = {}};
    const auto apart = (here.rowwise() - place.mean).array().square().colwise().mean().sqrt();
    // What does not vary tells nothing.
    constexpr double kNothing = 1e-9;
    place.scale = apart.unaryExpr([](double one) { return one > kNothing ? 1 / one : 0; });
    const auto standardised = [&](Eigen::Index i) -> Eigen::RowVectorXd {
      return (here.row(i) - place.mean).cwiseProduct(place.scale);
    };
    Eigen::MatrixXd terms(rows, terms_of(standardised(0)).size()), values(rows, 3);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const PathMargins& margins = judged[static_cast<std::size_t>(i)][k];
      terms.row(i) = terms_of(standardised(i));
      values.row(i) << margins.cornering, margins.tip_over, margins.traction;
    }
    place.coefficients = ridge(terms, values, kPull);
    places_.push_back(std::move(place));
  }
}

PathMargins SoilSurrogate::smallest(const std::vector<PlaceProbe::Features>& features) const {
  PathMargins smallest;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Place& place = places_[k];
    const Eigen::RowVector3d said =
        terms_of((features[k] - place.mean).cwiseProduct(place.scale)) * place.coefficients;
    smallest = {.cornering = std::min(smallest.cornering, said[0]),
                .tip_over = std::min(smallest.tip_over, said[1]),
                .traction = std::min(smallest.traction, said[2])};
  }
  return smallest;
}

LinearInfluence linear_influence(const Eigen::MatrixXd& deviations, const Eigen::VectorXd& values) {
  const Eigen::MatrixXd centred = deviations.rowwise() - deviations.colwise().mean();
  const Eigen::VectorXd spread = values.array() - values.mean();
  const Eigen::Index n = deviations.cols();
  LinearInfluence influence{.slope = Eigen::VectorXd::Zero(n), .share = Eigen::VectorXd::Zero(n)};
  const double variance = spread.squaredNorm();
  if (!(variance > 0)) return influence;
  influence.slope = centred.colPivHouseholderQr().solve(spread);
  for (Eigen::Index k = 0; k < n; ++k) {
    influence.share[k] =
        influence.slope[k] * influence.slope[k] * centred.col(k).squaredNorm() / variance;
  }
  influence.explained = 1 - (spread - centred * influence.slope).squaredNorm() / variance;
  return influence;
}

}  // namespace regoplan
