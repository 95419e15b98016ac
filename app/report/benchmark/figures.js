// Figures that a benchmark shares: a plot with axes, colours and dashes of planners, a legend.
const EXPERIMENTS = REPORT.experiments;
const PLANNERS = [...new Set(EXPERIMENTS.flatMap(e => e.planners.map(p => p.name)))];
// Okabe and Ito's colours, with a dash each so that colour alone never decides.
const PLANNER_COLOURS = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];
const PLANNER_DASHES = [null, '7 3', '2 2.5', '9 3 2 3', '12 4', '4 4'];
const plannerColour = name => PLANNER_COLOURS[PLANNERS.indexOf(name) % PLANNER_COLOURS.length];
const plannerDash = name => PLANNER_DASHES[PLANNERS.indexOf(name) % PLANNER_DASHES.length];

/// A figure with a title, a legend of planners and an SVG that `draw(svg, width)` fills.
function figure(host, title, description, planners, draw) {
  const caption = element('figcaption', {}, element('h3', {}, title));
  for (const name of planners) {
    const key = element('span', {class: 'key'});
    d3.select(key)
        .append('svg')
        .append('line')
        .attr('x2', 22)
        .attr('y1', 4)
        .attr('y2', 4)
        .attr('stroke', plannerColour(name))
        .attr('stroke-width', 2)
        .attr('stroke-dasharray', plannerDash(name));
    key.append(name);
    caption.append(key);
  }
  const holder = element('div');
  host.append(element('figure', {class: 'chart'}, caption, holder));
  onWidth(holder, width => {
    holder.replaceChildren();
    draw(
        d3.select(holder).append('svg').attr('role', 'img').attr('aria-label', description), width);
  });
}

const tickCount = width => Math.max(2, Math.min(7, Math.floor((width - 66) / 80)));

/// Axes of a plot; returns its inner box.
function axes(svg, width, height, x, y, labels) {
  const box = {left: 54, right: width - 12, top: 8, bottom: height - 38};
  svg.attr('viewBox', `0 0 ${width} ${height}`).attr('width', width).attr('height', height);
  x.range([box.left, box.right]);
  y.range([box.bottom, box.top]);
  const below = d3.axisBottom(x).tickSizeOuter(0);
  if (labels.x_ticks) below.tickValues(labels.x_ticks).tickFormat(labels.x_format);
  else below.ticks(tickCount(width), labels.x_format);
  svg.append('g')
      .attr('class', 'axis')
      .attr('transform', `translate(0,${box.bottom})`)
      .call(below);
  const beside = d3.axisLeft(y).tickSizeOuter(0);
  beside.ticks(5, labels.y_format);
  svg.append('g').attr('class', 'axis').attr('transform', `translate(${box.left},0)`).call(beside);
  svg.append('text')
      .attr('x', (box.left + box.right) / 2)
      .attr('y', height - 6)
      .attr('text-anchor', 'middle')
      .text(labels.x);
  svg.append('text')
      .attr('transform', `translate(13,${(box.top + box.bottom) / 2}) rotate(-90)`)
      .attr('text-anchor', 'middle')
      .text(labels.y);
  return box;
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
