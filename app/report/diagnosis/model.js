// What the diagnosis report shows: channels, runs grouped into conditions, residuals.
const DIAGNOSIS = REPORT, RUNS = REPORT.run_columns;

/// How a channel is called and in which unit it is drawn.
const CHANNELS = {
  fx_n: {title: 'Drawbar pull Fx', unit: 'N', scale: 1},
  fy_n: {title: 'Side force Fy', unit: 'N', scale: 1},
  torque_nm: {title: 'Torque', unit: 'N m', scale: 1},
  sinkage_m: {title: 'Sinkage', unit: 'mm', scale: 1000},
  rut_left_m: {title: 'Left rut depth', unit: 'mm', scale: 1000},
  rut_right_m: {title: 'Right rut depth', unit: 'mm', scale: 1000},
};
const channelOf = name => CHANNELS[name] || {title: words(name), unit: '', scale: 1};
const inUnit = (channel, value) =>
    isKnown(value) ? significant(value * channelOf(channel).scale, 3) : UNKNOWN;
const withChannelUnit = (channel, value) =>
    isKnown(value) ? `${inUnit(channel, value)}\u00a0${channelOf(channel).unit}` : UNKNOWN;

/// The models in the order in which they improve: name, key in the residuals, colour, dash.
const MODELS = [
  {name: 'model at the prior means', key: 'baseline', colour: '--soft', dash: '2 3'},
  {name: 'soil numbers calibrated', key: 'calibrated', colour: '--series-2', dash: '7 3'},
  {name: 'corrected', key: 'corrected', colour: '--series-1', dash: null},
];
/// Whether there is a correction beyond calibrated soil numbers.
const HAS_CORRECTION = Object.values(DIAGNOSIS.run_residuals)
                           .some(rows => rows.some(r => r.corrected !== r.calibrated));
const SHOWN_MODELS = MODELS.filter(m => m.key !== 'corrected' || HAS_CORRECTION);

/// For each value the mean of its cluster; clusters are at most `width` wide.
function clustered(values, width) {
  const order = d3.range(values.length).sort((a, b) => values[a] - values[b]);
  const result = new Array(values.length);
  let members = [];
  const close = () => {
    const mean = d3.mean(members, i => values[i]);
    members.forEach(i => (result[i] = mean));
    members = [];
  };
  for (const i of order) {
    if (members.length && values[i] - values[members[0]] > width) close();
    members.push(i);
  }
  if (members.length) close();
  return result;
}

const SLIP_OF = clustered(RUNS.slip_ratio, 0.025), ANGLE_OF = clustered(RUNS.slip_angle_deg, 1.5);
/// Loads that a test bed holds vary by a few percent from run to run: those are one load.
const LOAD_OF = clustered(RUNS.load_n.map(Math.log), 0.15).map(Math.exp);
/// What else tells runs apart, where it varies: [column, text of a run].
const OTHERS = ['pass', 'speed_mps', 'wheel'].filter(
    column => RUNS[column] && new Set(RUNS[column]).size > 1 && new Set(RUNS[column]).size <= 6);
const othersOf = run => OTHERS
                            .map(column => {
                              const {name, unit} = nameAndUnit(column), value = RUNS[column][run];
                              return `${name} ${isKnown(value) ? significant(value) : value}${
                                  unit ? '\u00a0' + unit : ''}`;
                            })
                            .join(', ');

/// Groups of a channel's residuals: d3.nest is what d3 5 offers.
const grouped = (rows, key) => d3.nest().key(key).entries(rows).map(entry => entry.values);

/// Means of a value of the runs by condition, in units of the noise too.
function byCondition(rows, value) {
  return grouped(
             rows.filter(r => isKnown(value(r)) && r.noise > 0),
             r => `${SLIP_OF[r.run]}|${ANGLE_OF[r.run]}|${othersOf(r.run)}`)
      .map(group => ({
             slip: SLIP_OF[group[0].run],
             angle: ANGLE_OF[group[0].run],
             others: othersOf(group[0].run),
             count: group.length,
             z: d3.mean(group, r => value(r) / r.noise),
             difference: d3.mean(group, value),
           }));
}

/// Mean residuals of a channel by condition.
const conditions = (channel, model) => byCondition(
    DIAGNOSIS.run_residuals[channel].filter(r => isKnown(r.measured) && isKnown(r[model])),
    r => r.measured - r[model]);

const degreesText = value_deg => fixed(value_deg, 1) + '\u00b0';
/// Ids as words: "load_transfer+slip_sinkage" as "load transfer + slip sinkage".
const idText = id => words(id).replace(/\+/g, ' + ');

/// Text of a region: {slip_ratio: [0.3, 0.8]} as "slip ratio 0.3 to 0.8".
function regionText(region) {
  const parts = Object.entries(region).map(([column, [low, high]]) => {
    const {name, unit} = nameAndUnit(column);
    // What an end is short of the larger's third digit is no number to read.
    const larger = d3.max([low, high].filter(isKnown), Math.abs);
    const step = 10 ** (2 - Math.floor(Math.log10(larger || 1)));
    const of = value =>
        significant(Math.round(value * step) / step + 0, 3) +
        (unit ? (unit === '\u00b0' ? '' : '\u00a0') + unit : '');
    if (!isKnown(low) && !isKnown(high)) return name;
    if (!isKnown(low)) return `${name} up to ${of(high)}`;
    if (!isKnown(high)) return `${name} from ${of(low)}`;
    return low === high ? `${name} ${of(low)}` : `${name} ${of(low)} to ${of(high)}`;
  });
  return parts.join(', ') || 'everywhere';
}
