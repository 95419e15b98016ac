// The vehicle from above, to scale: body, wheels as they are steered, and in a figure of its own
// what decides about it at the marker: loads, lateral demand and supply, margins.

/// Steering angle of a wheel for a path curvature, left positive.
const wheelSteer_deg = (wheel, curvature_1pm) => wheel.steered && isKnown(curvature_1pm) ?
    Math.atan2(
        curvature_1pm * (wheel.x_m - VEHICLE.turn_centre_x_m),
        Math.sqrt(1 - (curvature_1pm * VEHICLE.turn_centre_x_m) ** 2) - curvature_1pm * wheel.y_m) *
        180 / Math.PI :
    0;

/// Draws the vehicle into a group whose x axis is its heading, `k` pixels a metre.
function drawVehicle(group, k, curvature_1pm) {
  const {body, wheel_radius_m: r, wheel_width_m: width} = VEHICLE;
  group.append('rect')
      .attr('class', 'vehicle')
      .attr('x', body.x_min_m * k)
      .attr('y', -body.y_max_m * k)
      .attr('width', (body.x_max_m - body.x_min_m) * k)
      .attr('height', (body.y_max_m - body.y_min_m) * k)
      .attr('rx', 2);
  for (const wheel of VEHICLE.wheels)
    group.append('rect')
        .attr('class', 'vehicle-wheel')
        .attr('x', -r * k)
        .attr('y', -width * k / 2)
        .attr('width', 2 * r * k)
        .attr('height', width * k)
        .attr(
            'transform',
            `translate(${wheel.x_m * k},${- wheel.y_m * k}) rotate(${
                - wheelSteer_deg(wheel, curvature_1pm)})`);
  const nose = body.x_max_m * k;
  group.append('path')
      .attr('class', 'vehicle')
      .attr('d', `M${nose + 3},-4L${nose + 10},0L${nose + 3},4Z`);
}

/// The vehicle at the marker, heading upward.
function vehicleFigure(host) {
  if (!view.selected) {
    host.hidden = true;
    return;
  }
  const at = name => view.cursor.path.points[name][view.cursor.index];
  const loads = VEHICLE.wheels.map(w => ({name: words(w.name), key: `load_${w.name}_n`}));
  const made =
      figure(
          {
            title: 'Vehicle at the marker',
            keys: [
              {name: 'lateral supply', colour: cssVar('--band'), area: true},
              {name: 'demand', colour: cssVar('--series-4')},
            ],
            name: () => `Vehicle on path ${view.cursor.path.label} at ${fixed(at('time_s'), 1)} s`,
            said: () => `Lateral demand ${fixed(at('demand_n'), 0, 'N')} within ${
                fixed(at('supply_min_n'), 0)} to ${
                fixed(at('supply_max_n'), 0, 'N')}, left positive. ${
                loads.map(l => `Load ${l.name} ${fixed(at(l.key), 0, 'N')}`).join('; ')}. ${
                MARGINS.map(m => `${capital(words(m))} margin ${fixed(at(`${m}_margin`), 3)}`)
                    .join('; ')}.`,
            data:
                () => {
                  const names = [
                    'time_s', 'x_m', 'y_m', 'yaw_deg', 'speed_mps', 'curvature_1pm', 'demand_n',
                    'supply_min_n', 'supply_max_n', ...loads.map(l => l.key),
                    ...MARGINS.map(m => `${m}_margin`)
                  ];
                  return {columns: names, rows: [names.map(at)]};
                },
          },
          (svg, width) => {
            if (!view.cursor) return;
            const box = chartBox(svg, width, 336, {left: 8, right: 8, top: 8, bottom: 84});
            drawFromAbove(svg, box, at);
            drawMargins(svg, box, at);
          });
  host.append(made.node);
  view.events.on('cursor.vehicle', made.draw);
}

/// Half of the height of the bar of the supply, and the height of letters beside it.
const SUPPLY_HALF_PX = 9, LETTERS_PX = 11;

/// Where the load of a wheel is written that stands at this height: beside it, or next to the bar of
/// the supply where that lies there.
function loadBaseline(wheel_y) {
  const clear_px = SUPPLY_HALF_PX + 3;
  if (Math.abs(wheel_y) > clear_px + LETTERS_PX / 2) return wheel_y + 4;
  return wheel_y < 0 ? -clear_px : clear_px + LETTERS_PX;
}

/// Body, wheels with their loads, and across the centre of gravity supply and demand.
function drawFromAbove(svg, box, at) {
  const {body} = VEHICLE, middle = (box.left + box.right) / 2;
  // As large as fits with the loads beside the wheels.
  const half_m = d3.max(VEHICLE.wheels, w => Math.abs(w.y_m)) + VEHICLE.wheel_radius_m;
  const k =
      Math.min((box.bottom - box.top - 40) / (body.x_max_m - body.x_min_m), (middle - 54) / half_m);
  const centre_y = (box.top + box.bottom) / 2 + 6 + (body.x_max_m + body.x_min_m) * k / 2;
  const top = svg.append('g').attr('transform', `translate(${middle},${centre_y})`);
  drawVehicle(top.append('g').attr('transform', 'rotate(-90)'), k, at('curvature_1pm'));
  drawLateral(top, (box.right - box.left) / 2 - 6, at);
  for (const wheel of VEHICLE.wheels) {
    const load_n = at(`load_${wheel.name}_n`), side = wheel.y_m > 0 ? -1 : 1;
    top.append('text')
        .attr('class', load_n > 0 || !isKnown(load_n) ? 'load' : 'load alarm')
        .attr('text-anchor', side < 0 ? 'end' : 'start')
        .attr(
            'x',
            -wheel.y_m * k +
                side * (VEHICLE.wheel_width_m * k / 2 + VEHICLE.wheel_radius_m * k * 0.5 + 6))
        .attr('y', loadBaseline(-wheel.x_m * k))
        .text(fixed(load_n, 0, 'N'));
  }
  top.append('text')
      .attr('text-anchor', 'middle')
      .attr('y', -body.x_max_m * k - 16)
      .text(fixed(at('speed_mps'), 2, 'm/s'));
}

/// Supply as a bar and demand as an arrow across the vehicle, on one scale for the whole path.
function drawLateral(top, reach, at) {
  const {points} = view.cursor.path;
  const most = d3.max(['demand_n', 'supply_min_n', 'supply_max_n'].flatMap(
                   name => points[name].filter(isKnown).map(Math.abs))) ||
      1;
  const x = left_n => -left_n / most * reach;  // left is left
  const [low, high, demand] = ['supply_min_n', 'supply_max_n', 'demand_n'].map(at);
  if (isKnown(low) && isKnown(high))
    top.append('rect')
        .attr('class', 'supply')
        .attr('x', x(high))
        .attr('width', x(low) - x(high))
        .attr('y', -SUPPLY_HALF_PX)
        .attr('height', 2 * SUPPLY_HALF_PX)
        .attr('fill', cssVar('--band'))
        .attr('stroke', cssVar('--series-1'));
  if (!isKnown(demand)) return;
  const end = x(demand), head = Math.sign(end) * Math.min(8, Math.abs(end));
  const beyond = demand < low || demand > high;
  top.append('path')
      .attr('class', beyond ? 'demand beyond' : 'demand')
      .attr('d', `M0,0H${end}M${end - head},-5L${end},0L${end - head},5`);
  top.append('circle').attr('class', 'centre').attr('r', 3);
}

/// The three margins as bars from 0, with the limit in force.
function drawMargins(svg, box, at) {
  const left = 74, right = box.right - 44, top = box.bottom + 16;
  const x = d3.scaleLinear().domain([0, 1]).range([left, right]).clamp(true);
  MARGINS.forEach((name, k) => {
    const value = at(`${name}_margin`), y = top + 20 * k;
    svg.append('text').attr('x', 4).attr('y', y + 10).text(words(name));
    svg.append('rect')
        .attr('class', 'bar-ground')
        .attr('x', left)
        .attr('width', right - left)
        .attr('y', y)
        .attr('height', 12);
    if (isKnown(value))
      svg.append('rect')
          .attr('x', left)
          .attr('width', Math.max(1, x(value) - left))
          .attr('y', y)
          .attr('height', 12)
          .attr('fill', marginColour(value));
    svg.append('text').attr('x', right + 6).attr('y', y + 10).text(fixed(value, 2));
  });
  svg.append('line')
      .attr('class', 'limit')
      .attr('x1', x(LIMITS.margin_min))
      .attr('x2', x(LIMITS.margin_min))
      .attr('y1', top - 3)
      .attr('y2', top + 56);
}
