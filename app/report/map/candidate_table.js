// The candidates as a table: choose the path that the charts follow, show and hide paths.
const CANDIDATE_COLUMNS = [
  {text: 'Rank', value: p => p.rank, cell: p => p.label},
  {text: 'Planner', value: p => p.planner, cell: p => p.planner},
  {text: 'Pareto', value: p => (p.pareto && p.verified_path ? 0 : 1), cell: paretoCell},
  {text: 'Length', number: true, value: p => p.length_m, cell: p => fixed(p.length_m, 1, 'm')},
  {text: 'Duration', number: true, value: p => p.duration_s, cell: p => SECONDS(p.duration_s)},
  {text: 'Energy', number: true, value: p => p.energy_j, cell: p => energy(p.energy_j)},
  {
    text: 'Smallest margin',
    number: true,
    value: p => p.margin_min,
    cell: p => marginCell(p.margin_min)
  },
  {text: '5 % margin', number: true, value: p => p.margin_p05, cell: p => marginCell(p.margin_p05)},
  {
    text: 'P(feasible)',
    number: true,
    value: p => p.probability_feasible,
    cell: p => percent(p.probability_feasible)
  },
  {
    text: 'Verified margin',
    number: true,
    value: p => p.verified.margin_min,
    cell: p => marginCell(p.verified.margin_min)
  },
  {
    text: 'Largest deviation',
    number: true,
    value: p => p.verified.max_deviation_m,
    cell: p => fixed(p.verified.max_deviation_m, 2, 'm')
  },
  {text: 'Limiting', wide: true, value: p => p.limiting.margin, cell: limitingCell},
];

function marginCell(margin) {
  const swatch = element('span', {class: 'swatch', 'aria-hidden': 'true'});
  swatch.style.background = marginColour(margin);
  return element('span', {}, swatch, fixed(margin, 3));
}

/// Marks a path that no other beats in smallest margin, duration and energy at once.
function paretoCell(path) {
  if (!path.pareto || !path.verified_path) return '';
  return element(
      'span', {title: 'No other path beats it in margin, duration and energy'}, '\u25c6',
      element('span', {class: 'visually-hidden'}, ' Pareto-best'));
}

function limitingCell(path) {
  const at = path.limiting;
  const where = `${words(at.margin)} at ${fixed(at.x_m, 1)}, ${fixed(at.y_m, 1, 'm')}, ${
      fixed(at.time_s, 1, 's')}`;
  return path.verified_path ?
      where :
      `${where}. Overturned: ${path.verified.reason || 'the replay failed'}`;
}

function candidateTable(host) {
  if (!view.paths.length) {
    host.append(element(
        'p', {},
        PLAN.status === 'feasible' ?
            'There is no path: the vehicle stands in its goal already.' :
            'No path was verified. The map shows where the search met the edge of feasibility.'));
    return;
  }
  let sorted = {column: 0, descending: false};
  const body = element('tbody');
  const rows = new Map(view.paths.map(path => [path, candidateRow(path)]));
  const heads = CANDIDATE_COLUMNS.map((column, k) => {
    const button =
        element('button', {type: 'button', title: `Sort by ${column.text}`}, column.text);
    button.addEventListener('click', () => {
      sorted = {column: k, descending: sorted.column === k && !sorted.descending};
      order();
    });
    return element('th', {scope: 'col', class: column.number ? 'number' : null}, button);
  });

  function order() {
    const value = CANDIDATE_COLUMNS[sorted.column].value;
    const compare = (a, b) =>
        (sorted.descending ? d3.descending : d3.ascending)(value(a), value(b));
    const paths =
        view.paths.slice().sort((a, b) => b.verified_path - a.verified_path || compare(a, b) || 0);
    body.append(...paths.map(path => rows.get(path).row));
    heads.forEach((head, k) => {
      if (k === sorted.column)
        head.setAttribute('aria-sort', sorted.descending ? 'descending' : 'ascending');
      else
        head.removeAttribute('aria-sort');
    });
  }

  function update() {
    for (const [path, {row, radio, box}] of rows) {
      row.classList.toggle('selected', path === view.selected);
      radio.checked = path === view.selected;
      box.checked = path.visible;
    }
  }

  order();
  update();
  view.events.on('selected.table', update).on('visible.table', update);
  if (view.paths.some(path => path.relaxed))
    host.append(element(
        'p', {},
        'No path was verified within the limits. Those named by letters take a change that stands in the table below; they keep all other limits and are dashed on the map.'));
  host.append(element(
      'p', {class: 'note'},
      'Ranked by the margin that 95 % of the soil draws keep, or by the share of draws that hold where that breaks limits; what lies within its own sampling error of a better path is tied with it, and the faster stands first. Every path was replayed with the direct wheel model and a ten times finer step; the deviation is between search and replay. \u25c6 marks what no other path beats in smallest margin, duration and energy at once.'));
  const wide = element(
      'table', {class: 'candidates'},
      element(
          'thead', {},
          element(
              'tr', {}, element('th', {scope: 'col'}, 'Follow'),
              element('th', {scope: 'col'}, 'Show'), ...heads)),
      body);
  host.append(element(
      'div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Table of candidates'},
      wide));
}

function candidateRow(path) {
  const name = path.verified_path ? `candidate ${path.label}` : `path ${path.label}`;
  const radio = element('input', {
    type: 'radio',
    name: 'follow',
    'aria-label': `Follow ${name} in the charts`,
    disabled: !path.length
  });
  const box = element(
      'input', {type: 'checkbox', 'aria-label': `Show ${name} on the map`, disabled: !path.length});
  const follow = () => {
    if (!path.length) return;
    if (!path.visible) setVisible(path, true);
    select(path);
  };
  radio.addEventListener('change', follow);
  box.addEventListener('change', () => setVisible(path, box.checked));
  const row = element(
      'tr', {class: path.verified_path ? null : 'overturned'}, element('td', {}, radio),
      element('td', {}, box),
      ...CANDIDATE_COLUMNS.map(
          (column, k) => element(
              k ? 'td' : 'th', {
                scope: k ? null : 'row',
                class: column.number ? 'number' :
                    column.wide      ? 'wide' :
                                       null
              },
              column.cell(path))));
  row.addEventListener('click', event => {
    if (event.target.tagName !== 'INPUT') follow();
  });
  return {row, radio, box};
}
