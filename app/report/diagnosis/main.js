// Draws the diagnosis report.
document.body.classList.add(`status-${DIAGNOSIS.verdict}`);
byId('notes').append(...DIAGNOSIS.notes.map(note => element('li', {}, note)));
byId('notes').append(...DIAGNOSIS.left_out.map(
    ({line, run_id, column, value, allowed}) => element(
        'li', {},
        `Left out: line ${line}, run ${run_id}: ${column} is ${value} (allowed: ${allowed}).`)));
if (DIAGNOSIS.ignored_columns.length)
  byId('notes').append(
      element('li', {}, `Columns kept and not used: ${DIAGNOSIS.ignored_columns.join(', ')}.`));
byId('notes-section').hidden = !byId('notes').children.length;
whereTable(byId('where'));
differenceMaps(byId('differences'), byId('differences-section'));
residualMaps(byId('maps'));
residualsInTime(byId('in-time'));
curves(byId('curves'));
shareBar(byId('shares'));
claimList(byId('claims'));
candidateTable(byId('candidates'));
soilTable(byId('soil'));
fitTable(byId('fit'));
nextTable(byId('next'), byId('next-section'));
detectableTable(byId('detectable'), byId('detectable-section'));
byId('corrected-model').textContent = DIAGNOSIS.corrected_model_text;
document.documentElement.dataset.drawn = 'yes';
