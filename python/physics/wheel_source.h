#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "terramech/force_table/force_table.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan::python {

/// What answers for a wheel: the direct model, or a table of it.
struct WheelSource {
  std::shared_ptr<const WheelModel> direct;
  std::shared_ptr<const ForceTable> table;  ///< null where the model answers
};

/// What answers: `direct`, `fast`, `table`.
std::vector<std::string> method_names();

/// The words of `model` in a model file.
std::vector<std::string> variant_names();

/// A wheel from the keys of a model file.
/// \param settings JSON \param how one of `method_names()` \param nominal_load_n of a table
/// \throws InputError
WheelSource wheel_source(const std::string& settings, const std::string& how,
                         double nominal_load_n);

/// A soil's keys (JSON), checked, with those that were left out: the same numbers, bit for bit.
std::string checked_soil(const std::string& settings);

/// The keys of a model file, as JSON.
std::string model_file_settings(const std::string& file);

/// The wheel and soil of the paper's figures, as JSON with the keys of a model file.
std::string paper_wheel_settings();

/// The soils of a soils file as JSON, each `{source, <soil keys>}`, uncertain ones `{mean, std}`.
std::string soils_file_settings(const std::string& file);

/// The soils that come with regoplan, as `soils_file_settings` gives them.
/// \param demo_soils the soils file of the demo
std::string preset_soil_settings(const std::string& demo_soils);

}  // namespace regoplan::python
