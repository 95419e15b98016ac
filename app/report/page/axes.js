// Axes of charts, drawn one way: a faint grid, the x axis with its title below at the right, the
// y axis without a line and its title above at the left.

/// A cleared and sized SVG, and the box in it that data may fill.
function chartBox(svg, width, height, margin) {
  svg.attr('viewBox', `0 0 ${width} ${height}`).attr('height', height).selectAll('*').remove();
  return {
    width,
    height,
    left: margin.left,
    right: width - margin.right,
    top: margin.top,
    bottom: height - margin.bottom
  };
}

/// How many ticks fit side by side.
const tickCount = (box, each_px = 85) =>
    Math.max(3, Math.min(10, Math.floor((box.right - box.left) / each_px)));

/// Draws the axes {scale, ticks: their number, values: the ticks, format, title, grid} into a box
/// that their scales fill.
function drawAxes(svg, box, x, y) {
  drawGrid(svg, box, x, y);
  const below =
      svg.append('g').attr('class', 'axis').attr('transform', `translate(0,${box.bottom})`);
  below.call(ticked(d3.axisBottom(x.scale), x, tickCount(box)).tickSize(4).tickSizeOuter(0));
  const beside =
      svg.append('g').attr('class', 'axis').attr('transform', `translate(${box.left},0)`);
  beside.call(ticked(d3.axisLeft(y.scale), y, 4).tickSize(0).tickPadding(6));
  beside.select('.domain').remove();
  if (x.title) axisTitle(svg, box.right, box.height - 4, x.title, 'end');
  if (y.title) axisTitle(svg, 4, 11, y.title, 'start');
}

function ticked(axis, {values, ticks, format}, usual) {
  if (values)
    axis.tickValues(values);
  else
    axis.ticks(ticks || usual, typeof format === 'string' ? format : undefined);
  return typeof format === 'function' ? axis.tickFormat(format) : axis;
}

function drawGrid(svg, box, x, y) {
  const places = axis => axis.values || axis.scale.ticks(axis.ticks || 4);
  const grid = svg.append('g').attr('class', 'grid');
  const line = (x1, x2, y1, y2) =>
      grid.append('line').attr('x1', x1).attr('x2', x2).attr('y1', y1).attr('y2', y2);
  if (y.grid !== false && y.scale.ticks)
    for (const v of places(y)) line(box.left, box.right, y.scale(v), y.scale(v));
  if (x.grid)
    for (const v of places({ticks: tickCount(box), ...x}))
      line(x.scale(v), x.scale(v), box.top, box.bottom);
}

function axisTitle(svg, x, y, text, anchor) {
  svg.append('g')
      .attr('class', 'axis')
      .append('text')
      .attr('x', x)
      .attr('y', y)
      .attr('text-anchor', anchor)
      .text(text);
}

/// A logarithmic scale's ticks at 1, 2 and 5 of each decade.
function decadeTicks([low, high]) {
  const ticks = [];
  for (let k = Math.floor(Math.log10(low)); k <= Math.ceil(Math.log10(high)); ++k)
    for (const m of [1, 2, 5]) {
      const value = m * 10 ** k;
      if (value >= low * 0.999 && value <= high * 1.001) ticks.push(value);
    }
  if (ticks.length < 3) return d3.ticks(low, high, 4);
  return ticks.length > 9 ? ticks.filter(v => /^1/.test(v.toExponential())) : ticks;
}

/// A linear scale that shows every value with room around it.
function paddedScale(values, least, range) {
  const [low, high] = d3.extent(values);
  const middle = (low + high) / 2, half = Math.max(high - low, least) / 2;
  return d3.scaleLinear().domain([middle - half * 1.12, middle + half * 1.12]).range(range);
}

/// Room for names beside an axis, and the names as they fit into it: what is wider loses its
/// middle, as the names of a family differ at their ends.
function namesBeside(svg, names, most_px) {
  const group = svg.append('g').attr('class', 'axis');
  const text = group.append('text');
  const width = name => text.text(name).node().getComputedTextLength();
  const fitted = name => {
    let kept = name.length, shown = name;
    while (kept > 4 && width(shown) > most_px) {
      --kept;
      shown = `${name.slice(0, Math.floor(kept / 2))}…${name.slice(-Math.ceil(kept / 2))}`;
    }
    return shown;
  };
  const shown = new Map(names.map(name => [name, fitted(name)]));
  const widest_px = Math.max(0, ...[...shown.values()].map(width));
  group.remove();
  return {width: Math.ceil(widest_px), format: name => shown.get(name)};
}
