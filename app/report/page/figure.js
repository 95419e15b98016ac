// A figure: heading, legend, chart, the same in words, and the menu that saves it.
let figureCount = 0;

/// A figure of `draw(svg, width)`, drawn anew whenever its width or the theme changes. What `draw`
/// returns as marks [{x, y, text}] can be pointed at.
/// \param spec {title, unit, level: of its heading, name: () => what it is called by itself, keys:
/// [{name, colour, dash, area}], shared_keys: () => those of a legend elsewhere, said: () => text
/// that stands for the picture, data: () => {columns, rows}} \returns {node, svg, values, draw}:
/// `values` are the nodes beside the keys
function figure(spec, draw) {
  const {
    title,
    unit,
    level = 3,
    keys = [],
    shared_keys = () => [],
    said,
    data,
    name = () => title
  } = spec;
  const id = `figure-${++figureCount}`;
  const heading =
      element(`h${level}`, {id}, title, unit ? element('span', {class: 'unit'}, ` ${unit}`) : null);
  const legend = keys.map(legendKey);
  const caption = element('figcaption', {}, heading, ...legend.map(key => key.node));
  const holder = element('div', {class: 'plot'});
  const words = element('p', {class: 'visually-hidden', id: `${id}-words`});
  const svg = d3.select(holder)
                  .append('svg')
                  .attr('role', 'img')
                  .attr('aria-labelledby', id)
                  .attr('aria-describedby', `${id}-words`);
  const take = pointing(holder, svg);
  const picture = () => ({
    title: unit ? `${name()}, ${unit}` : name(),
    svg: svg.node(),
    keys: keys.concat(shared_keys())
  });
  caption.append(saveMenu(title, name, picture, data));
  const node = element('figure', {class: 'chart', 'aria-labelledby': id}, caption, holder, words);
  let width = 0;
  const redraw = () => {
    if (!width || !node.isConnected) return;
    words.textContent = said();
    take(draw(svg, width) || []);
  };
  onWidth(holder, now => {
    width = now;
    redraw();
  });
  onThemeChange(redraw);
  return {node, svg, values: legend.map(key => key.value), draw: redraw};
}

/// What columns of numbers range over, in words: the least that a chart says to those who do not
/// see it.
function rangesText(columns) {
  return columns
             .map(({name, values, decimals, unit}) => {
               const [low, high] = d3.extent(values.filter(isKnown));
               return low === undefined ?
                   `${name}: not known` :
                   `${name}: ${fixed(low, decimals)} to ${fixed(high, decimals, unit)}`;
             })
             .join('; ') +
      '.';
}
