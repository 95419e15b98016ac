#pragma once

#include <map>
#include <string>
#include <vector>

#include "diagnosis/bed/wheel_bed.h"

namespace regoplan {

/// One unknown number in units of its prior: x is standard normal beforehand.
struct Coordinate {
  std::string name;
  bool logarithmic = false;  ///< the number is exp(centre + spread x), else centre + spread x
  double centre = 0, spread = 1;
  double min = -1e300, max = 1e300;  ///< valid range of the number

  double value(double x) const;
  double at(double value) const;  ///< the x of a number
  double slope(double x) const;   ///< d value/dx
};

/// A soil number that is not known exactly; held in SI.
struct SoilCoordinate {
  std::size_t parameter = 0;  ///< index into soil_parameters()
  Coordinate coordinate;
};

/// The uncertain numbers of a soil.
/// \param widen factor on the prior standard deviations
std::vector<SoilCoordinate> soil_coordinates(const UncertainSoil& soil, double widen = 1);

/// The soil at x (one entry a coordinate; further entries are not read).
Soil soil_at(const UncertainSoil& soil, const std::vector<SoilCoordinate>& coordinates,
             const Eigen::VectorXd& x);

/// The same x with a1 (a0 where a1 is known) at the edge at which the maximum stress leaves the
/// contact, a0 + a1 s = 0 or 1 at some slip, if x lies beyond it: what a fit's step is cut to.
Eigen::VectorXd kept_inside(const UncertainSoil& soil,
                            const std::vector<SoilCoordinate>& coordinates, Eigen::VectorXd x);

/// Prior standard deviations by which a0 or a1 lies from its test, the larger. Where an edge is met
/// far from the tests other physics is missing, and no fit is made to go along it.
double maximum_stress_pull(const std::vector<SoilCoordinate>& coordinates,
                           const Eigen::VectorXd& x);

enum class EffectKind {
  kMechanism,
  kBias,
  kGain,
  kCrosstalk,  ///< a share of one channel in another
  kTurn,       ///< a sensor of two forces turned about the axis across both
};

/// What is there of an instrument's bias or gain, t from 0 at the first condition to 1 at the last.
enum class FaultCourse {
  kConstant,  ///< 1
  kSettling,  ///< exp(-(time - first time)/settling_time_s): an amplifier that warms up
  kDrifting,  ///< t
};

/// One form of one thing that may be wrong: a mechanism of the wheel or a fault of an instrument.
struct Effect {
  std::string id;
  std::string form;
  EffectKind kind = EffectKind::kMechanism;
  std::vector<Coordinate> coordinates;
  std::map<std::string, double> fixed;
  std::size_t to = 0, from = 0;   ///< instruments: index into TestBed::channels
  std::vector<std::size_t> also;  ///< further channels that the same fault acts on
  FaultCourse course = FaultCourse::kConstant;
  std::vector<double> start;  ///< x to start a fit from
  /// Its last coordinate is a factor on kx and ky of the soil: the modulus of another shear law is
  /// not the one that soil tests state.
  bool own_modulus = false;
  bool slow = false;  ///< its stress integrals are some thirty times slower
};

/// Whether an id is a fault of instruments and not physics of wheel and soil.
bool is_instrument(const std::string& id);

/// Whether what it does is known to the last term, so that no other form of it can be meant: a
/// sensor's bias, constant gain and crosstalk, a scale, a tilt.
bool has_one_form(const Effect& effect);

/// Whether nothing but the time of the runs tells it from other effects: two of these together
/// would share one course in time in any way one likes.
bool is_told_by_time(const Effect& effect);

/// What effects are to explain: a recording against the model as a whole, by names whose rates of
/// error are known from campaigns; in part, by later names too; or against a reference, where the
/// soil may have changed.
enum class EffectsOf { kRecording, kPart, kDifference };

/// Every form of every mechanism and instrument fault that the recording can bear, each from every
/// starting point it needs. Lugs whose height or number the setup tells are taken as told.
std::vector<Effect> effects_for(const TestBed& bed, const Recording& recording,
                                EffectsOf of = EffectsOf::kRecording);

/// What is wrong, if anything, and from which soil.
struct Hypothesis {
  std::vector<Effect> effects;
};

/// The soil at x with the factors of effects that have a shear modulus of their own.
Soil soil_of(const TestBed& bed, const std::vector<SoilCoordinate>& soil,
             const Hypothesis& candidate, const Eigen::VectorXd& x);

/// The mechanism with its numbers at x (the effect's own coordinates).
Mechanism mechanism_at(const Effect& effect, const Eigen::VectorXd& x);

/// Model values of a candidate; x holds the soil's coordinates, then each effect's.
std::optional<Eigen::VectorXd> predict(const TestBed& bed, const std::vector<SoilCoordinate>& soil,
                                       const Hypothesis& candidate, const Eigen::VectorXd& x);

}  // namespace regoplan
