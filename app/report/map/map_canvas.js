// The terrain on a canvas: hillshade, colours of the ground, forbidden ground, contours, rocks,
// rejected states.
const shownMarks = () => PLAN.rejected_states.filter(
    s => view.reasons.has(s.reason) && isKnown(s.x_m) && isKnown(s.y_m));

function mapCanvas(canvas, frame) {
  const stretch = shadingStretch(TERRAIN);
  const contours = contourLines(TERRAIN);
  const pictures = {
    shade: null,
    soils: soilLayer(TERRAIN),
    forbidden: TERRAIN.soil.some(soil => soil < 0) ? forbiddenLayer(TERRAIN) : null
  };

  function resize() {
    const density = Math.max(1, window.devicePixelRatio || 1);
    canvas.width = frame.width * density;
    canvas.height = frame.height * density;
  }

  function forgetTheme() { pictures.shade = null; }

  function draw() {
    const context = canvas.getContext('2d'), density = canvas.width / frame.width;
    if (!pictures.shade) pictures.shade = hillshade(TERRAIN, stretch, isDark());
    context.setTransform(density, 0, 0, density, 0, 0);
    context.clearRect(0, 0, frame.width, frame.height);
    context.save();
    context.beginPath();
    context.rect(frame.left, frame.top, frame.plotWidth, frame.plotHeight);
    context.clip();
    context.fillStyle = cssColour('--hover');  // beyond the map
    context.fillRect(0, 0, frame.width, frame.height);
    const [west, north] = frame.screen(MAP.west_m, MAP.north_m);
    const [east, south] = frame.screen(MAP.east_m, MAP.south_m);
    context.beginPath();
    context.rect(west, north, east - west, south - north);
    context.clip();
    context.fillStyle = hatching(context, density);
    context.fillRect(0, 0, frame.width, frame.height);
    const k = frame.pixelsPerMetre(), width = TERRAIN.columns * TERRAIN.cell_width_m * k,
          height = TERRAIN.rows * TERRAIN.cell_height_m * k;
    context.imageSmoothingQuality = 'high';
    context.drawImage(pictures.shade, west, north, width, height);
    drawForbidden(context, density, west, north, width, height);
    drawGround(context, west, north, k);
    if (LAYERS.contours) drawContours(context, density, west, north);
    if (LAYERS.rocks) drawRocks(context);
    drawMarks(context);
    context.restore();
  }

  function drawGround(context, west, north, k) {
    const layer =
        LAYERS.ground === 'soils' ? {...TERRAIN, picture: pictures.soils} : chosenGround();
    if (!layer) return;
    const strength = LAYERS.ground === 'soils' ? 0.36 : 0.75;
    context.imageSmoothingEnabled = false;
    context.globalAlpha = isDark() ? 0.83 * strength : strength;
    context.globalCompositeOperation = isDark() ? 'source-over' : 'multiply';
    context.drawImage(
        layer.picture, west, north, layer.columns * layer.cell_width_m * k,
        layer.rows * layer.cell_height_m * k);
    context.globalAlpha = 1;
    context.globalCompositeOperation = 'source-over';
  }

  function hatching(context, density) {
    const tile = element('canvas', {width: 8 * density, height: 8 * density}),
          brush = tile.getContext('2d');
    brush.scale(density, density);
    brush.fillStyle = cssColour('--hatch-ground');
    brush.fillRect(0, 0, 8, 8);
    brush.strokeStyle = cssColour('--hatch');
    brush.beginPath();
    for (const shift of [-8, 0, 8]) {
      brush.moveTo(shift - 1, 9);
      brush.lineTo(shift + 9, -1);
    }
    brush.stroke();
    const pattern = context.createPattern(tile, 'repeat');
    pattern.setTransform(new DOMMatrix().scale(1 / density));
    return pattern;
  }

  function drawForbidden(context, density, west, north, width, height) {
    if (!pictures.forbidden) return;
    const layer = element('canvas', {width: canvas.width, height: canvas.height}),
          brush = layer.getContext('2d');
    brush.setTransform(density, 0, 0, density, 0, 0);
    brush.imageSmoothingEnabled = false;
    brush.drawImage(pictures.forbidden, west, north, width, height);
    brush.globalCompositeOperation = 'source-in';
    brush.fillStyle = hatching(brush, density);
    brush.fillRect(0, 0, frame.width, frame.height);
    context.globalAlpha = 0.75;
    context.drawImage(layer, 0, 0, frame.width, frame.height);
    context.globalAlpha = 1;
  }

  function drawContours(context, density, west, north) {
    const k = frame.pixelsPerMetre(), kx = TERRAIN.cell_width_m * k, ky = TERRAIN.cell_height_m * k;
    context.save();
    context.setTransform(density * kx, 0, 0, density * ky, density * west, density * north);
    context.strokeStyle = isDark() ? '#ffffff' : '#3a2d1a';
    for (const [path, width, alpha] of [[contours.fine, 0.7, 0.3], [contours.bold, 1.2, 0.5]]) {
      context.globalAlpha = alpha;
      context.lineWidth = width / kx;
      context.stroke(path);
    }
    context.restore();
  }

  function drawRocks(context) {
    context.fillStyle = isDark() ? '#b49b83' : '#4a3826';
    context.strokeStyle = isDark() ? '#000000' : '#ffffff';
    context.lineWidth = 0.6;
    for (const [x_m, y_m, radius_m] of MAP.rocks) {
      const [x, y] = frame.screen(x_m, y_m), r = radius_m * frame.pixelsPerMetre();
      if (x < -r || y < -r || x > frame.width + r || y > frame.height + r) continue;
      context.beginPath();
      context.arc(x, y, Math.max(0.6, r), 0, 2 * Math.PI);
      context.fill();
      if (r > 2.5) context.stroke();
    }
  }

  function drawMarks(context) {
    const shapes =
        new Map([...view.reasons].map(reason => [reason, new Path2D(symbolPath(reason, 30))]));
    const density = canvas.width / frame.width;
    context.lineWidth = 0.7;
    context.strokeStyle = isDark() ? '#000000b0' : '#ffffffd0';
    for (const state of shownMarks()) {
      const [x, y] = frame.screen(state.x_m, state.y_m);
      if (x < 0 || y < 0 || x > frame.width || y > frame.height) continue;
      context.setTransform(density, 0, 0, density, density * x, density * y);
      context.fillStyle = reasonStyle(state.reason).colour;
      context.fill(shapes.get(state.reason));
      context.stroke(shapes.get(state.reason));
    }
    context.setTransform(density, 0, 0, density, 0, 0);
  }

  return {resize, draw, forgetTheme, stretch, contour_interval_m: contours.interval_m};
}
