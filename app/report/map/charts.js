// Charts along the selected path under one common cursor that moves the marker on the map.
const CHARTS = [
  {
    title: 'Margins',
    decimals: 3,
    zero: true,
    limits: [LIMITS.margin_min],
    series: [
      {name: 'cornering', key: 'cornering_margin', colour: '--series-1'},
      {name: 'tip-over', key: 'tip_over_margin', colour: '--series-2', dash: '7 3'},
      {name: 'traction', key: 'traction_margin', colour: '--series-3', dash: '2 2.5'}
    ]
  },
  {
    title: 'Lateral demand within supply',
    unit: 'N',
    decimals: 0,
    zero: true,
    band: ['supply_min_n', 'supply_max_n'],
    series: [{name: 'demand', key: 'demand_n', colour: '--series-4'}]
  },
  {
    title: 'Speed',
    unit: 'm/s',
    decimals: 2,
    zero: true,
    limits: [LIMITS.speed_max_mps],
    series: [{name: 'speed', key: 'speed_mps', colour: '--series-1'}]
  },
  {
    title: 'Steering',
    unit: '\u00b0',
    decimals: 1,
    zero: true,
    series: [{name: 'largest angle, left positive', key: 'steer_deg', colour: '--series-1'}]
  },
  {
    title: 'Slip ratio',
    decimals: 3,
    zero: true,
    limits: [LIMITS.slip_max, -LIMITS.slip_max],
    series: [{name: 'largest of the wheels', key: 'slip_max', colour: '--series-1'}]
  },
  {
    title: 'Slip angle',
    unit: '\u00b0',
    decimals: 1,
    zero: true,
    limits: [LIMITS.slip_angle_max_deg, -LIMITS.slip_angle_max_deg],
    series: [{name: 'largest of the wheels', key: 'slip_angle_max_deg', colour: '--series-1'}]
  },
  {
    title: 'Sinkage',
    unit: 'mm',
    decimals: 1,
    scale: 1000,
    zero: true,
    limits: [1000 * LIMITS.sinkage_max_m],
    series: [{name: 'largest of the wheels', key: 'sinkage_max_m', colour: '--series-1'}]
  },
  {
    title: 'Elevation and soil',
    unit: 'm',
    decimals: 2,
    soils: true,
    series: [{name: 'ground', key: 'z_m', colour: '--series-4'}]
  },
];

function charts(host) {
  if (!view.selected) {
    host.append(element('p', {}, 'There is no path to follow.'));
    byId('along-path').parentElement.hidden = true;
    return;
  }
  const panels = CHARTS.map(chart => {
    const panel = chartPanel(chart);
    host.append(panel.node);
    return panel;
  });
  const caption = () => {
    const path = view.selected;
    byId('along-path').textContent =
        `Path ${path.label} (${path.planner}). The dashed red lines are limits in force.` +
        (path.points_total > path.length ?
             ` ${integer(path.length)} of ${
                 integer(path.points_total)} points are drawn, the worst of each stretch.` :
             '');
  };
  const drawAll = () => {
    caption();
    panels.forEach(panel => panel.draw());
  };
  for (const radio of document.querySelectorAll('input[name=axis]'))
    radio.addEventListener('change', () => {
      view.axis = radio.value;
      drawAll();
    });
  panels.forEach(panel => onWidth(panel.node, panel.draw));
  caption();
  view.events.on('selected.charts', drawAll)
      .on('cursor.charts', () => panels.forEach(panel => panel.point()));
}

/// The smallest and largest of what a chart shows; limits only where they are near.
function chartDomain(chart, columns) {
  const values =
      columns.reduce((all, column) => all.concat(column.filter(isKnown)), chart.zero ? [0] : []);
  let [low, high] = d3.extent(values);
  if (low === undefined) [low, high] = [0, 1];
  const span = high - low || Math.abs(high) || 1;
  for (const limit of chart.limits || []) {
    if (!isKnown(limit)) continue;
    if (limit > high && limit < high + 1.5 * span) high = limit;
    if (limit < low && limit > low - 0.3 * span) low = limit;
  }
  return high > low ? [low, high] : [low - 0.5, high + 0.5];
}

function chartPanel(chart) {
  const margin = {left: 48, right: 22, top: 8, bottom: 20}, height = 164, scaled = chart.scale || 1;
  const values = key => view.selected.points[key].map(v => (isKnown(v) ? v * scaled : null));
  const caption = element(
      'figcaption', {},
      element(
          'h3', {}, chart.title,
          chart.unit ? element('span', {class: 'unit'}, ` ${chart.unit}`) : ''));
  const node = element('figure', {class: 'chart'}, caption);
  const svg =
      d3.select(node)
          .append('svg')
          .attr('role', 'img')
          .attr(
              'aria-label',
              `${chart.title} along the selected path; the values at the marker stand in the heading`);
  const keys =
      chart.series.map(series => chartKey(caption, series.name, series.colour, series.dash));
  const bandKey = chart.band ? chartKey(caption, 'supply', '--band', null, 8) : null;
  if (chart.soils)
    MAP.soils.forEach((soil, k) => {
      const swatch = element('span', {class: 'swatch', 'aria-hidden': 'true'});
      swatch.style.background = soilColour(k);
      caption.append(element('span', {class: 'key'}, swatch, soil.name));
    });
  let x = null, y = null, marker = null;

  function draw() {
    const width = Math.max(240, node.clientWidth), path = view.selected,
          along = path.points[view.axis];
    const columns = chart.series.map(s => values(s.key)), band = (chart.band || []).map(values);
    x = d3.scaleLinear().domain([0, d3.max(along) || 1]).range([margin.left, width - margin.right]);
    y = d3.scaleLinear().domain(chartDomain(chart, columns.concat(band))).nice(5).range([
      height - margin.bottom, margin.top
    ]);
    svg.attr('viewBox', `0 0 ${width} ${height}`).attr('height', height).selectAll('*').remove();
    const unit = view.axis === 'time_s' ? 's' : 'm';
    svg.append('g')
        .attr('class', 'grid')
        .selectAll('line')
        .data(y.ticks(4))
        .join('line')
        .attr('x1', margin.left)
        .attr('x2', width - margin.right)
        .attr('y1', y)
        .attr('y2', y);
    svg.append('g')
        .attr('class', 'axis')
        .attr('transform', `translate(0,${height - margin.bottom})`)
        .call(d3.axisBottom(x)
                  .ticks(Math.max(3, width / 90))
                  .tickSize(4)
                  .tickFormat(v => `${v} ${unit}`));
    svg.append('g')
        .attr('class', 'axis')
        .attr('transform', `translate(${margin.left},0)`)
        .call(d3.axisLeft(y).ticks(4).tickSize(0).tickPadding(6))
        .select('.domain')
        .remove();
    if (chart.soils) drawSoils(svg, x, height - margin.bottom, along, path.points.soil);
    const line = d3.line()
                     .defined((v, i) => isKnown(v) && isKnown(along[i]))
                     .x((_, i) => x(along[i]))
                     .y(v => y(v));
    if (chart.band) {
      svg.append('path')
          .attr('fill', cssVar('--band'))
          .attr(
              'd',
              d3.area()
                  .defined((_, i) => isKnown(band[0][i]) && isKnown(band[1][i]))
                  .x((_, i) => x(along[i]))
                  .y0((_, i) => y(band[0][i]))
                  .y1((_, i) => y(band[1][i]))(along));
      for (const edge of band)
        svg.append('path')
            .attr('class', 'line')
            .attr('stroke', cssVar('--series-1'))
            .attr('stroke-opacity', 0.6)
            .attr('d', line(edge));
    }
    chart.series.forEach(
        (series, k) => svg.append('path')
                           .attr('class', 'line')
                           .attr('stroke', cssVar(series.colour))
                           .attr('stroke-dasharray', series.dash || null)
                           .attr('d', line(columns[k])));
    drawLimits(svg, chart, y, margin.left, width - margin.right);
    marker = svg.append('g').attr('display', 'none');
    marker.append('line')
        .attr('class', 'crosshair')
        .attr('y1', margin.top)
        .attr('y2', height - margin.bottom);
    marker.selectAll('circle')
        .data(chart.series)
        .join('circle')
        .attr('r', 3.5)
        .attr('fill', s => cssVar(s.colour))
        .attr('stroke', cssVar('--panel'));
    const overlay = svg.append('rect')
                        .attr('x', margin.left)
                        .attr('width', width - margin.left - margin.right)
                        .attr('height', height)
                        .attr('fill', 'transparent');
    overlay.on('mousemove touchmove', () => {
      const value = x.invert(d3.mouse(svg.node())[0]), i = d3.bisectLeft(along, value);
      setCursor(path, i > 0 && value - along[i - 1] < along[i] - value ? i - 1 : i);
    });
    point();
  }

  function point() {
    if (!marker || !view.cursor || view.cursor.path !== view.selected) return;
    const i = view.cursor.index, points = view.selected.points;
    marker.attr('display', null);
    marker.select('line').attr('x1', x(points[view.axis][i])).attr('x2', x(points[view.axis][i]));
    const at = series => {
      const v = points[series.key][i];
      return isKnown(v) ? v * scaled : null;
    };
    marker.selectAll('circle')
        .attr('display', s => (at(s) === null ? 'none' : null))
        .attr('cx', x(points[view.axis][i]))
        .attr('cy', s => (at(s) === null ? 0 : y(at(s))));
    chart.series.forEach((series, k) => {
      keys[k].textContent = fixed(at(series), chart.decimals);
    });
    if (bandKey)
      bandKey.textContent =
          chart.band.map(key => fixed(points[key][i], chart.decimals)).join(' to ');
  }

  return {node, draw, point};
}

const cssVar = name => `var(${name})`;

/// Limits as dashed lines; one that lies beyond the axis is said in words.
function drawLimits(svg, chart, y, left, right) {
  const [bottom, top] = y.range(), decimals = chart.decimals > 1 ? 2 : chart.decimals;
  for (const limit of chart.limits || []) {
    const at = y(limit);
    if (!isKnown(at)) continue;
    const beyond = at < top - 1 || at > bottom + 1;
    if (beyond && limit < 0) continue;  // its positive twin says it
    if (!beyond)
      svg.append('line')
          .attr('class', 'limit')
          .attr('x1', left)
          .attr('x2', right)
          .attr('y1', at)
          .attr('y2', at);
    svg.append('text')
        .attr('class', 'limit-label')
        .attr('x', right)
        .attr('y', beyond ? top + 4 : at + (at < top + 14 ? 12 : -4))
        .attr('text-anchor', 'end')
        .text(`limit ${fixed(limit, decimals)}${beyond ? ' (above)' : ''}`);
  }
}

/// An entry of a chart's legend; returns the node that takes the value at the marker.
function chartKey(caption, name, colour, dash, width = 2) {
  const sample = d3.create('svg').attr('viewBox', '0 0 22 8').attr('aria-hidden', 'true');
  sample.append('line')
      .attr('x2', 22)
      .attr('y1', 4)
      .attr('y2', 4)
      .attr('stroke', cssVar(colour))
      .attr('stroke-width', width)
      .attr('stroke-dasharray', dash || null);
  const value = element('b');
  caption.append(element('span', {class: 'key'}, sample.node(), `${name} `, value));
  return value;
}

/// The soil below the vehicle as a band along the axis.
function drawSoils(svg, x, bottom, along, soils) {
  let from = 0;
  for (let i = 1; i <= soils.length; ++i) {
    if (i < soils.length && soils[i] === soils[from]) continue;
    const end = along[Math.min(i, soils.length - 1)];
    if (soils[from] >= 0)
      svg.append('rect')
          .attr('x', x(along[from]))
          .attr('width', Math.max(0, x(end) - x(along[from])))
          .attr('y', bottom - 9)
          .attr('height', 9)
          .attr('fill', soilColour(soils[from]));
    from = i;
  }
}
