#include "benchmarks/diagnosis/soil_fit.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "terramech/basics/input_error.h"

namespace regoplan::challenge {
namespace {

using Values = std::vector<std::array<double, kChannelCount>>;

std::vector<SoilParameter> free_parameters(const UncertainSoil& soil) {
  std::vector<SoilParameter> free;
  for (const SoilParameter& parameter : soil_parameters()) {
    if (soil.standard_deviation.*parameter.member > 0) free.push_back(parameter);
  }
  return free;
}

std::array<double, kChannelCount> nothing() {
  std::array<double, kChannelCount> values{};
  values.fill(WheelRun::kNotMeasured);
  return values;
}

/// Whitened misfit and priors; empty where the model has no value for a row.
Eigen::VectorXd residuals(const std::vector<FitRow>& rows, const Values& fitted,
                          const Eigen::VectorXd& x, Eigen::Index soil_numbers) {
  std::vector<double> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t c = 0; c < kChannelCount; ++c) {
      if (std::isnan(rows[i].value[c])) continue;
      if (std::isnan(fitted[i][c])) return {};
      all.push_back((rows[i].value[c] - fitted[i][c]) / rows[i].sigma[c]);
    }
  }
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    // a mechanism's parameters are all but free
    all.push_back(i < soil_numbers ? x[i] : x[i] / 4);
  }
  return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

}  // namespace

Values model_values(const std::vector<FitRow>& rows, const DiagnosisSetup& setup,
                    const FittedMechanism& mechanism, const Eigen::VectorXd& x) {
  WheelModelSpec spec{.variant = setup.variant,
                      .wheel = setup.wheel,
                      .soil = setup.soil.mean,
                      .gravity_mps2 = setup.gravity_mps2};
  Eigen::Index at = 0;
  for (const SoilParameter& parameter : free_parameters(setup.soil)) {
    spec.soil.*parameter.member += x[at++] * setup.soil.standard_deviation.*parameter.member;
  }
  if (mechanism.form) {
    Mechanism added{std::string(mechanism.form->id), std::string(mechanism.form->form), {}};
    for (const MechanismParameter& parameter : mechanism.form->parameters) {
      const double half = (parameter.high - parameter.low) / 2;
      added.parameters[std::string(parameter.name)] = parameter.typical + x[at++] * half;
    }
    spec.mechanisms.push_back(std::move(added));
  }
  Values values;
  try {
    const WheelModel model(spec);
    for (const FitRow& row : rows) {
      const WheelMotion motion = motion_at(row.slip_ratio, row.slip_angle_rad);
      WheelChannels c;
      if (mechanism.form) {
        c = model.channels(row.load_n, motion, row.conditions);
      } else {
        c.forces = model.forces(row.load_n, motion);
        c.rut_left_m = c.rut_right_m = c.forces.sinkage_m;
      }
      const WheelForces& f = c.forces;
      values.push_back(has_forces(f.status)
                           ? std::array<double, kChannelCount>{f.fx_n, f.fy_n, f.torque_nm,
                                                               f.sinkage_m, c.rut_left_m,
                                                               c.rut_right_m}
                           : nothing());
    }
  } catch (const InputError&) {  // a soil number left its valid range: no such model
    values.assign(rows.size(), nothing());
  }
  return values;
}

SoilFit fit_soil(const std::vector<FitRow>& rows, const DiagnosisSetup& setup,
                 const FittedMechanism& mechanism, const Eigen::VectorXd& start, int iterations) {
  const auto soil_numbers = static_cast<Eigen::Index>(free_parameters(setup.soil).size());
  const Eigen::Index more =
      mechanism.form ? static_cast<Eigen::Index>(mechanism.form->parameters.size()) : 0;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(soil_numbers + more);
  if (start.size() > 0)
    x.head(std::min(start.size(), x.size())) = start.head(std::min(start.size(), x.size()));
  Values fitted = model_values(rows, setup, mechanism, x);
  Eigen::VectorXd misfit = residuals(rows, fitted, x, soil_numbers);
  double damping = 1e-3;
  for (int i = 0; i < iterations && misfit.size() > 0; ++i) {
    constexpr double kStep = 1e-3;
    Eigen::MatrixXd jacobian(misfit.size(), x.size());
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      Eigen::VectorXd moved = x;
      moved[j] += kStep;
      Eigen::VectorXd there =
          residuals(rows, model_values(rows, setup, mechanism, moved), moved, soil_numbers);
      double step = kStep;
      if (there.size() == 0) {
        moved[j] -= 2 * kStep;
        step = -kStep;
        there = residuals(rows, model_values(rows, setup, mechanism, moved), moved, soil_numbers);
      }
      if (there.size() == 0) {
        jacobian.col(j).setZero();
      } else {
        jacobian.col(j) = (there - misfit) / step;
      }
    }
    const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    const Eigen::VectorXd gradient = jacobian.transpose() * misfit;
    const double before = misfit.squaredNorm();
    bool moved = false;
    double gain = 0;
    for (int attempt = 0; attempt < 6 && !moved; ++attempt) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() += damping * (normal.diagonal().array() + 1e-6).matrix();
      const Eigen::VectorXd next = x - damped.ldlt().solve(gradient);
      const Values there = model_values(rows, setup, mechanism, next);
      const Eigen::VectorXd left = residuals(rows, there, next, soil_numbers);
      if (left.size() > 0 && left.squaredNorm() < before) {
        gain = before - left.squaredNorm();
        x = next;
        fitted = there;
        misfit = left;
        damping = std::max(damping / 10, 1e-9);
        moved = true;
      } else {
        damping *= 10;
      }
    }
    if (!moved || gain < 1e-3) break;
  }
  SoilFit fit{.x = x, .fitted = fitted};
  if (misfit.size() == 0) {
    fit.chi2 = fit.penalty = std::numeric_limits<double>::infinity();
    return fit;
  }
  fit.penalty = x.head(soil_numbers).squaredNorm();
  fit.chi2 = misfit.head(misfit.size() - x.size()).squaredNorm();
  return fit;
}

}  // namespace regoplan::challenge
