// What the planners came to in one experiment, and which differences are real.
function summaryTable() {
  const columns = [
    {text: 'Planner'}, {text: 'Verified', number: true}, {text: '95 % interval', number: true},
    {text: 'Overturned', number: true}, {text: 'Crashed', number: true},
    {text: 'Time', number: true}, {text: 'Length', number: true}, {text: 'Duration', number: true},
    {text: 'Energy', number: true}, {text: 'Margin', number: true},
    {text: 'Margin, 95 % of soils', number: true}, {text: 'Propagations', number: true}
  ];
  const rows = shown.experiment.planners.map(planner => {
    const [low, high] = planner.success_ci95;
    return [
      planner.name, `${verifiedRuns(planner).length} of ${planner.runs.length}`,
      `${percent(low)} to ${percent(high)}`, integer(planner.runs.filter(r => r.overturned).length),
      integer(planner.runs.filter(r => r.crashed).length),
      fixed(medianOf(planner, 'time_s'), 3, 's'), fixed(medianOf(planner, 'length_m'), 1, 'm'),
      fixed(medianOf(planner, 'duration_s'), 1, 's'), energy(medianOf(planner, 'energy_j')),
      fixed(medianOf(planner, 'margin_min'), 3), fixed(medianOf(planner, 'margin_p05'), 3),
      integer(medianOf(planner, 'propagations'))
    ];
  });
  byId('summary').replaceChildren(table(`Experiment ${shown.experiment.name}`, columns, rows));
}

function pairedTable() {
  const rows = shown.experiment.comparisons.map(
      c =>
          [`${c.planner} against ${c.other}`,
           c.property === 'time REAL' ? 'search time' : 'path length', integer(c.pairs),
           significant(c.ratio, 3),
           `${significant(c.ratio_ci95[0], 3)} to ${significant(c.ratio_ci95[1], 3)}`,
           element('span', {class: c.real ? 'good' : null}, c.real ? 'real' : 'not shown')]);
  byId('paired').replaceChildren(
      rows.length ? table(
                        `Experiment ${shown.experiment.name}`,
                        [
                          {text: 'Planners'}, {text: 'Of'}, {text: 'Seeds', number: true},
                          {text: 'Ratio', number: true}, {text: '95 % interval', number: true},
                          {text: 'Difference'}
                        ],
                        rows) :
                    element('p', {}, 'No two planners solved five common seeds.'));
}
