// The terrain of a map as pictures: hillshade, soil layer, contour lines. Raster cells run row by
// row from the north; index = row * columns + column.

/// Little-endian 16-bit numbers out of base64.
function numbersOf(base64) {
  // Loops: what from() makes of a million cells takes a tenth of a second.
  const bytes = atob(base64), numbers = new Uint16Array(bytes.length / 2);
  for (let i = 0; i < numbers.length; ++i)
    numbers[i] = bytes.charCodeAt(2 * i) | bytes.charCodeAt(2 * i + 1) << 8;
  return numbers;
}

/// The rasters of a report's map, with heights in metres (NaN unknown) and soils as index (-1
/// none).
function readTerrain(map) {
  const raster = map.raster, {min_m, max_m} = raster.elevation;
  const step_m = (max_m - min_m) / 65534;
  const heights = numbersOf(raster.elevation.base64), runs = raster.soil_runs;
  const height_m = new Float32Array(heights.length), soil = new Int16Array(heights.length);
  for (let i = 0; i < heights.length; ++i)
    height_m[i] = heights[i] ? min_m + (heights[i] - 1) * step_m : NaN;
  for (let run = 0, first = 0; run < runs.length; run += 2) {
    soil.fill(runs[run] - 1, first, first + runs[run + 1]);
    first += runs[run + 1];
  }
  const terrain = {
    columns: raster.columns,
    rows: raster.rows,
    cell_width_m: raster.cell_width_m,
    cell_height_m: raster.cell_height_m,
    height_m,
    soil
  };
  terrain.indexAt = (x_m, y_m) => {
    const column = Math.floor((x_m - map.west_m) / raster.cell_width_m);
    const row = Math.floor((map.north_m - y_m) / raster.cell_height_m);
    return x_m >= map.west_m && x_m < map.east_m && y_m <= map.north_m && y_m > map.south_m ?
        row * raster.columns + column :
        -1;
  };
  return terrain;
}

/// A picture with a pixel for each cell of a raster {columns, rows}.
function rasterCanvas(terrain, paintCell) {
  const canvas = element('canvas', {width: terrain.columns, height: terrain.rows});
  const context = canvas.getContext('2d');
  const image = context.createImageData(terrain.columns, terrain.rows);
  for (let i = 0; i < terrain.columns * terrain.rows; ++i) paintCell(image.data, 4 * i, i);
  context.putImageData(image, 0, 0);
  return canvas;
}

/// Rise per metre from cell a to cell b, `span_m` from it; 0 towards unknown ground and the rim.
function riseBetween(height_m, a, b, span_m) {
  const rise_m = height_m[b] - height_m[a];
  return a === b || Number.isNaN(rise_m) ? 0 : rise_m / span_m;
}

/// Rise per metre to the east and to the north at a cell; 0 towards unknown neighbours.
function gradient(terrain, i) {
  const {columns, rows, height_m} = terrain, column = i % columns, row = (i - column) / columns;
  const west = column > 0 ? i - 1 : i, east = column < columns - 1 ? i + 1 : i;
  const north = row > 0 ? i - columns : i, south = row < rows - 1 ? i + columns : i;
  return [
    riseBetween(height_m, west, east, (east - west) * terrain.cell_width_m),
    riseBetween(height_m, south, north, ((south - north) / columns) * terrain.cell_height_m)
  ];
}

/// How much heights are stretched so that the shading shows them: the steep tenth at 25 degrees.
function shadingStretch(terrain) {
  const stride = Math.max(1, Math.floor(terrain.height_m.length / 20000));
  const slopes = new Float64Array(Math.ceil(terrain.height_m.length / stride));
  let known = 0;
  for (let i = 0; i < terrain.height_m.length; i += stride) {
    if (Number.isNaN(terrain.height_m[i])) continue;
    const [east, north] = gradient(terrain, i);
    slopes[known++] = Math.sqrt(east * east + north * north);
  }
  const steep = d3.quantile(slopes.subarray(0, known).sort(), 0.9) || 0;
  return steep > 0 ? Math.min(8, Math.max(1, Math.tan(25 * Math.PI / 180) / steep)) : 1;
}

/// Light from the north-west, 45 degrees high. Unknown cells stay transparent.
function hillshade(terrain, stretch, dark) {
  const light = [-0.5, 0.5, Math.SQRT1_2], [low, high] = dark ? [16, 168] : [70, 252];
  return rasterCanvas(terrain, (pixels, p, i) => {
    if (Number.isNaN(terrain.height_m[i])) return;
    const [rise_east, rise_north] = gradient(terrain, i);
    const east = rise_east * stretch, north = rise_north * stretch;
    const lit = Math.max(
        0,
        (light[2] - east * light[0] - north * light[1]) /
            Math.sqrt(1 + east * east + north * north));
    const grey = low + (high - low) * lit;
    pixels[p] = grey;
    pixels[p + 1] = grey * 0.985;
    pixels[p + 2] = grey * 0.96;
    pixels[p + 3] = 255;
  });
}

function soilLayer(terrain) {
  const colours = new Map();
  const colourOf = soil => {
    if (!colours.has(soil)) colours.set(soil, d3.rgb(soilColour(soil)));
    return colours.get(soil);
  };
  return rasterCanvas(terrain, (pixels, p, i) => {
    if (terrain.soil[i] < 0 || Number.isNaN(terrain.height_m[i])) return;
    const {r, g, b} = colourOf(terrain.soil[i]);
    pixels[p] = r;
    pixels[p + 1] = g;
    pixels[p + 2] = b;
    pixels[p + 3] = 255;
  });
}

/// Cells that no soil is known for, or that are forbidden: where no vehicle may go.
function forbiddenLayer(terrain) {
  return rasterCanvas(terrain, (pixels, p, i) => {
    if (terrain.soil[i] < 0) pixels[p + 3] = 255;
  });
}

/// Heights averaged over three by three cells, so that contour lines follow the ground and not
/// its roughness.
function smoothed(terrain) {
  const {columns, rows, height_m} = terrain, heights = new Float32Array(height_m.length);
  for (let i = 0; i < heights.length; ++i) {
    const column = i % columns, row = (i - column) / columns;
    let sum = 0, count = 0;
    for (let r = Math.max(0, row - 1); r <= Math.min(rows - 1, row + 1); ++r)
      for (let c = Math.max(0, column - 1); c <= Math.min(columns - 1, column + 1); ++c) {
        const value = height_m[r * columns + c];
        if (!Number.isNaN(value)) {
          sum += value;
          ++count;
        }
      }
    heights[i] = Number.isNaN(height_m[i]) ? NaN : sum / count;
  }
  return heights;
}

/// Draws where heights a, b, c, d at the corners of a square (clockwise from its north-west) pass
/// `level`, as straight lines between its edges.
function contourAcross(path, column, row, a, b, c, d, level) {
  let down = false;
  const edge = (from, to, x, y, dx, dy) => {
    if (from >= level === to >= level) return;
    const part = (level - from) / (to - from);
    if (down)
      path.lineTo(column + x + part * dx, row + y + part * dy);
    else
      path.moveTo(column + x + part * dx, row + y + part * dy);
    down = !down;
  };
  edge(a, b, 0, 0, 1, 0);
  edge(b, c, 1, 0, 0, 1);
  edge(c, d, 1, 1, -1, 0);
  edge(d, a, 0, 1, 0, -1);
}

/// Contour lines as {interval_m, fine, bold}, two Path2D in raster cells; every fifth line is bold.
/// Lines closer than 5 cm would draw the roughness of ground that is level. All lines come out of
/// one pass over the squares between centres of cells: d3.contours passes once for each line, which
/// took a fourth of the time until the page was there.
const CONTOUR_LEAST_M = 0.05;
function contourLines(terrain) {
  const {columns, rows} = terrain, heights = smoothed(terrain);
  const paths = {interval_m: 0, fine: new Path2D(), bold: new Path2D()};
  let low = Infinity, high = -Infinity;  // d3.extent takes a tenth of a second for them
  for (const height_m of heights) {
    if (height_m < low) low = height_m;
    if (height_m > high) high = height_m;
  }
  if (!(high > low)) return paths;
  paths.interval_m = Math.max(CONTOUR_LEAST_M, d3.tickStep(low, high, 15));
  for (let i = 0; i < heights.length; ++i) heights[i] /= paths.interval_m;
  for (let row = 0; row + 1 < rows; ++row)
    for (let column = 0; column + 1 < columns; ++column) {
      const i = row * columns + column;
      const a = heights[i], b = heights[i + 1], c = heights[i + columns + 1],
            d = heights[i + columns];
      // Beside unknown ground both are NaN: there is no contour.
      const last = Math.floor(Math.max(a, b, c, d));
      for (let k = Math.floor(Math.min(a, b, c, d)) + 1; k <= last; ++k)
        contourAcross(
            k % 5 === 0 ? paths.bold : paths.fine, column + 0.5, row + 0.5, a, b, c, d, k);
    }
  return paths;
}
