// What the paths on the map may be coloured by: {key: column, size: what is shown of a value, text,
// decimals, domain: of the ramp, ramp: sizes to colours, beyond: whether a size breaks its limit,
// limited: whether it has one, worst: of several sizes}.

/// A quantity along paths that is the worse the larger it is; its ramp ends at the limit, or at the
/// largest of the verified paths.
function quantityColours({key, text, unit, scale = 1, decimals, limit}) {
  const size = value => Math.abs(value) * scale;
  const verified = view.paths.filter(p => p.verified_path);
  const largest = d3.max(verified, p => d3.max(p.points[key].filter(isKnown), size)) || 1;
  const allowed = isKnown(limit) ? limit * scale : Infinity, high = Math.min(largest, allowed);
  return {
    key,
    size,
    text: unit ? `${text}, ${unit}` : text,
    decimals,
    domain: [0, high],
    ramp: d3.scaleSequential(d3.interpolateViridis).domain([0, high]).clamp(true),
    beyond: shown => shown > allowed,
    limited: isKnown(limit),
    worst: d3.max
  };
}

const PATH_COLOURS = [
  {
    key: 'margin',
    size: margin => margin,
    text: 'Stability margin',
    decimals: 2,
    domain: marginColour.domain(),
    ramp: marginColour,
    beyond: margin => margin < LIMITS.margin_min,
    worst: d3.min
  },
  {key: 'speed_mps', text: 'Speed', unit: 'm/s', decimals: 2, limit: LIMITS.speed_max_mps},
  {key: 'slip_max', text: 'Largest slip ratio', decimals: 2, limit: LIMITS.slip_max},
  {
    key: 'slip_angle_max_deg',
    text: 'Largest slip angle',
    unit: '\u00b0',
    decimals: 1,
    limit: LIMITS.slip_angle_max_deg
  },
  {
    key: 'sinkage_max_m',
    text: 'Largest sinkage',
    unit: 'mm',
    scale: 1000,
    decimals: 1,
    limit: LIMITS.sinkage_max_m
  },
  {key: 'slope_deg', text: 'Slope', unit: '\u00b0', decimals: 1, limit: LIMITS.slope_max_deg},
  {key: 'energy_per_m_j', text: 'Energy per metre', unit: 'J', decimals: 0},
]
    .filter(({key}) => key === 'margin' || view.paths.some(p => (p.points[key] || []).some(isKnown)))
    .map((quantity, k) => (k ? quantityColours(quantity) : quantity));
view.pathColour = PATH_COLOURS[0];

/// The colour of a piece of a path between two values: that of the worse, in forty steps, so that
/// neighbours share a line.
function pieceColour(a, b) {
  if (!isKnown(a) || !isKnown(b)) return '#888888';
  const {size, worst, beyond, ramp, domain: [low, high]} = view.pathColour;
  const shown = worst([size(a), size(b)]), step = (high - low) / 40;
  if (beyond(shown)) return UNDER_LIMIT;
  return ramp(low + (Math.min(40, Math.floor((shown - low) / step)) + 0.5) * step);
}
