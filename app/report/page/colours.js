// Colours that hold for colour-blind eyes: viridis for margins, Tol's light scheme for soils,
// Okabe and Ito's with a shape of its own for each reason of rejection.
const SOIL_COLOURS = [
  '#77aadd', '#ee8866', '#eedd88', '#bbcc33', '#ffaabb', '#44bb99', '#99ddff', '#aaaa00', '#dddddd'
];
const soilColour = index => SOIL_COLOURS[index % SOIL_COLOURS.length];
/// The colour of the k-th of several things that are drawn alike, in the theme's light.
const seriesColour = k => cssVar(`--series-${1 + k % 6}`);
const UNDER_LIMIT = '#d55e00';

/// Colour of a margin: viridis from the limit to `top`; below the limit its own colour.
function marginColours(limit, top) {
  const scale = d3.scaleSequential(d3.interpolateViridis)
                    .domain([limit, Math.max(top, limit + 0.01)])
                    .clamp(true);
  const colour = margin =>
      (!isKnown(margin)   ? '#888888' :
           margin < limit ? UNDER_LIMIT :
                            scale(margin));
  colour.domain = () => scale.domain();
  return colour;
}
