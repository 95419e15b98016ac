// The experiments of a benchmark and how their planners are drawn.
const EXPERIMENTS = REPORT.experiments;
for (const experiment of EXPERIMENTS) experiment.map = REPORT.maps[experiment.scenario];
const PLANNERS = [...new Set(EXPERIMENTS.flatMap(e => e.planners.map(p => p.name)))];
// Okabe and Ito's colours, with a dash each so that colour alone never decides.
const PLANNER_COLOURS = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];
const PLANNER_DASHES = [null, '7 3', '2 2.5', '9 3 2 3', '12 4', '4 4'];
const plannerColour = name => PLANNER_COLOURS[PLANNERS.indexOf(name) % PLANNER_COLOURS.length];
const plannerDash = name => PLANNER_DASHES[PLANNERS.indexOf(name) % PLANNER_DASHES.length];
const plannerKey = name => ({name, colour: plannerColour(name), dash: plannerDash(name)});

const shown = {
  experiment: EXPERIMENTS[0]
};
const HEIGHT = 260, MARGIN = {
  left: 48,
  right: 14,
  top: 26,
  bottom: 36
};

const verifiedRuns = planner => planner.runs.filter(run => run.verified);
const values = (planner, key) => verifiedRuns(planner).map(run => run[key]).filter(isKnown);
const medianOf = (planner, key) => {
  const known = values(planner, key).sort(d3.ascending);
  return known.length ? d3.median(known) : null;
};
