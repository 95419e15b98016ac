// Charts along the selected path under one common cursor that moves the marker on the map.
const CHARTS = [
  {
    title: 'Margins',
    note:
        'Shares of the weight. Cornering: how far demand is from the ends of the supply. Tip-over: how far the resultant is from the support edges. Traction: the drive force that is left.',
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
    note:
        'Demand: the lateral force that the commanded manoeuvre takes. Supply: the interval of lateral forces that steady manoeuvres can give there.',
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
    series: STEERS ?
        [{name: 'largest angle, left positive', key: 'steer_deg', colour: '--series-1'}] :
        []
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
    title: 'Torque',
    unit: 'N m',
    decimals: 1,
    zero: true,
    limits: isKnown(VEHICLE.torque_max_nm) ? [VEHICLE.torque_max_nm, -VEHICLE.torque_max_nm] : [],
    series: [{name: 'largest of the wheels', key: 'torque_max_nm', colour: '--series-1'}]
  },
  {
    title: 'Drive power',
    unit: 'W',
    decimals: 0,
    zero: true,
    note: 'Torque times turning rate of each wheel while it drives, mean to the next point; braking gives nothing back.',
    series: [{name: 'all wheels', key: 'power_w', colour: '--series-2'}]
  },
  {
    title: 'Wheel loads',
    unit: 'N',
    decimals: 0,
    zero: true,
    series: VEHICLE.wheels.map(wheel => ({
                                 name: words(wheel.name),
                                 key: `load_${wheel.name}_n`,
                                 colour: wheel.y_m > 0 ? '--series-1' : '--series-2',
                                 dash: [null, '7 3', '2 2.5', '9 3 2 3'][axleOf(wheel) % 4]
                               }))
  },
  {
    title: 'Slope, pitch and roll',
    unit: '\u00b0',
    decimals: 1,
    zero: true,
    limits: [LIMITS.slope_max_deg],
    series: [
      {name: 'slope', key: 'slope_deg', colour: '--series-4'},
      {name: 'pitch, nose up', key: 'pitch_deg', colour: '--series-1', dash: '7 3'},
      {name: 'roll, left side up', key: 'roll_deg', colour: '--series-2', dash: '2 2.5'}
    ]
  },
  {
    title: 'Elevation and soil',
    unit: 'm',
    decimals: 2,
    soils: true,
    series: [{name: 'ground', key: 'z_m', colour: '--series-4'}]
  },
].filter(chart => chart.series.length > 0);

function charts(host) {
  if (!view.selected) {
    host.closest('section').hidden = true;
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
  byId('others').addEventListener('change', event => {
    view.others = event.target.checked;
    drawAll();
  });
  caption();
  view.events.on('selected.charts', drawAll)
      .on('visible.charts', () => view.others && drawAll())
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

const CHART_HEIGHT = 170, CHART_MARGIN = {
  left: 48,
  right: 22,
  top: 14,
  bottom: 20
};

function chartPanel(chart) {
  const scaled = chart.scale || 1;
  const at = (key, i) => {
    const value = view.selected.points[key][i];
    return isKnown(value) ? value * scaled : null;
  };
  const column = key => view.selected.points[key].map((_, i) => at(key, i));
  const keys = chart.series.map(
      series => ({name: series.name, colour: cssVar(series.colour), dash: series.dash}));
  if (chart.band) keys.push({name: 'supply', colour: cssVar('--band'), area: true});
  if (chart.soils)
    MAP.soils.forEach((soil, k) => keys.push({name: soil.name, colour: soilColour(k), area: true}));
  const shown = chart.series.concat(
      (chart.band || []).map((key, k) => ({key, name: `supply to the ${k ? 'left' : 'right'}`})));
  const made =
      figure(
          {
            title: chart.title,
            unit: chart.unit,
            keys,
            name: () => `${chart.title} along path ${view.selected.label}`,
            said: () => rangesText(shown.map(({name, key}) => ({
                                               name: `${chart.title}, ${name}`,
                                               values: column(key),
                                               decimals: chart.decimals,
                                               unit: chart.unit
                                             }))),
            data: () => pointColumns(['distance_m', 'time_s', ...shown.map(s => s.key)]),
          },
          draw);
  if (chart.note) made.node.append(element('p', {class: 'note'}, chart.note));
  let x = null, y = null, marker = null;

  function draw(svg, width) {
    const path = view.selected, along = path.points[view.axis];
    const columns = chart.series.map(s => column(s.key)), band = (chart.band || []).map(column);
    const others = view.others ? otherLines(chart, scaled) : [];
    const box = chartBox(svg, width, CHART_HEIGHT, CHART_MARGIN);
    x = d3.scaleLinear()
            .domain([0, d3.max([...along, ...others.flatMap(o => o.along)]) || 1])
            .range([box.left, box.right]);
    const values = [...columns, ...band, ...others.map(other => other.values)];
    y = d3.scaleLinear().domain(chartDomain(chart, values)).nice(5).range([box.bottom, box.top]);
    const unit = view.axis === 'time_s' ? 's' : 'm';
    drawAxes(svg, box, {scale: x, format: v => `${v} ${unit}`}, {scale: y});
    if (chart.soils) drawSoils(svg, x, box.bottom, along, path.points.soil);
    const line = d3.line()
                     .defined((v, i) => isKnown(v) && isKnown(along[i]))
                     .x((_, i) => x(along[i]))
                     .y(v => y(v));
    for (const other of others) drawOther(svg, x, y, other);
    if (chart.band) drawBand(svg, band, along, x, y, line);
    chart.series.forEach(
        (series, k) => svg.append('path')
                           .attr('class', 'line')
                           .attr('stroke', cssVar(series.colour))
                           .attr('stroke-dasharray', series.dash || null)
                           .attr('d', line(columns[k])));
    drawLimits(svg, chart, y, box.left, box.right);
    marker = svg.append('g').attr('class', 'marker').attr('display', 'none');
    marker.append('line').attr('class', 'crosshair').attr('y1', box.top).attr('y2', box.bottom);
    marker.selectAll('circle')
        .data(chart.series)
        .join('circle')
        .attr('r', 3.5)
        .attr('fill', s => cssVar(s.colour))
        .attr('stroke', cssVar('--panel'));
    const overlay = svg.append('rect')
                        .attr('class', 'pointer-area')
                        .attr('x', box.left)
                        .attr('width', box.right - box.left)
                        .attr('height', CHART_HEIGHT)
                        .attr('fill', 'transparent');
    overlay.on('mousemove touchmove', () => {
      const value = x.invert(d3.mouse(svg.node())[0]), i = d3.bisectLeft(along, value);
      setCursor(path, i > 0 && value - along[i - 1] < along[i] - value ? i - 1 : i);
    });
    point();
  }

  function point() {
    if (!view.cursor || view.cursor.path !== view.selected) return;
    const i = view.cursor.index;
    chart.series.forEach((series, k) => {
      made.values[k].textContent = fixed(at(series.key, i), chart.decimals);
    });
    if (chart.band)
      made.values[chart.series.length].textContent =
          chart.band.map(key => fixed(at(key, i), chart.decimals)).join(' to ');
    if (!marker) return;
    const place = x(view.selected.points[view.axis][i]);
    marker.attr('display', null);
    marker.select('line').attr('x1', place).attr('x2', place);
    marker.selectAll('circle')
        .attr('display', s => (at(s.key, i) === null ? 'none' : null))
        .attr('cx', place)
        .attr('cy', s => (at(s.key, i) === null ? 0 : y(at(s.key, i))));
  }

  return {...made, point};
}

/// What a chart shows of the other paths on the map: {path, dash, along, values} for each series.
function otherLines({series}, scaled) {
  const shown = view.paths.filter(p => p !== view.selected && p.visible && p.length);
  return shown.flatMap(
      path => series.filter(({key}) => path.points[key])
                  .map(({key, dash}) => ({
                         path,
                         dash,
                         along: path.points[view.axis],
                         values: path.points[key].map(v => (isKnown(v) ? v * scaled : null))
                       })));
}

function drawOther(svg, x, y, {path, dash, along, values}) {
  const line = d3.line()
                   .defined((v, i) => isKnown(v) && isKnown(along[i]))
                   .x((_, i) => x(along[i]))
                   .y(v => y(v));
  svg.append('path')
      .attr('class', 'line other')
      .attr('stroke-dasharray', dash || null)
      .attr('d', line(values))
      .append('title')
      .text(`Path ${path.label}`);
}

/// Columns of the selected path, as they stand in candidate-K.csv.
function pointColumns(names) {
  const {points} = view.selected;
  return {columns: names, rows: points.time_s.map((_, i) => names.map(name => points[name][i]))};
}

/// The area between two columns, with its edges.
function drawBand(svg, band, along, x, y, line) {
  svg.append('path')
      .attr('fill', cssVar('--band'))
      .attr(
          'd',
          d3.area()
              .defined((_, i) => isKnown(band[0][i]) && isKnown(band[1][i]) && isKnown(along[i]))
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
        .attr('y', beyond ? top + 8 : at - 4)
        .attr('text-anchor', 'end')
        .text(`limit ${fixed(limit, decimals)}${beyond ? ' (above)' : ''}`);
  }
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
