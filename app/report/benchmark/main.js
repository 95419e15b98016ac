// Draws the benchmark's report; its lower sections are those of the experiment that is chosen.
function drawExperiment() {
  summaryTable();
  boxes(byId('boxes'));
  progress(byId('progress'));
  byId('progress-section').hidden = !byId('progress').children.length;
  pairedTable();
  paths(byId('paths'));
  byId('paths-section').hidden = !byId('paths').children.length;
}

const choice = byId('experiment');
for (const [k, experiment] of EXPERIMENTS.entries())
  choice.append(element('option', {value: String(k)}, experiment.name));
choice.addEventListener('change', () => {
  shown.experiment = EXPERIMENTS[Number(choice.value)];
  drawExperiment();
});
profiles(byId('profiles'));
drawExperiment();
document.documentElement.dataset.drawn = 'yes';
