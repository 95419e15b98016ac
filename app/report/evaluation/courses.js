// A drawing of each path or manoeuvre, coloured by its margin.
const COURSE_HEIGHT = 190;
const courseColour = marginColours(
    REPORT.margin_min,
    d3.max(COURSES.flatMap(course => course.line.margin).filter(isKnown)) || 0.5);

/// Draws into the rooms that the page has for them, in the order of the paths.
function courses(hosts) { hosts.forEach((host, k) => host.append(courseFigure(COURSES[k]))); }

function courseFigure(course) {
  const {line, plane} = course;
  const ground =
      plane ? `on a slope of ${fixed(plane.slope_deg, 1, '\u00b0')}` : 'on the map, north up';
  return figure(
             {
               title: `${course.rank} ${course.name}`,
               said: () => `The course ${course.name} ${ground}. ` +
                   rangesText([{name: 'margin', values: line.margin, decimals: 3}]),
               data: () => ({
                 columns: ['x_m', 'y_m', 'yaw_deg', 'margin'],
                 rows: line.x_m.map(
                     (_, i) => [line.x_m[i], line.y_m[i], line.yaw_deg[i], line.margin[i]])
               })
             },
             (svg, width) => drawCourse(svg, width, course))
      .node;
}

/// A turn on the spot as the arc that its nose sweeps; its radius has no meaning.
function coursePlaces({line, plane}) {
  if (!plane || !plane.on_the_spot) return line.x_m.map((x_m, i) => [x_m, line.y_m[i]]);
  const unrolled = unwrapped(line.yaw_deg);
  return unrolled.map(
      yaw_deg => [Math.cos(yaw_deg * Math.PI / 180), Math.sin(yaw_deg * Math.PI / 180)]);
}

/// Headings without jumps of a full turn.
function unwrapped(yaw_deg) {
  let turns = 0;
  return yaw_deg.map((yaw, i) => {
    if (i && Math.abs(yaw - yaw_deg[i - 1]) > 180) turns -= Math.sign(yaw - yaw_deg[i - 1]);
    return yaw + 360 * turns;
  });
}

function drawCourse(svg, width, course) {
  const box = chartBox(svg, width, COURSE_HEIGHT, {left: 22, right: 22, top: 18, bottom: 30});
  const places = coursePlaces(course), {line, plane, limiting, refused} = course;
  const known = places.filter(p => p.every(isKnown));
  if (!known.length) return [];
  const screen = courseFrame(box, plane && plane.on_the_spot ? [...known, [0, 0]] : known);
  for (let i = 0; i + 1 < places.length; ++i) {
    const [a, b] = [screen(places[i]), screen(places[i + 1])];
    svg.append('line')
        .attr('x1', a[0])
        .attr('y1', a[1])
        .attr('x2', b[0])
        .attr('y2', b[1])
        .attr('stroke-width', 4)
        .attr('stroke-linecap', 'round')
        .attr('stroke', courseColour(Math.min(line.margin[i], line.margin[i + 1])));
  }
  drawCourseStart(svg, screen(places[0]), line.yaw_deg[0]);
  if (plane && plane.slope_deg) drawUphill(svg, width, plane);
  const marks = [];
  if (plane && plane.on_the_spot) {
    svg.append('circle')
        .attr('class', 'path-end')
        .attr('r', 4)
        .attr('transform', `translate(${screen([0, 0])})`);
  } else {
    drawLength(svg, box, screen);
    marks.push(courseMark(svg, screen, limiting, 'O', 'The margin is smallest here.'));
    if (refused)
      marks.push(
          courseMark(svg, screen, refused, '\u2715', `Refused here for ${words(refused.reason)}.`));
  }
  return marks.filter(Boolean);
}

/// Maps places into the box, one scale on both axes. Also tells pixels per metre.
function courseFrame(box, places) {
  const [west, east] = d3.extent(places, p => p[0]), [south, north] = d3.extent(places, p => p[1]);
  const k = Math.min(
      (box.right - box.left) / Math.max(east - west, 1e-3),
      (box.bottom - box.top) / Math.max(north - south, 1e-3));
  const screen = ([x_m, y_m]) =>
      [(box.left + box.right) / 2 + k * (x_m - (west + east) / 2),
       (box.top + box.bottom) / 2 - k * (y_m - (south + north) / 2)];
  screen.pixelsPerMetre = k;
  return screen;
}

function drawCourseStart(svg, [x, y], yaw_deg) {
  svg.append('path')
      .attr('d', 'M-6,-6L8,0L-6,6L-3,0Z')
      .attr('class', 'course-start')
      .attr('transform', `translate(${x},${y}) rotate(${- (yaw_deg || 0)})`);
}

function drawUphill(svg, width, {slope_deg, uphill_deg}) {
  svg.append('path')
      .attr('d', 'M-9,0H8M3,-5L9,0L3,5')
      .attr('class', 'uphill')
      .attr('transform', `translate(${width - 16},16) rotate(${- uphill_deg})`);
  svg.append('text')
      .attr('x', width - 32)
      .attr('y', 20)
      .attr('text-anchor', 'end')
      .text(`uphill, ${fixed(slope_deg, 1, '\u00b0')}`);
}

function drawLength(svg, box, screen) {
  const k = screen.pixelsPerMetre, span_m = d3.tickStep(0, 90 / k, 1.5), y = box.height - 8;
  svg.append('path').attr('class', 'length-bar').attr('d', `M4,${y - 4}V${y}h${span_m * k}v-4`);
  svg.append('text').attr('x', 10 + span_m * k).attr('y', y + 1).text(`${significant(span_m)} m`);
}

function courseMark(svg, screen, {x_m, y_m}, sign, text) {
  if (!isKnown(x_m) || !isKnown(y_m)) return null;
  const [x, y] = screen([x_m, y_m]);
  if (sign === 'O')
    svg.append('circle').attr('class', 'path-end').attr('r', 6).attr('cx', x).attr('cy', y);
  else
    svg.append('text').attr('class', 'refused').attr('x', x).attr('y', y).text(sign);
  return {x, y, text};
}
