# Puts the reports' pages into the program. d3 is read from Debian's node-d3, with its licence.
include(cmake/embed.cmake)
set(node_d3_script /usr/share/nodejs/d3/dist/d3.min.js)
set(node_d3_licence /usr/share/doc/node-d3/copyright)
foreach(file ${node_d3_script} ${node_d3_licence})
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "${file} is missing; Debian's package node-d3 brings it")
  endif()
endforeach()

# report_files(variable folder file...): files of app/report/<folder>, in the order given.
function(report_files variable folder)
  list(TRANSFORM ARGN PREPEND app/report/${folder}/ OUTPUT_VARIABLE files)
  set(${variable} ${files} PARENT_SCOPE)
endfunction()

report_files(page_scripts page format.js dom.js colours.js axes.js legend.js pointing.js save.js figure.js)
# Paths on a map: what the reports of plans, evaluations and drives share.
report_files(map_scripts map terrain.js model.js path_colours.js ground_layers.js candidate_table.js map_frame.js map_canvas.js vehicle.js map_overlay.js
             map_view.js charts.js layers.js readout.js playback.js rejections.js)
# With a map and without: evaluations of manoeuvres alone.
report_files(evaluation_scripts evaluation spreads.js courses.js)
report_files(benchmark_scripts benchmark planners.js tables.js profiles.js spread.js progress.js paths.js
             main.js)
report_files(diagnosis_scripts diagnosis model.js residual_maps.js residuals_in_time.js difference_maps.js
             curves.js tables.js shares.js main.js)

regoplan_embed(
  regoplan_app app/page/report_assets.h
  kD3 ${node_d3_script}
  kD3Licence ${node_d3_licence}
  kPageHtml app/report/page/page.html
  kPageCss app/report/page/page.css
  kPageScript ${page_scripts}
  kPlanHtml app/report/map/map.html app/report/plan/plan.html
  kPlanScript ${map_scripts} app/report/plan/facts.js app/report/plan/relaxed.js
              app/report/plan/main.js
  kEvaluationHtml app/report/map/map.html
  kEvaluationScript ${map_scripts} ${evaluation_scripts} app/report/evaluation/main.js
  kManoeuvresScript ${evaluation_scripts} app/report/evaluation/manoeuvres.js
  kDriveHtml app/report/map/map.html app/report/drive/drive.html
  kDriveScript ${map_scripts} app/report/drive/charts.js app/report/drive/limits.js app/report/drive/main.js
  kDiagnosisHtml app/report/diagnosis/diagnosis.html
  kDiagnosisScript ${diagnosis_scripts}
  kDrivesHtml app/report/drives/drives.html
  kDrivesScript app/report/map/terrain.js app/report/map/map_chart.js app/report/drives/residuals.js
                app/report/drives/main.js
  kLoopHtml app/report/loop/loop.html
  kLoopScript app/report/map/terrain.js app/report/map/map_chart.js app/report/loop/main.js
  kCompareHtml app/report/compare/compare.html
  kCompareScript app/report/map/map_chart.js app/report/compare/main.js
  kBenchmarkHtml app/report/benchmark/benchmark.html
  kBenchmarkScript app/report/map/terrain.js app/report/map/map_chart.js ${benchmark_scripts})
