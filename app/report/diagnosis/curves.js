// Measured runs and what the models say of them over slip, a panel for each slip angle. The
// corrected model is shown as it predicts runs that it was not fitted to.
function curves(host) {
  const channels = DIAGNOSIS.channels.filter(c => DIAGNOSIS.run_residuals[c].length);
  if (!channels.length) {
    host.append(element('p', {}, 'There are no runs to show.'));
    return;
  }
  const lines = HAS_CORRECTION ?
      `The corrected line predicts each run from a fit without its own family of conditions${
          DIAGNOSIS.held_out_by ? ` (held out by ${words(DIAGNOSIS.held_out_by)})` :
                                  ''}, with a band of two standard deviations. ` :
                                  '';
  host.append(element(
      'p', {class: 'note'},
      `Points are runs with one standard deviation of the noise. ${
          lines}Runs stand at the mean load of their condition, moved there by the slope of the model; lines join means over replicates, of each load by itself.`));
  host.append(
      element('div', {class: 'residual-legend'}, ...MODEL_KEYS.map(key => legendKey(key).node)));
  for (const channel of channels) {
    const panels = panelsOf(channel), row = element('div', {class: 'panels'});
    const {title, unit} = channelOf(channel);
    const y = valueDomain(channel);
    for (const rows of panels) row.append(curvePanel(channel, rows, y));
    host.append(element('h3', {}, title, element('span', {class: 'unit'}, ` ${unit}`)), row);
  }
}

const MODEL_KEYS =
    SHOWN_MODELS.map(({name, colour, dash}) => ({name, colour: cssVar(colour), dash}));

/// What a model says of a run on the panels: the corrected one where it had not seen it.
const shownValue = (row, key) =>
    (key === 'corrected' && isKnown(row.held_out) ? row.held_out : row[key]);

function valueDomain(channel) {
  const {scale} = channelOf(channel), values = [0];
  for (const row of DIAGNOSIS.run_residuals[channel]) {
    const noise = isKnown(row.noise) ? row.noise : 0;
    values.push(row.measured - noise, row.measured + noise);
    for (const {key} of SHOWN_MODELS) values.push(shownValue(row, key));
  }
  const [low, high] = d3.extent(values.filter(isKnown));
  return [low * scale, high > low ? high * scale : low * scale + 1];
}

/// The runs of a channel by slip angle and whatever else tells them apart.
const panelsOf = channel => grouped(
                                DIAGNOSIS.run_residuals[channel].filter(r => isKnown(r.measured)),
                                r => `${ANGLE_OF[r.run]}|${othersOf(r.run)}`)
                                .sort(
                                    (a, b) => ANGLE_OF[a[0].run] - ANGLE_OF[b[0].run] ||
                                        d3.ascending(othersOf(a[0].run), othersOf(b[0].run)));

function curvePanel(channel, rows, yDomain) {
  const first = rows[0].run, others = othersOf(first),
        {title: channelTitle, unit} = channelOf(channel);
  const title = `Slip angle ${degreesText(ANGLE_OF[first])}${others ? ', ' + others : ''}`;
  const rmse = key => Math.sqrt(d3.mean(rows, r => Math.pow(r.measured - shownValue(r, key), 2)));
  const errors =
      SHOWN_MODELS.map(m => `${m.name} ${withChannelUnit(channel, rmse(m.key))}`).join(', ');
  const columns = ['load_n', 'slip_ratio', 'slip_angle_deg'];
  return figure(
             {
               title,
               level: 4,
               name: () => `${channelTitle} over slip ratio, ${unit}, ${title.toLowerCase()}`,
               shared_keys: () => MODEL_KEYS,
               said: () => `${channelTitle} over slip ratio, ${
                   rows.length} runs; root mean square error: ${errors}.`,
               data: () => ({
                 columns: [
                   'run_id', ...columns, `measured_${channel}`, `noise_${channel}`,
                   ...SHOWN_MODELS.map(m => `${m.key}_${channel}`)
                 ],
                 rows: rows.map(
                     r =>
                         [RUNS.run_id[r.run], ...columns.map(c => RUNS[c][r.run]), r.measured,
                          r.noise, ...SHOWN_MODELS.map(m => shownValue(r, m.key))])
               })
             },
             (svg, width) => drawPanel(svg, width, channel, rows, yDomain))
      .node;
}

function drawPanel(svg, width, channel, rows, yDomain) {
  const loads =
      grouped(rows, r => LOAD_OF[r.run]).sort((a, b) => LOAD_OF[a[0].run] - LOAD_OF[b[0].run]);
  const box =
      chartBox(svg, width, 190, {left: 44, right: loads.length > 1 ? 44 : 12, top: 8, bottom: 32});
  const {scale} = channelOf(channel);
  const x = paddedScale(RUNS.slip_ratio, 0.2, [box.left, box.right]);
  const y = d3.scaleLinear().domain(yDomain).nice(4).range([box.bottom, box.top]);
  drawAxes(svg, box, {scale: x, title: 'slip ratio'}, {scale: y});

  for (const ofLoad of loads) drawModels(svg, ofLoad, scale, x, y);
  if (loads.length > 1) labelLoads(svg, box, loads, scale, x, y);
  drawMeasured(svg, rows, scale, x, y);
  return rows.map(
      r => ({
        x: x(RUNS.slip_ratio[r.run]),
        y: y(scale * r.measured),
        text: `${RUNS.run_id[r.run]}: slip ratio ${significant(RUNS.slip_ratio[r.run], 3)}, load ${
            significant(
                RUNS.load_n[r.run], 3)}\u00a0N, measured ${withChannelUnit(channel, r.measured)}; ${
            SHOWN_MODELS.map(m => `${m.name} ${inUnit(channel, shownValue(r, m.key))}`).join(', ')}`
      }));
}

/// What the models say of runs of one load, a line each.
function drawModels(svg, rows, scale, x, y) {
  const bySlip =
      grouped(rows, r => SLIP_OF[r.run]).sort((a, b) => SLIP_OF[a[0].run] - SLIP_OF[b[0].run]);
  const slip = group => x(SLIP_OF[group[0].run]);
  const mean = (group, of) => {
    const values = group.map(of).filter(isKnown);
    return values.length ? scale * d3.mean(values) : null;
  };
  const spread = group => mean(group, r => r.held_out_std) || 0;
  if (HAS_CORRECTION) {
    const middle = group => mean(group, r => shownValue(r, 'corrected'));
    svg.append('path')
        .attr('fill', 'var(--band)')
        .attr(
            'd',
            d3.area()
                .defined(group => middle(group) !== null)
                .x(slip)
                .y0(group => y(middle(group) - 2 * spread(group)))
                .y1(group => y(middle(group) + 2 * spread(group)))(bySlip));
  }
  for (const model of SHOWN_MODELS) {
    const value = group => mean(group, r => shownValue(r, model.key));
    const known = bySlip.filter(group => value(group) !== null);
    const line = d3.line().x(slip).y(group => y(value(group)));
    svg.append('path')
        .attr('class', 'line')
        .attr('stroke', `var(${model.colour})`)
        .attr('stroke-dasharray', model.dash)
        .attr(
            'd',
            known.length === 1 ? `M${slip(known[0]) - 8},${y(value(known[0]))}h16` : line(known));
  }
}

/// The load of each line beside its runs of the largest slip; labels that would overlap move apart.
function labelLoads(svg, box, loads, scale, x, y) {
  const apart_px = 12, middle_px = 4;
  const labels = loads
                     .map(rows => {
                       const last = d3.max(rows, r => SLIP_OF[r.run]);
                       const ends = rows.filter(r => SLIP_OF[r.run] === last);
                       return {
                         text: `${significant(LOAD_OF[rows[0].run], 2)}\u00a0N`,
                         x: x(last) + 6,
                         y: y(scale * d3.mean(ends, r => r.measured)) + middle_px
                       };
                     })
                     .sort((a, b) => b.y - a.y);
  let free_px = box.bottom;
  for (const label of labels) {
    label.y = Math.min(label.y, free_px);
    free_px = label.y - apart_px;
  }
  svg.append('g')
      .attr('class', 'axis')
      .selectAll('text')
      .data(labels)
      .join('text')
      .attr('x', l => l.x)
      .attr('y', l => l.y)
      .text(l => l.text);
}

function drawMeasured(svg, rows, scale, x, y) {
  const points = svg.append('g').selectAll('g').data(rows).join('g').attr(
      'transform', r => `translate(${x(RUNS.slip_ratio[r.run])},0)`);
  points.append('line')
      .attr('class', 'noise')
      .attr('y1', r => y(scale * (r.measured - (r.noise || 0))))
      .attr('y2', r => y(scale * (r.measured + (r.noise || 0))));
  points.append('circle')
      .attr('class', 'measured')
      .attr('r', 2.6)
      .attr('cy', r => y(scale * r.measured));
}
