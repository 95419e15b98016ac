// Residuals over slip ratio and slip angle in units of the noise: colour and size say how much,
// the mark's direction which way.
const BEYOND_NOISE = 2;

/// One scale for all maps: from what the first model misses most.
function residualScale() {
  const sizes = [];
  for (const channel of DIAGNOSIS.channels)
    for (const model of SHOWN_MODELS)
      sizes.push(...conditions(channel, model.key).map(c => Math.abs(c.z)));
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
  const most = residualScale();
  host.append(
      element(
          'p', {class: 'note'},
          'Mean of measured minus modelled over the runs of a condition, in standard deviations of the noise. Triangles point up where more was measured than modelled, down where less; dots are within two standard deviations.'),
      residualLegend(most));
  for (const channel of channels) {
    const row = element('div', {class: 'maps'});
    for (const model of SHOWN_MODELS) row.append(residualMap(channel, model, most));
    host.append(element('h3', {}, channelOf(channel).title), row);
  }
}

function residualLegend(most) {
  const legend = element('div', {class: 'residual-legend'});
  const draw = () => {
    const colour = residualColour(most);
    legend.replaceChildren(...[-most, -most / 2, 0, most / 2, most].map((z, k) => {
      const svg = d3.create('svg').attr('viewBox', '-9 -9 18 18').attr('aria-hidden', 'true');
      svg.append('path').attr('class', 'residual').attr('d', markOf(z)).attr('fill', colour(z));
      const text = `${fixed(z, 0)}${k === 0 ? ' and less' : k === 4 ? ' and more' : ''}`;
      return element('span', {class: 'key'}, svg.node(), text);
    }));
  };
  draw();
  onThemeChange(draw);
  return legend;
}

function residualMap(channel, model, most) {
  const marks = conditions(channel, model.key);
  const beyond = marks.filter(m => Math.abs(m.z) >= BEYOND_NOISE).length;
  const rms = Math.sqrt(d3.mean(marks, m => m.z * m.z) || 0);
  const said = `rms ${fixed(rms, 1)}; ${beyond} of ${marks.length} conditions beyond two`;
  const figure = element(
      'figure', {class: 'chart'},
      element(
          'figcaption', {}, element('span', {}, capital(model.name)),
          element('span', {class: 'key'}, said)));
  const svg = d3.select(figure)
                  .append('svg')
                  .attr('role', 'img')
                  .attr(
                      'aria-label',
                      `${channelOf(channel).title}, ${
                          model.name}, residuals over slip ratio and slip angle: ${said}`);
  const draw = () => drawResidualMap(svg, Math.max(220, figure.clientWidth), channel, marks, most);
  onWidth(figure, draw);
  onThemeChange(draw);
  return figure;
}

/// A linear axis that shows every value with room around it.
function paddedScale(values, least, range) {
  let [low, high] = d3.extent(values);
  const middle = (low + high) / 2, half = Math.max(high - low, least) / 2;
  return d3.scaleLinear().domain([middle - half * 1.12, middle + half * 1.12]).range(range);
}

function drawResidualMap(svg, width, channel, marks, most) {
  const angles = new Set(ANGLE_OF).size, margin = {left: 44, right: 12, top: 20, bottom: 34};
  const height = margin.top + margin.bottom + Math.min(190, 50 + 26 * angles);
  const x = paddedScale(RUNS.slip_ratio, 0.2, [margin.left, width - margin.right]);
  const y = paddedScale(RUNS.slip_angle_deg, 4, [height - margin.bottom, margin.top]);
  const colour = residualColour(most);
  svg.attr('viewBox', `0 0 ${width} ${height}`).attr('height', height).selectAll('*').remove();
  svg.append('g')
      .attr('class', 'axis')
      .attr('transform', `translate(0,${height - margin.bottom})`)
      .call(d3.axisBottom(x).ticks(Math.max(3, width / 80)).tickSize(4));
  svg.append('g')
      .attr('class', 'axis')
      .attr('transform', `translate(${margin.left},0)`)
      .call(
          d3.axisLeft(y).ticks(Math.min(6, 1 + angles)).tickSize(4).tickFormat(v => `${v}\u00b0`));
  axisTitle(svg, width - margin.right, height - 4, 'slip ratio');
  axisTitle(svg, 4, 11, 'slip angle', 'start');
  const places = new Map();
  for (const mark of marks) {
    const key = `${mark.slip}|${mark.angle}`, taken = places.get(key) || 0;
    places.set(key, taken + 1);
    const group = svg.append('path')
                      .attr('class', 'residual')
                      .attr('d', markOf(mark.z))
                      .attr('fill', colour(mark.z))
                      .attr('transform', `translate(${x(mark.slip) + 9 * taken},${y(mark.angle)})`);
    group.append('title').text(
        `slip ratio ${significant(mark.slip, 3)}, slip angle ${degreesText(mark.angle)}${
            mark.others ? ', ' + mark.others : ''}: ${withChannelUnit(channel, mark.difference)}, ${
            fixed(mark.z, 1)} standard deviations (${mark.count} runs)`);
  }
}

function axisTitle(svg, x, y, text, anchor = 'end') {
  svg.append('g')
      .attr('class', 'axis')
      .append('text')
      .attr('x', x)
      .attr('y', y)
      .attr('text-anchor', anchor)
      .text(text);
}
