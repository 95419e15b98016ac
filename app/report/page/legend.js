// Legends of charts: a sample of each line or area beside its name.
const cssVar = name => `var(${name})`;

/// Draws the sample of a key {colour, dash, width, area, symbol} into a 22 by 8 box of an SVG.
function drawSample(parent, key) {
  if (key.symbol)
    parent.append('path')
        .attr('d', key.symbol)
        .attr('stroke', '#5b6168')
        .attr('stroke-width', 0.8)
        .attr('fill', key.colour)
        .attr('transform', 'translate(11,4) scale(0.8)');
  else if (key.area)
    parent.append('rect').attr('width', 22).attr('height', 8).attr('fill', key.colour);
  else
    parent.append('line')
        .attr('x2', 22)
        .attr('y1', 4)
        .attr('y2', 4)
        .attr('stroke', key.colour)
        .attr('stroke-width', key.width || 2)
        .attr('stroke-dasharray', key.dash || null);
}

/// A key {name, colour, dash, area} as {node, value}; `value` takes what holds at a marker.
function legendKey(key) {
  const sample = d3.create('svg').attr('viewBox', '0 0 22 8').attr('aria-hidden', 'true');
  drawSample(sample, key);
  const value = element('b');
  return {node: element('span', {class: 'key'}, sample.node(), `${key.name} `, value), value};
}
