// Draws a drive: planned and driven path on the map, limits, and charts along the way.
const STATUS_CLASS = {
  reached: 'feasible',
  limits_broken: 'doubtful',
  not_reached: 'infeasible'
};
document.body.classList.add(`status-${STATUS_CLASS[PLAN.status]}`);
byId('candidates-title').textContent = 'Limits on the way';
byId('along-title').textContent = 'Along the way';
const [driven, planned] = view.paths;
driven.label = 'driven';
driven.points.distance_m = driven.points.way_m;
Object.assign(planned, {label: 'planned', visible: true, guide: true});

/// The state of a drive at a row; of limits what is broken.
stateAt = (path, i) => {
  const p = path.points, limiting = p.limiting[i];
  const over = (value, limit) => isKnown(value) && Math.abs(value) > limit;
  const under = value => isKnown(value) && value < LIMITS.margin_min;
  return [
    [
      'Cross-track error', fixed(p.cross_track_m[i], 3, 'm'),
      over(p.cross_track_m[i], DRIVE.deviation_allowed_m)
    ],
    ['Course error', fixed(p.course_error_deg[i], 1, '\u00b0'), false],
    [
      'Stability margin', `${fixed(p.margin[i], 3)}${limiting ? ` (${words(limiting)})` : ''}`,
      under(p.margin[i])
    ],
    ['Largest slip ratio', fixed(p.slip_max[i], 3), over(p.slip_max[i], LIMITS.slip_max)],
    [
      'Largest slip angle', fixed(p.slip_angle_max_deg[i], 1, '\u00b0'),
      over(p.slip_angle_max_deg[i], LIMITS.slip_angle_max_deg)
    ],
    [
      'Largest sinkage', millimetres(p.sinkage_max_m[i]),
      over(p.sinkage_max_m[i], LIMITS.sinkage_max_m)
    ],
    ['Rim speed', fixed(p.rim_speed_mps[i], 2, 'm/s'), false],
    ['Time', fixed(p.time_s[i], 1, 's'), false],
    ['Way', fixed(p.distance_m[i], 1, 'm'), false],
    ['Speed', fixed(p.speed_mps[i], 2, 'm/s'), false],
    ['Curvature', fixed(p.curvature_1pm[i], 3, '1/m'), false],
    ['Heading', fixed(p.yaw_deg[i], 1, '\u00b0'), false],
    ['Position', `${fixed(p.x_m[i], 1)}, ${fixed(p.y_m[i], 1, 'm')}`, false],
    ['Elevation', fixed(p.z_m[i], 2, 'm'), false],
    ['Soil', soilName(p.soil[i]), false],
  ];
};

/// Names of the places where the drive ended or first broke a limit.
view.named = DRIVE.limits_broken.map(({limit, first}) => ({...first, text: words(limit)}));
if (PLAN.status === 'not_reached' && DRIVE.reason)
  view.named.push({...DRIVE.place, text: words(DRIVE.reason)});

view.zones = PLAN.zones;
view.marksOver = true;
view.said = {
  marks: 'Limits broken',
  rejected: 'Marked for',
  choose: 'Choose a mark on the map to read which limit was broken there.',
  none: 'No limit was broken.',
  under: 'below the limit; the dashed line is the path as planned',
};
const brokenCounts = d3.nest().key(s => s.reason).rollup(v => v.length).entries(PLAN.rejected_states);
PLAN.rejected = brokenCounts.map(({key, value}) => ({reason: key, count: value}));
for (const {reason} of PLAN.rejected) view.reasons.add(reason);

/// Numbers of the whole drive.
function driveFacts(host) {
  const rows = (title, pairs) => element(
      'div', {}, table(title, [{text: ''}, {text: '', number: true}], pairs));
  const {margins_min: margins} = DRIVE;
  host.append(
      rows(
          'Drive',
          [
            ['follower', DRIVE.follower],
            ['sensors', DRIVE.sensors],
            ['seed', integer(DRIVE.seed)],
            ['way', fixed(DRIVE.length_m, 1, 'm')],
            ['time', SECONDS(DRIVE.duration_s)],
            ['energy of the drives', energy(DRIVE.energy_j)],
            ['cross-track error, rms over the way', fixed(DRIVE.cross_track_rms_m, 3, 'm')],
            ['cross-track error, largest', fixed(DRIVE.cross_track_max_m, 3, 'm')],
            ...MARGINS.map(name => [`smallest ${words(name)} margin`, fixed(margins[name], 3)]),
          ]),
      rows('Gains of the follower', Object.entries(DRIVE.steering_law).map(([key, value]) => {
        const {name, unit} = nameAndUnit(key);
        return [name, `${significant(value)}${unit ? ` ${unit}` : ''}`];
      })),
      element(
          'div', {class: 'wide'}, element('h3', {}, 'How the world differs from the planned one'),
          PLAN.truth_text ? element('pre', {}, PLAN.truth_text) : element('p', {}, 'Not at all.')));
}

limitTable(byId('candidates'));
driveFacts(byId('drive-facts'));
byId('vehicle').remove();
byId('readout').style.gridColumn = '1 / -1';
readout(byId('readout'), byId('position'));
playback(byId('playback'));
layerPanel(byId('layers'), mapView(byId('map')));
charts(byId('charts'));
if (driven.length) setCursor(driven, worstIndex(driven));
view.events.call('marks');
document.documentElement.dataset.drawn = 'yes';
