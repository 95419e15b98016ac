// Verified paths of one experiment over its terrain, a picture for each planner, on one scale.

/// The terrain of an experiment as a picture in the theme's light; nothing where it is not known.
const shades = new Map();
function shadeOf(experiment) {
  if (!experiment.map) return null;
  const key = `${experiment.name}|${isDark()}`;
  if (!shades.has(key)) {
    const terrain = readTerrain(experiment.map);
    shades.set(key, hillshade(terrain, shadingStretch(terrain), isDark()).toDataURL());
  }
  return shades.get(key);
}

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
           const around_m = 6, across_m = xs[1] - xs[0] + 2 * around_m,
                 up_m = ys[1] - ys[0] + 2 * around_m;
           const margin = {left: 44, right: 14, top: 20, bottom: 36};
           const room = width - margin.left - margin.right;
           const height =
               Math.max(150, Math.min(420, room * up_m / across_m)) + margin.top + margin.bottom;
           const box = chartBox(svg, width, height, margin);
           const scale = Math.min(room / across_m, (box.bottom - box.top) / up_m);
           const axis = ([low, high], from, to) => {
             const half = Math.abs(to - from) / scale / 2, middle = (low + high) / 2;
             return d3.scaleLinear().domain([middle - half, middle + half]).range([from, to]);
           };
           const x = axis(xs, box.left, box.right), y = axis(ys, box.bottom, box.top);
           drawGround(svg, box, experiment, x, y);
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

/// Hillshade and rocks below the paths, cut off at the axes.
function drawGround(svg, box, experiment, x, y) {
  const {map} = experiment, shade = shadeOf(experiment);
  if (!shade) return;
  const id = `ground-${experiment.name}-${box.width}`.replace(/[^\w-]/g, '_');
  svg.append('clipPath')
      .attr('id', id)
      .append('rect')
      .attr('x', box.left)
      .attr('y', box.top)
      .attr('width', box.right - box.left)
      .attr('height', box.bottom - box.top);
  const ground = svg.append('g').attr('clip-path', `url(#${id})`);
  ground.append('image')
      .attr('href', shade)
      .attr('preserveAspectRatio', 'none')
      .attr('x', x(map.west_m))
      .attr('y', y(map.north_m))
      .attr('width', x(map.west_m + map.raster.columns * map.raster.cell_width_m) - x(map.west_m))
      .attr('height', y(map.north_m - map.raster.rows * map.raster.cell_height_m) - y(map.north_m));
  for (const [x_m, y_m, radius_m] of map.rocks)
    ground.append('circle')
        .attr('class', 'rock')
        .attr('cx', x(x_m))
        .attr('cy', y(y_m))
        .attr('r', Math.max(0.6, x(x_m + radius_m) - x(x_m)));
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
