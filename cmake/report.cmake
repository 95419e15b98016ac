# Puts the reports' pages into the program. d3 is read from Debian's node-d3, with its licence.
include(cmake/embed.cmake)
set(node_d3_script /usr/share/nodejs/d3/dist/d3.min.js)
set(node_d3_licence /usr/share/doc/node-d3/copyright)
foreach(file ${node_d3_script} ${node_d3_licence})
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "${file} is missing; Debian's package node-d3 brings it")
  endif()
endforeach()
regoplan_embed(
  regoplan_app
  app/report_assets.h
  kD3
  ${node_d3_script}
  kD3Licence
  ${node_d3_licence}
  kPageHtml
  app/report/page/page.html
  kPageCss
  app/report/page/page.css
  kPageScript
  app/report/page/format.js
  app/report/page/dom.js
  app/report/page/colours.js
  app/report/page/terrain.js
  kPlanHtml
  app/report/plan/plan.html
  kPlanScript
  app/report/plan/model.js
  app/report/plan/candidate_table.js
  app/report/plan/map_frame.js
  app/report/plan/map_canvas.js
  app/report/plan/map_overlay.js
  app/report/plan/map_view.js
  app/report/plan/charts.js
  app/report/plan/layers.js
  app/report/plan/readout.js
  app/report/plan/rejections.js
  app/report/plan/facts.js
  app/report/plan/main.js
  kEvaluationHtml
  app/report/evaluation/evaluation.html
  kEvaluationScript
  app/report/plan/model.js
  app/report/plan/candidate_table.js
  app/report/plan/map_frame.js
  app/report/plan/map_canvas.js
  app/report/plan/map_overlay.js
  app/report/plan/map_view.js
  app/report/plan/charts.js
  app/report/plan/layers.js
  app/report/plan/readout.js
  app/report/plan/rejections.js
  app/report/evaluation/main.js
  kBenchmarkHtml
  app/report/benchmark/benchmark.html
  kBenchmarkScript
  app/report/benchmark/figures.js
  app/report/benchmark/main.js)
