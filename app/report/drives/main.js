// Draws the diagnosis of whole drives.
const number = value => (isKnown(value) ? significant(value, 3) : UNKNOWN);

/// The driven tracks, north up, one scale on both axes; zones that were found over them.
function drawTrack(svg, width) {
  const points = REPORT.track, zones = REPORT.zones || [];
  const [west, east] = d3.extent(points, p => p[0]);
  const [south, north] = d3.extent(points, p => p[1]);
  const inner = width - 70;
  const span_m = Math.max(east - west, 1e-9);
  const height = Math.min(560, Math.max(160, inner * (north - south) / span_m + 50));
  const box = chartBox(svg, width, height, {left: 56, right: 14, top: 20, bottom: 34});
  const per_m = Math.min(
      (box.right - box.left) / span_m, (box.bottom - box.top) / Math.max(north - south, 1e-9));
  const x = d3.scaleLinear([west, west + (box.right - box.left) / per_m], [box.left, box.right]);
  const y = d3.scaleLinear([south, south + (box.bottom - box.top) / per_m], [box.bottom, box.top]);
  drawAxes(svg, box, {scale: x, title: 'x, m'}, {scale: y, title: 'y, m'});
  for (const zone of zones)
    svg.append('path')
        .attr('d', d3.line()(zone.track.map(([px, py]) => [x(px), y(py)])))
        .attr('fill', 'none')
        .attr('stroke', UNDER_LIMIT)
        .attr('stroke-opacity', 0.5)
        .attr('stroke-width', 12);
  svg.append('g')
      .selectAll('circle')
      .data(points)
      .join('circle')
      .attr('cx', p => x(p[0]))
      .attr('cy', p => y(p[1]))
      .attr('r', 1.6)
      .attr('fill', p => soilColour(p[2]));
  return [];
}

if (REPORT.track.length)
  byId('track').append(
      figure(
          {
            title: 'Tracks of the drives',
            said: () => `${REPORT.track.length} places of ${REPORT.drives.length} drives.`,
            data: () => ({columns: ['x_m', 'y_m', 'drive'], rows: REPORT.track})
          },
          drawTrack)
          .node);

const columns = (...texts) => texts.map(text => ({text}));
byId('where').append(
    REPORT.where.length ?
        table(
            null, columns('quantity', 'where', 'measured - model', '95 %', 'p'),
            REPORT.where.map(at => [at.channel, at.where, number(at.effect),
                                    at.ci95.map(number).join(' to '), number(at.p_value)])) :
        'Nowhere beyond what chance gives.');
byId('claims').append(
    REPORT.mechanisms.length ?
        table(
            null, columns('name', 'these drives cannot tell it from', 'numbers'),
            REPORT.mechanisms.map(
                claim => [words(claim.id),
                          claim.equivalent.filter(id => id !== claim.id).map(words).join(', ') ||
                              UNKNOWN,
                          Object.entries(claim.parameters)
                              .map(([key, {value, std}]) => `${key} ${number(value)} \u00b1 ${
                                       number(std)}`)
                              .join('; ')])) :
        'Nothing is claimed.');
byId('fit').append(table(
    null, columns('quantity', 'before', 'after', 'held out'),
    Object.entries(REPORT.fit).map(([channel, fit]) => [channel, number(fit.baseline_rmse),
                                                        number(fit.corrected_rmse), fit.held_out])));
byId('findings').append(
    ...(REPORT.findings.length ?
            REPORT.findings.map(({drive, text}) => element('li', {}, drive ? `${drive}: ${text}` : text)) :
            [element('li', {}, 'Nothing.')]));
byId('silent').append(table(
    null, columns('effects', 'why', 'a drive that would show them'),
    REPORT.not_shown.map(({ids, why, next_drive}) => [ids.map(words).join(', '), why, next_drive])));
document.documentElement.dataset.drawn = 'yes';
