// Draws the planning report.
document.body.classList.add(`status-${PLAN.doubtful ? 'doubtful' : PLAN.status}`);
candidateTable(byId('candidates'));
(PLAN.candidates.length || !PLAN.relaxed.length ? whatIfTable : relaxedTable)(byId('what-ifs'));
rejectionBars(byId('rejected'));
facts(byId('facts'));
readout(byId('readout'), byId('position'));
playback(byId('playback'));
vehicleFigure(byId('vehicle'));
layerPanel(byId('layers'), mapView(byId('map')));
charts(byId('charts'));
if (view.selected)
  setCursor(view.selected, worstIndex(view.selected));
else
  byId('along-map').hidden = true;
view.events.call('marks');
document.documentElement.dataset.drawn = 'yes';
