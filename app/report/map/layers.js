// Legend and layers beside the map: what paths and ground are coloured by, and what lies over them.
function layerPanel(host, {contour_interval_m, stretch}) {
  const toggle = (name, text) => {
    const box = element('input', {type: 'checkbox'});
    box.checked = LAYERS[name];
    box.addEventListener('change', () => {
      LAYERS[name] = box.checked;
      view.events.call('layers');
    });
    return element('div', {}, element('label', {}, box, text));
  };
  host.append(
      pathColours(), groundColours(),
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

/// A choice among `texts` with what `legend(k)` says of the one chosen.
function legendChoice(title, texts, chosen, legend) {
  const select = element(
      'select', {'aria-label': title},
      ...texts.map((text, k) => element('option', {value: k}, text)));
  const room = element('div');
  const show = k => room.replaceChildren(...legend(k).filter(Boolean));
  select.value = chosen;
  select.addEventListener('change', () => show(Number(select.value)));
  show(chosen);
  return element('div', {}, element('h3', {}, title), select, room);
}

function pathColours() {
  return legendChoice('Colour of the paths', PATH_COLOURS.map(c => c.text), 0, k => {
    view.pathColour = PATH_COLOURS[k];
    view.events.call('coloured');
    const {domain, decimals, ramp, key, limited} = view.pathColour;
    if (key !== 'margin')
      return [
        ...rampLegend(domain, decimals, ramp, ['', '']),
        limited ? beyondEntry('beyond the limit') : null
      ];
    return [
      ...rampLegend(domain, decimals, ramp, [' limit', 'and more']),
      PLAN.overturned.length ? beyondEntry(view.said.under) : null
    ];
  });
}

/// What the colour beyond a limit means.
function beyondEntry(text) {
  const swatch = element('span', {class: 'swatch', 'aria-hidden': 'true'});
  swatch.style.background = UNDER_LIMIT;
  return element('div', {class: 'note'}, swatch, text);
}

function groundColours() {
  const chosen = GROUNDS.findIndex(g => g.key === LAYERS.ground);
  return legendChoice('Colour of the ground', GROUNDS.map(g => g.text), chosen, k => {
    LAYERS.ground = GROUNDS[k].key;
    view.events.call('layers');
    const layer = chosenGround();
    if (!layer) return [groundEntries()];
    const ends = layer.limited ? [' limit', 'and more'] : ['', layer.unit];
    return [
      ...rampLegend(layer.domain, layer.decimals, layer.colour, ends),
      layer.limited ? beyondEntry('below the limit') : null, groundEntries()
    ];
  });
}

function groundEntries() {
  const soils = MAP.soils.filter(soil => !soil.zone).map((soil, k) => {
    const swatch = element('span', {class: 'swatch', 'aria-hidden': 'true'});
    swatch.style.background = soilColour(k);
    return element('li', {}, swatch, soil.name);
  });
  return element('ul', {}, ...(LAYERS.ground === 'soils' ? soils : []), hatchedEntry());
}

/// A bar of colours over its ends and middle.
function rampLegend([low, high], decimals, colour, [lowest, highest]) {
  const bar = element('div', {class: 'legend-bar', 'aria-hidden': 'true'});
  bar.style.background = `linear-gradient(to right, ${
      d3.range(0, 1.01, 0.1).map(t => colour(low + t * (high - low))).join(', ')})`;
  const ticks = element('div', {class: 'legend-ticks'}, ...[0, 0.5, 1].map(t => {
    const tick = element(
        'span', {}, fixed(low + t * (high - low), decimals) + [lowest, '', ` ${highest}`][2 * t]);
    tick.style.left = `${100 * t}%`;
    return tick;
  }));
  return [bar, ticks];
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
    element('p', {class: 'note'}, reasons.length ? view.said.choose : view.said.none)
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
