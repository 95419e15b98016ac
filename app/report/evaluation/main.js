// Draws the map and the charts of an evaluation; what is not feasible is dashed.
document.body.classList.add(`status-${PLAN.status}`);
byId('candidates-title').textContent = 'Paths on the map';
CANDIDATE_COLUMNS[1].text = 'Path';
CANDIDATE_COLUMNS.splice(CANDIDATE_COLUMNS.findIndex(c => c.text === 'Verified margin'), 1);
CANDIDATE_COLUMNS.find(c => c.text === 'P(feasible)').text = 'P(margins hold)';
CANDIDATE_COLUMNS.find(c => c.text === 'Limiting').cell = path =>
    path.verified_path ? limitingCell(path) : `not feasible: ${path.verified.reason}`;
for (const state of PLAN.rejected_states) view.reasons.add(state.reason);
for (const path of view.paths) {
  path.label = String(path.rank);
  path.visible = true;
}
spreads(byId('spreads'));
courses(document.querySelectorAll('.course'));
candidateTable(byId('candidates'));
byId('candidates').querySelector('p').textContent =
    'Feasible paths first, by the margin that 95 % of the soil draws keep, or by the share of draws that hold where that breaks limits; what lies within its own sampling error of a better path is tied with it, and the faster stands first. The deviation is that of the driven path from the given one. \u25c6 marks what no other feasible path beats in smallest margin, duration and energy at once.';
readout(byId('readout'), byId('position'));
playback(byId('playback'));
vehicleFigure(byId('vehicle'));
layerPanel(byId('layers'), mapView(byId('map')));
charts(byId('charts'));
if (view.selected) setCursor(view.selected, worstIndex(view.selected));
view.events.call('marks');
document.documentElement.dataset.drawn = 'yes';
