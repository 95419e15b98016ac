// The page itself: its data, its elements, its theme, and what it says when it cannot draw.
const REPORT = JSON.parse(document.getElementById('data').textContent);
const byId = id => document.getElementById(id);

window.addEventListener('error', event => {
  const failure = byId('failure');
  failure.hidden = false;
  failure.textContent = `A figure could not be drawn (${
      event.message}). The verdict above stands; the data are at the end of this file.`;
});

/// An element with attributes, text or children. Text never becomes markup.
function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true)
      node.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined)
      node.setAttribute(name, value);
  }
  node.append(...children.filter(child => child !== null && child !== undefined));
  return node;
}

/// A table from {text, number} columns and rows of texts or nodes.
function table(caption, columns, rows) {
  const head =
      columns.map(c => element('th', {scope: 'col', class: c.number ? 'number' : null}, c.text));
  const body = rows.map(
      row => element(
          'tr', {},
          ...row.map(
              (cell, k) => element(
                  k ? 'td' : 'th',
                  {scope: k ? null : 'row', class: columns[k].number ? 'number' : null}, cell))));
  return element(
      'table', {}, caption ? element('caption', {}, caption) : null,
      element('thead', {}, element('tr', {}, ...head)), element('tbody', {}, ...body));
}

const DARK = window.matchMedia('screen and (prefers-color-scheme: dark)');
const cssColour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
/// Whether pictures are dark. Paper never is: while the page prints, `printing` undoes the theme.
const isDark = () => DARK.matches && !document.documentElement.classList.contains('printing');
function onThemeChange(draw) {
  DARK.addListener(draw);
  themeListeners.push(draw);
}
const themeListeners = [];
for (const [event, printing] of [['beforeprint', true], ['afterprint', false]])
  window.addEventListener(event, () => {
    if (!DARK.matches) return;
    document.documentElement.classList.toggle('printing', printing);
    themeListeners.forEach(draw => draw());
  });

/// Calls draw(width) now and whenever the node's width changes.
function onWidth(node, draw) {
  let width = 0;
  const changed = () => {
    const now = Math.round(node.clientWidth);
    if (!now || now === width) return false;
    width = now;
    return true;
  };
  if (changed()) draw(width);
  // The width is read here, where the page is laid out: read between drawings, each would lay it
  // out anew. Drawing changes heights: not within the observer, which would see itself.
  new ResizeObserver(() => {
    if (changed()) requestAnimationFrame(() => draw(width));
  }).observe(node);
}
