#include "drive_diagnosis/fit/linearised_windows.h"

namespace regoplan {

LinearisedWindows LinearisedWindows::none(const Eigen::MatrixXd& alike, std::size_t parameters,
                                          std::size_t inputs, std::size_t zones,
                                          std::size_t numbers) {
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(alike.rows(), alike.cols());
  return {.data = zero,
          .base = zero,
          .columns = std::vector(parameters, zero),
          .inputs = std::vector(inputs, zero),
          .zones = std::vector(zones, std::vector(numbers, zero)),
          .unbalanced = {}};
}

Eigen::MatrixXd LinearisedWindows::changed_by(const ContestFit& fit) const {
  Eigen::MatrixXd change = Eigen::MatrixXd::Zero(data.rows(), data.cols());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    change += fit.parameters[static_cast<Eigen::Index>(k)] * columns[k];
  }
  for (std::size_t z = 0; z < zones.size(); ++z) {
    for (std::size_t k = 0; k < zones[z].size(); ++k) {
      change += fit.zones[z][static_cast<Eigen::Index>(k)] * zones[z][k];
    }
  }
  return change;
}

Eigen::MatrixXd LinearisedWindows::shifted_by(const Eigen::MatrixXd& shifts) const {
  Eigen::MatrixXd change = Eigen::MatrixXd::Zero(data.rows(), data.cols());
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    change += shifts.col(static_cast<Eigen::Index>(k)).asDiagonal() * inputs[k];
  }
  return change;
}

void LinearisedWindows::forget(const WindowSet& windows) {
  for (const std::size_t window : windows) {
    const auto w = static_cast<Eigen::Index>(window);
    data.row(w).setZero();
    base.row(w).setZero();
    for (Eigen::MatrixXd& column : columns) column.row(w).setZero();
    for (Eigen::MatrixXd& input : inputs) input.row(w).setZero();
    for (std::vector<Eigen::MatrixXd>& numbers : zones) {
      for (Eigen::MatrixXd& number : numbers) number.row(w).setZero();
    }
  }
}

}  // namespace regoplan
