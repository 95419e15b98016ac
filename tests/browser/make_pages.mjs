// Makes the reports that the tests open: make_pages.mjs PROGRAM SOURCE_ROOT FOLDER DEMO,
// the last the folder of the demos that tests have run.
import {execFileSync} from 'node:child_process';
import {cpSync, mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

const [program, source, folder, demo] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});
const scenario = name => join(source, 'benchmarks/scenarios', `${name}.yaml`);

/// Runs the program; status 2 is an answer too.
function regoplan(...args) {
  try {
    execFileSync(program, [...args, '--quiet'], {stdio: ['ignore', 'ignore', 'inherit']});
  } catch (failure) {
    if (failure.status !== 2) throw failure;
  }
}

/// A path along the corridor of fast_corner, round its corner on a radius.
function cornerPath(name, radius_m, speed_mps) {
  const points = [];
  for (let x = 20; x < 100 - radius_m; x += 2) points.push([x, 100]);
  for (let i = 0; i <= 12; ++i) {
    const angle = Math.PI / 2 * i / 12;
    points.push(
        [100 - radius_m + radius_m * Math.sin(angle), 100 + radius_m - radius_m * Math.cos(angle)]);
  }
  for (let y = 102 + radius_m; y <= 180; y += 2) points.push([100, y]);
  const rows = points.map(([x, y]) => `${x.toFixed(3)},${y.toFixed(3)},${speed_mps}\n`);
  writeFileSync(join(folder, name), 'x_m,y_m,speed_mps\n' + rows.join(''));
  return join(folder, name);
}

cpSync(join(demo, 'whole'), join(folder, 'plan'), {recursive: true});
cpSync(join(demo, 'plan-alone'), join(folder, 'other-plan'), {recursive: true});
// More margin than the corner leaves at speed.
writeFileSync(
    join(folder, 'careful.yaml'),
    readFileSync(scenario('fast_corner'), 'utf8')
            .replace('../../scenarios', join(source, 'scenarios')) +
        'limits: {margin_min: 0.42}\n');
regoplan(
    'plan', join(folder, 'careful.yaml'), '--planner', 'Lattice', '--iterations', '3000',
    '--candidates', '1', '--out', join(folder, 'undecided'));
regoplan(
    'evaluate', scenario('fast_corner'), cornerPath('wide.csv', 14, 1),
    cornerPath('tight.csv', 8, 2.9), '--draws', '20', '--out', join(folder, 'evaluation'));
writeFileSync(join(folder, 'manoeuvres.yaml'), `
- {kind: steady_turn, radius_m: 12, angle_deg: 90, speed_mps: [1, 3], soil: firm_regolith}
- {kind: point_turn, slope_deg: 15, vehicle: curiosity, soil: firm_regolith}
`);
regoplan(
    'evaluate', scenario('dune_field'), '--manoeuvres', join(folder, 'manoeuvres.yaml'), '--draws',
    '100', '--out', join(folder, 'manoeuvres'));
// Nothing of this vehicle is steered.
const wheel = (name, x_m, y_m) =>
    `  - {name: ${name}, x_m: ${x_m}, y_m: ${y_m}, steered: false, driven: true}\n`;
writeFileSync(
    join(folder, 'skidder.yaml'),
    `name: skidder
source: own, a small rover of four wheels that turns by its sides
mass_kg: 90
yaw_inertia_kgm2: 14
cg_height_m: 0.32
turn_centre_x_m: 0
speed_max_mps: 0.6
acceleration_max_mps2: 0.15
curvature_max_1pm: 0.4
curvature_rate_max_1pms: 0.4
steer_angle_max_deg: 0
slip_angle_max_deg: 30
slip_max: 0.6
sinkage_max_m: 0.06
slope_max_deg: 20
step_max_m: 0.1
wheel: {radius_m: 0.16, width_m: 0.12}
suspension: equal_springs
drive_law: kinematic
steering: skid
body: {x_min_m: -0.5, x_max_m: 0.5, y_min_m: -0.42, y_max_m: 0.42, clearance_m: 0.15, height_m: 0.5}
wheels:
${wheel('fl', 0.3, 0.36)}${wheel('fr', 0.3, -0.36)}${wheel('rl', -0.3, 0.36)}${
        wheel('rr', -0.3, -0.36)}`);
writeFileSync(
    join(folder, 'skidder_scenario.yaml'),
    readFileSync(scenario('side_slope'), 'utf8')
        .replace('../../scenarios', join(source, 'scenarios'))
        .replace('slope_north_deg: 14', 'slope_north_deg: 2')
        .replace('vehicle: lrv', 'vehicle: skidder.yaml')
        .replace('max: 3', 'max: 0.6'));
writeFileSync(join(folder, 'straight.csv'), 'x_m,y_m\n20,100\n30,100\n40,100\n');
regoplan(
    'evaluate', join(folder, 'skidder_scenario.yaml'), join(folder, 'straight.csv'), '--draws', '2',
    '--out', join(folder, 'skid evaluation'));
regoplan(
    'drive', join(folder, 'skidder_scenario.yaml'), join(folder, 'straight.csv'), '--out',
    join(folder, 'skid drive'));
writeFileSync(join(folder, 'truth.yaml'), `zones:
  - {name: soft, like: loose_regolith, soil: {kphi: 1e5}, corners_m: [[60, 80], [120, 80], [120, 120]]}
vehicle: {wheels: {front_left: {steer_offset_deg: 12}}}
`);
regoplan(
    'drive', scenario('fast_corner'), join(folder, 'tight.csv'), '--sensors', 'B', '--truth',
    join(folder, 'truth.yaml'), '--out', join(folder, 'drive'));
regoplan(
    'diagnose', join(folder, 'drive/drive.csv'), '--scenario', scenario('fast_corner'), '--out',
    join(folder, 'drives'));
const recording = name => join(source, 'scenarios/diagnosis', name);
regoplan(
    'diagnose', recording('recording.csv'), '--setup', recording('setup.yaml'), '--out',
    join(folder, 'diagnosis'));
writeFileSync(join(folder, 'suite.yaml'), `name: small
scenarios: [${scenario('dune_field')}, ${scenario('side_slope')}]
planners: [RRT, KPIECE1]
seeds: 3
time_s: 30
iterations: 400
soil_draws: 2
`);
regoplan('benchmark', join(folder, 'suite.yaml'), '--out', join(folder, 'benchmark'));
regoplan(
    'compare', join(folder, 'plan'), join(folder, 'other-plan'), '--out',
    join(folder, 'comparison'));
