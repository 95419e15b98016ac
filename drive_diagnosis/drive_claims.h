#pragma once

#include <string>
#include <vector>

#include "drive_diagnosis/drive_diagnosis.h"

namespace regoplan {

/// Claims a mounting of the attitude sensor that is not where the setup says, by more than 4.5
/// standard deviations; finds attitudes of a wrong sign or unit.
void judge_mounting(const DriveSetup& setup, DriveDiagnosis& result);

/// Claims that one side takes more current than the other straight ahead on the level, where
/// `result.currents` found it, and says where; finds that their model is no better than a constant.
/// \pre result.currents
void judge_currents(DriveDiagnosis& result);

/// How far a model of currents is off that does no better than a constant.
std::string no_better_text(const HeldOutCurrents& held_out);

/// Claims what the contest of `result.effects` found, and says where zones lie.
/// \pre result.effects
void claim_effects(const DriveSetup& setup, const std::vector<DriveRecording>& drives,
                   DriveDiagnosis& result);

/// Claims soils of the map of which a number lies more than 4.5 of the map's standard deviations
/// off, where held-out stretches are likelier with it. \pre result.effects
void claim_soils(const DriveSetup& setup, DriveDiagnosis& result);

/// Says that slopes of the map are more than 2 deg off those of the ground; nothing where they are
/// not.
std::optional<DriveFinding> slopes_finding(const VehicleEffects& effects);

/// Says that something stands out of a size that cannot be, as a drag of less than nothing.
DriveFinding unnamed_finding(const VehicleFinding& unnamed);
/// What tells of a zone that is not claimed beside a wheel law.
DriveFinding zone_within_law_finding(const VehicleFinding& zone,
                                     const std::vector<DriveRecording>& drives);

/// In what share of drives of a sound vehicle over the map's soils chance alone shows as much.
double chance_of(const VehicleFinding& finding);

/// How rare drives of a sound vehicle over the map's soils are in which chance alone shows as much.
std::string chance_text(const VehicleFinding& finding);

/// A fault's size with its interval and how far from nothing it is.
std::string fault_text(const VehicleFinding& finding);

/// Why a soil that was driven on stays as the map has it.
std::string withheld_text(const SoilFitted& fitted, const MapSoil& said);

}  // namespace regoplan
