// Of a problem without a path: what was given up in turn, and the path that it opens.
function relaxedTable(host) {
  byId('what-if-title').textContent = 'The smallest change that opens the way';
  const rows = PLAN.relaxed.map(({given_up, path}, k) => {
    const named = `${letter(k)}\u2002${given_up}`;
    if (!path)
      return [named, element('span', {class: 'alarm'}, 'no path found'), UNKNOWN, UNKNOWN, UNKNOWN];
    const drawn = view.paths.find(p => p.relaxed && p.label === letter(k));
    const follow = element(
        'button', {type: 'button', title: 'Show on the map and in the charts'}, 'a path');
    follow.addEventListener('click', () => {
      setVisible(drawn, true);
      select(drawn);
      byId('map').scrollIntoView({block: 'nearest'});
    });
    return [
      named, element('span', {class: 'good'}, 'opens ', follow), fixed(path.margin_min, 3),
      fixed(path.length_m, 1, 'm'), SECONDS(path.duration_s)
    ];
  });
  host.append(
      element(
          'p', {class: 'note'},
          'One thing was changed at a time, first by little and where nothing helped by more, and planned for briefly. Every path named here passed its verification; where none was found, none is shown not to be.'),
      element(
          'div',
          {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Table of relaxations'},
          table(
              null,
              [
                {text: 'Change'}, {text: 'Answer'}, {text: 'Smallest margin', number: true},
                {text: 'Length', number: true}, {text: 'Duration', number: true}
              ],
              rows)));
}
