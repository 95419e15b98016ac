// Residuals over slip ratio and slip angle in units of the noise: colour and size say how much,
// the mark's direction which way.
const BEYOND_NOISE = 2;

/// One scale for all maps. \param all marks of each
function mapScale(all) {
  const sizes = [].concat(...all).map(c => Math.abs(c.z));
  const most = d3.quantile(sizes.sort(d3.ascending), 0.95) || 4;
  return Math.min(30, Math.max(4, Math.ceil(most)));
}

/// Blue below, orange above, the panel's own colour between.
function residualColour(most) {
  const low = cssColour('--below'), high = cssColour('--above'), middle = cssColour('--level');
  return d3.scaleLinear()
      .domain([-most, 0, most])
      .range([low, middle, high])
      .interpolate(d3.interpolateLab)
      .clamp(true);
}

const markOf = z => Math.abs(z) < BEYOND_NOISE ? 'M-3.5,0a3.5,3.5 0 1,0 7,0a3.5,3.5 0 1,0 -7,0' :
    z > 0                                      ? 'M0,-7L6.5,5L-6.5,5Z' :
                                                 'M0,7L6.5,-5L-6.5,-5Z';

function residualMaps(host) {
  const channels = DIAGNOSIS.channels.filter(c => DIAGNOSIS.run_residuals[c].length);
  if (!channels.length) {
    host.append(element('p', {}, 'There are no residuals to show.'));
    return;
  }
  const most = mapScale([].concat(
      ...channels.map(channel => SHOWN_MODELS.map(({key}) => conditions(channel, key)))));
  host.append(
      element(
          'p', {class: 'note'},
          'Mean of measured minus modelled over the runs of a condition, in standard deviations of the noise. Triangles point up where more was measured than modelled, down where less; dots are within two standard deviations.'),
      residualLegend(most));
  for (const channel of channels) {
    const row = element('div', {class: 'maps'});
    for (const model of SHOWN_MODELS)
      row.append(signedMap(channel, model.name, conditions(channel, model.key), most, 'residuals'));
    host.append(element('h3', {}, channelOf(channel).title), row);
  }
}

/// What the marks say, from far below to far above.
function residualKeys(most) {
  const colour = residualColour(most);
  return [-most, -most / 2, 0, most / 2, most].map((z, k) => ({
                                                     name: `${fixed(z, 0)}${
                                                         k === 0     ? ' and less' :
                                                             k === 4 ? ' and more' :
                                                                       ''}`,
                                                     colour: colour(z),
                                                     symbol: markOf(z)
                                                   }));
}

function residualLegend(most) {
  const legend = element('div', {class: 'residual-legend'});
  const draw = () => legend.replaceChildren(...residualKeys(most).map(key => legendKey(key).node));
  draw();
  onThemeChange(draw);
  return legend;
}

/// Marks over slip ratio and slip angle. \param what residuals or differences
function signedMap(channel, name, marks, most, what) {
  const {title} = channelOf(channel), column = what.slice(0, -1);
  const beyond = marks.filter(m => Math.abs(m.z) >= BEYOND_NOISE).length;
  const rms = Math.sqrt(d3.mean(marks, m => m.z * m.z) || 0);
  const said = `rms ${fixed(rms, 1)}; ${beyond} of ${marks.length} conditions beyond two`;
  const made = figure(
      {
        title: capital(name),
        level: 4,
        name: () => `${title}, ${what}, ${name}`,
        shared_keys: () => residualKeys(most),
        said: () => `${title}, ${what} over slip ratio and slip angle: ${said}.`,
        data: () => ({
          columns: [
            'slip_ratio', 'slip_angle_deg', 'other_conditions', 'runs', `${column}_${channel}`,
            `${column}_in_standard_deviations`
          ],
          rows: marks.map(m => [m.slip, m.angle, m.others, m.count, m.difference, m.z])
        })
      },
      (svg, width) => drawResidualMap(svg, width, channel, marks, most));
  made.node.querySelector('figcaption h4').after(element('span', {class: 'key'}, said));
  return made.node;
}

function drawResidualMap(svg, width, channel, marks, most) {
  const angles = new Set(ANGLE_OF).size, margin = {left: 44, right: 12, top: 20, bottom: 34};
  const height = margin.top + margin.bottom + Math.min(190, 50 + 26 * angles);
  const box = chartBox(svg, width, height, margin), colour = residualColour(most);
  const x = paddedScale(RUNS.slip_ratio, 0.2, [box.left, box.right]);
  const y = paddedScale(RUNS.slip_angle_deg, 4, [box.bottom, box.top]);
  drawAxes(svg, box, {scale: x, title: 'slip ratio'}, {
    scale: y,
    ticks: Math.min(6, 1 + angles),
    format: v => `${v}\u00b0`,
    title: 'slip angle',
    grid: false
  });
  const places = new Map();
  return marks.map(mark => {
    const key = `${mark.slip}|${mark.angle}`, taken = places.get(key) || 0;
    const at = {x: x(mark.slip) + 9 * taken, y: y(mark.angle)};
    places.set(key, taken + 1);
    svg.append('path')
        .attr('class', 'residual')
        .attr('d', markOf(mark.z))
        .attr('fill', colour(mark.z))
        .attr('transform', `translate(${at.x},${at.y})`);
    return {
      ...at,
      text: `slip ratio ${significant(mark.slip, 3)}, slip angle ${degreesText(mark.angle)}${
          mark.others ? ', ' + mark.others : ''}: ${withChannelUnit(channel, mark.difference)}, ${
          fixed(mark.z, 1)} standard deviations (${mark.count} runs)`
    };
  });
}
