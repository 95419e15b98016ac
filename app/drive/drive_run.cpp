#include "app/drive/drive_run.h"

#include <fmt/format.h>

#include "app/drive/drive_report.h"

namespace regoplan {

std::string drive_summary(const DriveRecord& record) {
  const DriveResult& r = record.result;
  std::string text = drive_headline(record) + "\n";
  if (r.smallest_margin) {
    text += fmt::format("smallest margins: cornering {:.3f}, tip-over {:.3f}, traction {:.3f}\n",
                        r.margin_cornering_min, r.margin_tip_over_min, r.margin_traction_min);
  }
  for (const LimitBroken& one : r.broken) text += broken_text(one) + "\n";
  return text;
}

void write_drive(const DriveRecord& record, const PlanningProblem& problem,
                 const ReferencePath& path, const TrueWorld& world, const ResultFolder& folder) {
  const std::vector<RenderedFile> files{{"drive.csv", drive_csv(record, problem.vehicle)},
                                        {"truth.json", truth_json(record, world)},
                                        {"drive.json", drive_json(record, problem)},
                                        {record.page, drive_report(problem, path, record, world)}};
  StagedFiles staged(folder);
  for (const RenderedFile& file : files) staged.write(file);
  staged.commit();
}

std::vector<std::string> drive_result_names(const std::string& page) {
  return {"drive.csv", "truth.json", "drive.json", page};
}

}  // namespace regoplan
