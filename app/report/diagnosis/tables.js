// Findings as tables: where, what, soil numbers, fit, what to measure next.
const scrolled = (label, node) =>
    element('div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': label}, node);

const probability = p => !isKnown(p) ? UNKNOWN :
    p > 0 && p < 0.01                ? 'under 1\u00a0%' :
    p > 0.99                         ? 'over 99\u00a0%' :
                                       percent(p, 0);
const pValue = p => (isKnown(p) && p < 0.001 ? '< 0.001' : fixed(p, 3));

/// A number with its spread as a mark on a common axis; what it says stands in the table as text.
function intervalMark(value, low, high, from, to, limits = []) {
  const x = d3.scaleLinear().domain([from, to]).range([4, 136]).clamp(true);
  const svg = d3.create('svg')
                  .attr('class', 'interval')
                  .attr('viewBox', '0 0 140 16')
                  .attr('aria-hidden', 'true');
  svg.append('line').attr('class', 'zero').attr('x1', x(0)).attr('x2', x(0)).attr('y2', 16);
  for (const limit of limits)
    svg.append('line')
        .attr('class', 'limit')
        .attr('x1', x(limit))
        .attr('x2', x(limit))
        .attr('y2', 16);
  if (isKnown(low) && isKnown(high))
    svg.append('line')
        .attr('class', 'range')
        .attr('x1', x(low))
        .attr('x2', x(high))
        .attr('y1', 8)
        .attr('y2', 8);
  if (isKnown(value))
    svg.append('circle').attr('class', 'value').attr('r', 4).attr('cx', x(value)).attr('cy', 8);
  return svg.node();
}

/// What a gain or evidence of so many nats is.
const NATS =
    'A nat is the natural logarithm of odds: 1 makes them 2.7 times as high, 3 are 20 to 1.';

/// How a claim scored beside an unnamed remainder does against that remainder alone, and chance.
function overUnexplained({over_unexplained_nats: nats}) {
  if (nats === null) return '';
  return `, over a mismatch without a name: ${fixed(nats, 1)} nats, where one nameless mismatch in ` +
      `forty lets some name reach ${fixed(DIAGNOSIS.chance_nats, 1)}`;
}

/// What the mechanisms named in candidates are, each by the formula of its first form.
function namesExplained(ids) {
  const names = [...new Set(ids.flatMap(id => id.split('+')))].filter(n => DIAGNOSIS.formulas[n]);
  const entry = name => element(
      'li', {}, `${words(name)}: `, element('span', {class: 'formula'}, DIAGNOSIS.formulas[name]));
  return element(
      'details', {class: 'note'},
      element('summary', {}, 'What these names are, each in one of its forms'),
      element('ul', {}, ...names.sort().map(entry)));
}

/// What places are off, by `where_off`.
const HELD_AGAINST = {
  calibrated_model: 'model, the soil numbers calibrated',
  soil_beside_claim: 'model, its soil fitted beside what is claimed and that left out',
  reference: 'what it shares with the reference',
};

function whereTable(host) {
  if (!DIAGNOSIS.where.length) {
    host.append(element('p', {}, 'Nowhere beyond what noise explains.'));
    return;
  }
  const widest = {};
  for (const {channel, effect, ci95} of DIAGNOSIS.where)
    widest[channel] =
        Math.max(widest[channel] || 0, ...[effect, ...ci95].filter(isKnown).map(Math.abs));
  const rows = DIAGNOSIS.where.map(({channel, region, effect, ci95, p_value}) => {
    const most = widest[channel] || 1;
    return [
      channelOf(channel).title, element('span', {class: 'region'}, regionText(region)),
      withChannelUnit(channel, effect),
      `${inUnit(channel, ci95[0])} to ${inUnit(channel, ci95[1])}`,
      intervalMark(effect, ci95[0], ci95[1], -most, most), pValue(p_value)
    ];
  });
  host.append(
      element(
          'p', {class: 'note'},
          `Measured minus ${HELD_AGAINST[DIAGNOSIS.where_off]}; strongest first. P-values are corrected for the number of places looked at.`),
      scrolled(
          'Table of places where model and recording differ',
          table(
              null,
              [
                {text: 'Channel'}, {text: 'Where'}, {text: 'Effect', number: true},
                {text: '95 % interval', number: true}, {text: 'Below \u2190 0 \u2192 above'},
                {text: 'p', number: true}
              ],
              rows)));
}

function claimList(host) {
  if (!DIAGNOSIS.mechanisms.length) {
    const none = {
      consistent: 'Nothing is claimed: the model is consistent with the recording.',
      parameters: 'No mechanism is claimed: soil numbers explain the recording.',
      unexplained:
          'No name is claimed. The corrected model carries the mismatch as an unnamed correction that is silent outside the conditions of this recording.',
    };
    host.append(element('p', {}, none[DIAGNOSIS.verdict] || 'Nothing is claimed.'));
    return;
  }
  for (const claim of DIAGNOSIS.mechanisms) {
    const form = DIAGNOSIS.forms.find(f => f.id === claim.id);
    const parameters = Object.entries(claim.parameters)
                           .map(([key, {value, std}]) => {
                             const {name, unit} = nameAndUnit(key);
                             return `${name} = ${withSpread({mean: value, std})}${
                                 unit ? '\u00a0' + unit : ''}`;
                           })
                           .join('; ');
    host.append(element(
        'div', {class: 'panel claim'},
        element(
            'h3', {}, [claim.id, ...claim.equivalent].map(idText).join(' or '),
            element('span', {class: 'unit'}, ` ${probability(claim.probability)}`)),
        form ? element(
                   'p', {}, element('span', {class: 'formula'}, form.formula),
                   element('span', {class: 'note'}, ` (${form.source})`)) :
               null,
        parameters ? element('p', {}, parameters) : null,
        element(
            'p', {class: 'note'},
            `Shows in ${
                claim.channels.map(c => channelOf(c).title).join(', ') ||
                UNKNOWN}; evidence over the best score without it: ${
                fixed(claim.evidence_nats, 1)} nats${overUnexplained(claim)}. ${NATS}${
                claim.equivalent.length ? ' These data cannot tell the names above apart.' :
                                          ''}`)));
  }
}

function candidateTable(host) {
  const SHOWN = 12, ranking = DIAGNOSIS.ranking;
  if (!ranking.length) return;
  const claimed = new Set([].concat(...DIAGNOSIS.mechanisms.map(m => [m.id, ...m.equivalent])));
  const most = d3.max(ranking, c => c.probability) || 1;
  const rows = ranking.slice(0, SHOWN).map(({id, probability: p}) => {
    const bar = element('div', {class: 'bar'});
    bar.style.width = `${100 * p / most}%`;
    bar.style.background = 'var(--series-1)';
    return element(
        'tr', {},
        element(
            'th', {scope: 'row'}, idText(id),
            claimed.has(id) ? element('span', {class: 'note'}, ' alone (claimed)') : null),
        element('td', {class: 'bar-cell'}, bar), element('td', {class: 'number'}, probability(p)));
  });
  const rest = ranking.slice(SHOWN);
  const head = element(
      'thead', {class: 'visually-hidden'},
      element(
          'tr', {},
          ...['Candidate', 'Bar', 'Probability'].map(t => element('th', {scope: 'col'}, t))));
  host.append(scrolled(
      'Table of candidates',
      element(
          'table', {class: 'bars wide-bars'},
          element(
              'caption', {},
              `Every candidate that was scored, each as the whole of what is missing, most probable first; a claim has the probabilities of all that hold its name${
                  rest.length ?
                      `; ${rest.length} others have ${
                          probability(d3.sum(rest, c => c.probability))} together` :
                      ''}. "none" is the model at the prior means, "parameters" the model with fitted soil numbers.`),
          head, element('tbody', {}, ...rows))));
  host.append(namesExplained(ranking.slice(0, SHOWN).map(c => c.id)));
}

function soilTable(host) {
  const entries = Object.entries(DIAGNOSIS.soil);
  if (!entries.length) {
    host.append(element('p', {}, 'No soil number was fitted.'));
    return;
  }
  const PULL_LIMIT = 4.5;
  const pull = value => element(
      'span', {class: Math.abs(value) > PULL_LIMIT ? 'alarm together' : 'together'},
      intervalMark(value, null, null, -6, 6, [-PULL_LIMIT, PULL_LIMIT]),
      ` ${fixed(value, 1)}${Math.abs(value) > PULL_LIMIT ? ' (beyond)' : ''}`);
  const rows = entries.map(([key, s]) => {
    const {name, unit} = nameAndUnit(key);
    const row =
        [name + (unit ? ` (${unit})` : ''), withSpread(s.prior), withSpread(s.calibrated), pull(s.pull)];
    return HAS_CORRECTION ? [...row, withSpread(s.corrected), pull(s.corrected_pull)] : row;
  });
  const columns = [
    {text: 'Number'}, {text: 'Prior', number: true}, {text: 'Calibrated', number: true},
    {text: 'Pull', number: true}
  ];
  if (HAS_CORRECTION)
    columns.push({text: 'With the correction', number: true}, {text: 'Pull', number: true});
  host.append(
      scrolled('Table of soil numbers', table(null, columns, rows)),
      element(
          'p', {class: 'note'},
          'Pull: shift from the prior mean in prior standard deviations; dashed lines at 4.5, beyond which a fit hides missing physics.'));
}

/// The models of the fit's columns: of a difference the names alone, of one recording the
/// correction as it is handed on.
function fitColumns() {
  return DIAGNOSIS.references.length ? ['Prior means', 'What both share', 'With the names'] :
                                       ['Prior means', 'Calibrated', 'Corrected'];
}

/// How much of the misfit on held-out conditions is explained; of a difference the names' share.
function explainedWords() {
  if (!DIAGNOSIS.excess_is_clear)
    return 'On held-out conditions the misfit is not clear of noise: no share of it can be told.';
  const share = percent(DIAGNOSIS.share_explained);
  if (!DIAGNOSIS.references.length)
    return `Share of the excess misfit that the correction explains: ${share}.`;
  return DIAGNOSIS.mechanisms.length ?
      `Share of the difference above noise that the names explain: ${share}.` :
      'No name is claimed of the difference: what the corrected model predicts is told at the top.';
}

function fitTable(host) {
  const entries = Object.entries(DIAGNOSIS.fit);
  if (entries.length) {
    const times = (rmse, floor) =>
        isKnown(rmse) && floor > 0 ? ` (${fixed(rmse / floor, 1)}\u00d7)` : '';
    const rows = entries.map(([channel, f]) => {
      const {title, unit} = channelOf(channel);
      const cell = rmse => inUnit(channel, rmse) + times(rmse, f.noise_floor);
      return [
        `${title} (${unit})`, inUnit(channel, f.noise_floor), cell(f.baseline_rmse),
        cell(f.calibrated_rmse), cell(f.corrected_rmse)
      ];
    });
    host.append(scrolled(
        'Table of fit',
        table(
            `Root mean square error on conditions held out of the fit${
                DIAGNOSIS.held_out_by ? ` by ${words(DIAGNOSIS.held_out_by)}` :
                                        ''}; in brackets over the noise of replicates`,
            [
              {text: 'Channel'}, {text: 'Noise', number: true},
              ...fitColumns().map(text => ({text, number: true}))
            ],
            rows)));
  }
  const {before, after} = DIAGNOSIS.lack_of_fit;
  const lack = (name, l) =>
      [name, fixed(l.f, 2), fixed(l.critical, 2), pValue(l.p_value),
       `${integer(l.degrees_of_freedom)}, ${integer(l.pure_error_degrees_of_freedom)}`];
  host.append(scrolled(
      'Table of lack of fit',
      table(
          'Lack of fit against the scatter of replicates',
          [
            {text: ''}, {text: 'F', number: true}, {text: 'Critical', number: true},
            {text: 'p', number: true}, {text: 'Degrees of freedom', number: true}
          ],
          [lack('Before', before), lack('After', after)])));
  if (HAS_CORRECTION) host.append(element('p', {class: 'note'}, explainedWords()));
}

/// What comparing recordings would decide, where something was found that it may.
function furtherRecordings() {
  const {verdict, references, mechanisms} = DIAGNOSIS;
  const said = [];
  if (['partly', 'class', 'unexplained'].includes(verdict) && !references.length)
    said.push(
        'A reference (same rig and soil, without the effect that is looked for) would tell what this test adds from what the base model lacks anyway: with --reference only the difference is explained.');
  const by_time = ['cohesion_drift', 'soil_change', 'soil_zone', 'multi_pass'];
  const courses = /^(settling|drifting|for_a_time)/;
  const in_question = mechanisms.flatMap(
      m => [m.id, ...m.equivalent].filter(id => courses.test(m.form) || by_time.includes(id)));
  if (in_question.length)
    said.push(
        `A repeat of the same conditions at another time, in another order, would tell ${
            in_question.map(idText).join(' and ')} from physics of slip, slip angle and load.`);
  return said;
}

function nextTable(host, section) {
  const further = furtherRecordings();
  host.append(...further.map(text => element('p', {}, text)));
  if (!DIAGNOSIS.next_experiment.length) {
    section.hidden = !further.length;
    return;
  }
  const rows = DIAGNOSIS.next_experiment.map((e, k) => {
    const exact = {};
    for (const [column, value] of Object.entries(e.conditions)) exact[column] = [value, value];
    const sensor =
        e.further_sensor ? `measure ${channelOf(e.further_sensor).title.toLowerCase()}` : '';
    const conditions = Object.keys(exact).length ? regionText(exact) : '';
    return [
      String(k + 1),
      element(
          'span', {class: 'region'}, [sensor, conditions].filter(Boolean).join(' at ') || UNKNOWN),
      e.separates.map(idText).join(', '), fixed(e.expected_gain_nats, 2, 'nats')
    ];
  });
  host.append(scrolled(
      'Table of next experiments',
      table(
          `What would tell the remaining candidates apart, best first. ${NATS}`,
          [
            {text: ''}, {text: 'Experiment'}, {text: 'Separates'},
            {text: 'Expected gain', number: true}
          ],
          rows)));
}

function detectableTable(host, section) {
  const entries = Object.entries(DIAGNOSIS.smallest_detectable);
  if (!entries.length) {
    section.hidden = true;
    return;
  }
  const rows = entries.map(([id, d]) => {
    const {name, unit} = nameAndUnit(d.parameter);
    const of = value => significant(value, 2) + (unit ? '\u00a0' + unit : '');
    const smallest = d.value === null ? 'none of a usual size' : of(d.value);
    return [words(id), name, smallest, `${of(d.usual_range[0])} to ${of(d.usual_range[1])}`];
  });
  host.append(scrolled(
      'Table of smallest detectable effects',
      table(
          'The smallest amplitude of each mechanism that these data would have shown in 80 % of cases',
          [
            {text: 'Mechanism'}, {text: 'Parameter'}, {text: 'Smallest shown', number: true},
            {text: 'Usual range', number: true}
          ],
          rows)));
}
