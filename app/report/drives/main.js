// Draws the diagnosis of whole drives.
const number = value => (isKnown(value) ? significant(value, 3) : UNKNOWN);

const TRACK_POINTS = REPORT.tracks.flatMap(track => track.points.map(p => [...p, track.drive]));
const EXTENTS = [0, 1].map(axis => d3.extent(TRACK_POINTS, p => p[axis]));

const SOILS_DIFFER = REPORT.map.soils.length > 1;

/// The driven tracks over the map, zones that were found below them.
function drawTracks(svg, width) {
  const chart = mapChart(svg, width, ...EXTENTS, {around_m: 20, tight: true}), {box, x, y} = chart;
  drawGround(svg, chart, REPORT.map, {soils: SOILS_DIFFER});
  drawAxes(svg, box, {scale: x, title: 'x, m'}, {scale: y, title: 'y, m', grid: false});
  const line = d3.line().x(p => x(p[0])).y(p => y(p[1]));
  for (const zone of REPORT.zones)
    svg.append('path')
        .attr('d', line(zone.track))
        .attr('fill', 'none')
        .attr('stroke', UNDER_LIMIT)
        .attr('stroke-opacity', 0.6)
        .attr('stroke-width', 14);
  // Round ends: a drive of a single window is a dot.
  const lineOf = track =>
      svg.append('path').attr('stroke-linecap', 'round').attr('d', line(track.points));
  for (const track of REPORT.tracks) {
    lineOf(track).attr('class', 'line path-casing');
    lineOf(track).attr('class', 'line').attr('stroke', seriesColour(track.drive));
  }
  return TRACK_POINTS.map(([x_m, y_m, drive]) => ({
                            x: x(x_m),
                            y: y(y_m),
                            text: `${REPORT.drives[drive].drive_id}: ${fixed(x_m, 1)}, ${
                                fixed(y_m, 1, 'm')}`
                          }));
}

const MOST_NAMED = 8;
const trackKeys = () => [
  ...(REPORT.zones.length ? [{name: 'zone of other soil', colour: UNDER_LIMIT, area: true}] : []),
  ...(REPORT.drives.length <= MOST_NAMED ?
          REPORT.drives.map(({drive_id}, k) => ({name: drive_id, colour: seriesColour(k)})) :
          []),
  ...(SOILS_DIFFER ? soilKeys(REPORT.map) : [])
];

if (TRACK_POINTS.length)
  byId('track').append(
      figure(
          {
            title: 'Tracks of the drives',
            keys: trackKeys(),
            said: () => `${TRACK_POINTS.length} places of ${REPORT.drives.length} drives.`,
            data: () => ({columns: ['x_m', 'y_m', 'drive'], rows: TRACK_POINTS})
          },
          drawTracks)
          .node);

const COMPARED = REPORT.verdict !== 'undecided';
const columns = (...texts) => texts.map(text => ({text}));

/// A table that scrolls by itself where the page is narrow.
const wideTable = (name, heads, rows) => element(
    'div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': name},
    table(null, heads, rows));
const withUnit = key => {
  const {name, unit} = nameAndUnit(key);
  return unit ? `${name}, ${unit}` : name;
};

/// A zone's soil is told by what a wheel takes to roll there more than on the map's soil.
const quantityText = channel =>
    channel === 'soil' ? 'soil: rolling resistance, share of the load' : withUnit(channel);

/// A vehicle's fault is no place: it acts wherever is driven.
const nowhereText = () => {
  if (REPORT.findings.some(({id}) => id === 'drives_differ'))
    return 'Not the same in every drive: what was found in the recordings says in which.';
  if (REPORT.findings.some(({id}) => id === 'no_name'))
    return 'At no one place: what stands out has no name.';
  if (REPORT.findings.some(({id}) => id === 'map_slopes'))
    return 'All along: the slopes of the ground are not those of the map.';
  if (!COMPARED) return 'Nothing could be compared.';
  return REPORT.mechanisms.length ? 'At no one place: what is claimed acts all along.' :
                                    'Nowhere beyond what chance gives.';
};

byId('where').append(
    REPORT.where.length ?
        wideTable(
            'Where model and drives differ',
            columns('quantity', 'where', 'measured - model', '95 %', 'p'),
            REPORT.where.map(at => [quantityText(at.channel), at.where, number(at.effect),
                                    at.ci95.map(number).join(' to '), number(at.p_value)])) :
        nowhereText());
if (REPORT.where.length)
  byId('where').append(element(
      'p', {class: 'note'},
      'p: how often chance alone would show as much anywhere on such drives, by all that is compared together. ' +
          'The number told is one of several that may differ there, and may be uncertain by itself.'));
const parameterText = ([key, {value, std}]) =>
    `${withUnit(key)} ${withSpread({mean: value, std})}`;
byId('claims').append(
    REPORT.mechanisms.length ?
        wideTable(
            'What it may be', columns('name', 'these drives cannot tell it from', 'numbers'),
            REPORT.mechanisms.map(
                claim => [words(claim.id),
                          claim.equivalent.filter(id => id !== claim.id).map(words).join(', ') ||
                              UNKNOWN,
                          Object.entries(claim.parameters).map(parameterText).join('; ')])) :
        'Nothing is claimed.');
const differs = (a, b) => a.mean !== b.mean || a.std !== b.std;
/// Numbers of a zone's soil that the drives tell otherwise than the map.
const zoneTable = ({drive, map_soil, starts_s, ends_s, soil, soil_of_map}) => {
  const of = `${drive}, ${fixed(starts_s, 1)} to ${fixed(ends_s, 1, 's')}`;
  return element(
      'div', {}, element('h3', {}, of),
      wideTable(
          `Soil of the zone of ${of}`,
          columns('number', `the map's ${words(map_soil)}`, 'the drives'),
          Object.keys(soil)
              .filter(key => differs(soil[key], soil_of_map[key]))
              .map(key => [withUnit(key), withSpread(soil_of_map[key]), withSpread(soil[key])])));
};
/// Numbers of a soil of the map that the drives tell otherwise, all along.
const soilTable = ([name, {map, drives, withheld}]) => element(
    'div', {}, element('h3', {}, words(name)),
    element('p', {class: 'note'}, `corrected-map/ has what ${withheld ? 'the map has' : 'the drives tell'}.`),
    wideTable(
        `${words(name)}, as the map has it and as the drives tell it`,
        columns('number', 'the map', 'the drives'),
        Object.keys(map)
            .filter(key => differs(map[key], drives[key]))
            .map(key => [withUnit(key), withSpread(map[key]), withSpread(drives[key])])));
const soilsTold = Object.entries(REPORT.soils || {});
if (soilsTold.length) {
  byId('soils-section').hidden = false;
  byId('soils').append(
      element('p', {class: 'note'}, 'By the windows that no zone touches, fitted along with all else.'),
      ...soilsTold.map(soilTable));
}
const isCompared = REPORT.soils !== undefined;
const zonesText = isCompared ? 'No zone of other soil.' : 'Not looked for: no vehicle was compared with its map.';
byId('zones').append(...(REPORT.zones.length ? REPORT.zones.map(zoneTable) : [zonesText]));
if (REPORT.zones.length)
  byId('zones').append(element(
      'p', {class: 'note'},
      '\u00b1: one standard deviation, as far as soils differ where the drives tell nothing: they tell most of ' +
          'bearing and strength. The numbers vary together, which is not shown. All others stay as the map has them.'));
const isJudged = isCompared && REPORT.verdict !== 'undecided';
const verdict = why => why || 'may be driven';
byId('verdicts').append(
    REPORT.verdicts.length ?
        wideTable(
            'Verdicts that flip', columns('drive', 'from, s', 'to, s', 'at', 'as it was known', 'as it is corrected'),
            REPORT.verdicts.map(
                flip => [flip.drive, fixed(flip.starts_s, 1), fixed(flip.ends_s, 1), place(flip.x_m, flip.y_m),
                         verdict(flip.before), verdict(flip.after)])) :
        isJudged            ? 'None: what was driven is judged as before.' :
                              'Not judged: there is no corrected map.');
if (isJudged)
  byId('verdicts').append(element(
      'p', {class: 'note'},
      'Each window is judged by its means: what lasts less than a window only evaluate tells.'));
const fits = Object.entries(REPORT.fit);
byId('fit').append(
    fits.length ? wideTable(
                      'Fit', columns('quantity', 'noise', 'before', 'after', 'held out'),
                      fits.map(([channel, fit]) => [withUnit(channel), number(fit.noise_floor),
                                                    number(fit.baseline_rmse),
                                                    number(fit.corrected_rmse),
                                                    fit.held_out || 'nothing'])) :
                  'Nothing was fitted.');
if (REPORT.windows_used) {
  const {compared, left_out, columns_missing} = REPORT.windows_used;
  const reasons = Object.entries(left_out)
                      .filter(([, count]) => count)
                      .map(([reason, count]) => `${count} ${words(reason)}`);
  byId('fit').append(element(
      'p', {},
      `${compared} of ${REPORT.windows} windows are compared with the vehicle's model` +
          (reasons.length ? `; left out: ${reasons.join(', ')}.` : '.')));
  const missing = Object.entries(columns_missing);
  if (missing.length)
    byId('fit').append(element(
        'p', {},
        `Windows in which a column has no value: ${
            missing.map(([column, count]) => `${column} ${count}`).join(', ')}.`));
}
if (REPORT.residuals.length) {
  byId('residuals-section').hidden = false;
  residualsAlongTheWay(byId('residuals'));
}
byId('findings').append(
    ...(REPORT.findings.length ?
            REPORT.findings.map(({drive, text}) => element('li', {}, drive ? `${drive}: ${text}` : text)) :
            [element('li', {}, 'Nothing.')]));
byId('silent').append(wideTable(
    'What these drives cannot show', columns('effects', 'why', 'a drive that would show them'),
    REPORT.not_shown.map(({ids, why, next_drive}) => [ids.map(words).join(', '), why, next_drive])));
document.documentElement.dataset.drawn = 'yes';
