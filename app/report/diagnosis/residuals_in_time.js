// Residuals along the time of the runs, before and after the correction: what dries, warms up or
// remembers shows as a course, and a correction that heeds it leaves none.
const TIME = RUNS.time_s ?
    {
      of: RUNS.time_s.map(t => (t - d3.min(RUNS.time_s)) / 3600),
      title: 'hours since the first run',
      column: 'hours'
    } :
    {
      of: d3.range(RUNS.run_id.length).map(i => i + 1),
      title: 'run, in the order of the file',
      column: 'run_in_order'
    };
const IN_TIME_MODELS = MODELS.filter(
    m => m.key === 'calibrated' || (m.key === 'corrected' && HAS_CORRECTION));

const residualsInTimeOf = (channel, model) =>
    DIAGNOSIS.run_residuals[channel]
        .filter(r => isKnown(r.measured) && isKnown(r[model]) && r.noise > 0)
        .map(r => ({run: r.run, at: TIME.of[r.run], z: (r.measured - r[model]) / r.noise}));

function residualsInTime(host) {
  const channels = DIAGNOSIS.channels.filter(c => DIAGNOSIS.run_residuals[c].length);
  if (!channels.length) return;
  host.append(element(
      'p', {class: 'note'},
      'Measured minus modelled of each run, in standard deviations of the noise. The line is the mean of nine neighbouring runs, broken where the runs pause.'));
  for (const channel of channels) {
    const shown = IN_TIME_MODELS.map(({key}) => residualsInTimeOf(channel, key));
    const most = d3.max([].concat(...shown), r => Math.abs(r.z)) || 1;
    const row = element('div', {class: 'maps'});
    IN_TIME_MODELS.forEach(
        ({name}, k) => row.append(timeChart(channel, name, shown[k], most)));
    host.append(element('h3', {}, channelOf(channel).title), row);
  }
}

/// Runs in the order of time, parted by pauses: five times as long as three of four steps are.
function stretchesOf(rows) {
  const order = rows.slice().sort((a, b) => a.at - b.at);
  const steps = order.slice(1).map((r, i) => r.at - order[i].at);
  const pause = 5 * d3.quantile(steps.filter(step => step > 0), 0.75);
  const stretches = [];
  order.forEach((r, i) => {
    if (i === 0 || steps[i - 1] > pause) stretches.push([]);
    stretches[stretches.length - 1].push(r);
  });
  return stretches;
}

/// Means over a run and its four neighbours on each side, none of them beyond a pause.
const runningMean = stretch => stretch.map(
    (r, i) => ({at: r.at, z: d3.mean(stretch.slice(Math.max(0, i - 4), i + 5), n => n.z)}));

function timeChart(channel, name, rows, most) {
  const {title} = channelOf(channel), lines = stretchesOf(rows).map(runningMean);
  const means = lines.flat();
  return figure(
             {
               title: capital(name),
               level: 4,
               name: () => `${title}, residuals in time, ${name}`,
               said: () => `${title}, residuals of ${rows.length} runs in time; means of neighbours ${
                   fixed(d3.min(means, m => m.z), 1)} to ${
                   fixed(d3.max(means, m => m.z), 1)} standard deviations.`,
               data: () => ({
                 columns: ['run_id', TIME.column, `residual_${channel}_in_standard_deviations`],
                 rows: rows.map(r => [RUNS.run_id[r.run], r.at, r.z])
               })
             },
             (svg, width) => drawInTime(svg, width, rows, lines, most))
      .node;
}

function drawInTime(svg, width, rows, lines, most) {
  const box = chartBox(svg, width, 150, {left: 44, right: 12, top: 20, bottom: 34});
  const x = d3.scaleLinear().domain(d3.extent(TIME.of)).range([box.left + 4, box.right - 4]);
  const y = d3.scaleLinear().domain([-most * 1.05, most * 1.05]).range([box.bottom, box.top]);
  drawAxes(svg, box, {scale: x, title: TIME.title}, {scale: y, title: 'standard deviations'});
  const marks = rows.map(r => ({
                           x: x(r.at),
                           y: y(r.z),
                           text: `run ${RUNS.run_id[r.run]}: ${fixed(r.z, 1)} standard deviations`
                         }));
  // One path of round dots: an element a run makes a page of thousands of runs slow.
  svg.append('path')
      .attr('class', 'dots-in-time')
      .attr('d', marks.map(m => `M${m.x.toFixed(1)},${m.y.toFixed(1)}h0`).join(''));
  const line = d3.line().x(m => x(m.at)).y(m => y(m.z));
  svg.append('path').attr('class', 'mean-in-time').attr('d', lines.map(line).join(''));
  return marks;
}
