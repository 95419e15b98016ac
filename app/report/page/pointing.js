// Pointing at the marks of a chart: what a mark says stands beside it, for the pointer and, with
// the chart in focus, for the arrow keys.
function pointing(holder, svg) {
  const tooltip = element('div', {class: 'tooltip', role: 'status', hidden: true});
  const node = svg.node();
  let marks = [], chosen = -1;
  holder.append(tooltip);

  function show(index) {
    chosen = index;
    svg.selectAll('.pointed').remove();
    tooltip.hidden = index < 0;
    if (index < 0) return;
    const mark = marks[index], width = holder.clientWidth, scale = width / widthOf();
    svg.append('circle')
        .attr('class', 'pointed')
        .attr('cx', mark.x)
        .attr('cy', mark.y)
        .attr('r', 6);
    tooltip.textContent = mark.text;
    const x = mark.x * scale, y = mark.y * scale;
    const left = x + 12 + tooltip.offsetWidth > width ? x - 12 - tooltip.offsetWidth : x + 12;
    tooltip.style.left = `${Math.max(0, left)}px`;
    tooltip.style.top = `${y + 10}px`;
  }

  const widthOf = () => Number(svg.attr('viewBox').split(' ')[2]);

  function nearest([x, y]) {
    const distance = mark => Math.hypot(mark.x - x, mark.y - y);
    const index = d3.scan(marks, (a, b) => distance(a) - distance(b));
    return index !== undefined && distance(marks[index]) < 22 ? index : -1;
  }

  svg.on('mousemove touchstart', () => {
    const index = marks.length ? nearest(d3.mouse(node)) : -1;
    if (index !== chosen) show(index);
  });
  svg.on('mouseleave blur', () => show(-1));
  svg.on('keydown', () => {
    const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[d3.event.key];
    if (d3.event.key === 'Escape') show(-1);
    if (!step || !marks.length) return;
    d3.event.preventDefault();
    show((Math.max(chosen, step > 0 ? -1 : 0) + step + marks.length) % marks.length);
  });

  /// Takes the marks [{x, y, text}] of a chart that was drawn anew.
  return drawn => {
    marks = drawn;
    show(-1);
    svg.attr('tabindex', marks.length ? 0 : null);
  };
}
