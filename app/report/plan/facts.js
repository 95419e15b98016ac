// How the answer was reached: limits, vehicle, soils, search. Every number as it was used.
function factTable(title, rows, wide = false) {
  const body =
      rows.filter(row => row[1] !== null)
          .map(
              ([name, value]) =>
                  element('tr', {}, element('th', {scope: 'row'}, name), element('td', {}, value)));
  return element(
      'div', {class: wide ? 'wide' : null}, element('h3', {}, title),
      element('table', {}, element('tbody', {}, ...body)));
}

const withUnit = (key, value) => {
  const {name, unit} = nameAndUnit(key);
  return [
    capital(name), significant(value) + (unit ? (unit === '\u00b0' ? '' : '\u00a0') + unit : '')
  ];
};

function soilTable() {
  const soils = MAP.soils;
  const rows = soils.length ? soils[0].parameters.map((parameter, k) => {
    const {name, unit} = nameAndUnit(parameter.name);
    return [
      name + (unit ? ` (${unit})` : ''), ...soils.map(soil => {
        const {mean, std} = soil.parameters[k];
        return significant(mean) + (std ? `\u00a0\u00b1\u00a0${significant(std, 3)}` : '');
      })
    ];
  }) :
                              [];
  const swatch = k => {
    const node = element('span', {class: 'swatch', 'aria-hidden': 'true'});
    node.style.background = soilColour(k);
    return node;
  };
  const columns = [
    {text: 'mean \u00b1 standard deviation'},
    ...soils.map((soil, k) => ({text: element('span', {}, swatch(k), soil.name), number: true}))
  ];
  const codes = soil => MAP.classes.filter(c => c.soil === soil.name).map(c => c.code).join(', ');
  const sources = soils.map(
      soil => element(
          'li', {}, element('b', {}, soil.name), codes(soil) ? ` (class ${codes(soil)})` : '',
          `: ${soil.source || 'no source is given'}`));
  return element(
      'div', {class: 'wide'}, element('h3', {}, 'Soils'),
      element(
          'div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Table of soils'},
          table(null, columns, rows)),
      element(
          'ul', {class: 'note'}, ...sources,
          element('li', {}, `Where no class is mapped: ${MAP.unmapped}.`)));
}

function facts(host) {
  const {problem} = PLAN, {search, vehicle, start, goal, limits} = problem;
  const wheels = vehicle.wheels;
  const heading = 'heading_deg' in goal ?
      ` heading ${fixed(goal.heading_deg, 1, '\u00b0')} \u00b1 ${
          fixed(goal.heading_tolerance_deg, 1, '\u00b0')}` :
      '';
  host.append(
      factTable('Limits in force', [...Object.entries(limits).map(
                                       ([key, value]) => withUnit(key, value))]),
      factTable(
          'Query and search',
          [
            [
              'Start',
              `${place(start.x_m, start.y_m)}, heading ${fixed(start.heading_deg, 1, '\u00b0')}, ${
                  fixed(start.speed_mps, 2, 'm/s')}`
            ],
            [
              'Goal',
              `${place(goal.x_m, goal.y_m)}, within ${fixed(goal.radius_m, 2, 'm')}${heading}`
            ],
            ['Planner', search.planner],
            [
              'Budget',
              'iterations' in search ? `${integer(search.iterations)} iterations of each planner` :
                                       fixed(search.time_s, 1, 's')
            ],
            [
              'Asked for',
              `${integer(search.candidates)} candidates, ${
                  integer(search.soil_draws)} soil draws each`
            ],
            ['Seed', String(PLAN.seed)],
            ['Propagations', `${integer(PLAN.propagations)} integrator steps of the vehicle`],
            [
              'Time',
              `${SECONDS(PLAN.planning_time_s)} searching and verifying, ${
                  SECONDS(PLAN.verification_time_s)} more improving and drawing soils`
            ],
            ...PLAN.before_search.length === 0 ? [] : [[
              'Before the search',
              PLAN.before_search.map(part => `${part.step} ${SECONDS(part.time_s)}`).join(', ')
            ]],
            ['Threads', integer(search.threads)], ['Program', `regoplan ${PLAN.version}`]
          ]),
      factTable(
          'Vehicle',
          [
            ['Name', vehicle.name],
            [
              'Mass',
              `${significant(vehicle.mass_kg)}\u00a0kg, weighing ${fixed(WEIGHT_N, 0, 'N')} here`
            ],
            withUnit('yaw_inertia_kgm2', vehicle.yaw_inertia_kgm2),
            ['Centre of gravity', fixed(vehicle.cg_height_m, 2, 'm') + ' high'],
            [
              'Wheels',
              `${wheels.length} (${wheels.filter(w => w.steered).length} steered, ${
                  wheels.filter(w => w.driven).length} driven), radius ${
                  fixed(vehicle.wheel_radius_m, 3, 'm')}, width ${
                  fixed(vehicle.wheel_width_m, 3, 'm')}`
            ],
            ['Suspension', words(vehicle.suspension)], ['Drive law', words(vehicle.drive_law)],
            withUnit('speed_max_mps', vehicle.speed_max_mps),
            withUnit('acceleration_max_mps2', vehicle.acceleration_max_mps2),
            withUnit('curvature_max_1pm', vehicle.curvature_max_1pm),
            withUnit('steer_angle_max_deg', vehicle.steer_angle_max_deg),
            withUnit('step_max_m', vehicle.step_max_m),
            ['Source', vehicle.source || 'no source is given']
          ]),
      factTable(
          'Ground and wheel model',
          [
            ['Gravity', significant(problem.gravity_mps2, 6) + '\u00a0m/s\u00b2'],
            [
              'Wheel model',
              `${problem.wheel_variant} (Yoshida & Ishigami 2004${
                  problem.wheel_variant === 'ishigami2007' ?
                      ', sinkage solved for the load at every slip' :
                      ', sinkage as printed, h0 + c0 s'})`
            ],
            [
              'Elevation',
              `${integer(MAP.columns)} \u00d7 ${integer(MAP.rows)} cells of ${
                  significant(
                      MAP.cell_width_m)}\u00a0m \u00d7 ${significant(MAP.cell_height_m)}\u00a0m, ${
                  fixed(MAP.raster.elevation.min_m, 1)} to ${
                  fixed(MAP.raster.elevation.max_m, 1, 'm')}` +
                  (MAP.raster.cells_averaged > 1 ?
                       `; drawn here as means of ${MAP.raster.cells_averaged} \u00d7 ${
                           MAP.raster.cells_averaged} cells` :
                       '')
            ],
            ['Coordinates', MAP.crs || 'the file names no reference system'],
            [
              'Rocks',
              integer(MAP.rocks_total) +
                  (MAP.rocks_total > MAP.rocks.length ?
                       `, the largest ${integer(MAP.rocks.length)} of them drawn here` :
                       '')
            ],
            ['Certificate', PLAN.certificate]
          ]),
      soilTable());
}
