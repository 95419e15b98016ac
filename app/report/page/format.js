// Numbers and names as text. What is not known is a dash, never a zero.
d3.formatDefaultLocale(
    {decimal: '.', thousands: '\u202f', grouping: [3], currency: ['', ''], minus: '\u2212'});
const UNKNOWN = '\u2014';
const isKnown = value => typeof value === 'number' && Number.isFinite(value);

function fixed(value, decimals, unit = '') {
  if (!isKnown(value)) return UNKNOWN;
  const text = value.toFixed(decimals).replace(/^-(0(\.0*)?)$/, '$1').replace('-', '\u2212');
  return unit ? text + '\u00a0' + unit : text;
}

const percent = (share, decimals = 0) => fixed(isKnown(share) ? 100 * share : null, decimals, '%');
const integer = value =>
    (isKnown(value) ? d3.format(',d')(value) : UNKNOWN);
const millimetres = value_m => fixed(isKnown(value_m) ? 1000 * value_m : null, 1, 'mm');

/// As many digits as say something, whatever the size: 1600, 0.036, 814\u202f000, 8.14e9.
function significant(value, digits = 4) {
  if (!isKnown(value)) return UNKNOWN;
  if (value === 0) return '0';
  const rounded = Number(value.toPrecision(digits)), size = Math.abs(rounded);
  const text = size >= 1e9 || size < 1e-3 ?
      rounded.toExponential().replace('e+', 'e') :
      size >= 1e4 ? d3.format(',')(rounded) :
                    String(rounded);
  return text.replace(/-/g, '\u2212');
}

/// A number and its standard deviation, to two digits of the latter: 0.0201 \u00b1 0.0017. One that
/// is exact has none.
function withSpread({mean, std}) {
  if (!isKnown(mean) || !isKnown(std) || std <= 0) return significant(mean, 3);
  const last = Math.floor(Math.log10(std)) - 1;
  if (last < -6) return `${significant(mean, 3)}\u00a0\u00b1\u00a0${significant(std, 2)}`;
  const text = value => d3.format(`${Math.abs(value) >= 1e4 ? ',' : ''}.${Math.max(0, -last)}f`)(
      last > 0 ? Math.round(value / 10 ** last) * 10 ** last : value);
  return `${text(mean)}\u00a0\u00b1\u00a0${text(std)}`;
}

const SECONDS = value_s =>
    (isKnown(value_s) && value_s >= 120 ?
         `${Math.floor(value_s / 60)}\u00a0min ${fixed(value_s % 60, 0, 's')}` :
         fixed(value_s, 1, 's'));
const energy = value_j =>
    (isKnown(value_j) && Math.abs(value_j) >= 1e4 ? fixed(value_j / 1000, 1, 'kJ') :
         isKnown(value_j) && Math.abs(value_j) < 100 ? `${significant(value_j, 3)}\u00a0J` :
                                                       fixed(value_j, 0, 'J'));

/// A name of files as words: "tip_over" as "tip over".
const words = name => String(name).replace(/_/g, ' ');
const capital = text => text.charAt(0).toUpperCase() + text.slice(1);
const place = (x_m, y_m) =>
    `x\u00a0=\u00a0${fixed(x_m, 1, 'm')}, y\u00a0=\u00a0${fixed(y_m, 1, 'm')}`;

/// Keys of soil files whose unit their ending does not say, or says wrongly: the bearing numbers' depends on the
/// exponent n of the sinkage.
const UNITS_OF_KEYS = {
  kc: {name: 'kc', unit: 'N/m\u207f\u207a\u00b9'},
  kphi: {name: 'kphi', unit: 'N/m\u207f\u207a\u00b2'},
  kx1_m: {name: 'kx1', unit: 'm/rad'},
  ky1_m: {name: 'ky1', unit: 'm/rad'}
};

const UNIT_ENDINGS = [
  ['_kgpm3', 'kg/m\u00b3'],
  ['_kgm2', 'kg m\u00b2'],
  ['_mps2', 'm/s\u00b2'],
  ['_1pms', '1/(m s)'],
  ['_1pm', '1/m'],
  ['_mps', 'm/s'],
  ['_rad_s', 'rad/s'],
  ['_rad', 'rad'],
  ['_nm', 'N m'],
  ['_deg', '\u00b0'],
  ['_pa', 'Pa'],
  ['_kg', 'kg'],
  ['_m', 'm'],
  ['_s', 's'],
  ['_n', 'N'],
  ['_a', 'A'],
];

/// A key as {name, unit}: "sinkage_max_m" as {name: "sinkage max", unit: "m"}.
function nameAndUnit(key) {
  if (Object.hasOwn(UNITS_OF_KEYS, key)) return UNITS_OF_KEYS[key];
  const ending = UNIT_ENDINGS.find(([end]) => key.endsWith(end) && key.length > end.length);
  return ending ? {name: words(key.slice(0, -ending[0].length)), unit: ending[1]} :
                  {name: words(key), unit: ''};
}
