// Playback: the marker moves along the selected path as the vehicle would, faster or slower.
const PLAYBACK_SPEEDS = [0.5, 1, 2, 5, 10, 20, 50, 100];
/// The slowest that shows a whole path in half a minute.
const usualSpeed = path =>
    PLAYBACK_SPEEDS.find(speed => speed >= 1 && path.duration_s <= 30 * speed) || 100;

function playback(host) {
  if (!view.selected) {
    host.hidden = true;
    return;
  }
  const usual = usualSpeed(view.selected);
  const button = element('button', {type: 'button', class: 'play'});
  const speed = element(
      'select', {},
      ...PLAYBACK_SPEEDS.map(
          s => element('option', {value: s, selected: s === usual}, `${s}\u00d7`)));
  const clock = element('span', {class: 'clock'});
  host.append(
      button, element('label', {}, 'Speed ', speed), stepButton('Step back', '\u25c2', -1),
      stepButton('Step on', '\u25b8', 1), clock);
  let playing = false, time_s = 0, before_ms = null, own = null;

  function stepButton(name, text, by) {
    const node = element('button', {type: 'button', title: name, 'aria-label': name}, text);
    node.addEventListener('click', () => stepMarker(by));
    return node;
  }

  function show() {
    view.playing = playing;
    button.textContent = playing ? '\u275a\u275a Pause' : '\u25b6 Play';
  }

  function stop() {
    playing = false;
    before_ms = null;
    show();
  }

  function frame(now_ms) {
    if (!playing) return;
    const {points} = view.selected, end_s = d3.max(points.time_s);
    if (view.cursor !== own) time_s = view.cursor ? points.time_s[view.cursor.index] || 0 : 0;
    if (before_ms !== null) time_s += (now_ms - before_ms) / 1000 * Number(speed.value);
    before_ms = now_ms;
    setCursor(view.selected, d3.bisectRight(points.time_s, time_s) - 1);
    own = view.cursor;
    if (time_s >= end_s)
      stop();
    else
      requestAnimationFrame(frame);
  }

  function toggle() {
    if (playing) return stop();
    const {points, length} = view.selected;
    if (!view.cursor || view.cursor.path !== view.selected || view.cursor.index >= length - 1)
      setCursor(view.selected, 0);
    own = null;
    playing = true;
    show();
    requestAnimationFrame(frame);
  }

  button.addEventListener('click', toggle);
  view.events.on('playback', toggle).on('selected.playback', stop).on('cursor.playback', () => {
    const {path, index} = view.cursor;
    clock.textContent =
        `${fixed(path.points.time_s[index], 1)} of ${fixed(path.duration_s, 1, 's')}`;
  });
  show();
}

/// Moves the marker by points of the selected path.
function stepMarker(by) {
  if (!view.selected) return;
  const index = view.cursor && view.cursor.path === view.selected ? view.cursor.index : 0;
  setCursor(view.selected, index + by);
}
