// Draws a plan that was driven, diagnosed and planned again.
const DRIVES = [
  {key: 'first', label: 'first plan, driven', drive: REPORT.first_drive},
  {key: 'second', label: 'planned again, driven', drive: REPORT.second_drive}
].filter(({drive}) => drive).map((one, k) => ({...one, colour: seriesColour(2 * k)}));
const PLACES = DRIVES.flatMap(({key}) => REPORT.paths[key]);
const FOUND = '#cc79a7';

const lengthOf = track =>
    d3.sum(d3.pairs(track), ([a, b]) => Math.hypot(b[0] - a[0], b[1] - a[1]));

/// Both drives over the map, the patch that is there and the zone that was found.
function drawTracks(svg, width) {
  const all = [...PLACES, ...REPORT.corners];
  const extents = [0, 1].map(axis => d3.extent(all, p => p[axis]));
  const chart = mapChart(svg, width, ...extents, {around_m: 10, tight: true}), {box, x, y} = chart;
  drawGround(svg, chart, REPORT.map);
  drawAxes(svg, box, {scale: x, title: 'x, m'}, {scale: y, title: 'y, m', grid: false});
  const line = d3.line().x(p => x(p[0])).y(p => y(p[1]));
  for (const track of REPORT.diagnosis.zones)
    svg.append('path')
        .attr('d', line(track))
        .attr('fill', 'none')
        .attr('stroke', FOUND)
        .attr('stroke-opacity', 0.35)
        .attr('stroke-width', x(lengthOf(track)) - x(0));
  svg.append('path')
      .attr('d', `${line(REPORT.corners)}Z`)
      .attr('fill', 'none')
      .attr('stroke', UNDER_LIMIT)
      .attr('stroke-width', 2)
      .attr('stroke-dasharray', '5 3');
  for (const {key, colour} of DRIVES) {
    svg.append('path').attr('class', 'line path-casing').attr('d', line(REPORT.paths[key]));
    svg.append('path').attr('class', 'line').attr('stroke', colour).attr('d', line(REPORT.paths[key]));
  }
  for (const {drive} of DRIVES)
    for (const {limit, first} of drive.limits_broken)
      svg.append('circle')
          .attr('cx', x(first.x_m))
          .attr('cy', y(first.y_m))
          .attr('r', 5)
          .attr('fill', UNDER_LIMIT)
          .append('title')
          .text(`${words(limit)} first broken here`);
  return DRIVES.flatMap(({key, label}) => REPORT.paths[key].map(([x_m, y_m, way_m, margin]) => ({
                                            x: x(x_m),
                                            y: y(y_m),
                                            text: `${label}: ${fixed(way_m, 1, 'm')} on the way, margin ${
                                                fixed(margin, 3)}`
                                          })));
}

const known = key => REPORT.paths[key].filter(p => isKnown(p[3]));

function drawMargins(svg, width) {
  const all = DRIVES.flatMap(({key}) => known(key));
  const box = chartBox(svg, width, 220, {left: 48, right: 14, top: 20, bottom: 34});
  const x = d3.scaleLinear([0, d3.max(all, p => p[2])], [box.left, box.right]);
  const y = paddedScale([0, ...all.map(p => p[3])], 0.1, [box.bottom, box.top]);
  drawAxes(svg, box, {scale: x, title: 'way, m'}, {scale: y});
  svg.append('line')
      .attr('x1', box.left)
      .attr('x2', box.right)
      .attr('y1', y(REPORT.margin_min_allowed))
      .attr('y2', y(REPORT.margin_min_allowed))
      .attr('stroke', UNDER_LIMIT)
      .attr('stroke-dasharray', '5 3');
  for (const {key, colour} of DRIVES)
    svg.append('path')
        .attr('class', 'line')
        .attr('stroke', colour)
        .attr('d', d3.line().x(p => x(p[2])).y(p => y(p[3]))(known(key)));
  return [];
}

const driveKeys = () => DRIVES.map(({label, colour}) => ({name: label, colour}));
byId('track').append(
    figure(
        {
          title: 'The drives on the map',
          keys: [
            ...driveKeys(), {name: 'hidden patch; dots: limits first broken', colour: UNDER_LIMIT, dash: '5 3'},
            ...(REPORT.diagnosis.zones.length ?
                    [{name: 'zone of other soil, as found', colour: FOUND, area: true}] :
                    [])
          ],
          said: () => `${DRIVES.length} drives, ${REPORT.diagnosis.zones.length} zones found.`,
          data: () => ({columns: ['x_m', 'y_m', 'way_m', 'margin'], rows: PLACES})
        },
        drawTracks)
        .node);
byId('margins').append(
    figure(
        {
          title: 'Smallest stability margin along the way, as it truly was',
          keys: [...driveKeys(), {name: 'least allowed', colour: UNDER_LIMIT, dash: '5 3'}],
          said: () => DRIVES
                          .map(({key, label}) =>
                                   `${label}: ${fixed(d3.min(known(key), p => p[3]), 3)} at least.`)
                          .join(' '),
          data: () => ({columns: ['x_m', 'y_m', 'way_m', 'margin'], rows: PLACES})
        },
        drawMargins)
        .node);

/// A table that scrolls by itself where the page is narrow.
const wideTable = (name, heads, rows) => element(
    'div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': name},
    table(null, heads, rows));
const columns = (...texts) => texts.map(text => ({text}));
const ends = {
  reached: 'goal, within every limit',
  limits_broken: 'goal, limits broken',
  not_reached: 'not reached'
};
const margin = (drive, which) => fixed(drive.margins_min[which], 3);
const brokenText = ({limit, worst, allowed}) =>
    `${words(limit)} ${significant(worst, 3)} (allowed ${significant(allowed, 3)})`;
const ROWS = [
  ['End', drive => ends[drive.status]],
  ['Limits broken', drive => drive.limits_broken.map(brokenText).join('; ') || 'none'],
  ['Smallest margin: cornering', drive => margin(drive, 'cornering')],
  ['tip-over', drive => margin(drive, 'tip_over')], ['traction', drive => margin(drive, 'traction')],
  ['Length', drive => fixed(drive.length_m, 1, 'm')], ['Time', drive => fixed(drive.duration_s, 1, 's')],
  ['Energy', drive => energy(drive.energy_j)]
];
byId('drives').append(wideTable(
    'The two drives', columns('', ...DRIVES.map(({label}) => label)),
    ROWS.map(([name, text]) => [name, ...DRIVES.map(({drive}) => text(drive))])));
if (!REPORT.second_drive)
  byId('drives').append(element(
      'p', {}, `Planned again: ${REPORT.second_plan.status}. ${REPORT.second_plan.reason}`));

const verdict = ({feasible, holds, why}) =>
    (!feasible ? `infeasible: ${why}` : holds ? 'feasible' : 'in doubt');
const share = ({probability_margins}) => percent(probability_margins);
byId('verdicts').append(
    wideTable(
        'The first plan\'s paths, judged again',
        columns(
            'path', 'as the map was known', 'draws that keep the margins', 'as the drive corrects it',
            'draws that keep the margins'),
        REPORT.verdicts.map(({candidate, flips, before, after}) => [
          `candidate ${candidate}`, verdict(before), share(before),
          flips ? element('strong', {class: 'alarm'}, verdict(after)) : verdict(after), share(after)
        ])));

const withUnit = key => {
  const {name, unit} = nameAndUnit(key);
  return unit ? `${name}, ${unit}` : name;
};
byId('soil').append(wideTable(
    'The hidden soil', columns('number', 'as the map says', 'hidden', 'as the drive tells it'),
    REPORT.hidden_patch.soil.map(({number, hidden, map, found}) => [
      withUnit(number), significant(map, 3), significant(hidden, 3),
      found ? withSpread(found) : 'not found'
    ])));

for (const [href, text] of [
       ['../report.html', 'the first plan'], ['drive.html', 'its drive'],
       ['diagnosis.html', 'the diagnosis'],
       ['again/report.html', 'the second plan'],
       ...(REPORT.second_drive ? [['again/drive/report.html', 'its drive']] : [])
     ])
  byId('pages').append(element('li', {}, element('a', {href}, text)));
document.documentElement.dataset.drawn = 'yes';
