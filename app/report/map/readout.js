// The slider along the selected path and the numbers at the marker.
function readout(list, slider) {
  function update() {
    const {cursor} = view;
    if (!cursor) return;
    const {path, index} = cursor;
    list.replaceChildren(...[['Path', path.label, false], ...stateAt(path, index)].map(
        ([name, text, alarm]) => element(
            'div', {}, element('dt', {}, name),
            element('dd', {class: alarm ? 'alarm' : null}, text))));
    if (path !== view.selected) return;
    slider.max = path.length - 1;
    slider.value = index;
    slider.setAttribute(
        'aria-valuetext',
        stateAt(path, index)
            .slice(0, 2)
            .concat(stateAt(path, index).slice(7, 10))
            .map(([n, t]) => `${n} ${t}`)
            .join(', '));
  }
  if (!view.selected) {
    list.hidden = true;
    slider.parentElement.hidden = true;
    return;
  }
  slider.addEventListener('input', () => setCursor(view.selected, Number(slider.value)));
  const name = () => {
    byId('position-label').textContent = `Marker on path ${view.selected.label}`;
  };
  name();
  view.events.on('cursor.readout', update).on('selected.readout', name);
}
