#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "planner/soils/soil_uncertainty.h"

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

/// What was drawn, one row a draw and one column a number: differences from the mean over the
/// standard deviation.
Eigen::MatrixXd standard_deviations(const std::vector<MapSoil>& soils, const SoilNumbers& numbers,
                                    const std::vector<SoilDraw>& draws);

/// The wheel's forces on each soil of one draw, by the wheel model at its fast accuracy.
std::vector<WheelModel> models_of(const PlanningProblem& problem, const SoilDraw& soils);

/// What a place of a path says of a draw of the soils, cheaply: what the wheels' forces sum to, and
/// how deep they sink, in the states that they have at the mean soils where the supply ends to
/// either side and where traction is largest. Margins follow these nearly linearly, whatever the
/// number of uncertain soil numbers.
class PlaceProbe {
 public:
  PlaceProbe(const PlanningProblem& problem, const VehicleState& state);

  static constexpr Eigen::Index kTrims = 3, kOfTrim = 4, kFeatures = kTrims * kOfTrim;
  using Features = Eigen::Matrix<double, 1, kFeatures>;
  Features features(const std::vector<WheelModel>& models) const;

 private:
  struct Wheel {
    Eigen::Index trim = 0;
    std::size_t mount = 0, soil = 0;
    SteeredWheel steered;
    double load_n = 0;
    WheelMotion motion;
  };
  const Vehicle& vehicle_;
  std::vector<Wheel> wheels_;
};

/// Margins of the places of a path as quadratic polynomials of their features, by least squares
/// with a slight pull toward 0.
class SoilSurrogate {
 public:
  /// \param features [place][draw] \param judged [draw][place]; of the draws it is made from
  SoilSurrogate(const std::vector<std::vector<PlaceProbe::Features>>& features,
                const std::vector<std::vector<PathMargins>>& judged, std::size_t draws);

  /// The smallest margins over the places. \param features of each
  PathMargins smallest(const std::vector<PlaceProbe::Features>& features) const;

  /// How many draws it takes.
  static constexpr int kTrainingDraws = 140;

 private:
  struct Place {
    PlaceProbe::Features mean, scale;
    Eigen::MatrixXd coefficients;  ///< [term][kind]
  };
  std::vector<Place> places_;
};

/// A linear regression on standardised numbers.
struct LinearInfluence {
  Eigen::VectorXd slope;  ///< per standard deviation of each number
  Eigen::VectorXd share;  ///< of the variance
  double explained = 0;   ///< share of the variance, by all of them
};
LinearInfluence linear_influence(const Eigen::MatrixXd& deviations, const Eigen::VectorXd& values);

}  // namespace regoplan
