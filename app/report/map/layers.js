// Legend and layers beside the map; every layer is a checkbox.
function layerPanel(host, {contour_interval_m, stretch}) {
  const toggle = (name, text, extra = null) => {
    const box = element('input', {type: 'checkbox'});
    box.checked = LAYERS[name];
    box.addEventListener('change', () => {
      LAYERS[name] = box.checked;
      view.events.call('layers');
    });
    return element('div', {}, element('label', {}, box, text), extra);
  };
  const soils = element(
      'ul', {}, ...MAP.soils.filter(soil => !soil.zone).map((soil, k) => {
        const swatch = element('span', {class: 'swatch', 'aria-hidden': 'true'});
        swatch.style.background = soilColour(k);
        return element('li', {}, swatch, soil.name);
      }),
      hatchedEntry());
  host.append(
      marginLegend(), toggle('soils', 'Soils', soils),
      toggle(
          'contours',
          contour_interval_m ? `Contours every ${significant(contour_interval_m)} m` :
                               'Contours (the ground is level)'),
      toggle('rocks', `Rocks, to scale (${integer(MAP.rocks_total)})`), rejectedPanel(),
      element(
          'p', {class: 'note'},
          'Light from the north-west' +
              (stretch > 1.05 ? `; the shading stretches heights ${fixed(stretch, 1)} times.` :
                                '.')));
}

function marginLegend() {
  const [low, high] = marginColour.domain(),
              bar = element('div', {class: 'legend-bar', 'aria-hidden': 'true'});
  bar.style.background = `linear-gradient(to right, ${
      d3.range(0, 1.01, 0.1).map(t => marginColour(low + t * (high - low))).join(', ')})`;
  const ticks = element('div', {class: 'legend-ticks'}, ...[0, 0.5, 1].map(t => {
    const tick = element(
        'span', {},
        t ? fixed(low + t * (high - low), 2) + (t === 1 ? ' and more' : '') :
            `${fixed(low, 2)} limit`);
    tick.style.left = `${100 * t}%`;
    return tick;
  }));
  const under = element('span', {class: 'swatch', 'aria-hidden': 'true'});
  under.style.background = UNDER_LIMIT;
  return element(
      'div', {}, element('h3', {}, 'Stability margin along the paths'), bar, ticks,
      PLAN.overturned.length ?
          element('div', {class: 'note'}, under, view.said.under) :
          null);
}

function hatchedEntry() {
  const swatch = element('span', {class: 'swatch', 'aria-hidden': 'true'});
  swatch.style.background =
      'repeating-linear-gradient(135deg, var(--hatch) 0 1px, var(--hatch-ground) 1px 4px)';
  return element('li', {}, swatch, 'unknown or forbidden');
}

/// A toggle for each reason, and why the chosen state was rejected; its buttons step through the
/// marks shown, for those who do not point.
function rejectedPanel() {
  const counts = d3.nest().key(s => s.reason).rollup(v => v.length).object(PLAN.rejected_states);
  const reasons = PLAN.rejected.map(r => r.reason).filter(reason => counts[reason]);
  const detail = element('div', {class: 'mark-detail', 'aria-live': 'polite'});
  const step = by => {
    const shown = PLAN.rejected_states.filter(s => view.reasons.has(s.reason));
    if (shown.length)
      chooseMark(shown
                     [(Math.max(shown.indexOf(view.mark), by > 0 ? -1 : 0) + by + shown.length) %
                      shown.length]);
  };
  const stepButton = (text, by) => {
    const button = element('button', {type: 'button'}, text);
    button.addEventListener('click', () => step(by));
    return button;
  };
  const boxes = reasons.map(reason => {
    const box = element('input', {type: 'checkbox'});
    if (reason === 'cornering') view.reasons.add(reason);
    box.checked = view.reasons.has(reason);
    box.addEventListener('change', () => {
      view.reasons[box.checked ? 'add' : 'delete'](reason);
      if (view.mark && !view.reasons.has(view.mark.reason)) view.mark = null;
      view.events.call('marks');
    });
    return element(
        'label', {}, box, reasonSymbol(reason), words(reason),
        element('span', {class: 'count'}, integer(counts[reason])));
  });
  const update = () => detail.replaceChildren(...(view.mark ? rejectionDetail(view.mark) : [
    element(
        'p', {class: 'note'},
        reasons.length ? view.said.choose : view.said.none)
  ]));
  update();
  view.events.on('marks.detail', update);
  return element(
      'fieldset', {}, element('legend', {}, element('h3', {}, view.said.marks)), ...boxes, detail,
      reasons.length ? element(
                           'div', {class: 'step screen-only'}, stepButton('Previous', -1),
                           stepButton('Next', 1)) :
                       null);
}
