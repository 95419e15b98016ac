// Limits of a drive: which were broken, how far, and where first.
Object.assign(REASONS, {
  deviation: {symbol: 5, colour: '#d55e00', found: 'distance from the path', show: v => fixed(v, 2, 'm')},
  stalled: {symbol: 1, colour: '#d55e00', found: null},
  dynamics: {symbol: 6, colour: '#d55e00', found: null},
  does_not_stop: {symbol: 3, colour: '#d55e00', found: 'speed', show: v => fixed(v, 3, 'm/s')},
  goal_missed: {symbol: 2, colour: '#d55e00', found: 'distance from the goal', show: v => fixed(v, 2, 'm')},
});
Object.assign(REASON_TEXT, {
  deviation: 'the vehicle strayed too far from the path',
  stalled: 'the vehicle did not get on',
  dynamics: 'no motion balances the forces',
  does_not_stop: 'the vehicle did not come to rest',
  goal_missed: 'the vehicle came to rest beside the goal',
});

/// The largest of columns by magnitude, or the least.
function extreme(keys, least = false) {
  const {points} = view.paths[0];
  const values = keys.flatMap(key => points[key].filter(isKnown));
  return least ? d3.min(values) : d3.max(values, Math.abs);
}

const wheelKeys = key => byWheel(key).map(series => series.key);

/// What is held along the way: {limit, allowed, worst, show}.
function heldLimits() {
  const angle = v => fixed(v, 1, '\u00b0'), ratio = v => fixed(v, 3);
  const margin = name => ({
    limit: name,
    allowed: LIMITS.margin_min,
    worst: extreme([`${name}_margin`], true),
    show: ratio,
    margin: true
  });
  return [
    {
      limit: 'deviation',
      allowed: DRIVE.deviation_allowed_m,
      worst: DRIVE.cross_track_max_m,
      show: v => fixed(v, 3, 'm')
    },
    {limit: 'speed', allowed: LIMITS.speed_max_mps, worst: extreme(['speed_mps']), show: v => fixed(v, 2, 'm/s')},
    {limit: 'slope', allowed: LIMITS.slope_max_deg, worst: null, show: angle},
    {limit: 'sinkage', allowed: LIMITS.sinkage_max_m, worst: extreme(wheelKeys(n => `sinkage_${n}_m`)), show: millimetres},
    {limit: 'slip', allowed: LIMITS.slip_max, worst: extreme(wheelKeys(n => `slip_${n}`)), show: ratio},
    {
      limit: 'slip_angle',
      allowed: LIMITS.slip_angle_max_deg,
      worst: extreme(wheelKeys(n => `slip_angle_${n}_deg`)),
      show: angle
    },
    ...MARGINS.map(margin),
  ];
}

/// Where a limit was broken, as a button that shows the place on the map.
function placeButton({x_m, y_m}) {
  const node = element(
      'button', {type: 'button', title: 'Show on the map'}, `${fixed(x_m, 1)}, ${fixed(y_m, 1, 'm')}`);
  node.addEventListener('click', () => view.events.call('goto', null, {x_m, y_m}));
  return node;
}

function limitRow({limit, allowed, worst, show, margin}) {
  const broken = DRIVE.limits_broken.find(one => one.limit === limit) ||
      (DRIVE.reason === limit && {first: DRIVE.place, worst: DRIVE.value});
  const held = element('span', {class: 'good'}, 'held');
  return [
    capital(words(limit)) + (margin ? ' margin' : ''),
    `${margin ? 'at least' : 'at most'} ${show(allowed)}`,
    show(broken ? Math.abs(broken.worst) * (margin ? Math.sign(broken.worst) : 1) : worst),
    broken ? element('span', {class: 'alarm'}, 'broken') : held,
    broken ? element('span', {class: 'together'}, placeButton(broken.first), ` ${fixed(broken.first.time_s, 1, 's')}, ${
        fixed(broken.first.s_m, 1, 'm')} along`) : UNKNOWN,
  ];
}

function limitTable(host) {
  const end = REASONS[DRIVE.reason] && !heldLimits().some(held => held.limit === DRIVE.reason) ?
      element(
          'p', {}, element('b', {class: 'alarm'}, `Ended by ${words(DRIVE.reason)}`),
          `: ${REASON_TEXT[DRIVE.reason]}, at `, placeButton(DRIVE.place),
          ` ${fixed(DRIVE.place.time_s, 1, 's')}.`) :
      null;
  if (end) host.append(end);
  host.append(element(
      'div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Table of limits'},
      table(
          null,
          [
            {text: 'Limit'}, {text: 'Allowed', number: true}, {text: 'Worst', number: true},
            {text: ''}, {text: 'First broken'}
          ],
          heldLimits().filter(held => held.worst !== null || DRIVE.limits_broken.some(one => one.limit === held.limit)).map(limitRow))));
}
