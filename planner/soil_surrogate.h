#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "planner/soil_uncertainty.h"

namespace regoplan {

/// A soil number that is not known exactly: which of which soil, as indices in the map's soils and
/// in `soil_parameters()`.
struct SoilNumber {
  std::size_t soil = 0;
  std::size_t parameter = 0;
  bool operator==(const SoilNumber&) const = default;
};
using SoilNumbers = std::vector<SoilNumber>;

/// The uncertain numbers of the soils under the wheels of the states.
SoilNumbers uncertain_numbers(const PlanningProblem& problem,
                              const std::vector<VehicleState>& states);

/// Which of `numbers` belong to the soils under the wheels of a state.
std::vector<Eigen::Index> columns_under(const PlanningProblem& problem, const SoilNumbers& numbers,
                                        const VehicleState& state);

/// What was drawn, one row a draw and one column a number: differences from the mean over the
/// standard deviation.
Eigen::MatrixXd standard_deviations(const std::vector<MapSoil>& soils, const SoilNumbers& numbers,
                                    const std::vector<SoilDraw>& draws);

/// How many draws a surrogate over so many numbers is made from.
std::size_t training_draws(std::size_t numbers);

/// Margins of the places of a path as quadratic polynomials of the numbers of the soils under the
/// wheels there, all products included, by least squares with a slight pull toward 0.
class SoilSurrogate {
 public:
  using Columns = std::vector<Eigen::Index>;

  /// \param judged the margins of every place, for each of the first `draws` draws
  /// \param columns of `deviations` that each place depends on
  SoilSurrogate(const Eigen::MatrixXd& deviations,
                const std::vector<std::vector<PathMargins>>& judged, std::size_t draws,
                std::vector<Columns> columns);

  /// The smallest margins over the places.
  PathMargins smallest(const Eigen::RowVectorXd& deviations) const;

 private:
  std::vector<Columns> columns_;               ///< of each place
  std::vector<Eigen::MatrixXd> coefficients_;  ///< of each place, [term][kind]
};

/// A linear regression on standardised numbers.
struct LinearInfluence {
  Eigen::VectorXd slope;  ///< per standard deviation of each number
  Eigen::VectorXd share;  ///< of the variance
  double explained = 0;   ///< share of the variance, by all of them
};
LinearInfluence linear_influence(const Eigen::MatrixXd& deviations, const Eigen::VectorXd& values);

}  // namespace regoplan
