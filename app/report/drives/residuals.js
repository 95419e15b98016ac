// What was measured in each window less what the model says of it, before and after what was found:
// a zone shows as a step that the corrected model takes away.

const NOISE_BAND = 'rgba(0, 114, 178, .13)', ZONE_BAND = 'rgba(213, 94, 0, .16)';

/// The drives one behind the other, each by its own time.
const DRIVE_STARTS = (() => {
  const rows = [].concat(...REPORT.residuals.map(channel => channel.rows));
  const starts = [];
  let end_s = 0;
  for (const drive of d3.range(REPORT.drives.length)) {
    const [from_s, to_s] = d3.extent(rows.filter(row => row[0] === drive), row => row[1]);
    starts.push({behind_s: end_s - (from_s || 0), at_s: end_s});
    if (to_s !== undefined) end_s += to_s - from_s + 10;
  }
  return starts;
})();
const alongTheWay = (drive, time_s) => time_s + DRIVE_STARTS[drive].behind_s;

/// Of the fields of a row: drive, time, measured less model, measured less corrected.
const BEFORE = 2, AFTER = 3;
const lefts = (rows, field) => rows.filter(row => isKnown(row[field]));
const isKnownBefore = channel => lefts(channel.rows, BEFORE).length > 0;
const DOT = d3.symbol(d3.symbolCircle, 60)();
const RESIDUAL_KEYS = [
  ...(REPORT.residuals.some(isKnownBefore) ?
          [{name: 'as map and vehicle are said to be', colour: UNDER_LIMIT, symbol: DOT}] :
          []),
  {
    name: REPORT.currents ? 'corrected; of currents, as fitted to what was not held out' : 'corrected',
    colour: seriesColour(0),
    symbol: DOT
  },
  ...(REPORT.zones.length ? [{name: 'zone of other soil', colour: ZONE_BAND, area: true}] : [])
];
const rootMeanSquare = rows => field =>
    Math.sqrt(d3.mean(lefts(rows, field), row => row[field] * row[field]));

function residualsAlongTheWay(host) {
  const several = REPORT.drives.length > 1;
  host.append(element(
      'p', {class: 'note'},
      `A dot a window${several ? ', the drives one behind the other' : ''}.` +
          (REPORT.residuals.some(channel => channel.noise > 0) ?
               ' The band is twice the noise to either side, without what the scatter of wheel speeds and slopes adds.' :
               '')));
  host.append(
      element('div', {class: 'residual-legend'}, ...RESIDUAL_KEYS.map(key => legendKey(key).node)));
  const charts = element('div', {class: 'maps'});
  charts.append(...REPORT.residuals.map(residualChart));
  host.append(charts);
}

function residualChart(of) {
  const {channel, rows} = of, {name, unit} = nameAndUnit(channel), rms = rootMeanSquare(rows);
  return figure(
             {
               title: capital(name),
               shared_keys: () => RESIDUAL_KEYS,
               said: () => `${name}, measured minus modelled in ${rows.length} windows: root mean square ${
                   isKnownBefore(of) ? `${significant(rms(BEFORE), 3)} before, ` : ''}${
                   significant(rms(AFTER), 3)} corrected.`,
               data: () => ({
                 columns: ['drive_id', 'time_s', `before_${channel}`, `after_${channel}`],
                 rows: rows.map(([drive, ...values]) => [REPORT.drives[drive].drive_id, ...values])
               })
             },
             (svg, width) => drawResiduals(svg, width, of, unit))
      .node;
}

function drawResiduals(svg, width, {noise, rows}, unit) {
  const box = chartBox(svg, width, 160, {left: 52, right: 12, top: 20, bottom: 34});
  const values = [BEFORE, AFTER].flatMap(field => lefts(rows, field).map(row => row[field]));
  const most = 1.15 * Math.max(d3.max(values, Math.abs) || 1, 2 * noise);
  const x = d3.scaleLinear()
                .domain(d3.extent(rows, ([drive, time_s]) => alongTheWay(drive, time_s)))
                .range([box.left + 4, box.right - 4]);
  const y = d3.scaleLinear().domain([-most, most]).range([box.bottom, box.top]);
  const band = (x1, x2, y1, y2, colour) => svg.append('rect')
                                               .attr('x', x1)
                                               .attr('width', Math.max(1, x2 - x1))
                                               .attr('y', y1)
                                               .attr('height', y2 - y1)
                                               .attr('fill', colour);
  if (noise > 0) band(box.left, box.right, y(2 * noise), y(-2 * noise), NOISE_BAND);
  for (const zone of REPORT.zones) {
    const drive = REPORT.drives.findIndex(({drive_id}) => drive_id === zone.drive);
    band(x(alongTheWay(drive, zone.starts_s)), x(alongTheWay(drive, zone.ends_s)), box.top,
         box.bottom, ZONE_BAND);
  }
  drawAxes(svg, box, {scale: x, title: REPORT.drives.length > 1 ? 'time of all drives, s' : 'time, s'},
           {scale: y, title: unit});
  const dots = (field, colour) => {
    const marks = lefts(rows, field).map(row => ({
                                           x: x(alongTheWay(row[0], row[1])),
                                           y: y(row[field]),
                                           text: `${REPORT.drives[row[0]].drive_id}, ${
                                               fixed(row[1], 1, 's')}: ${significant(row[field], 3)} ${unit}`
                                         }));
    svg.append('path')
        .attr('class', 'dots-in-time')
        .style('stroke', colour)
        .attr('d', marks.map(m => `M${m.x.toFixed(1)},${m.y.toFixed(1)}h0`).join(''));
    return marks;
  };
  return [...dots(BEFORE, UNDER_LIMIT), ...dots(AFTER, seriesColour(0))];
}
