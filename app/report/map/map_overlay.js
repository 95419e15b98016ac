// Paths, places, the vehicle, axes and scale bar in SVG over the terrain.
function mapOverlay(svg, frame) {
  svg.append('clipPath').attr('id', 'plot').append('rect');
  const over = svg.append('g').attr('clip-path', 'url(#plot)');
  const pathLayer = over.append('g');
  const placeLayer = over.append('g');
  const markerLayer = over.append('g').attr('pointer-events', 'none');
  const axisGroups = [svg.append('g').attr('class', 'axis'), svg.append('g').attr('class', 'axis')];
  const scaleBar = svg.append('g').attr('class', 'scale-bar');

  function resize() {
    svg.attr('viewBox', `0 0 ${frame.width} ${frame.height}`);
    svg.select('#plot rect')
        .attr('x', frame.left)
        .attr('y', frame.top)
        .attr('width', frame.plotWidth)
        .attr('height', frame.plotHeight);
    drawPaths();
  }

  /// A path as runs of one colour.
  function pieces(path) {
    const {x_m, y_m} = path.points, values = path.points[view.pathColour.key];
    const list = [];
    for (let i = 0; i + 1 < path.length; ++i) {
      if (![x_m[i], y_m[i], x_m[i + 1], y_m[i + 1]].every(isKnown)) continue;
      const colour = pieceColour(values[i], values[i + 1]);
      const end = frame.base(x_m[i + 1], y_m[i + 1]);
      const last = list[list.length - 1];
      if (last && last.colour === colour && last.end === i) {
        last.points.push(end);
        last.end = i + 1;
      } else {
        const points = [frame.base(x_m[i], y_m[i]), end];
        list.push({end: i + 1, colour, points});
      }
    }
    return list;
  }

  function drawPaths() {
    const shown = view.paths.filter(p => p.visible && p.length)
                      .sort(
                          (a, b) => Boolean(a.guide) - Boolean(b.guide) ||
                              (a === view.selected) - (b === view.selected) || b.rank - a.rank);
    const groups = pathLayer.selectAll('g.path')
                       .data(shown, p => p.label)
                       .join('g')
                       .attr('class', 'path')
                       .order();
    groups.each(function(path) {
      const chosen = path === view.selected, runs = pieces(path), line = d3.line();
      const outline = runs.map(run => line(run.points)).join('');
      const group = d3.select(this);
      group.selectAll('*').remove();
      if (path.guide) {
        group.append('path')
            .attr('class', 'guide')
            .attr('d', outline)
            .attr('vector-effect', 'non-scaling-stroke');
        return;
      }
      group.append('path')
          .attr('class', 'casing')
          .attr('d', outline)
          .attr('vector-effect', 'non-scaling-stroke')
          .attr('stroke-width', chosen ? 7.6 : 5)
          .attr('stroke-opacity', chosen ? 0.95 : 0.7);
      group.selectAll('path.piece')
          .data(runs)
          .join('path')
          .attr('class', 'piece')
          .attr('d', run => line(run.points))
          .attr('stroke', run => run.colour)
          .attr('vector-effect', 'non-scaling-stroke')
          .attr('stroke-width', chosen ? 5 : 3.4)
          .attr('stroke-dasharray', path.verified_path && !path.relaxed ? null : '6 5');
    });
    arrange();
  }

  function arrange() {
    pathLayer.attr('transform', frame.transform);
    placeLayer.selectAll('*').remove();
    const {start, goal} = PLAN.problem;
    const [sx, sy] = frame.screen(start.x_m, start.y_m);
    const [gx, gy] = frame.screen(goal.x_m, goal.y_m);
    placeLayer.append('circle')
        .attr('class', 'goal-ring')
        .attr('cx', gx)
        .attr('cy', gy)
        .attr('r', Math.max(5, goal.radius_m * frame.pixelsPerMetre()));
    placeLayer.append('path')
        .attr('class', 'place')
        .attr('d', 'M-6,-6L9,0L-6,6L-3,0Z')
        .attr('transform', `translate(${sx},${sy}) rotate(${- start.heading_deg})`);
    placeLayer.append('path')
        .attr('class', 'place')
        .attr('d', 'M0,0V-17L11,-13L0,-9')
        .attr('transform', `translate(${gx},${gy})`);
    label('Start', sx, sy + 20);
    label(goal.label || 'Goal', gx, gy + 16);
    drawNamed();
    const labelled = [];
    for (const path of view.paths.filter(p => p.visible && p.length)) {
      const share = path.verified_path ? 0.35 + 0.3 * ((path.rank * 0.382) % 1) : 0.5,
            i = Math.round(share * (path.length - 1));
      if (isKnown(path.points.x_m[i]) && isKnown(path.points.y_m[i]))
        labelPath(
            path.verified_path ? path.label : path.label.replace('overturned ', '\u2715'),
            ...frame.screen(path.points.x_m[i], path.points.y_m[i]), labelled);
    }
    for (const w of PLAN.what_ifs) {
      if (!w.driven || !w.driven.length) continue;
      placeLayer.append('path')
          .attr('class', 'driven')
          .attr('d', d3.line()(w.driven.map(([x_m, y_m]) => frame.screen(x_m, y_m))))
          .append('title')
          .text(w.question);
    }
    PLAN.what_ifs.forEach((w, k) => {
      if (w.feasible || !isKnown(w.x_m) || !isKnown(w.y_m)) return;
      const [x, y] = frame.screen(w.x_m, w.y_m);
      const g = placeLayer.append('g').attr('class', 'what-if');
      g.attr('transform', `translate(${x},${y})`);
      g.append('title').text(`${w.question}: rejected${w.reason ? ' for ' + words(w.reason) : ''}`);
      g.append('path')
          .attr('d', 'M0,0V-15')
          .attr('stroke', cssVar('--alarm'))
          .attr('stroke-width', 2);
      g.append('circle').attr('cy', -24).attr('r', 9.5);
      g.append('text').attr('y', -24).text(letter(k));
    });
    if (view.mark) {
      const [x, y] = frame.screen(view.mark.x_m, view.mark.y_m);
      placeLayer.append('circle')
          .attr('class', 'mark-chosen')
          .attr('cx', x)
          .attr('cy', y)
          .attr('r', 9);
    }
    drawAxes();
    drawMarker();
  }

  /// Zones in outline, marks that lie over the paths, and names one below the other.
  function drawNamed() {
    for (const {name, corners} of view.zones) {
      const outline = corners.map(([x_m, y_m]) => frame.screen(x_m, y_m));
      placeLayer.append('path').attr('class', 'zone').attr('d', `${d3.line()(outline)}Z`);
      label(name, ...d3.polygonCentroid(outline));
    }
    for (const state of view.marksOver ? shownMarks() : []) {
      const [x, y] = frame.screen(state.x_m, state.y_m);
      placeLayer.append('path')
          .attr('class', 'mark-over')
          .attr('d', symbolPath(state.reason, 60))
          .attr('fill', reasonStyle(state.reason).colour)
          .attr('transform', `translate(${x},${y})`);
    }
    const named = [];
    for (const {x_m, y_m, text} of view.named) {
      let [x, y] = frame.screen(x_m, y_m);
      while (named.some(([nx, ny]) => Math.abs(nx - x) < 80 && Math.abs(ny - y) < 14)) y += 14;
      named.push([x, y]);
      label(text, x, y, 12, 14);
    }
  }

  /// Beside a path; on narrow screens below the labels that stand there already.
  function labelPath(text, x, y, labelled) {
    const width = 9 * text.length;
    const covers = other =>
        Math.abs(other.y - y) < 14 && x < other.x + other.width && other.x < x + width;
    while (labelled.some(covers)) y += 14;
    labelled.push({x, y, width});
    label(text, x, y, 9, -7);
  }

  function label(text, x, y, dx = 0, dy = 0) {
    placeLayer.append('text')
        .attr('class', 'label')
        .attr('text-anchor', dx ? 'start' : 'middle')
        .attr('x', x + dx)
        .attr('y', y + dy)
        .text(text);
  }

  /// To which the letters of a picture are drawn.
  const ROUNDING_PX = 1;

  function drawAxes() {
    const [west, north] = frame.mapPoint([frame.left, frame.top]);
    const [east, south] =
        frame.mapPoint([frame.left + frame.plotWidth, frame.top + frame.plotHeight]);
    const x =
        d3.scaleLinear().domain([west, east]).range([frame.left, frame.left + frame.plotWidth]);
    const y =
        d3.scaleLinear().domain([south, north]).range([frame.top + frame.plotHeight, frame.top]);
    const plain = scale => {
      const ticks = scale.ticks(6);
      return d3.format(`.${d3.precisionFixed(ticks.length > 1 ? ticks[1] - ticks[0] : 1)}f`);
    };
    axisGroups[0]
        .attr('transform', `translate(0,${frame.top + frame.plotHeight})`)
        .call(d3.axisBottom(x)
                  .ticks(Math.max(2, Math.min(8, frame.width / 110)))
                  .tickSize(4)
                  .tickFormat(plain(x)))
        .selectAll('text')
        // The map goes to the edge of its picture: half of a number at its end would be cut off.
        .attr('text-anchor', function(place_m) {
          const half_px = this.getComputedTextLength() / 2 + ROUNDING_PX;
          return x(place_m) + half_px > frame.width ? 'end' : 'middle';
        });
    axisGroups[1]
        .attr('transform', `translate(${frame.left},0)`)
        .call(d3.axisLeft(y).ticks(6).tickSize(4).tickFormat(plain(y)))
        .selectAll('text')
        .attr('dy', function(north_m) {
          const half_px = this.getBBox().height / 2 + ROUNDING_PX;
          return y(north_m) - half_px < frame.top ? '0.95em' : '0.32em';
        });
    const span_m = d3.tickStep(0, 130 / frame.pixelsPerMetre(), 1.5),
          length = span_m * frame.pixelsPerMetre();
    scaleBar.selectAll('*').remove();
    scaleBar.attr(
        'transform',
        `translate(${frame.left + frame.plotWidth - length - 14},${
            frame.top + frame.plotHeight - 12})`);
    scaleBar.append('rect')
        .attr('x', -28)
        .attr('y', -22)
        .attr('width', length + 34)
        .attr('height', 29)
        .attr('rx', 3)
        .attr('fill', cssVar('--panel'))
        .attr('opacity', 0.82);
    scaleBar.append('path').attr('d', `M0,-5V0H${length}V-5`);
    scaleBar.append('text')
        .attr('x', length / 2)
        .attr('y', -8)
        .attr('text-anchor', 'middle')
        .text(span_m >= 1 ? `${span_m} m` : `${Math.round(span_m * 100)} cm`);
    scaleBar.append('path').attr('class', 'north').attr('d', 'M-17,-9L-12,4L-17,1L-22,4Z');
    scaleBar.append('text').attr('x', -17).attr('y', -11).attr('text-anchor', 'middle').text('N');
  }

  /// The vehicle at the marker: its body and wheels to scale where that can be seen, else a dot.
  function drawMarker() {
    markerLayer.selectAll('*').remove();
    if (!view.cursor || !view.cursor.path.visible) return;
    const {path, index} = view.cursor, p = path.points, k = frame.pixelsPerMetre(),
                 {body} = VEHICLE;
    if (!isKnown(p.x_m[index]) || !isKnown(p.y_m[index])) return;
    const [x, y] = frame.screen(p.x_m[index], p.y_m[index]);
    const g = markerLayer.append('g').attr(
        'transform', `translate(${x},${y}) rotate(${- (p.yaw_deg[index] || 0)})`);
    if ((body.x_max_m - body.x_min_m) * k > 16) {
      drawVehicle(g, k, p.curvature_1pm[index]);
    } else {
      g.append('path').attr('class', 'marker-dot').attr('d', 'M-7,-6.5L10,0L-7,6.5L-3.5,0Z');
    }
  }

  return {resize, drawPaths, drawMarker, arrange};
}
