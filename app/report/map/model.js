// What the planning report shows: the paths, which of them is selected, and where the marker is.
// Views draw on "selected", "visible", "coloured", "cursor" and "marks".
const PLAN = REPORT, MAP = REPORT.map, TERRAIN = readTerrain(MAP), LIMITS = REPORT.problem.limits,
      VEHICLE = REPORT.problem.vehicle;
/// Whether a wheel of the vehicle is steered: of one that turns by its sides there is no angle to
/// show.
const STEERS = VEHICLE.wheels.some(wheel => wheel.steered);
const WEIGHT_N = VEHICLE.mass_kg * PLAN.problem.gravity_mps2;
/// Of an entry of a list that the map names.
const letter = k => String.fromCharCode(65 + k % 26);
/// Axles counted from the front.
const AXLES_X_M = [...new Set(VEHICLE.wheels.map(w => w.x_m))].sort(d3.descending);
const axleOf = wheel => AXLES_X_M.indexOf(wheel.x_m);
const MARGINS = ['cornering', 'tip_over', 'traction'];

const view = {
  paths: [
    ...PLAN.candidates.map(c => readPath(c, true)),
    ...PLAN.relaxed.map(readRelaxed).filter(Boolean),
    ...PLAN.overturned.map((c, k) => readPath(c, false, k))
  ],
  selected: null,      // a path
  cursor: null,        // {path, index}
  axis: 'distance_m',  // of the charts
  others: false,       // whether they show the other paths, too
  reasons: new Set(),  // of rejection, shown on the map
  mark: null,          // a rejected state
  playing: false,
  named: [],         // places {x_m, y_m, text} that the map names
  zones: [],         // {name, corners: [[x_m, y_m]]} that it outlines
  marksOver: false,  // marks lie over the paths, not under them
  said: {
    marks: 'Rejected states',
    rejected: 'Rejected for',
    choose: 'Choose a mark on the map to read why that state was rejected.',
    none: 'No rejected states were kept for display.',
    under: 'below the limit (overturned paths, dashed)',
  },
  events:
      d3.dispatch(
          'selected', 'visible', 'coloured', 'cursor', 'axis', 'marks', 'layers', 'goto',
          'playback'),
};
view.selected = view.paths.find(path => path.length) || null;
if (view.selected) view.selected.visible = true;

/// A path with its columns, the distance along it and what limits at each point.
function readPath(candidate, verified, number) {
  const points = candidate.points, count = points.time_s.length;
  let sum_m = 0;
  points.distance_m = points.x_m.map((x_m, i) => {
    const step_m = i ? Math.hypot(x_m - points.x_m[i - 1], points.y_m[i] - points.y_m[i - 1]) : 0;
    return (sum_m += isKnown(step_m) ? step_m : 0);
  });
  points.limiting = points.time_s.map((_, i) => {
    const known = MARGINS.filter(m => isKnown(points[m + '_margin'][i]));
    return known.length ?
        known.reduce((a, b) => (points[a + '_margin'][i] <= points[b + '_margin'][i] ? a : b)) :
        null;
  });
  return {
    ...candidate,
    points,
    length: count,
    verified_path: verified,
    visible: verified,
    label: verified ? String(candidate.rank) : `overturned ${number + 1}`
  };
}

/// The path that giving something up opens, called by the letter of what was given up.
function readRelaxed({given_up, path}, k) {
  return path && {...readPath(path, true), label: letter(k), given_up, relaxed: true};
}

const marginTop = d3.quantile(
    view.paths.filter(p => p.verified_path)
        .reduce((all, p) => all.concat(p.points.margin.filter(isKnown)), [])
        .sort(d3.ascending),
    0.95);
const marginColour = marginColours(LIMITS.margin_min, Math.ceil(10 * (marginTop || 0.5)) / 10);

function select(path) {
  if (view.selected === path) return;
  view.selected = path;
  view.events.call('selected');
  setCursor(path, worstIndex(path));
}

function setVisible(path, visible) {
  path.visible = visible;
  view.events.call('visible');
}

function setCursor(path, index) {
  if (!path || !path.length) return;
  view.cursor = {path, index: Math.max(0, Math.min(path.length - 1, index))};
  view.events.call('cursor');
}

/// Where the margin is smallest.
function worstIndex(path) {
  const index = d3.scan(path.points.margin.map(m => (isKnown(m) ? m : Infinity)), d3.ascending);
  return index === undefined ? 0 : index;
}

const soilName = index => (MAP.soils[index] ? MAP.soils[index].name : UNKNOWN);

/// Everything about one point of a path, as [name, text, whether it is over a limit].
function stateAt(path, i) {
  const p = path.points, limiting = p.limiting[i];
  const under = value => isKnown(value) && value < LIMITS.margin_min;
  const over = (value, limit) => isKnown(value) && isKnown(limit) && Math.abs(value) > limit;
  const margin = name =>
      [capital(words(name)) + ' margin', fixed(p[name + '_margin'][i], 3),
       under(p[name + '_margin'][i])];
  return [
    ['What limits', limiting ? words(limiting) : UNKNOWN, false],
    ['Stability margin', fixed(p.margin[i], 3), under(p.margin[i])],
    ...MARGINS.map(margin),
    [
      'Lateral demand', fixed(p.demand_n[i], 0, 'N'),
      p.demand_n[i] < p.supply_min_n[i] || p.demand_n[i] > p.supply_max_n[i]
    ],
    [
      'Lateral supply', `${fixed(p.supply_min_n[i], 0)} to ${fixed(p.supply_max_n[i], 0, 'N')}`,
      false
    ],
    ['Time', fixed(p.time_s[i], 1, 's'), false],
    ['Distance', fixed(p.distance_m[i], 1, 'm'), false],
    ['Speed', fixed(p.speed_mps[i], 2, 'm/s'), over(p.speed_mps[i], LIMITS.speed_max_mps)],
    ['Largest slip ratio', fixed(p.slip_max[i], 3), over(p.slip_max[i], LIMITS.slip_max)],
    [
      'Largest slip angle', fixed(p.slip_angle_max_deg[i], 1, '\u00b0'),
      over(p.slip_angle_max_deg[i], LIMITS.slip_angle_max_deg)
    ],
    [
      'Largest sinkage', millimetres(p.sinkage_max_m[i]),
      over(p.sinkage_max_m[i], LIMITS.sinkage_max_m)
    ],
    ['Largest torque', fixed(p.torque_max_nm[i], 1, 'N m'), false],
    [
      'Energy so far', fixed(isKnown(p.energy_j[i]) ? p.energy_j[i] / 1000 : null, 2, 'kJ'),
      false
    ],
    ...(STEERS ? [['Steering', fixed(p.steer_deg[i], 1, '\u00b0'), false]] : []),
    ['Heading', fixed(p.yaw_deg[i], 1, '\u00b0'), false],
    ['Position', `${fixed(p.x_m[i], 1)}, ${fixed(p.y_m[i], 1, 'm')}`, false],
    ['Elevation', fixed(p.z_m[i], 2, 'm'), false],
    ['Soil', soilName(p.soil[i]), false],
  ];
}
