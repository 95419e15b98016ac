// Charts whose axes are map coordinates: one scale on both axes, north up, the terrain below.

/// Room left of a chart for the longest of its ticks' numbers.
const roomForTicks = values =>
    Math.max(44, 16 + 6.5 * d3.max(values, v => v.toFixed(0).length + (Math.abs(v) >= 1e6 ? 2 : 0)));

/// An empty chart that holds the extents of x to the east and y to the north, metres, with `around_m`
/// on each side: {box, x, y}. `tight` gives no more width than the extents need.
function mapChart(svg, width, xs, ys, {around_m = 6, height_max = 560, tight = false} = {}) {
  const across_m = xs[1] - xs[0] + 2 * around_m, up_m = ys[1] - ys[0] + 2 * around_m;
  const margin = {left: roomForTicks(ys), right: 14, top: 20, bottom: 36};
  const room = width - margin.left - margin.right;
  const height =
      Math.max(150, Math.min(height_max, room * up_m / across_m)) + margin.top + margin.bottom;
  const box = chartBox(svg, width, height, margin);
  const per_m = Math.min(room / across_m, (box.bottom - box.top) / up_m);
  if (tight) box.right = Math.min(box.right, box.left + Math.max(across_m * per_m, 160));
  const scale = ([low, high], from, to) => {
    const half = Math.abs(to - from) / per_m / 2, middle = (low + high) / 2;
    return d3.scaleLinear().domain([middle - half, middle + half]).range([from, to]);
  };
  return {box, x: scale(xs, box.left, box.right), y: scale(ys, box.bottom, box.top)};
}

/// Pictures of a map: its terrain in the theme's light, its soils. Each is made once.
const mapPictures = new Map();
function mapPicture(map, name, make) {
  if (!mapPictures.has(map)) mapPictures.set(map, {terrain: readTerrain(map)});
  const pictures = mapPictures.get(map);
  if (!pictures[name]) pictures[name] = make(pictures.terrain).toDataURL();
  return pictures[name];
}
const shadeOf = map => mapPicture(
    map, isDark() ? 'dark' : 'light',
    terrain => hillshade(terrain, shadingStretch(terrain), isDark()));
const soilsOf = map => mapPicture(map, 'soils', soilLayer);

/// Keys of a map's soils as `drawGround` colours them.
const soilKeys = map => map.soils.map(({name}, k) => {
  const {r, g, b} = d3.rgb(soilColour(k));
  return {name: words(name), colour: `rgba(${r}, ${g}, ${b}, ${2 * SOILS_OPACITY})`, area: true};
});

/// Hillshade and rocks of a report's map below what a map chart shows, cut off at its axes; with
/// `soils` their colours as well.
const SOILS_OPACITY = 0.35;
let grounds = 0;
function drawGround(svg, {box, x, y}, map, {soils = false} = {}) {
  const id = `ground-${++grounds}`;
  svg.append('clipPath')
      .attr('id', id)
      .append('rect')
      .attr('x', box.left)
      .attr('y', box.top)
      .attr('width', box.right - box.left)
      .attr('height', box.bottom - box.top);
  const ground = svg.append('g').attr('clip-path', `url(#${id})`);
  const lay = picture =>
      ground.append('image')
          .attr('href', picture)
          .attr('preserveAspectRatio', 'none')
          .attr('x', x(map.west_m))
          .attr('y', y(map.north_m))
          .attr('width', x(map.west_m + map.raster.columns * map.raster.cell_width_m) - x(map.west_m))
          .attr('height', y(map.north_m - map.raster.rows * map.raster.cell_height_m) - y(map.north_m));
  lay(shadeOf(map));
  if (soils) lay(soilsOf(map)).attr('opacity', SOILS_OPACITY);
  for (const [x_m, y_m, radius_m] of map.rocks)
    ground.append('circle')
        .attr('class', 'rock')
        .attr('cx', x(x_m))
        .attr('cy', y(y_m))
        .attr('r', Math.max(0.6, x(x_m + radius_m) - x(x_m)));
}
