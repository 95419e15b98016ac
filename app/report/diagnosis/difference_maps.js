// Test minus reference over slip ratio and slip angle, beside what the names make of it.
function differenceMaps(host, section) {
  const channels = DIAGNOSIS.channels.filter(c => (DIAGNOSIS.run_differences[c] || []).length);
  if (!channels.length) {
    section.hidden = true;
    return;
  }
  const shown = [{name: 'test minus reference', value: r => r.difference}];
  if (DIAGNOSIS.mechanisms.length)
    shown.push(
        {name: 'by the names claimed', value: r => r.by_names},
        {name: 'left', value: r => r.difference - r.by_names});
  const marks = channels.map(
      channel => shown.map(({value}) => byCondition(DIAGNOSIS.run_differences[channel], value)));
  const most = mapScale([].concat(...marks));
  host.append(
      element(
          'p', {class: 'note'},
          'Mean over the runs of a condition, in standard deviations of the difference. Of the reference it is what it shares with the test at that condition, with the uncertainty of that. Triangles point up where the test has more than the reference, down where less; dots are within two standard deviations.'),
      residualLegend(most));
  channels.forEach((channel, k) => {
    const row = element('div', {class: 'maps'});
    shown.forEach(
        ({name}, j) => row.append(signedMap(channel, name, marks[k][j], most, 'differences')));
    host.append(element('h3', {}, channelOf(channel).title), row);
  });
}
