// Where the map lies on the screen. Base pixels are those of the whole map fitted into the plot;
// pan and zoom transform base to screen.
function mapFrame() {
  // Northings of UTM have seven digits: the labels need their room.
  const digits = d3.max([MAP.south_m, MAP.north_m], y => Math.round(y).toString().length);
  const margin = {left: 24 + 7 * Math.max(4, digits), right: 1, top: 1, bottom: 22};
  const mapWidth_m = MAP.east_m - MAP.west_m;
  const mapHeight_m = MAP.north_m - MAP.south_m;
  const frame = {
    width: 0,
    height: 0,
    left: margin.left,  // of the plot, as the next three
    top: margin.top,
    plotWidth: 0,
    plotHeight: 0,
    scale: 1,  // base pixels per metre
    x0: 0,     // base pixel of the map's north-west corner
    y0: 0,
    transform: d3.zoomIdentity,
  };

  frame.resize = width => {
    const tallest = Math.min(780, 0.82 * Math.max(700, window.innerHeight));
    const fitting = Math.min(width * mapHeight_m / mapWidth_m, tallest);
    frame.width = width;
    frame.height = Math.round(Math.max(fitting, Math.min(width, 340)));
    frame.plotWidth = width - margin.left - margin.right;
    frame.plotHeight = frame.height - margin.top - margin.bottom;
    frame.scale = Math.min(frame.plotWidth / mapWidth_m, frame.plotHeight / mapHeight_m);
    frame.x0 = margin.left + (frame.plotWidth - mapWidth_m * frame.scale) / 2;
    frame.y0 = margin.top + (frame.plotHeight - mapHeight_m * frame.scale) / 2;
  };

  frame.base = (x_m, y_m) =>
      [frame.x0 + (x_m - MAP.west_m) * frame.scale,
       frame.y0 + (MAP.north_m - y_m) * frame.scale,
  ];
  frame.screen = (x_m, y_m) => frame.transform.apply(frame.base(x_m, y_m));
  frame.mapPoint = pixel => {
    const [x, y] = frame.transform.invert(pixel);
    return [
      MAP.west_m + (x - frame.x0) / frame.scale,
      MAP.north_m - (y - frame.y0) / frame.scale,
    ];
  };
  frame.pixelsPerMetre = () => frame.scale * frame.transform.k;

  /// The transform that shows the given places with some room around them.
  frame.showing = places => {
    const [left, right] = d3.extent(places, p => p[0]);
    const [bottom, top] = d3.extent(places, p => p[1]);
    const [x1, y1] = frame.base(left, top);
    const [x2, y2] = frame.base(right, bottom);
    const across = frame.plotWidth / Math.max(x2 - x1, 1);
    const down = frame.plotHeight / Math.max(y2 - y1, 1);
    const k = Math.min(60, 0.86 * Math.min(across, down));
    return d3.zoomIdentity
        .translate(
            frame.left + frame.plotWidth / 2 - k * (x1 + x2) / 2,
            frame.top + frame.plotHeight / 2 - k * (y1 + y2) / 2)
        .scale(k);
  };
  return frame;
}
