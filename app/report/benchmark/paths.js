// Verified paths of one experiment over its terrain, a picture for each planner, on one scale.

function paths(host) {
  const {experiment} = shown;
  const drivenBy = planner => verifiedRuns(planner).filter(r => r.path && r.path.length);
  const all = experiment.planners.flatMap(p => drivenBy(p).map(r => r.path));
  const extent = axis => d3.extent(all.flatMap(path => path.map(p => p[axis])));
  const [xs, ys] = [extent(0), extent(1)];
  host.replaceChildren(
      ...experiment.planners.filter(p => drivenBy(p).length)
          .map(planner => pathFigure(experiment, planner, drivenBy(planner), xs, ys)));
}

function pathFigure(experiment, planner, runs, xs, ys) {
  const said = run =>
      `seed ${run.seed}: ${fixed(run.length_m, 1, 'm')}, margin ${fixed(run.margin_min, 3)}`;
  const spec = {
    title: `${planner.name} (${runs.length})`,
    name: () => `Paths of ${planner.name}, ${experiment.name}`,
    said: () => `${runs.length} verified paths of ${planner.name}. ${runs.map(said).join('; ')}.`,
    data: () => ({
      columns: ['planner', 'seed', 'x_m', 'y_m', 'margin'],
      rows: runs.flatMap(run => run.path.map(p => [planner.name, run.seed, ...p]))
    })
  };
  return figure(spec, (svg, width) => {
           const chart = mapChart(svg, width, xs, ys, {height_max: 420}), {box, x, y} = chart;
           if (experiment.map) drawGround(svg, chart, experiment.map);
           drawAxes(
               svg, box, {scale: x, title: 'x, m'},
               {scale: y, title: 'y, m', grid: !experiment.map});
           for (const run of runs) {
             const d = d3.line().x(p => x(p[0])).y(p => y(p[1]))(run.path);
             if (experiment.map) svg.append('path').attr('class', 'line path-casing').attr('d', d);
             svg.append('path')
                 .attr('class', 'line')
                 .attr('stroke', plannerColour(planner.name))
                 .attr('d', d);
           }
           drawEnds(svg, runs, x, y);
           return runs.flatMap(
               run => run.path.filter((_, i) => i % 4 === 0)
                          .map(p => ({x: x(p[0]), y: y(p[1]), text: said(run)})));
         }).node;
}

/// A circle where all paths start, a square where each ends.
function drawEnds(svg, runs, x, y) {
  const start = runs[0].path[0];
  svg.append('circle')
      .attr('class', 'path-end')
      .attr('cx', x(start[0]))
      .attr('cy', y(start[1]))
      .attr('r', 5);
  for (const {path} of runs) {
    const [x_m, y_m] = path[path.length - 1];
    svg.append('rect')
        .attr('class', 'path-end')
        .attr('x', x(x_m) - 3.5)
        .attr('y', y(y_m) - 3.5)
        .attr('width', 7)
        .attr('height', 7);
  }
}
