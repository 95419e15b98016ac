// What the charts of a drive show, in place of those of a plan.
const DRIVE = REPORT.drive;

/// A series for each wheel: left and right by colour, axles by dashes.
const byWheel = key => VEHICLE.wheels.map(
    wheel => ({
      name: words(wheel.name),
      key: key(wheel.name),
      colour: wheel.y_m > 0 ? '--series-1' : '--series-2',
      dash: [null, '7 3', '2 2.5', '9 3 2 3'][axleOf(wheel) % 4]
    }));

const MARGIN_CHART = CHARTS.find(chart => chart.title === 'Margins');
const ATTITUDE_CHART = CHARTS.find(chart => chart.title === 'Slope, pitch and roll');
const GROUND_CHART = CHARTS.find(chart => chart.title === 'Elevation and soil');
const DRIVE_CHARTS = [
  {
    title: 'Cross-track error, left positive',
    unit: 'm',
    decimals: 3,
    zero: true,
    limits: [DRIVE.deviation_allowed_m, -DRIVE.deviation_allowed_m],
    series: [{name: 'off the path', key: 'cross_track_m', colour: '--series-1'}]
  },
  {
    title: 'Course error, left positive',
    unit: '\u00b0',
    decimals: 1,
    zero: true,
    series: [{name: 'course less heading of the path', key: 'course_error_deg', colour: '--series-1'}]
  },
  {
    title: 'Slip ratio of the wheels, driving positive',
    decimals: 3,
    zero: true,
    limits: [LIMITS.slip_max, -LIMITS.slip_max],
    series: byWheel(name => `slip_${name}`)
  },
  {
    title: 'Slip angle of the wheels, to the left positive',
    unit: '\u00b0',
    decimals: 1,
    zero: true,
    limits: [LIMITS.slip_angle_max_deg, -LIMITS.slip_angle_max_deg],
    series: byWheel(name => `slip_angle_${name}_deg`)
  },
  {
    title: 'Speed',
    unit: 'm/s',
    decimals: 2,
    zero: true,
    series: [
      {name: 'of the path', key: 'speed_planned_mps', colour: '--series-4', dash: '2 2.5'},
      {name: 'rims, asked for', key: 'rim_speed_asked_mps', colour: '--series-2', dash: '7 3'},
      {name: 'rims', key: 'rim_speed_mps', colour: '--series-3'},
      {name: 'vehicle', key: 'speed_mps', colour: '--series-1'}
    ]
  },
  {
    title: 'Steering as curvature, left positive',
    unit: '1/m',
    decimals: 3,
    zero: true,
    limits: [VEHICLE.curvature_max_1pm, -VEHICLE.curvature_max_1pm],
    series: [
      {name: 'of the path', key: 'curvature_planned_1pm', colour: '--series-4', dash: '2 2.5'},
      {name: 'asked for', key: 'curvature_asked_1pm', colour: '--series-2', dash: '7 3'},
      {name: 'steered', key: 'curvature_1pm', colour: '--series-1'}
    ]
  },
  {
    title: 'Steering angles of the wheels, left positive',
    unit: '\u00b0',
    decimals: 1,
    zero: true,
    series: byWheel(name => `steer_${name}_deg`)
        .filter((_, i) => VEHICLE.wheels[i].steered)
  },
  MARGIN_CHART,
  {
    title: 'Sinkage of the wheels',
    unit: 'mm',
    decimals: 1,
    scale: 1000,
    zero: true,
    limits: [1000 * LIMITS.sinkage_max_m],
    series: byWheel(name => `sinkage_${name}_m`)
  },
  {
    title: 'Torque of the wheels, driving positive',
    unit: 'N\u00a0m',
    decimals: 1,
    zero: true,
    series: byWheel(name => `torque_${name}_nm`)
  },
  {
    title: 'Loads of the wheels',
    unit: 'N',
    decimals: 0,
    zero: true,
    series: byWheel(name => `load_${name}_n`)
  },
  {
    title: 'How far off the vehicle takes itself to be',
    unit: 'm',
    decimals: 3,
    zero: true,
    series: [{name: 'estimated from true position', key: 'seen_off_m', colour: '--series-1'}]
  },
  ATTITUDE_CHART,
  GROUND_CHART,
];
/// A chart without a line shows nothing, and exact sensors are not off.
const isShown = ({series}) =>
    series.length > 0 && (DRIVE.sensors !== 'exact' || series[0].key !== 'seen_off_m');
CHARTS.splice(0, CHARTS.length, ...DRIVE_CHARTS.filter(isShown));
