// Charts whose marks are pointed at: diagnosis and benchmark.
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';

import {startBrowser, stopBrowser, withPage} from './pages.mjs';

before(startBrowser);
after(stopBrowser);

const CHARTS = {
  diagnosis: [['#maps', /slip ratio .* standard deviations/], ['#curves', /measured .* corrected/]],
  drives: [['#residuals', /s: .* m\/s/]],
  benchmark: [['#profiles', /% of the runs up to/], ['#boxes', /median .* quartiles/]],
};

for (const [kind, charts] of Object.entries(CHARTS))
  for (const [host, says] of charts) {
    const chartIn = page => page.locator(`${host} .plot`).first();

    test(`${kind}: pointing at a mark in ${host} says what it is`, async () => {
      await withPage(kind, async page => {
        const plot = chartIn(page);
        await plot.scrollIntoViewIfNeeded();
        await plot.locator('svg').focus();
        await page.keyboard.press('ArrowRight');
        const ring = await plot.locator('.pointed').boundingBox();
        await page.keyboard.press('Escape');
        await plot.locator('.tooltip').waitFor({state: 'hidden'});
        await page.mouse.move(ring.x + ring.width / 2 + 1, ring.y + ring.height / 2);
        await plot.locator('.tooltip').waitFor({state: 'visible'});
        assert.match(await plot.locator('.tooltip').innerText(), says);
      });
    });

    test(`${kind}: arrow keys step through the marks in ${host}`, async () => {
      await withPage(kind, async page => {
        const plot = chartIn(page);
        await plot.locator('svg').focus();
        await page.keyboard.press('ArrowRight');
        const first = await plot.locator('.tooltip').innerText();
        assert.match(first, says);
        await page.keyboard.press('ArrowRight');
        assert.notEqual(await plot.locator('.tooltip').innerText(), first);
      });
    });
  }

test('benchmark: another experiment fills the sections below', async () => {
  await withPage('benchmark', async page => {
    const before = await page.locator('#summary').innerText();
    await page.locator('#experiment').selectOption('1');
    assert.notEqual(await page.locator('#summary').innerText(), before);
  });
});

test('benchmark: paths lie over the shaded terrain', async () => {
  await withPage('benchmark', async page => {
    await page.locator('#paths .plot').first().scrollIntoViewIfNeeded();
    const picture = page.locator('#paths svg image').first();
    assert.match(await picture.getAttribute('href'), /^data:image\/png/);
    const ground = await picture.boundingBox();
    const path = await page.locator('#paths svg .path-casing').first().boundingBox();
    assert.ok(path.x > ground.x && path.x + path.width < ground.x + ground.width);
    assert.ok(path.y > ground.y && path.y + path.height < ground.y + ground.height);
  });
});

test('diagnosis: the finding stands first and the corrected model can be opened', async () => {
  await withPage('diagnosis', async page => {
    assert.ok((await page.locator('h1').innerText()).length > 20);
    await page.getByText('Show it').click();
    assert.match(await page.locator('#corrected-model').innerText(), /mechanisms:/);
  });
});
