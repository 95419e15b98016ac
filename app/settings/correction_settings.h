#pragma once

#include <string>

#include "app/settings/settings_node.h"
#include "terramech/mechanisms/generic_correction.h"

namespace regoplan {

/// The id under which the unnamed correction stands among the mechanisms of a model file, and the
/// name of its form.
inline constexpr const char* kGenericId = "generic";
inline constexpr const char* kGenericForm = "gaussian_bumps";

/// Reads the parameters of a generic correction: `{slip_scale, slip_angle_scale_deg,
/// log_load_scale, region: {slip_ratio: [from, to], slip_angle_deg: [...], load_n: [...]},
/// fade_share, nodes: [{slip_ratio, slip_angle_deg, load_n, fx_n, fy_n, torque_nm, sinkage_m}]}`;
/// heights that are left out are 0, and so is `fade_share`.
GenericCorrection read_correction(const SettingsNode& parameters);

/// The same as YAML in block style, every line behind `indent`. Reads back to the same numbers, bit
/// for bit, where an angle is one that degrees can express; else within its last place.
std::string correction_text(const GenericCorrection& correction, const std::string& indent);

}  // namespace regoplan
