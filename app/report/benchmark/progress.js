// How the best solution of a run improves while it searches.

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
        const known = at.filter(isKnown);
        // A run without a solution yet counts as one of any cost: else the median would rise as
        // late runs join.
        const sorted = at.map(v => isKnown(v) ? v : Infinity).sort(d3.ascending);
        const quantile = share => {
          const value = d3.quantile(sorted, share);
          return isKnown(value) ? value : d3.max(known);
        };
        return isKnown(d3.quantile(sorted, 0.5)) ?
            {t, low: quantile(0.25), middle: quantile(0.5), high: quantile(0.75)} :
            null;
      })
      .filter(p => p);
}

function progress(host) {
  const names = new Set(shown.experiment.planners.flatMap(
      p => p.runs.flatMap(r => (r.progress_names || []).filter(n => n.startsWith('best')))));
  host.replaceChildren(...[...names].map(progressFigure).filter(Boolean));
}

function progressFigure(property) {
  const {experiment} = shown;
  const planners =
      experiment.planners.map(p => ({name: p.name, series: progressSeries(p, property)}))
          .filter(p => p.series.length);
  if (!planners.length) return null;
  const last = d3.max(planners.flatMap(p => p.series.map(s => s[s.length - 1].t)));
  const times = d3.range(1, 81).map(k => last * k / 80);
  const drawn = planners.map(p => ({name: p.name, points: bands(p.series, times)}));
  const all = drawn.flatMap(p => p.points.flatMap(q => [q.low, q.high]));
  if (!all.length) return null;
  const title = `${capital(property.replace(/ REAL$/, ''))} (weighted sum of the objective; ` +
      `seconds where only time counts)`;
  const spec = {
    title,
    keys: drawn.map(p => plannerKey(p.name)),
    name: () => `${title}, ${experiment.name}`,
    said: () => `${title} against time, median and quartiles over the runs. At the end: ${
        drawn.filter(p => p.points.length)
            .map(p => `${p.name} ${significant(p.points[p.points.length - 1].middle, 3)}`)
            .join(', ')}.`,
    data: () => ({
      columns: ['planner', 'time_s', 'lower_quartile', 'median', 'upper_quartile'],
      rows: drawn.flatMap(p => p.points.map(q => [p.name, q.t, q.low, q.middle, q.high]))
    })
  };
  return figure(spec, (svg, width) => {
           const box = chartBox(svg, width, HEIGHT, MARGIN);
           const x = d3.scaleLinear().domain([0, last]).range([box.left, box.right]);
           const y = d3.scaleLinear().domain(d3.extent(all)).nice().range([box.bottom, box.top]);
           drawAxes(svg, box, {scale: x, title: 'seconds of search'}, {scale: y, ticks: 5});
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
           return drawn.flatMap(
               ({name, points}) => points.map(
                   p => ({
                     x: x(p.t),
                     y: y(p.middle),
                     text: `${name} after ${fixed(p.t, 2, 's')}: median ${significant(p.middle, 3)}`
                   })));
         }).node;
}
