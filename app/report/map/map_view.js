// The map: terrain and overlay under one pan and zoom; pointing and keys.
function mapView(host) {
  const frame = mapFrame();
  const node = d3.select(host).append('canvas').attr('aria-hidden', 'true').node();
  const svg = d3.select(host).append('svg').attr('aria-hidden', 'true');
  const tooltip = host.appendChild(element('div', {class: 'tooltip', hidden: true}));
  const canvas = mapCanvas(node, frame);
  const overlay = mapOverlay(svg, frame);
  let waiting = 0, shown = false;

  function zoomed() {
    frame.transform = d3.event.transform;
    redraw();
  }

  /// The wheel scrolls the page until the map is chosen; one finger scrolls the page as well.
  function zooms() {
    const event = d3.event;
    if (event.type === 'wheel')
      return event.ctrlKey || event.metaKey || document.activeElement === host;
    if (event.type.startsWith('touch')) return event.touches.length > 1;
    return !event.button;
  }

  const zoom = d3.zoom().on('zoom', zoomed).filter(zooms);
  svg.call(zoom).style('touch-action', 'pan-x pan-y').on('dblclick.zoom', null);

  const show = places => svg.call(zoom.transform, frame.showing(places));
  const showAll = () => svg.call(zoom.transform, d3.zoomIdentity);

  function showPaths() {
    const {start, goal} = PLAN.problem;
    const r = Math.max(goal.radius_m || 0, 3);
    const places = [
      [start.x_m, start.y_m],
      [goal.x_m - r, goal.y_m - r],
      [goal.x_m + r, goal.y_m + r],
    ];
    for (const path of view.paths.filter(p => p.visible))
      path.points.x_m.forEach((x_m, i) => places.push([x_m, path.points.y_m[i]]));
    show(places.filter(p => isKnown(p[0]) && isKnown(p[1])));
  }

  function resize(width) {
    frame.resize(width);
    host.style.aspectRatio = `${width} / ${frame.height}`;
    const right = frame.left + frame.plotWidth;
    const bottom = frame.top + frame.plotHeight;
    zoom.extent([[frame.left, frame.top], [right, bottom]])
        .scaleExtent([0.8, 200])
        .translateExtent([
          [frame.left - 0.3 * frame.plotWidth, frame.top - 0.3 * frame.plotHeight],
          [right + 0.3 * frame.plotWidth, bottom + 0.3 * frame.plotHeight],
        ]);
    canvas.resize();
    overlay.resize();
    showPaths();
    // At once: a resized canvas is empty. Before the first frame nobody sees that.
    if (shown) canvas.draw();
  }

  function redraw() {
    overlay.arrange();
    if (waiting) return;
    waiting = requestAnimationFrame(() => {
      waiting = 0;
      shown = true;
      canvas.draw();
    });
  }

  function keepInView({path, index}) {
    const x_m = path.points.x_m[index], y_m = path.points.y_m[index];
    const [x, y] = frame.screen(x_m, y_m);
    const inside = x > frame.left && x < frame.left + frame.plotWidth && y > frame.top &&
        y < frame.top + frame.plotHeight;
    if (!inside && isKnown(x) && isKnown(y)) svg.call(zoom.translateTo, ...frame.base(x_m, y_m));
  }

  /// The point of a visible path nearest to a pixel, within reach.
  function nearestPoint(pixel, reach_px) {
    let best = null, nearest = reach_px;
    for (const path of view.paths.filter(p => p.visible && !p.guide)) {
      for (let i = 0; i < path.length; ++i) {
        if (!isKnown(path.points.x_m[i]) || !isKnown(path.points.y_m[i])) continue;
        const [x, y] = frame.screen(path.points.x_m[i], path.points.y_m[i]);
        const d = Math.hypot(x - pixel[0], y - pixel[1]);
        if (d < nearest - (path === view.selected ? 0 : 1e-9))
          [best, nearest] = [{path, index: i}, d];
      }
    }
    return best;
  }

  function nearestMark(pixel) {
    const found = shownMarks()
                      .map(state => {
                        const [x, y] = frame.screen(state.x_m, state.y_m);
                        return {state, distance: Math.hypot(x - pixel[0], y - pixel[1])};
                      })
                      .filter(m => m.distance < 11);
    return found.length ? found.reduce((a, b) => (a.distance <= b.distance ? a : b)).state : null;
  }

  function showTooltip(pixel, nodes) {
    tooltip.hidden = !nodes;
    if (!nodes) return;
    tooltip.replaceChildren(...nodes);
    const left = pixel[0] + 16 + tooltip.offsetWidth > frame.width ?
        pixel[0] - 12 - tooltip.offsetWidth :
        pixel[0] + 16;
    tooltip.style.left = `${Math.max(4, left)}px`;
    tooltip.style.top =
        `${Math.max(4, Math.min(pixel[1] + 12, frame.height - tooltip.offsetHeight - 4))}px`;
  }

  function pathTooltip({path, index}) {
    const lines = stateAt(path, index)
                      .slice(0, 13)
                      .map(
                          ([name, text, alarm]) =>
                              element('div', {class: alarm ? 'alarm' : null}, `${name}: ${text}`));
    return [element('b', {}, `Path ${path.label}`), ...lines];
  }

  /// What lies at a pixel of the ground, in words.
  function groundAt(pixel) {
    const [x_m, y_m] = frame.mapPoint(pixel);
    const i = TERRAIN.indexAt(x_m, y_m);
    if (i < 0) return '';
    const z_m = TERRAIN.height_m[i];
    const height = Number.isNaN(z_m) ? 'elevation unknown' : `z\u00a0=\u00a0${fixed(z_m, 1, 'm')}`;
    const soil = TERRAIN.soil[i] < 0 ? 'no soil known: forbidden' : soilName(TERRAIN.soil[i]);
    return `At the pointer: ${place(x_m, y_m)}, ${height}, ${soil}${groundText(x_m, y_m)}.`;
  }

  function pointed() {
    const pixel = d3.mouse(svg.node());
    const near = nearestPoint(pixel, 16);
    byId('map-pointer').textContent = groundAt(pixel);
    if (near) setCursor(near.path, near.index);
    showTooltip(pixel, near ? pathTooltip(near) : null);
    svg.style('cursor', near || nearestMark(pixel) ? 'pointer' : 'grab');
  }

  function left() {
    showTooltip(null, null);
    byId('map-pointer').textContent = '';
  }

  function clicked() {
    const pixel = d3.mouse(svg.node());
    const near = nearestPoint(pixel, 16);
    const mark = nearestMark(pixel);
    host.focus({preventScroll: true});
    if (mark) {
      chooseMark(mark);
    } else if (near) {
      select(near.path);
      setCursor(near.path, near.index);
    }
  }

  svg.on('mousemove', pointed).on('mouseleave', left).on('click', clicked);

  const move = (x, y) => svg.call(zoom.translateBy, x / frame.transform.k, y / frame.transform.k);
  const scale = factor => svg.call(zoom.scaleBy, factor);
  const keys = {
    'ArrowLeft': () => move(60, 0),
    'ArrowRight': () => move(-60, 0),
    'ArrowUp': () => move(0, 60),
    'ArrowDown': () => move(0, -60),
    '+': () => scale(1.4),
    '=': () => scale(1.4),
    '-': () => scale(1 / 1.4),
    '0': showPaths,
    '1': showAll,
    ' ': () => view.events.call('playback'),
    ',': () => stepMarker(-1),
    '.': () => stepMarker(1),
  };
  host.addEventListener('keydown', event => {
    const act = keys[event.key];
    if (!act || event.target !== host || event.ctrlKey || event.metaKey || event.altKey) return;
    act();
    event.preventDefault();
  });

  const button = (text, name, act) => {
    const node = element('button', {type: 'button', title: name, 'aria-label': name}, text);
    node.addEventListener('click', act);
    return node;
  };
  host.append(element(
      'div', {class: 'buttons screen-only'}, button('+', 'Zoom in', () => scale(1.5)),
      button('\u2212', 'Zoom out', () => scale(1 / 1.5)),
      button('Paths', 'Show the paths', showPaths), button('All', 'Show the whole map', showAll)));
  host.after(saveMenu(
      'Map', () => 'Map',
      () => ({title: document.title, svg: svg.node(), canvas: node, keys: mapKeys()}), mapData));

  onWidth(host, resize);
  onThemeChange(() => {
    canvas.forgetTheme();
    overlay.arrange();
    canvas.draw();  // at once: a printer does not wait
  });
  view.events.on('selected.map', overlay.drawPaths)
      .on('visible.map', overlay.drawPaths)
      .on('coloured.map', overlay.drawPaths)
      .on('cursor.map',
          () => {
            if (view.playing) keepInView(view.cursor);
            overlay.drawMarker();
          })
      .on('marks.map', redraw)
      .on('layers.map', redraw)
      .on('goto.map', place => {
        show([[place.x_m - 15, place.y_m - 15], [place.x_m + 15, place.y_m + 15]]);
        host.scrollIntoView({block: 'nearest'});
      });
  return canvas;
}

function chooseMark(state) {
  view.mark = state;
  view.events.call('marks');
}

/// What the colours of a saved map mean.
function mapKeys() {
  const three =
      (text, {domain: [low, high], decimals}, colour) => [low, (low + high) / 2, high].map(
          size => ({name: `${text} ${fixed(size, decimals)}`, colour: colour(size), area: true}));
  const layer = chosenGround();
  const ground = layer ?
      three(layer.text.toLowerCase(), layer, layer.colour) :
      LAYERS.ground === 'soils' ?
      MAP.soils.map((soil, k) => ({name: soil.name, colour: soilColour(k), area: true})) :
      [];
  return three(view.pathColour.text.toLowerCase(), view.pathColour, view.pathColour.ramp)
      .concat(ground);
}

/// The points of the paths shown, as drawn.
function mapData() {
  const names = [...new Set(['time_s', 'x_m', 'y_m', 'z_m', 'margin', view.pathColour.key])];
  const shown = view.paths.filter(p => p.visible && p.length);
  return {
    columns: ['path', ...names],
    rows: shown.flatMap(
        path =>
            path.points.time_s.map((_, i) => [path.label, ...names.map(n => path.points[n][i])]))
  };
}
