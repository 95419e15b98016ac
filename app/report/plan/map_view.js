// The map: terrain on a canvas, paths and places in SVG over it, both under one pan and zoom.
// Base pixels are those of the whole map fitted into the plot; zoom transforms base to screen.
const TERRAIN = readTerrain(MAP);
const LAYERS = {soils: true, contours: true, rocks: true};

function mapView(host) {
  const margin = {left: 52, right: 1, top: 1, bottom: 22};
  const canvas = d3.select(host).append("canvas").attr("aria-hidden", "true").node();
  const svg = d3.select(host).append("svg").attr("aria-hidden", "true");
  const tooltip = host.appendChild(element("div", {class: "tooltip", hidden: true}));
  const stretch = shadingStretch(TERRAIN), contours = contourLines(TERRAIN);
  const pictures = {shade: null, soils: soilLayer(TERRAIN), forbidden: forbiddenLayer(TERRAIN)};
  const size = {width: 0, height: 0, scale: 1, x0: 0, y0: 0};
  let transform = d3.zoomIdentity, frame = 0;

  svg.append("clipPath").attr("id", "plot").append("rect");
  const over = svg.append("g").attr("clip-path", "url(#plot)");
  const pathLayer = over.append("g"), placeLayer = over.append("g"), markerLayer = over.append("g").attr("pointer-events", "none");
  const axes = [svg.append("g").attr("class", "axis"), svg.append("g").attr("class", "axis")];
  const scaleBar = svg.append("g").attr("class", "scale-bar");

  const base = (x_m, y_m) => [size.x0 + (x_m - MAP.west_m) * size.scale, size.y0 + (MAP.north_m - y_m) * size.scale];
  const screen = (x_m, y_m) => transform.apply(base(x_m, y_m));
  const mapPoint = pixel => {
    const [x, y] = transform.invert(pixel);
    return [MAP.west_m + (x - size.x0) / size.scale, MAP.north_m - (y - size.y0) / size.scale];
  };
  const pixelsPerMetre = () => size.scale * transform.k;

  const zoom = d3.zoom().on("zoom", () => { transform = d3.event.transform; redraw(); })
    .filter(() => {
      const event = d3.event;
      if (event.type === "wheel") return event.ctrlKey || event.metaKey || document.activeElement === host;
      if (event.type.startsWith("touch")) return event.touches.length > 1;
      return !event.button;
    });
  svg.call(zoom).style("touch-action", "pan-x pan-y").on("dblclick.zoom", null);

  /// Shows the given places with some room around them.
  function show(places) {
    const [left, right] = d3.extent(places, p => p[0]), [bottom, top] = d3.extent(places, p => p[1]);
    const [x1, y1] = base(left, top), [x2, y2] = base(right, bottom);
    const plotWidth = size.width - margin.left - margin.right, plotHeight = size.height - margin.top - margin.bottom;
    const room_px = 6 / Math.max(MAP.east_m - MAP.west_m, 1e-9) ;
    const k = Math.min(60, 0.86 * Math.min(plotWidth / Math.max(x2 - x1, room_px), plotHeight / Math.max(y2 - y1, room_px)));
    svg.call(zoom.transform, d3.zoomIdentity.translate(margin.left + plotWidth / 2 - k * (x1 + x2) / 2, margin.top + plotHeight / 2 - k * (y1 + y2) / 2).scale(k));
  }
  const showAll = () => svg.call(zoom.transform, d3.zoomIdentity);
  function showPaths() {
    const {start, goal} = PLAN.problem, r = Math.max(goal.radius_m || 0, 3);
    const places = [[start.x_m, start.y_m], [goal.x_m - r, goal.y_m - r], [goal.x_m + r, goal.y_m + r]];
    for (const path of view.paths.filter(p => p.visible)) path.points.x_m.forEach((x, i) => places.push([x, path.points.y_m[i]]));
    const known = places.filter(p => isKnown(p[0]) && isKnown(p[1]));
    if (known.length) show(known);
  }

  function resize(width) {
    const aspect = (MAP.north_m - MAP.south_m) / (MAP.east_m - MAP.west_m);
    const height = Math.round(Math.max(Math.min(width, 340), Math.min(aspect * width, 0.82 * Math.max(700, window.innerHeight), 780)));
    const plotWidth = width - margin.left - margin.right, plotHeight = height - margin.top - margin.bottom;
    Object.assign(size, {width, height, scale: Math.min(plotWidth / (MAP.east_m - MAP.west_m), plotHeight / (MAP.north_m - MAP.south_m))});
    size.x0 = margin.left + (plotWidth - (MAP.east_m - MAP.west_m) * size.scale) / 2;
    size.y0 = margin.top + (plotHeight - (MAP.north_m - MAP.south_m) * size.scale) / 2;
    host.style.aspectRatio = `${width} / ${height}`;
    const density = Math.max(1, window.devicePixelRatio || 1);
    canvas.width = width * density;
    canvas.height = height * density;
    svg.attr("viewBox", `0 0 ${width} ${height}`);
    svg.select("#plot rect").attr("x", margin.left).attr("y", margin.top).attr("width", plotWidth).attr("height", plotHeight);
    zoom.extent([[margin.left, margin.top], [width - margin.right, height - margin.bottom]]).scaleExtent([0.8, 200])
      .translateExtent([[margin.left - 0.3 * plotWidth, margin.top - 0.3 * plotHeight], [margin.left + 1.3 * plotWidth, margin.top + 1.3 * plotHeight]]);
    drawPaths();
    showPaths();
  }

  function redraw() {
    placeOverlay();
    if (!frame) frame = requestAnimationFrame(() => { frame = 0; drawTerrain(); });
  }

  // ---- the canvas

  function drawTerrain() {
    const context = canvas.getContext("2d"), density = canvas.width / size.width;
    if (!pictures.shade) pictures.shade = hillshade(TERRAIN, stretch, DARK.matches);
    context.setTransform(density, 0, 0, density, 0, 0);
    context.clearRect(0, 0, size.width, size.height);
    context.save();
    context.beginPath();
    context.rect(margin.left, margin.top, size.width - margin.left - margin.right, size.height - margin.top - margin.bottom);
    context.clip();
    const [west, north] = screen(MAP.west_m, MAP.north_m), [east, south] = screen(MAP.east_m, MAP.south_m);
    context.beginPath();
    context.rect(west, north, east - west, south - north);
    context.clip();
    context.fillStyle = hatching(context, density);
    context.fillRect(0, 0, size.width, size.height);
    const k = pixelsPerMetre(), width = TERRAIN.columns * TERRAIN.cell_width_m * k, height = TERRAIN.rows * TERRAIN.cell_height_m * k;
    context.imageSmoothingQuality = "high";
    context.drawImage(pictures.shade, west, north, width, height);
    drawForbidden(context, density, west, north, width, height);
    if (LAYERS.soils) {
      context.imageSmoothingEnabled = false;
      context.globalAlpha = DARK.matches ? 0.3 : 0.36;
      context.globalCompositeOperation = DARK.matches ? "source-over" : "multiply";
      context.drawImage(pictures.soils, west, north, width, height);
      context.globalAlpha = 1;
      context.globalCompositeOperation = "source-over";
    }
    if (LAYERS.contours) drawContours(context, density, west, north);
    if (LAYERS.rocks) drawRocks(context);
    drawMarks(context);
    context.restore();
  }

  function hatching(context, density) {
    const tile = element("canvas", {width: 8 * density, height: 8 * density}), brush = tile.getContext("2d");
    brush.scale(density, density);
    brush.fillStyle = cssColour("--hatch-ground");
    brush.fillRect(0, 0, 8, 8);
    brush.strokeStyle = cssColour("--hatch");
    brush.beginPath();
    for (const shift of [-8, 0, 8]) { brush.moveTo(shift - 1, 9); brush.lineTo(shift + 9, -1); }
    brush.stroke();
    const pattern = context.createPattern(tile, "repeat");
    pattern.setTransform(new DOMMatrix().scale(1 / density));
    return pattern;
  }

  function drawForbidden(context, density, west, north, width, height) {
    const layer = element("canvas", {width: canvas.width, height: canvas.height}), brush = layer.getContext("2d");
    brush.setTransform(density, 0, 0, density, 0, 0);
    brush.imageSmoothingEnabled = false;
    brush.drawImage(pictures.forbidden, west, north, width, height);
    brush.globalCompositeOperation = "source-in";
    brush.fillStyle = hatching(brush, density);
    brush.fillRect(0, 0, size.width, size.height);
    context.globalAlpha = 0.75;
    context.drawImage(layer, 0, 0, size.width, size.height);
    context.globalAlpha = 1;
  }

  function drawContours(context, density, west, north) {
    const k = pixelsPerMetre(), kx = TERRAIN.cell_width_m * k, ky = TERRAIN.cell_height_m * k;
    context.save();
    context.setTransform(density * kx, 0, 0, density * ky, density * west, density * north);
    context.strokeStyle = DARK.matches ? "#ffffff" : "#3a2d1a";
    for (const [path, width, alpha] of [[contours.fine, 0.7, 0.3], [contours.bold, 1.2, 0.5]]) {
      context.globalAlpha = alpha;
      context.lineWidth = width / kx;
      context.stroke(path);
    }
    context.restore();
  }

  function drawRocks(context) {
    context.fillStyle = DARK.matches ? "#b49b83" : "#4a3826";
    context.strokeStyle = DARK.matches ? "#000000" : "#ffffff";
    context.lineWidth = 0.6;
    for (const [x_m, y_m, radius_m] of MAP.rocks) {
      const [x, y] = screen(x_m, y_m), r = radius_m * pixelsPerMetre();
      if (x < -r || y < -r || x > size.width + r || y > size.height + r) continue;
      context.beginPath();
      context.arc(x, y, Math.max(0.6, r), 0, 2 * Math.PI);
      context.fill();
      if (r > 2.5) context.stroke();
    }
  }

  const shownMarks = () => PLAN.rejected_states.filter(s => view.reasons.has(s.reason) && isKnown(s.x_m) && isKnown(s.y_m));

  function drawMarks(context) {
    const shapes = new Map([...view.reasons].map(reason => [reason, new Path2D(symbolPath(reason, 30))]));
    const density = canvas.width / size.width;
    context.lineWidth = 0.7;
    context.strokeStyle = DARK.matches ? "#000000b0" : "#ffffffd0";
    for (const state of shownMarks()) {
      const [x, y] = screen(state.x_m, state.y_m);
      if (x < 0 || y < 0 || x > size.width || y > size.height) continue;
      context.setTransform(density, 0, 0, density, density * x, density * y);
      context.fillStyle = reasonStyle(state.reason).colour;
      context.fill(shapes.get(state.reason));
      context.stroke(shapes.get(state.reason));
    }
    context.setTransform(density, 0, 0, density, 0, 0);
  }

  // ---- the SVG over it

  /// A path as runs of one colour: neighbours in the same fortieth of the scale share a line.
  function pieces(path) {
    const {x_m, y_m, margin: margins} = path.points, [low, high] = marginColour.domain();
    const step = (high - low) / 40, list = [];
    for (let i = 0; i + 1 < path.length; ++i) {
      if (![x_m[i], y_m[i], x_m[i + 1], y_m[i + 1]].every(isKnown)) continue;
      const worse = isKnown(margins[i]) && isKnown(margins[i + 1]) ? Math.min(margins[i], margins[i + 1]) : null;
      const bin = worse === null ? null : worse < LIMITS.margin_min ? -1 : Math.min(40, Math.floor((worse - low) / step));
      const last = list[list.length - 1];
      if (last && last.bin === bin && last.end === i) { last.points.push(base(x_m[i + 1], y_m[i + 1])); last.end = i + 1; }
      else list.push({bin, end: i + 1, colour: bin === null ? "#888888" : bin < 0 ? UNDER_LIMIT : marginColour(low + (bin + 0.5) * step), points: [base(x_m[i], y_m[i]), base(x_m[i + 1], y_m[i + 1])]});
    }
    return list;
  }

  function drawPaths() {
    const shown = view.paths.filter(p => p.visible && p.length).sort((a, b) => (a === view.selected) - (b === view.selected) || b.rank - a.rank);
    const groups = pathLayer.selectAll("g.path").data(shown, p => p.label).join("g").attr("class", "path").order();
    groups.each(function (path) {
      const chosen = path === view.selected, runs = pieces(path), line = d3.line();
      const outline = runs.map(run => line(run.points)).join("");
      const group = d3.select(this);
      group.selectAll("*").remove();
      group.append("path").attr("class", "casing").attr("d", outline).attr("vector-effect", "non-scaling-stroke").attr("stroke-width", chosen ? 8 : 4.6).attr("stroke-opacity", chosen ? 0.95 : 0.7);
      group.selectAll("path.piece").data(runs).join("path").attr("class", "piece").attr("d", run => line(run.points)).attr("stroke", run => run.colour)
        .attr("vector-effect", "non-scaling-stroke").attr("stroke-width", chosen ? 5 : 2.8).attr("stroke-dasharray", path.verified_path ? null : "6 5");
    });
    placeOverlay();
  }

  function placeOverlay() {
    pathLayer.attr("transform", transform);
    placeLayer.selectAll("*").remove();
    const {start, goal} = PLAN.problem, [sx, sy] = screen(start.x_m, start.y_m), [gx, gy] = screen(goal.x_m, goal.y_m);
    placeLayer.append("circle").attr("class", "goal-ring").attr("cx", gx).attr("cy", gy).attr("r", Math.max(5, goal.radius_m * pixelsPerMetre()));
    placeLayer.append("path").attr("class", "place").attr("d", "M-6,-6L9,0L-6,6L-3,0Z").attr("transform", `translate(${sx},${sy}) rotate(${-start.heading_deg})`);
    placeLayer.append("path").attr("class", "place").attr("d", "M0,0V-17L11,-13L0,-9").attr("transform", `translate(${gx},${gy})`);
    label("Start", sx, sy + 20);
    label("Goal", gx, gy + 16);
    for (const path of view.paths.filter(p => p.visible && p.length)) {
      const share = path.verified_path ? 0.35 + 0.3 * ((path.rank * 0.382) % 1) : 0.5, i = Math.round(share * (path.length - 1));
      if (isKnown(path.points.x_m[i]) && isKnown(path.points.y_m[i])) label(path.verified_path ? path.label : path.label.replace("overturned ", "\u2715"), ...screen(path.points.x_m[i], path.points.y_m[i]), 9, -7);
    }
    PLAN.what_ifs.forEach((w, k) => {
      if (w.feasible || !isKnown(w.x_m) || !isKnown(w.y_m)) return;
      const [x, y] = screen(w.x_m, w.y_m), g = placeLayer.append("g").attr("class", "what-if").attr("transform", `translate(${x},${y})`);
      g.append("title").text(`${w.question}: rejected${w.reason ? " for " + words(w.reason) : ""}`);
      g.append("path").attr("d", "M0,0V-15").attr("stroke", cssVar("--alarm")).attr("stroke-width", 2);
      g.append("circle").attr("cy", -24).attr("r", 9.5);
      g.append("text").attr("y", -24).text(whatIfLetter(k));
    });
    if (view.mark) {
      const [x, y] = screen(view.mark.x_m, view.mark.y_m);
      placeLayer.append("circle").attr("class", "mark-chosen").attr("cx", x).attr("cy", y).attr("r", 9);
    }
    drawAxes();
    drawMarker();
  }

  function label(text, x, y, dx = 0, dy = 0) {
    placeLayer.append("text").attr("class", "label").attr("text-anchor", dx ? "start" : "middle").attr("x", x + dx).attr("y", y + dy).text(text);
  }

  function drawAxes() {
    const [west, north] = mapPoint([margin.left, margin.top]), [east, south] = mapPoint([size.width - margin.right, size.height - margin.bottom]);
    const x = d3.scaleLinear().domain([west, east]).range([margin.left, size.width - margin.right]);
    const y = d3.scaleLinear().domain([south, north]).range([size.height - margin.bottom, margin.top]);
    const plain = scale => { const ticks = scale.ticks(6); return d3.format(`.${d3.precisionFixed(ticks.length > 1 ? ticks[1] - ticks[0] : 1)}f`); };
    axes[0].attr("transform", `translate(0,${size.height - margin.bottom})`).call(d3.axisBottom(x).ticks(Math.max(2, Math.min(8, size.width / 110))).tickSize(4).tickFormat(plain(x)));
    axes[1].attr("transform", `translate(${margin.left},0)`).call(d3.axisLeft(y).ticks(6).tickSize(4).tickFormat(plain(y)));
    const span_m = d3.tickStep(0, 130 / pixelsPerMetre(), 1.5), length = span_m * pixelsPerMetre();
    scaleBar.selectAll("*").remove();
    scaleBar.attr("transform", `translate(${margin.left + 12},${size.height - margin.bottom - 12})`);
    scaleBar.append("rect").attr("x", -6).attr("y", -22).attr("width", length + 12).attr("height", 29).attr("rx", 3).attr("fill", cssVar("--panel")).attr("opacity", 0.82);
    scaleBar.append("path").attr("d", `M0,-5V0H${length}V-5`);
    scaleBar.append("text").attr("x", length / 2).attr("y", -8).attr("text-anchor", "middle").text(span_m >= 1 ? `${span_m} m` : `${Math.round(span_m * 100)} cm`);
  }

  /// The vehicle at the marker: its body and wheels to scale where that can be seen, else a dot.
  function drawMarker() {
    markerLayer.selectAll("*").remove();
    if (!view.cursor || !view.cursor.path.visible) return;
    const {path, index} = view.cursor, p = path.points, k = pixelsPerMetre(), {body} = VEHICLE;
    if (!isKnown(p.x_m[index]) || !isKnown(p.y_m[index])) return;
    const [x, y] = screen(p.x_m[index], p.y_m[index]);
    const g = markerLayer.append("g").attr("transform", `translate(${x},${y}) rotate(${-(p.yaw_deg[index] || 0)})`);
    if ((body.x_max_m - body.x_min_m) * k > 16) {
      g.append("rect").attr("class", "vehicle").attr("x", body.x_min_m * k).attr("y", -body.y_max_m * k).attr("width", (body.x_max_m - body.x_min_m) * k).attr("height", (body.y_max_m - body.y_min_m) * k).attr("rx", 2);
      for (const wheel of VEHICLE.wheels) {
        const steer = wheel.steered ? (p.steer_deg[index] || 0) * Math.sign(wheel.x_m - VEHICLE.turn_centre_x_m) : 0;
        g.append("rect").attr("class", "vehicle-wheel").attr("x", -VEHICLE.wheel_radius_m * k).attr("y", -VEHICLE.wheel_width_m * k / 2).attr("width", 2 * VEHICLE.wheel_radius_m * k).attr("height", VEHICLE.wheel_width_m * k)
          .attr("transform", `translate(${wheel.x_m * k},${-wheel.y_m * k}) rotate(${-steer})`);
      }
      g.append("path").attr("class", "vehicle").attr("d", `M${body.x_max_m * k + 3},-4L${body.x_max_m * k + 10},0L${body.x_max_m * k + 3},4Z`);
    } else {
      g.append("path").attr("class", "marker-dot").attr("d", "M-7,-6.5L10,0L-7,6.5L-3.5,0Z");
    }
  }

  // ---- pointing and keys

  /// The point of a visible path nearest to a pixel, within reach.
  function nearestPoint(pixel, reach_px) {
    let best = null, nearest = reach_px;
    for (const path of view.paths.filter(p => p.visible)) {
      for (let i = 0; i < path.length; ++i) {
        if (!isKnown(path.points.x_m[i]) || !isKnown(path.points.y_m[i])) continue;
        const [x, y] = screen(path.points.x_m[i], path.points.y_m[i]), d = Math.hypot(x - pixel[0], y - pixel[1]);
        if (d < nearest - (path === view.selected ? 0 : 1e-9)) [best, nearest] = [{path, index: i}, d];
      }
    }
    return best;
  }

  function nearestMark(pixel) {
    const found = shownMarks().map(state => {
      const [x, y] = screen(state.x_m, state.y_m);
      return {state, distance: Math.hypot(x - pixel[0], y - pixel[1])};
    }).filter(m => m.distance < 11);
    return found.length ? found.reduce((a, b) => (a.distance <= b.distance ? a : b)).state : null;
  }

  function showTooltip(pixel, nodes) {
    tooltip.hidden = !nodes;
    if (!nodes) return;
    tooltip.replaceChildren(...nodes);
    const left = pixel[0] + 16 + tooltip.offsetWidth > size.width ? pixel[0] - 12 - tooltip.offsetWidth : pixel[0] + 16;
    tooltip.style.left = `${Math.max(4, left)}px`;
    tooltip.style.top = `${Math.max(4, Math.min(pixel[1] + 12, size.height - tooltip.offsetHeight - 4))}px`;
  }

  function pathTooltip({path, index}) {
    const lines = stateAt(path, index).slice(0, 13).map(([name, text, alarm]) => element("div", {class: alarm ? "alarm" : null}, `${name}: ${text}`));
    return [element("b", {}, `Path ${path.label}`), ...lines];
  }

  svg.on("mousemove", () => {
    const pixel = d3.mouse(svg.node()), [x_m, y_m] = mapPoint(pixel), near = nearestPoint(pixel, 16), i = TERRAIN.indexAt(x_m, y_m);
    byId("map-pointer").textContent = i < 0 ? "" : `At the pointer: ${place(x_m, y_m)}, ${Number.isNaN(TERRAIN.height_m[i]) ? "elevation unknown" : `z\u00a0=\u00a0${fixed(TERRAIN.height_m[i], 1, "m")}`}, ${TERRAIN.soil[i] < 0 ? "no soil known: forbidden" : soilName(TERRAIN.soil[i])}.`;
    if (near) setCursor(near.path, near.index);
    showTooltip(pixel, near ? pathTooltip(near) : null);
    const mark = near ? null : nearestMark(pixel);
    svg.style("cursor", near || mark ? "pointer" : "grab");
  }).on("mouseleave", () => { tooltip.hidden = true; byId("map-pointer").textContent = ""; })
    .on("click", () => {
      const pixel = d3.mouse(svg.node()), near = nearestPoint(pixel, 16), mark = nearestMark(pixel);
      host.focus({preventScroll: true});
      if (mark) { chooseMark(mark); return; }
      if (near) { select(near.path); setCursor(near.path, near.index); }
    });

  host.addEventListener("keydown", event => {
    const move = {ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60]}[event.key];
    if (event.target !== host || event.ctrlKey || event.metaKey || event.altKey) return;
    if (move) svg.call(zoom.translateBy, move[0] / transform.k, move[1] / transform.k);
    else if (event.key === "+" || event.key === "=") svg.call(zoom.scaleBy, 1.4);
    else if (event.key === "-") svg.call(zoom.scaleBy, 1 / 1.4);
    else if (event.key === "0") showPaths();
    else if (event.key === "1") showAll();
    else return;
    event.preventDefault();
  });

  const button = (text, name, act) => {
    const node = element("button", {type: "button", title: name, "aria-label": name}, text);
    node.addEventListener("click", act);
    return node;
  };
  host.append(element("div", {class: "buttons screen-only"}, button("+", "Zoom in", () => svg.call(zoom.scaleBy, 1.5)),
    button("\u2212", "Zoom out", () => svg.call(zoom.scaleBy, 1 / 1.5)), button("Paths", "Show the paths", showPaths), button("All", "Show the whole map", showAll)));

  onWidth(host, resize);
  onThemeChange(() => { pictures.shade = null; redraw(); });
  view.events.on("selected.map", drawPaths).on("visible.map", drawPaths).on("cursor.map", drawMarker)
    .on("marks.map", redraw).on("layers.map", redraw).on("goto.map", place => { show([[place.x_m - 15, place.y_m - 15], [place.x_m + 15, place.y_m + 15]]); host.scrollIntoView({block: "nearest"}); });
  return {contour_interval_m: contours.interval_m, stretch};
}

function chooseMark(state) {
  view.mark = state;
  view.events.call("marks");
}
