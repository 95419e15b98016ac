// Draws the map and the charts of an evaluation; what is not feasible is dashed.
document.body.classList.add(`status-${PLAN.status}`);
CANDIDATE_COLUMNS[1].text = 'Path';
for (const path of view.paths) {
  path.label = String(path.rank);
  path.visible = true;
}
candidateTable(byId('candidates'));
readout(byId('readout'), byId('position'));
layerPanel(byId('layers'), mapView(byId('map')));
charts(byId('charts'));
if (view.selected) setCursor(view.selected, worstIndex(view.selected));
view.events.call('marks');
document.documentElement.dataset.drawn = 'yes';
