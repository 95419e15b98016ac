// What each path's margins are over the draws of the soils: dots with intervals on one axis.
const COURSES = REPORT.courses;
const SPREAD_STYLES = {
  cornering: {colour: '--series-1', shape: d3.symbolCircle},
  tip_over: {colour: '--series-2', shape: d3.symbolSquare},
  traction: {colour: '--series-3', shape: d3.symbolTriangle},
};
const spreadSymbol = (margin, area) => d3.symbol().type(SPREAD_STYLES[margin].shape).size(area)();

/// Both figures, row by row the same paths.
function spreads(host) {
  if (!COURSES.length) return;
  host.append(marginSpreads(), probabilities());
}

function marginSpreads() {
  const dots = course => course.spreads.map(
      spread => ({
        low: spread.p05,
        middle: spread.p50,
        high: spread.p95,
        at_mean: spread.at_mean,
        margin: spread.margin,
        text: `${course.name}, ${words(spread.margin)} margin: ` +
            (isKnown(spread.p50) ?
                 `${fixed(spread.p50, 3)}, from ${fixed(spread.p05, 3)} to ${
                     fixed(spread.p95, 3)} in 90 % of the draws; ${
                     fixed(spread.at_mean, 3)} at the mean soils` :
                 'none, not all of the path can be judged')
      }));
  return dotFigure({
    title: 'Smallest margins over the draws of the soils',
    limit: {value: REPORT.margin_min, text: 'limit'},
    keys: Object.entries(SPREAD_STYLES).map(([margin, style]) => ({
                                              name: words(margin),
                                              colour: cssVar(style.colour),
                                              symbol: spreadSymbol(margin, 50)
                                            })),
    note: 'Symbol: median. Line: 5 to 95 %. Upright stroke: at the mean soils.',
    dots,
    data: () => ({
      columns: ['path', 'margin', 'at_mean', 'p05', 'p50', 'p95'],
      rows: COURSES.flatMap(
          course =>
              course.spreads.map(s => [course.name, s.margin, s.at_mean, s.p05, s.p50, s.p95]))
    })
  });
}

const inPercent = share => (isKnown(share) ? 100 * share : null);

function probabilities() {
  const dots = ({name, probability: {share, low, high}}) => [{
    low: inPercent(low),
    middle: inPercent(share),
    high: inPercent(high),
    margin: 'cornering',
    text: isKnown(share) ?
        `${name}: the margins hold in ${percent(share, 1)} of the draws, 95 % interval ${
            fixed(100 * low, 1)} to ${percent(high, 1)}` :
        `${name}: nothing was drawn, not all of the path can be judged`
  }];
  return dotFigure({
    title: 'How likely the margins hold',
    unit: '%',
    domain: [0, 100],
    note: 'Dot: share of the draws. Line: its 95 % interval.',
    dots,
    data: () => ({
      columns: ['path', 'share', 'low', 'high'],
      rows: COURSES.map(c => [c.name, c.probability.share, c.probability.low, c.probability.high])
    })
  });
}

const DOT_ROW = 13;

/// A figure of `dots(course)` [{low, middle, high, at_mean, margin, text}], a row each, on one
/// axis.
function dotFigure({title, unit, limit, domain, keys, note, dots, data}) {
  const all = COURSES.flatMap(dots);
  const spec =
      {title, unit, level: 3, keys, said: () => `${all.map(d => d.text).join('; ')}.`, data};
  const made = figure(spec, (svg, width) => {
    const name_px = 18, block_px = name_px + DOT_ROW * dots(COURSES[0]).length + 8;
    const box = chartBox(
        svg, width, 30 + block_px * COURSES.length, {left: 12, right: 14, top: 4, bottom: 24});
    const x = dotScale(all, domain, limit).range([box.left, box.right]);
    const y = d3.scaleLinear().domain([0, COURSES.length]).range([box.top, box.bottom]);
    drawAxes(svg, box, {scale: x, grid: true}, {scale: y, values: [], grid: false});
    return COURSES.flatMap((course, k) => {
      const top = box.top + block_px * k;
      if (limit) drawDotLimit(svg, x(limit.value), top + name_px, top + block_px);
      svg.append('text')
          .attr('class', 'row-name')
          .attr('x', box.left)
          .attr('y', top + 13)
          .text(shortened(`${course.rank} ${course.name}`, (box.right - box.left) / 6.6));
      return dots(course).map(
          (dot, i) => drawDot(svg, x, top + name_px + DOT_ROW * (i + 0.5), dot));
    });
  });
  made.node.append(element('p', {class: 'note'}, note));
  return made.node;
}

function dotScale(all, domain, limit) {
  if (domain) return d3.scaleLinear().domain(domain);
  const values = all.flatMap(d => [d.low, d.high, d.at_mean]).filter(isKnown);
  return d3.scaleLinear().domain(d3.extent(values.concat(0, limit.value))).nice(6);
}

/// Beside the dots of one path, and not through its name.
function drawDotLimit(svg, x, top, bottom) {
  svg.append('line')
      .attr('class', 'limit')
      .attr('x1', x)
      .attr('x2', x)
      .attr('y1', top)
      .attr('y2', bottom);
}

/// Draws one interval with its middle; returns the mark that can be pointed at.
function drawDot(svg, x, y, {low, middle, high, at_mean, margin, text}) {
  const colour = cssVar(SPREAD_STYLES[margin].colour);
  const stroke = (x1, x2, y1, y2, width) => svg.append('line')
                                                .attr('x1', x1)
                                                .attr('x2', x2)
                                                .attr('y1', y1)
                                                .attr('y2', y2)
                                                .attr('stroke', colour)
                                                .attr('stroke-width', width);
  if (!isKnown(middle) && !isKnown(at_mean)) {
    svg.append('text').attr('x', x.range()[0]).attr('y', y + 4).text(UNKNOWN);
    return {x: x.range()[0], y, text};
  }
  if (isKnown(low) && isKnown(high)) stroke(x(low), x(high), y, y, 2);
  if (isKnown(at_mean)) stroke(x(at_mean), x(at_mean), y - 5.5, y + 5.5, 1.6);
  if (isKnown(middle))
    svg.append('path')
        .attr('d', spreadSymbol(margin, 46))
        .attr('fill', colour)
        .attr('stroke', cssVar('--paper'))
        .attr('transform', `translate(${x(middle)},${y})`);
  return {x: x(isKnown(middle) ? middle : at_mean), y, text};
}

/// Of text that does not fit into so many characters the end is left out.
const shortened = (text, length) =>
    (text.length > length ? `${text.slice(0, Math.max(1, Math.floor(length) - 1))}\u2026` : text);
