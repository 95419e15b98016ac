// What the ground of the map may be coloured by: {text, unit, decimals, columns, rows, width_m,
// height_m, values, domain, colour}; soils have colours of their own.

/// A layer of the report, as readTerrain reads the elevation: NaN where it is unknown.
function readLayer({columns, rows, cell_width_m, cell_height_m, min, max, base64}) {
  const step = (max - min) / 254;
  return {
    columns,
    rows,
    cell_width_m,
    cell_height_m,
    values: Float32Array.from(
        atob(base64), byte => (byte === '\0' ? NaN : min + (byte.charCodeAt(0) - 1) * step))
  };
}

/// \param values of the terrain's own cells
function ofTerrain(values) {
  const {columns, rows, cell_width_m, cell_height_m} = TERRAIN;
  return {columns, rows, cell_width_m, cell_height_m, values};
}

const slopesOfTerrain = () => Float32Array.from(
    TERRAIN.height_m,
    (z_m, i) =>
        (Number.isNaN(z_m) ? NaN : Math.atan(Math.hypot(...gradient(TERRAIN, i))) * 180 / Math.PI));

function ramped(text, unit, decimals, layer, interpolate, domain = null) {
  const [low, high] = domain || d3.extent(layer.values.filter(v => !Number.isNaN(v)));
  const colour = d3.scaleSequential(interpolate).domain([low, Math.max(high, low + 1e-9)]);
  return {text, unit, decimals, ...layer, domain: colour.domain(), colour: colour.clamp(true)};
}

const PLANNED_TEXTS = {
  margin: () => 'Margin of driving straight on',
  probability: () => 'Share of soil draws that bear driving straight on',
  supply: ({speed_mps}) => `Lateral supply at ${significant(speed_mps, 3)} m/s`
};
const plannedText = layer => PLANNED_TEXTS[layer.of](layer);

/// A layer that the planner made.
function plannedLayer(layer) {
  const text = plannedText(layer), read = readLayer(layer);
  if (layer.of === 'margin')
    return {
      text,
      unit: '',
      decimals: 2,
      ...read,
      domain: marginColour.domain(),
      colour: marginColour,
      limited: true
    };
  if (layer.of === 'probability') return ramped(text, '', 2, read, d3.interpolateRdYlBu, [0, 1]);
  return ramped(text, 'N', 0, read, d3.interpolatePuBuGn);
}

/// In the order in which they are offered; `make` is asked once, when one is chosen.
const GROUNDS = [
  {key: 'soils', text: 'Soils'},
  {
    key: 'elevation',
    text: 'Elevation',
    make: () => ramped('Elevation', 'm', 1, ofTerrain(TERRAIN.height_m), d3.interpolateCividis)
  },
  {
    key: 'slope',
    text: 'Slope',
    make: () => ramped('Slope', '\u00b0', 1, ofTerrain(slopesOfTerrain()), d3.interpolateYlOrRd)
  },
  ...(MAP.layers || []).map((layer, k) => ({
                              key: `${layer.of}-${k}`,
                              text: plannedText(layer),
                              make: () => plannedLayer(layer)
                            })),
  {key: 'none', text: 'Light and shade alone'},
];
const LAYERS = {
  ground: 'soils',
  contours: true,
  rocks: true
};

/// The layer chosen, with its picture; nothing for soils and bare ground.
function chosenGround() {
  const ground = GROUNDS.find(g => g.key === LAYERS.ground);
  if (!ground.make) return null;
  if (!ground.made) {
    ground.made = ground.make();
    ground.made.picture = layerPicture(ground.made);
  }
  return ground.made;
}

function layerPicture(layer) {
  return rasterCanvas(layer, (pixels, p, i) => {
    if (Number.isNaN(layer.values[i])) return;
    const {r, g, b} = d3.rgb(layer.colour(layer.values[i]));
    pixels.set([r, g, b, 255], p);
  });
}

/// What the chosen layer is at a place, in words; empty where there is none.
function groundText(x_m, y_m) {
  const layer = chosenGround();
  if (!layer || LAYERS.ground === 'elevation') return '';
  const column = Math.floor((x_m - MAP.west_m) / layer.cell_width_m);
  const row = Math.floor((MAP.north_m - y_m) / layer.cell_height_m);
  const inside = column >= 0 && row >= 0 && column < layer.columns && row < layer.rows;
  const value = inside ? layer.values[row * layer.columns + column] : NaN;
  const name = layer.text.charAt(0).toLowerCase() + layer.text.slice(1);
  return `, ${name} ${Number.isNaN(value) ? 'unknown' : fixed(value, layer.decimals, layer.unit)}`;
}
