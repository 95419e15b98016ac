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
regoplan('compare', join(folder, 'plan'), join(folder, 'other-plan'), '--out', join(folder, 'comparison'));
