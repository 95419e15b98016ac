// Shares of runs against what they took, over all experiments.

/// A figure of {name: {values, total}}: for each planner the share of its runs up to a value.
function stepFigure(title, label, perPlanner, said) {
  const all = [...perPlanner.values()].flatMap(p => p.values);
  if (!all.length) return null;
  const [low, high] = d3.extent(all), domain = [low, Math.max(1.02 * high, 1.05 * low)];
  const steps = new Map();
  for (const [name, {values, total}] of perPlanner)
    steps.set(
        name,
        values.slice().sort(d3.ascending).map((value, i) => ({value, share: (i + 1) / total})));
  const endOf = name =>
      (steps.get(name).length ? steps.get(name)[steps.get(name).length - 1].share : 0);
  const spec = {
    title,
    keys: [...perPlanner.keys()].map(plannerKey),
    said: () => `${said}. In the end: ${
        PLANNERS.map(name => `${name} ${percent(endOf(name))}`).join(', ')}.`,
    data: () => ({
      columns: ['planner', label.replace(/ /g, '_'), 'share_of_runs'],
      rows: [...steps].flatMap(([name, points]) => points.map(p => [name, p.value, p.share]))
    })
  };
  return figure(spec, (svg, width) => {
           const box = chartBox(svg, width, HEIGHT, MARGIN);
           const x = d3.scaleLog().domain(domain).range([box.left, box.right]);
           const y = d3.scaleLinear().domain([0, 1]).range([box.bottom, box.top]);
           drawAxes(
               svg, box, {
                 scale: x,
                 values: decadeTicks(domain),
                 format: v => significant(v, 3),
                 title: label
               },
               {scale: y, ticks: 5, format: '%', title: 'share of runs'});
           const marks = [];
           for (const [name, points] of steps) {
             if (!points.length) continue;
             const line = [
               {value: points[0].value, share: 0}, ...points, {value: domain[1], share: endOf(name)}
             ];
             svg.append('path')
                 .attr('class', 'line')
                 .attr('stroke', plannerColour(name))
                 .attr('stroke-dasharray', plannerDash(name))
                 .attr(
                     'd',
                     d3.line()
                         .curve(d3.curveStepAfter)
                         .x(p => x(p.value))
                         .y(p => y(p.share))(line));
             marks.push(...points.map(
                 p => ({
                   x: x(p.value),
                   y: y(p.share),
                   text: `${name}: ${percent(p.share)} of the runs up to ${significant(p.value, 3)}`
                 })));
           }
           return marks;
         }).node;
}

function profiles(host) {
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
  host.append(
      ...[stepFigure(
              'Time to the first solution', 'seconds of search', times,
              'Share of all runs with a verified path, against the time of the first solution'),
          stepFigure(
              'Length against the best known', 'length over the shortest of the experiment', ratios,
              'Share of all runs whose path is no longer than so many times the shortest known')]
          .filter(Boolean));
}
