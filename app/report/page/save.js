// Saving a figure: as SVG and PNG with its title and legend, and its data as CSV.
const DRAWN_STYLES = [
  'fill', 'fill-opacity', 'stroke', 'stroke-width', 'stroke-opacity', 'stroke-dasharray',
  'stroke-linejoin', 'stroke-linecap', 'opacity', 'font-family', 'font-size', 'font-weight',
  'text-anchor', 'dominant-baseline', 'paint-order', 'vector-effect', 'display'
];

/// A copy of an SVG that looks the same without the page's style sheet.
function styledCopy(svg) {
  const copy = svg.cloneNode(true), originals = svg.querySelectorAll('*');
  copy.querySelectorAll('*').forEach((node, i) => {
    const style = getComputedStyle(originals[i]);
    node.setAttribute(
        'style', DRAWN_STYLES.map(name => `${name}:${style.getPropertyValue(name)}`).join(';'));
    // What the style says now; the page's variables and classes mean nothing elsewhere.
    for (const {name, value} of [...node.attributes])
      if (name === 'class' || value.startsWith('var(')) node.removeAttribute(name);
  });
  return copy;
}

/// The text of an SVG file: title, legend, and below them the figure, over the canvas that lies
/// under it on the page.
function pictureOf({title, svg, canvas, keys}) {
  const [, , width, height] = svg.getAttribute('viewBox').split(' ').map(Number);
  const ink = cssColour('--ink'), font = 'system-ui, "DejaVu Sans", sans-serif';
  const picture = d3.create('svg').attr('xmlns', 'http://www.w3.org/2000/svg');
  const measure = element('canvas').getContext('2d');
  measure.font = `12px ${font}`;
  const ground = picture.append('rect')
                     .attr('width', '100%')
                     .attr('height', '100%')
                     .attr('fill', cssColour('--panel'));
  const text = (parent, x, y, words) => parent.append('text')
                                            .attr('x', x)
                                            .attr('y', y)
                                            .attr('fill', ink)
                                            .attr('font-family', font)
                                            .attr('font-size', 12)
                                            .text(words);
  text(picture, 8, 18, title).attr('font-weight', 650);
  let x = 8, y = 36;
  for (const key of keys) {
    const room = 30 + measure.measureText(key.name).width + 16;
    if (x > 8 && x + room > width) [x, y] = [8, y + 16];
    const group = picture.append('g').attr('transform', `translate(${x},${y})`);
    drawSample(
        group.append('g').attr('transform', 'translate(0,-8)'),
        {...key, colour: resolvedColour(key.colour)});
    text(group, 28, 0, key.name);
    x += room;
  }
  const top = keys.length ? y + 8 : 26;
  if (canvas)
    picture.append('image')
        .attr('y', top)
        .attr('width', width)
        .attr('height', height)
        .attr('href', canvas.toDataURL());
  const copy = styledCopy(svg);
  for (const [name, value] of [['y', top], ['width', width], ['height', height]])
    copy.setAttribute(name, value);
  picture.node().append(copy);
  picture.attr('viewBox', `0 0 ${width} ${top + height}`)
      .attr('width', width)
      .attr('height', top + height);
  ground.attr('width', width).attr('height', top + height);
  return new XMLSerializer().serializeToString(picture.node());
}

const resolvedColour = colour =>
    colour.startsWith('var(') ? cssColour(colour.slice(4, -1)) : colour;

/// {columns, rows} as CSV; what is not known is an empty cell.
function csvOf({columns, rows}) {
  const cell = value => {
    if (value === null || value === undefined || Number.isNaN(value)) return '';
    // A spreadsheet would take such a text for a formula.
    const formula = typeof value === 'string' && /^[=+\-@\t\r]/.test(value) && isNaN(value);
    const text = (formula ? '\'' : '') + value;
    return /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  };
  return [columns, ...rows].map(row => row.map(cell).join(',') + '\n').join('');
}

/// The picture as pixels, twice as fine as on the page.
async function pixelsOf(picture) {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(picture)}`;
  await image.decode();
  const canvas = element('canvas', {width: 2 * image.width, height: 2 * image.height});
  canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise(take => canvas.toBlob(take, 'image/png'));
}

function download(name, blob) {
  const link = element('a', {href: URL.createObjectURL(blob), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/// "Save" with a button for each kind of file. `name()` gives the files their names, `figure()`
/// gives {title, svg, canvas, keys}, `data()` {columns, rows}.
function saveMenu(label, name, figure, data) {
  const file = ending => {
    const words = `${REPORT.kind} ${name()}`.toLowerCase().replace(/[^a-z0-9]+/g, '-');
    return `${words.replace(/^-|-$/g, '')}.${ending}`;
  };
  const kinds = {
    SVG: () => download(file('svg'), new Blob([pictureOf(figure())], {type: 'image/svg+xml'})),
    PNG: async () => download(file('png'), await pixelsOf(pictureOf(figure()))),
    CSV: () => download(file('csv'), new Blob([csvOf(data())], {type: 'text/csv'})),
  };
  const buttons = Object.entries(kinds).map(([kind, save]) => {
    const button =
        element('button', {type: 'button', 'aria-label': `Save ${label} as ${kind}`}, kind);
    button.addEventListener('click', save);
    return button;
  });
  return element(
      'details', {class: 'save screen-only'},
      element('summary', {'aria-label': `Save ${label}`}, 'Save'), element('span', {}, ...buttons));
}
