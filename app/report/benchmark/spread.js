// Spread of the verified runs of one experiment, a box for each planner.
const BOXES = [
  {key: 'time_s', title: 'Search time', unit: 's', log: true},
  {key: 'length_m', title: 'Path length', unit: 'm'},
  {key: 'margin_min', title: 'Smallest stability margin', unit: ''},
  {key: 'energy_j', title: 'Energy', unit: 'kJ', scale: 0.001},
];

function boxes(host) {
  const made = BOXES.map(boxFigure).filter(Boolean);
  host.replaceChildren(
      ...(made.length ? made : [element('p', {}, 'No run of this experiment was verified.')]));
}

function boxFigure({key, title, unit, log, scale = 1}) {
  const {experiment} = shown;
  const planners = experiment.planners.filter(p => values(p, key).length);
  if (!planners.length) return null;
  const numbers = planner => values(planner, key).map(v => v * scale).sort(d3.ascending);
  const said = planner =>
      `${planner.name}: median ${significant(d3.median(numbers(planner)), 3)}, quartiles ${
          significant(d3.quantile(numbers(planner), 0.25), 3)} to ${
          significant(d3.quantile(numbers(planner), 0.75), 3)}, ${numbers(planner).length} runs`;
  const spec = {
    title,
    unit,
    name: () => `${title}, ${experiment.name}`,
    said: () => `${title} by planner. ${planners.map(said).join('; ')}.`,
    data: () => ({
      columns: ['planner', 'seed', key],
      rows: planners.flatMap(
          p => verifiedRuns(p).filter(r => isKnown(r[key])).map(r => [p.name, r.seed, r[key]]))
    })
  };
  return figure(spec, (svg, width) => {
           const height = 42 + 34 * planners.length;
           let box = chartBox(svg, width, height, {left: 0, right: 22, top: 4, bottom: 24});
           const names = namesBeside(svg, planners.map(p => p.name), 0.4 * width);
           box = {...box, left: Math.max(104, names.width + 10)};
           let [low, high] = d3.extent(planners.flatMap(numbers));
           if (low === high) [low, high] = [low * 0.95 - 1e-6, high * 1.05 + 1e-6];
           const x = (log ? d3.scaleLog() : d3.scaleLinear()).domain([low, high]).range([
             box.left, box.right
           ]);
           if (!log) x.nice();
           const y = d3.scaleBand().domain(planners.map(p => p.name)).padding(0.35).range([
             box.top, box.bottom
           ]);
           const ticks = log ? decadeTicks(x.domain()) : x.ticks(tickCount(box));
           drawAxes(
               svg, box, {scale: x, values: ticks, format: v => significant(v, 3), grid: true},
               {scale: y, format: names.format});
           return planners.flatMap(planner => {
             const middle = y(planner.name) + y.bandwidth() / 2;
             drawBox(svg, x, y, planner, numbers(planner));
             return [
               {x: x(d3.median(numbers(planner))), y: middle, text: said(planner)},
               ...verifiedRuns(planner)
                   .filter(r => isKnown(r[key]))
                   .map(run => ({
                          x: x(run[key] * scale),
                          y: middle,
                          text: `${planner.name}, seed ${run.seed}: ${
                              significant(run[key] * scale, 3)}`
                        }))
             ];
           });
         }).node;
}

/// Quartiles as a box, the median as a line, every run as a dot.
function drawBox(svg, x, y, planner, sorted) {
  const middle = y(planner.name) + y.bandwidth() / 2, colour = plannerColour(planner.name);
  const [first, median, third] = [0.25, 0.5, 0.75].map(q => d3.quantile(sorted, q));
  const group = svg.append('g');
  group.append('line')
      .attr('x1', x(sorted[0]))
      .attr('x2', x(sorted[sorted.length - 1]))
      .attr('y1', middle)
      .attr('y2', middle)
      .attr('stroke', colour);
  group.append('rect')
      .attr('x', x(first))
      .attr('width', Math.max(1, x(third) - x(first)))
      .attr('y', y(planner.name))
      .attr('height', y.bandwidth())
      .attr('fill', colour)
      .attr('fill-opacity', 0.25)
      .attr('stroke', colour);
  group.append('line')
      .attr('x1', x(median))
      .attr('x2', x(median))
      .attr('y1', y(planner.name))
      .attr('y2', y(planner.name) + y.bandwidth())
      .attr('stroke', colour)
      .attr('stroke-width', 3);
  group.selectAll('circle')
      .data(sorted)
      .enter()
      .append('circle')
      .attr('cx', v => x(v))
      .attr('cy', middle)
      .attr('r', 1.8)
      .attr('fill', cssVar('--ink'))
      .attr('fill-opacity', 0.55);
}
