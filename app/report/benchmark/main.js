// The benchmark's sections: tables, profiles, boxes, progress, comparisons, paths.
const HEIGHT = 260;
const shown = {experiment: EXPERIMENTS[0]};

const verifiedRuns = planner => planner.runs.filter(run => run.verified);
const values = (planner, key) => verifiedRuns(planner).map(run => run[key]).filter(isKnown);
const medianOf = (planner, key) => {
  const known = values(planner, key).sort(d3.ascending);
  return known.length ? d3.median(known) : null;
};

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

/// Steps of a share that grows with each value; `total` runs are 1.
function shares(sorted, total) {
  return sorted.map((value, i) => ({value, share: (i + 1) / total}));
}

function stepFigure(host, title, label, perPlanner, description) {
  const all = [...perPlanner.values()].flatMap(p => p.values);
  if (!all.length) return;
  const [low, high] = d3.extent(all);
  figure(host, title, description, [...perPlanner.keys()], (svg, width) => {
    const domain = [low, Math.max(high, low * 1.05)];
    const x = d3.scaleLog().domain(domain), y = d3.scaleLinear().domain([0, 1]);
    const box = axes(svg, width, HEIGHT, x, y, {
      x: label,
      y: 'share of runs',
      x_ticks: decadeTicks(domain),
      x_format: v => significant(v, 3),
      y_format: '%'
    });
    for (const [name, {values, total}] of perPlanner) {
      const points = shares(values.slice().sort(d3.ascending), total);
      if (!points.length) continue;
      const line = [
        {value: points[0].value, share: 0}, ...points,
        {value: domain[1], share: points[points.length - 1].share}
      ];
      svg.append('path')
          .attr('class', 'line')
          .attr('stroke', plannerColour(name))
          .attr('stroke-dasharray', plannerDash(name))
          .attr('d', d3.line().curve(d3.curveStepAfter).x(p => x(p.value)).y(p => y(p.share))(line))
          .append('title')
          .text(name);
    }
    return box;
  });
}

function profiles() {
  const host = byId('profiles');
  const times = new Map(PLANNERS.map(name => [name, {values: [], total: 0}]));
  const ratios = new Map(PLANNERS.map(name => [name, {values: [], total: 0}]));
  for (const experiment of EXPERIMENTS) {
    const best = d3.min(experiment.planners.flatMap(p => values(p, 'length_m')));
    for (const planner of experiment.planners) {
      const time = times.get(planner.name), ratio = ratios.get(planner.name);
      time.total += planner.runs.length;
      ratio.total += planner.runs.length;
      time.values.push(...values(planner, 'first_solution_s').map(t => Math.max(t, 1e-4)));
      ratio.values.push(...values(planner, 'length_m').map(length => length / best));
    }
  }
  stepFigure(
      host, 'Time to the first solution', 'seconds of search', times,
      'Share of all runs with a verified path, against the time of the first solution');
  stepFigure(
      host, 'Length against the best known', 'length over the shortest of the experiment', ratios,
      'Share of all runs whose path is no longer than so many times the shortest known');
}

const BOXES = [
  {key: 'time_s', title: 'Search time', unit: 's', log: true},
  {key: 'length_m', title: 'Path length', unit: 'm'},
  {key: 'margin_min', title: 'Smallest stability margin', unit: ''},
  {key: 'energy_j', title: 'Energy', unit: 'kJ', scale: 0.001},
];

function boxes() {
  const host = byId('boxes');
  host.replaceChildren();
  for (const chart of BOXES) {
    const planners = shown.experiment.planners.filter(p => values(p, chart.key).length);
    if (!planners.length) continue;
    const numbers = planner => values(planner, chart.key).map(v => v * (chart.scale || 1));
    const all = planners.flatMap(numbers);
    figure(host, chart.title, `${chart.title} by planner`, [], (svg, width) => {
      const height = 62 + 34 * planners.length;
      let [low, high] = d3.extent(all);
      if (low === high) [low, high] = [low * 0.95 - 1e-6, high * 1.05 + 1e-6];
      const x = (chart.log ? d3.scaleLog() : d3.scaleLinear()).domain([low, high]);
      if (!chart.log) x.nice();
      const y = d3.scaleBand().domain(planners.map(p => p.name)).padding(0.35);
      const left = 110;
      svg.attr('viewBox', `0 0 ${width} ${height}`).attr('width', width).attr('height', height);
      x.range([left, width - 14]);
      y.range([4, height - 40]);
      const below = d3.axisBottom(x).tickSizeOuter(0);
      if (chart.log) below.tickValues(decadeTicks(x.domain())).tickFormat(v => significant(v, 3));
      else below.ticks(tickCount(width - 60));
      svg.append('g')
          .attr('class', 'axis')
          .attr('transform', `translate(0,${height - 40})`)
          .call(below);
      svg.append('g')
          .attr('class', 'axis')
          .attr('transform', `translate(${left},0)`)
          .call(d3.axisLeft(y).tickSize(0));
      svg.append('text')
          .attr('x', (left + width) / 2)
          .attr('y', height - 6)
          .attr('text-anchor', 'middle')
          .text(chart.unit ? `${chart.title}, ${chart.unit}` : chart.title);
      for (const planner of planners) drawBox(svg, x, y, planner, numbers(planner));
    });
  }
}

/// Quartiles as a box, the median as a line, every run as a dot.
function drawBox(svg, x, y, planner, numbers) {
  const sorted = numbers.slice().sort(d3.ascending), middle = y(planner.name) + y.bandwidth() / 2;
  const [first, median, third] = [0.25, 0.5, 0.75].map(q => d3.quantile(sorted, q));
  const colour = plannerColour(planner.name);
  const group = svg.append('g');
  group.append('title').text(`${planner.name}: median ${significant(median)}, quartiles ${
      significant(first)} to ${significant(third)}, ${sorted.length} runs`);
  group.append('line')
      .attr('x1', x(sorted[0]))
      .attr('x2', x(sorted[sorted.length - 1]))
      .attr('y1', middle)
      .attr('y2', middle)
      .attr('stroke', colour);
  group.append('rect')
      .attr('x', x(first))
      .attr('width', Math.max(1, x(third) - x(first)))
      .attr('y', y(planner.name))
      .attr('height', y.bandwidth())
      .attr('fill', colour)
      .attr('fill-opacity', 0.25)
      .attr('stroke', colour);
  group.append('line')
      .attr('x1', x(median))
      .attr('x2', x(median))
      .attr('y1', y(planner.name))
      .attr('y2', y(planner.name) + y.bandwidth())
      .attr('stroke', colour)
      .attr('stroke-width', 3);
  group.selectAll('circle')
      .data(sorted)
      .enter()
      .append('circle')
      .attr('cx', v => x(v))
      .attr('cy', middle)
      .attr('r', 1.8)
      .attr('fill', cssColour('--ink'))
      .attr('fill-opacity', 0.55);
}

/// Value of a property against time, as steps, for runs that report progress.
function progressSeries(planner, property) {
  return planner.runs.filter(run => run.progress)
      .map(run => {
        const time = run.progress_names.indexOf('time REAL');
        const column = run.progress_names.indexOf(property);
        if (column < 0) return [];
        return run.progress
            .map(sample => ({t: parseFloat(sample[time]), value: parseFloat(sample[column])}))
            .filter(p => isKnown(p.t) && isKnown(p.value));
      })
      .filter(series => series.length);
}

/// Median and quartiles of steps over common times.
function bands(series, times) {
  return times
      .map(t => {
        const at = series.map(points => {
          const k = d3.bisector(p => p.t).right(points, t);
          return k ? points[k - 1].value : null;
        });
        const known = at.filter(isKnown).sort(d3.ascending);
        return known.length * 2 >= series.length ? {
          t,
          low: d3.quantile(known, 0.25),
          middle: d3.quantile(known, 0.5),
          high: d3.quantile(known, 0.75)
        } :
                                                   null;
      })
      .filter(p => p);
}

function progress() {
  const host = byId('progress');
  host.replaceChildren();
  const names = new Set(shown.experiment.planners.flatMap(
      p => p.runs.flatMap(r => (r.progress_names || []).filter(n => n.startsWith('best')))));
  for (const property of names) {
    const planners =
        shown.experiment.planners.map(p => ({name: p.name, series: progressSeries(p, property)}))
            .filter(p => p.series.length);
    if (!planners.length) continue;
    const last = d3.max(planners.flatMap(p => p.series.map(s => s[s.length - 1].t)));
    const times = d3.range(1, 81).map(k => last * k / 80);
    const drawn = planners.map(p => ({name: p.name, points: bands(p.series, times)}));
    const all = drawn.flatMap(p => p.points.flatMap(q => [q.low, q.high]));
    if (!all.length) continue;
    const title = capital(property.replace(/ REAL$/, ''));
    figure(host, title, `${title} against time`, drawn.map(p => p.name), (svg, width) => {
      const x = d3.scaleLinear().domain([0, last]), y = d3.scaleLinear().domain(d3.extent(all)).nice();
      axes(svg, width, HEIGHT, x, y, {x: 'seconds of search', y: title});
      for (const {name, points} of drawn) {
        svg.append('path')
            .attr('fill', plannerColour(name))
            .attr('fill-opacity', 0.18)
            .attr('d', d3.area().x(p => x(p.t)).y0(p => y(p.low)).y1(p => y(p.high))(points));
        svg.append('path')
            .attr('class', 'line')
            .attr('stroke', plannerColour(name))
            .attr('stroke-dasharray', plannerDash(name))
            .attr('d', d3.line().x(p => x(p.t)).y(p => y(p.middle))(points));
      }
    });
  }
  byId('progress-section').hidden = !host.children.length;
}

function pairedTable() {
  const rows = shown.experiment.comparisons.map(c => [
    `${c.planner} against ${c.other}`,
    c.property === 'time REAL' ? 'search time' : 'path length', integer(c.pairs),
    significant(c.ratio, 3), `${significant(c.ratio_ci95[0], 3)} to ${significant(c.ratio_ci95[1], 3)}`,
    element('span', {class: c.real ? 'good' : null}, c.real ? 'real' : 'not shown')
  ]);
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

function paths() {
  const host = byId('paths');
  host.replaceChildren();
  const drawn = shown.experiment.planners.flatMap(
      p => verifiedRuns(p).filter(r => r.path && r.path.length).map(r => r.path));
  if (!drawn.length) return;
  const xs = d3.extent(drawn.flatMap(path => path.map(p => p[0]))),
        ys = d3.extent(drawn.flatMap(path => path.map(p => p[1])));
  for (const planner of shown.experiment.planners) {
    const own = verifiedRuns(planner).filter(r => r.path && r.path.length);
    if (!own.length) continue;
    figure(host, `${planner.name} (${own.length})`, `Paths of ${planner.name}`, [], (svg, width) => {
      const span = Math.max(xs[1] - xs[0], (ys[1] - ys[0]), 1) * 1.06;
      const height = Math.min(420, width) * Math.max(0.35, Math.min(1, (ys[1] - ys[0] + 2) / span)) + 50;
      const x = d3.scaleLinear(), y = d3.scaleLinear();
      const scale = Math.min((width - 66) / (xs[1] - xs[0] + 2), (height - 46) / (ys[1] - ys[0] + 2));
      const half_x = (width - 66) / scale / 2, half_y = (height - 46) / scale / 2;
      x.domain([(xs[0] + xs[1]) / 2 - half_x, (xs[0] + xs[1]) / 2 + half_x]);
      y.domain([(ys[0] + ys[1]) / 2 - half_y, (ys[0] + ys[1]) / 2 + half_y]);
      axes(svg, width, height, x, y, {x: 'x, m', y: 'y, m'});
      for (const run of own) {
        svg.append('path')
            .attr('class', 'line')
            .attr('stroke', plannerColour(planner.name))
            .attr('stroke-opacity', 0.7)
            .attr('d', d3.line().x(p => x(p[0])).y(p => y(p[1]))(run.path))
            .append('title')
            .text(`seed ${run.seed}: ${fixed(run.length_m, 1, 'm')}, margin ${
                fixed(run.margin_min, 3)}`);
      }
      const start = own[0].path[0], ends = [own[0].path[own[0].path.length - 1]];
      svg.append('circle').attr('cx', x(start[0])).attr('cy', y(start[1])).attr('r', 5).attr(
          'fill', 'none').attr('stroke', cssColour('--ink')).attr('stroke-width', 2);
      for (const end of ends)
        svg.append('rect').attr('x', x(end[0]) - 4).attr('y', y(end[1]) - 4).attr('width', 8).attr(
            'height', 8).attr('fill', 'none').attr('stroke', cssColour('--ink')).attr('stroke-width', 2);
    });
  }
}

function drawExperiment() {
  summaryTable();
  boxes();
  progress();
  pairedTable();
  paths();
}

const choice = byId('experiment');
for (const [k, experiment] of EXPERIMENTS.entries())
  choice.append(element('option', {value: String(k)}, experiment.name));
choice.addEventListener('change', () => {
  shown.experiment = EXPERIMENTS[Number(choice.value)];
  drawExperiment();
});
profiles();
drawExperiment();
onThemeChange(drawExperiment);
document.documentElement.dataset.drawn = 'yes';
