// How much of the excess misfit each name explains on held-out conditions: a stacked bar, and below
// it every share with its range over ways to hold out.
function shareBar(host) {
  const claims = DIAGNOSIS.mechanisms.filter(claim => claim.share && claim.share.explained > 0);
  if (!claims.length) return;
  const parts = claims.map((claim, k) => ({
                             name: [claim.id, ...claim.equivalent].map(idText).join(' or '),
                             share: claim.share.explained,
                             colour: `var(--series-${1 + k % 3})`,
                           }));
  const rest = DIAGNOSIS.remainder.share;
  if (rest > 0) parts.push({name: 'no name', share: rest, colour: 'var(--soft)'});
  const whole = d3.sum(parts, p => p.share) || 1;
  const WIDTH = 640, HEIGHT = 28;
  const svg = d3.create('svg')
                  .attr('class', 'shares')
                  .attr('viewBox', `0 0 ${WIDTH} ${HEIGHT}`)
                  .attr('role', 'img')
                  .attr('aria-label', parts.map(p => `${p.name} ${percent(p.share, 0)}`).join(', '));
  let from = 0;
  for (const part of parts) {
    const width = part.share / whole * WIDTH;
    svg.append('rect')
        .attr('x', from)
        .attr('width', Math.max(width - 1, 0))
        .attr('height', HEIGHT)
        .attr('fill', part.colour)
        .append('title')
        .text(`${part.name}: ${percent(part.share, 0)}`);
    from += width;
  }
  const named = (text, colour) => {
    const swatch = element('span', {class: 'swatch', 'aria-hidden': 'true'});
    swatch.style.background = colour;
    return element('span', {}, swatch, text);
  };
  const row = (name, s) => [name, percent(s.explained, 0),
                            `${percent(s.low, 0)} to ${percent(s.high, 0)}`,
                            intervalMark(s.explained, s.low, s.high, 0, 1)];
  // The bar shows the first of a class; the others stand below it.
  const rows = claims.flatMap(
      (claim, k) => [row(named(idText(claim.id), parts[k].colour), claim.share),
                     ...claim.equivalent.filter(id => (claim.member_shares || {})[id])
                         .map(id => row(`or ${idText(id)}`, claim.member_shares[id]))]);
  if (rest > 0) rows.push([named('no name', 'var(--soft)'), percent(rest, 0), '', '']);
  host.append(
      element(
          'p', {class: 'note'},
          'Share of the excess misfit that each name explains on conditions held out of the fit, and its range over ways to hold out; members of a class stand in for each other. Above 100 % the rest is less than the noise leads one to expect.'),
      svg.node(),
      scrolled(
          'Table of shares',
          table(
              null,
              [
                {text: 'Name'}, {text: 'Share', number: true}, {text: 'Range', number: true},
                {text: '0 \u2192 all'}
              ],
              rows)));
}
