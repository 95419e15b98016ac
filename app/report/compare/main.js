// Draws two results of one kind side by side.
const SIDES = ['a', 'b'];
const DASH = {a: null, b: '6 4'};
/// What has no unit is a margin or a share: thousandths say enough.
const withUnit = (value, unit) =>
    (!isKnown(value) ? UNKNOWN :
         unit        ? `${significant(value)}\u00a0${unit}` :
                       fixed(value, 3));

/// A change with its sign, coloured by whether it is for the better; not where chance leaves that
/// open.
function changeNode(change, {unit, more_is_better}, tied) {
  if (!isKnown(change)) return UNKNOWN;
  if (change === 0) return 'the same';
  const good = (change > 0) === more_is_better;
  const text = (change > 0 ? '+' : '') + withUnit(change, unit);
  if (tied) return `${text} (tied within the ${REPORT.sampled})`;
  return element('span', {class: good ? 'good' : 'alarm'}, text);
}

/// A table for each entry: a row for each number, A, B and what changed.
function entryTables(host) {
  for (const entry of REPORT.entries) {
    const verdict = side => (entry[side] ? entry[side].verdict : 'not there');
    const rows = REPORT.metrics.map(metric => [
      capital(metric.words),
      ...SIDES.map(side => withUnit(entry[side] && entry[side][metric.key], metric.unit)),
      changeNode(
          entry.change && entry.change[metric.key], metric, entry.tied.includes(metric.key))
    ]);
    host.append(element(
        'div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': entry.name},
        table(
            entry.name,
            [
              {text: ''}, {text: 'A', number: true}, {text: 'B', number: true},
              {text: 'B less A', number: true}
            ],
            [['Verdict', verdict('a'), verdict('b'), ''], ...rows])));
  }
}

/// All paths of both results: {name, side, index, points: [[x_m, y_m, way_m, margin]]}.
const PATHS = REPORT.entries.flatMap(
    (entry, index) => SIDES.filter(side => entry.paths && entry.paths[side])
                          .map(side => ({name: entry.name, side, index, points: entry.paths[side]})));

const pathKeys = () => PATHS.map(({name, side, index}) => ({
  name: `${name}, ${side.toUpperCase()}`,
  colour: seriesColour(index),
  dash: DASH[side]
}));

function drawPath(svg, {index, side}, d) {
  svg.append('path')
      .attr('d', d)
      .attr('fill', 'none')
      .attr('stroke', seriesColour(index))
      .attr('stroke-width', 2)
      .attr('stroke-dasharray', DASH[side]);
}

/// North up, one scale on both axes.
function drawMap(svg, width) {
  const points = PATHS.flatMap(path => path.points);
  const extent = axis => d3.extent(points, p => p[axis]);
  const {box, x, y} = mapChart(svg, width, extent(0), extent(1), {around_m: 2, tight: true});
  drawAxes(svg, box, {scale: x, title: 'x, m'}, {scale: y, title: 'y, m'});
  for (const path of PATHS) drawPath(svg, path, d3.line()(path.points.map(p => [x(p[0]), y(p[1])])));
  return [];
}

const marginPoints = path => path.points.filter(p => isKnown(p[3]));

function drawMargins(svg, width) {
  const points = PATHS.flatMap(marginPoints);
  const box = chartBox(svg, width, 240, {left: 48, right: 14, top: 20, bottom: 34});
  const x = d3.scaleLinear([0, d3.max(points, p => p[2])], [box.left, box.right]);
  const y = paddedScale([0, ...points.map(p => p[3])], 0.1, [box.bottom, box.top]);
  drawAxes(svg, box, {scale: x, title: 'way, m'}, {scale: y});
  for (const path of PATHS)
    drawPath(svg, path, d3.line()(marginPoints(path).map(p => [x(p[2]), y(p[3])])));
  return [];
}

function pathFigures(host) {
  const rows = () => PATHS.flatMap(
      ({name, side, points}) => points.map(point => [name, side.toUpperCase(), ...point]));
  const data = () => ({columns: ['name', 'result', 'x_m', 'y_m', 'way_m', 'margin'], rows: rows()});
  const said = () => `${PATHS.length} paths of both results.`;
  host.append(figure({title: 'Paths', keys: pathKeys(), said, data}, drawMap).node);
  if (PATHS.some(path => marginPoints(path).length > 1))
    host.append(figure(
                    {title: 'Stability margin along the way', keys: pathKeys(), said, data},
                    drawMargins)
                    .node);
}

const told = value =>
    (value === null ? UNKNOWN : typeof value === 'number' ? significant(value, 8) : String(value));

entryTables(byId('entries'));
if (PATHS.length)
  pathFigures(byId('paths'));
else
  byId('paths-section').remove();
byId('asked').append(
    REPORT.settings.length ?
        element(
            'div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Settings'},
            table(
                null, [{text: 'Setting'}, {text: 'A', number: true}, {text: 'B', number: true}],
                REPORT.settings.map(({key, a, b}) => [key, told(a), told(b)]))) :
        element('p', {}, 'No setting.'));
byId('inputs').append(element(
    'p', {},
    REPORT.inputs.length ? `Files that are not the same: ${REPORT.inputs.join(', ')}.` :
                           'Every file that was read is the same.'));
document.documentElement.dataset.drawn = 'yes';
