// What was rejected: a shape and colour for each reason, counts as bars, why one state was
// rejected, and the what-ifs of the best candidate.
const SYMBOLS = [
  d3.symbolCircle, d3.symbolSquare, d3.symbolDiamond, d3.symbolTriangle, d3.symbolCross,
  d3.symbolStar, d3.symbolWye
];
const REASONS = {
  bounds: {symbol: 0, colour: '#8a8f94', found: null},
  speed: {symbol: 3, colour: '#8a8f94', found: 'speed', show: v => fixed(v, 3, 'm/s')},
  unknown_terrain: {symbol: 1, colour: '#8a8f94', found: null},
  obstacle: {symbol: 2, colour: '#5b3a1e', found: null},
  slope: {symbol: 3, colour: '#e69f00', found: 'slope', show: v => fixed(v, 1, '\u00b0')},
  sinkage: {symbol: 0, colour: '#cc79a7', found: 'sinkage', show: millimetres},
  slip: {symbol: 1, colour: '#0072b2', found: 'slip ratio', show: v => fixed(v, 3)},
  slip_angle: {symbol: 2, colour: '#56b4e9', found: 'slip angle', show: v => fixed(v, 1, '\u00b0')},
  traction: {
    symbol: 4,
    colour: '#009e73',
    found: 'traction margin',
    show: v => fixed(v, 3),
    margin: true
  },
  tip_over: {
    symbol: 6,
    colour: '#f0e442',
    found: 'tip-over margin',
    show: v => fixed(v, 3),
    margin: true
  },
  cornering: {
    symbol: 5,
    colour: '#d55e00',
    found: 'cornering margin',
    show: v => fixed(v, 3),
    margin: true
  },
};
const REASON_TEXT = {
  bounds: 'outside the map',
  speed: 'the vehicle moves faster than allowed',
  unknown_terrain: 'the ground or its soil is not known',
  obstacle: 'the body would touch a rock or the terrain',
  slope: 'the ground is steeper than allowed',
  sinkage: 'a wheel sinks deeper than allowed',
  slip: 'a wheel slips more than allowed',
  slip_angle: 'a wheel drifts at a larger angle than allowed',
  traction: 'the soil does not carry the drive force',
  tip_over: 'the resultant comes too close to a support edge',
  cornering: 'the cornering force falls below the centrifugal demand',
};
const reasonStyle = reason => REASONS[reason] || {symbol: 0, colour: '#888888', found: null};
const symbolPath = (reason, area) =>
    d3.symbol().type(SYMBOLS[reasonStyle(reason).symbol]).size(area)();

function reasonSymbol(reason) {
  const svg = d3.create('svg')
                  .attr('class', 'symbol')
                  .attr('width', 14)
                  .attr('height', 14)
                  .attr('viewBox', '-7 -7 14 14')
                  .attr('aria-hidden', 'true');
  svg.append('path')
      .attr('d', symbolPath(reason, 55))
      .attr('fill', reasonStyle(reason).colour)
      .attr('stroke', '#0008');
  return svg.node();
}

function rejectionBars(host) {
  const total = d3.sum(PLAN.rejected, r => r.count), most = d3.max(PLAN.rejected, r => r.count);
  if (!total) {
    // A certificate needs no search.
    if (PLAN.certificate)
      host.closest('section').hidden = true;
    else
      host.append(element('p', {}, 'The search rejected nothing.'));
    return;
  }
  const rows = PLAN.rejected.map(({reason, count}) => {
    const bar = element('div', {class: 'bar'});
    bar.style.width = `${100 * count / most}%`;
    bar.style.background = reasonStyle(reason).colour;
    if (!count) bar.style.visibility = 'hidden';
    return element(
        'tr', {title: capital(REASON_TEXT[reason] || '')},
        element('th', {scope: 'row'}, words(reason)), element('td', {class: 'bar-cell'}, bar),
        element('td', {class: 'number'}, integer(count)),
        element(
            'td', {class: 'number'},
            percent(count / total, count && count / total < 0.01 ? 1 : 0)));
  });
  const head = element(
      'thead', {class: 'visually-hidden'},
      element(
          'tr', {},
          ...['Reason', 'Bar', 'States', 'Share'].map(t => element('th', {scope: 'col'}, t))));
  host.append(element(
      'table', {class: 'bars'},
      element(
          'caption', {},
          `${integer(total)} states, each counted under the first reason in this order. ${
              integer(
                  PLAN.rejected_states.length)} of them, evenly drawn, can be shown on the map.`),
      head, element('tbody', {}, ...rows)));
}

/// Why one state was rejected, as paragraphs.
function rejectionDetail(state) {
  const style = reasonStyle(state.reason);
  const first = element(
      'p', {}, element('b', {}, `${view.said.rejected} ${words(state.reason)}`),
      `: ${REASON_TEXT[state.reason] || ''}.`);
  const numbers = style.found && isKnown(state.value) ?
      element(
          'p', {},
          `${capital(style.found)} ${style.show(state.value)}; ${
              style.margin ? 'at least' : 'at most'} ${style.show(state.limit)} allowed.`) :
      null;
  const radius = isKnown(state.curvature_1pm) && Math.abs(state.curvature_1pm) > 1e-4 ?
      `turning ${state.curvature_1pm > 0 ? 'left' : 'right'} on ${
          fixed(1 / Math.abs(state.curvature_1pm), 1, 'm')}` :
      'straight on';
  return [
    first, numbers,
    element(
        'p', {class: 'note'},
        `${place(state.x_m, state.y_m)}; ${fixed(state.speed_mps, 2, 'm/s')}, ${radius}, heading ${
            fixed(state.yaw_deg, 0, '\u00b0')}.`)
  ].filter(Boolean);
}

function whatIfTable(host) {
  if (!PLAN.what_ifs.length) {
    // Without a path there is nothing to vary.
    if (PLAN.candidates.length)
      host.append(element('p', {}, 'No what-ifs were asked.'));
    else
      host.closest('section').hidden = true;
    return;
  }
  const rows = PLAN.what_ifs.map((w, k) => {
    const answer = w.feasible ?
        element(
            'span', {class: 'good'},
            'feasible' +
                (isKnown(w.probability) ? `, in ${fixed(100 * w.probability, 0)} % of the draws` :
                                          '')) :
        element(
            'span', {class: 'alarm'}, w.reason ? `rejected for ${words(w.reason)}` : 'rejected');
    const go = element(
        'button', {type: 'button', title: 'Show on the map'},
        `${fixed(w.x_m, 1)}, ${fixed(w.y_m, 1, 'm')}`);
    go.addEventListener('click', () => view.events.call('goto', null, w));
    const where = w.feasible ?
        UNKNOWN :
        element('span', {class: 'together'}, go, ` ${fixed(w.time_s, 1, 's')}`);
    return [
      `${letter(k)}\u2002${w.question}`, answer, where, fixed(w.margin_min, 3),
      fixed(w.end_shift_m, 1, 'm')
    ];
  });
  host.append(
      element(
          'p', {class: 'note'},
          'The best candidate under other circumstances. Letters mark on the map where it is rejected; the end shift is how far from its own end the same controls lead, by the dotted way.'),
      element(
          'div',
          {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Table of what-ifs'},
          table(
              null,
              [
                {text: 'What if'}, {text: 'Answer'}, {text: 'Where and when'},
                {text: 'Margin', number: true}, {text: 'End shift', number: true}
              ],
              rows)));
}
