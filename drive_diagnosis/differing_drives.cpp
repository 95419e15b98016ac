#include "drive_diagnosis/differing_drives.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drive_diagnosis/recording/robust_statistics.h"

namespace regoplan {
namespace {

/// How far one drive lies from all others.
struct Apart {
  std::size_t drive = 0;
  double off = 0, scatters = 0;
};

/// The drive farthest from the others, in scatters of a window.
/// \param noise of the channel, as it is fitted: what is left of one without any scatter, as a
/// simulator without sensors may record, is round-off
Apart farthest(const std::vector<std::size_t>& drive_of, const std::vector<double>& residuals,
               std::size_t drives, double noise) {
  constexpr std::size_t kFewest = 8;
  constexpr double kNarrowest = 0.1;
  Apart most;
  for (std::size_t drive = 0; drive < drives; ++drive) {
    std::vector<double> own, others;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      (drive_of[i] == drive ? own : others).push_back(residuals[i]);
    }
    if (own.size() < kFewest || others.size() < kFewest) continue;
    const MiddleAndScatter of_own = middle_and_scatter(own), of_others = middle_and_scatter(others);
    const double off = of_own.middle - of_others.middle;
    const double scatter = std::max({of_own.scatter, of_others.scatter, kNarrowest * noise});
    if (!(scatter > 0)) continue;
    const double scatters = std::abs(off) / scatter;
    if (scatters > most.scatters) most = {drive, off, scatters};
  }
  return most;
}

/// Drives whose windows lie apart in a channel, in the middle of what all of them leave.
std::vector<DriveFinding> off_in_the_middle(const std::vector<DriveRecording>& drives,
                                            const std::vector<DriveWindow>& windows,
                                            const std::vector<ComparedChannel>& compared) {
  constexpr double kFar_scatters = 4;
  std::vector<DriveFinding> findings;
  for (const ComparedChannel& channel : compared) {
    std::vector<std::size_t> drive_of;
    std::vector<double> residuals;
    for (std::size_t i = 0; i < channel.windows.size(); ++i) {
      drive_of.push_back(windows[channel.windows[i]].drive);
      residuals.push_back(channel.measured[i] - channel.corrected[i]);
    }
    const Apart apart = farthest(drive_of, residuals, drives.size(), channel.noise);
    if (apart.scatters < kFar_scatters) continue;
    findings.push_back(
        {.id = "drives_differ",
         .drive = drives[apart.drive].drive_id,
         .text = fmt::format("{} lies {:.2g} {} in this drive than in the others, beside what all "
                             "of them together say: {:.0f} times the scatter of a window",
                             channel.name, std::abs(apart.off), apart.off > 0 ? "higher" : "lower",
                             apart.scatters),
         .value = apart.off});
  }
  return findings;
}

/// Whether the zones of a drive leave next to nothing of it outside, while other drives lie
/// outside: one for each soil of the map that it crosses.
bool are_all_of_a_drive(const std::vector<SoilZoneFound>& zones, std::size_t drive,
                        const std::vector<DriveWindow>& windows) {
  constexpr double kNearlyAll = 0.9;
  std::size_t of_drive = 0, within = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    if (windows[i].drive != drive) continue;
    ++of_drive;
    within += std::ranges::any_of(zones, [i, drive](const SoilZoneFound& zone) {
      return zone.drive == drive && i >= zone.first && i <= zone.last;
    });
  }
  return of_drive > 0 && of_drive < windows.size() &&
         static_cast<double>(within) >= kNearlyAll * static_cast<double>(of_drive);
}

DriveFinding zones_all_along(const DriveRecording& drive) {
  return {.id = "drives_differ",
          .drive = drive.drive_id,
          .text =
              "another soil would have to lie along all of this drive and of no other: the "
              "vehicle may have been otherwise in it, by a payload or a fault"};
}

}  // namespace

std::vector<DriveFinding> differing_drives(const std::vector<DriveRecording>& drives,
                                           const std::vector<DriveWindow>& windows,
                                           const VehicleEffects& effects) {
  std::vector<DriveFinding> findings = off_in_the_middle(drives, windows, effects.compared);
  std::vector<SoilZoneFound> zones;
  for (const VehicleFinding& finding : effects.found) {
    if (finding.zone) zones.push_back(*finding.zone);
  }
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (are_all_of_a_drive(zones, i, windows)) findings.push_back(zones_all_along(drives[i]));
  }
  return findings;
}

}  // namespace regoplan
