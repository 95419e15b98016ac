#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/diagnosis/calibrated_signal.h"

namespace regoplan::challenge {

enum class Stratum {
  kNulls,        ///< soil within its priors, day effects, outliers
  kParameters,   ///< one or two soil numbers wrong by 2 to 4 standard deviations
  kInstruments,  ///< one fault of an instrument
  kOneEffect,    ///< one listed effect in another form, 5 sigma and more after calibration
  kTwoEffects,   ///< two, each 8 sigma and more beyond the other
  kUnlisted,     ///< one effect on no list, 8 sigma and more
  kRutHidden,    ///< rut asymmetry, 8 sigma and more, no rut depths recorded
  kRutShown,     ///< rut asymmetry with rut depths
  kDrift,        ///< one effect that follows time, order or place, 8 sigma and more
  kLargeFaults,  ///< as kInstruments, larger than those, or a sensor that is turned
  kDriftByRun,   ///< one effect that follows time or the day, every run at a time of its own
  kNullsByRun,   ///< as kNulls, every run at a time of its own, noise with a memory in half of them
  kNullsOfFew,   ///< as kNulls, a third to a half of the runs kept by chance: few replicates
};

/// Whether nothing is wrong in it.
bool is_null(Stratum stratum);

const std::vector<Stratum>& strata();
std::string_view name(Stratum stratum);
/// \throws InputError listing the names
Stratum stratum_named(std::string_view text);

/// One thing that is wrong with the model or the instruments.
struct TrueCause {
  std::string id;  ///< of the vocabulary, or a name of our own
  std::string form;
  std::vector<std::string> accepted;  ///< ids that are right
  bool instrument = false;
  double amplitude = 0;
  double shape = 0;
  double signal = 0;  ///< standard deviations, after calibration and beyond the other causes
};

/// What the diagnosis must not see.
struct Truth {
  Stratum stratum = Stratum::kNulls;
  std::uint64_t index = 0;
  std::vector<TrueCause> causes;
  Signal signal;
  Soil soil;
  int attempts = 0;  ///< draws until one met the stratum's terms
};

struct Challenge {
  Recording recording;
  DiagnosisSetup setup;
  Truth truth;
};

/// The same for the same arguments. Effects take turns over the index, so that a stratum as long as
/// the list sees each form once.
Challenge generate(Stratum stratum, std::uint64_t seed, std::uint64_t index);

}  // namespace regoplan::challenge
