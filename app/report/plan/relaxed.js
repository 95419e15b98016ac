// Of a problem without a path: what was given up in turn, and the path that it opens.
function relaxedTable(host) {
  byId('what-if-title').textContent = 'The smallest change that opens the way';
  const rows = PLAN.relaxed.map(({given_up, path}) => {
    if (!path)
      return [given_up, element('span', {class: 'alarm'}, 'no path found'), UNKNOWN, UNKNOWN, UNKNOWN];
    const drawn = view.paths.find(p => p.relaxed && p.label === given_up);
    const follow = element(
        'button', {type: 'button', title: 'Show on the map and in the charts'}, 'a path');
    follow.addEventListener('click', () => {
      setVisible(drawn, true);
      select(drawn);
      byId('map').scrollIntoView({block: 'nearest'});
    });
    return [
      given_up, element('span', {class: 'good'}, 'opens ', follow), fixed(path.margin_min, 3),
      fixed(path.length_m, 1, 'm'), SECONDS(path.duration_s)
    ];
  });
  host.append(
      element(
          'p', {class: 'note'},
          'One thing was given up at a time and planned for briefly, until a path passed its verification. Where none was found, none is shown not to be.'),
      element(
          'div',
          {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Table of relaxations'},
          table(
              null,
              [
                {text: 'Given up'}, {text: 'Answer'}, {text: 'Smallest margin', number: true},
                {text: 'Length', number: true}, {text: 'Duration', number: true}
              ],
              rows)));
}
