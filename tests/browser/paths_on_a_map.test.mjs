// Map, table, charts and playback of plans and evaluations speak of one marker.
import assert from 'node:assert/strict';
import {after, before, describe, test} from 'node:test';

import {openPage, startBrowser, stopBrowser, withPage} from './pages.mjs';

before(startBrowser);
after(stopBrowser);

const readout = page => page.locator('#readout').innerText();
const timeOf = page => page.evaluate(() => {
  const {path, index} = view.cursor;
  return path.points.time_s[index];
});
const shownPaths = page => page.locator('#map g.path').count();

/// Opening a page takes longer than looking at it: the tests of a group look at one, in their
/// order, and leave it still and with all its paths.
function openOnce(kind) {
  const shared = {};
  before(async () => {
    Object.assign(shared, await openPage(kind));
  });
  after(() => shared.close());
  return shared;
}

for (const kind of ['plan', 'evaluation'])
  describe(kind, () => {
    const shared = openOnce(kind);

    test('pointing at a chart moves the marker of map, readout and slider', async () => {
      const {page} = shared;
      const area = page.locator('#charts .pointer-area').first();
      await area.scrollIntoViewIfNeeded();
      const box = await area.boundingBox();
      await page.mouse.move(box.x + 0.2 * box.width, box.y + box.height / 2);
      const [first, slider] = [await readout(page), await page.locator('#position').inputValue()];
      await page.mouse.move(box.x + 0.8 * box.width, box.y + box.height / 2);
      assert.notEqual(await readout(page), first);
      assert.notEqual(await page.locator('#position').inputValue(), slider);
      for (const word of ['What limits', 'Speed', 'slip ratio', 'sinkage', 'demand', 'supply'])
        assert.ok((await readout(page)).includes(word), word);
    });

    test('pointing at a path on the map says what holds there', async () => {
      const {page} = shared;
      await page.locator('#map').scrollIntoViewIfNeeded();
      const place = await page.evaluate(() => {
        const piece = document.querySelector('#map g.path:last-child path.casing');
        const point = piece.getPointAtLength(piece.getTotalLength() / 2);
        const {x, y} = point.matrixTransform(piece.getScreenCTM());
        return {x, y};
      });
      await page.mouse.move(place.x, place.y);
      const tooltip = page.locator('#map .tooltip');
      await tooltip.waitFor({state: 'visible'});
      const text = await tooltip.innerText();
      for (const word of ['What limits', 'Stability margin', 'Lateral supply', 'Speed', 'sinkage'])
        assert.ok(text.includes(word), `${word} in ${text}`);
    });

    test('a path is shown and hidden by its box, and followed by its row', async () => {
      const {page} = shared;
      const all = await shownPaths(page);
      assert.ok(all >= 2, `${all} paths`);
      const box = page.locator('.candidates tbody tr').nth(1).locator('input[type=checkbox]');
      await box.uncheck();
      assert.equal(await shownPaths(page), all - 1);
      await page.locator('.candidates tbody tr').nth(1).locator('td').last().click();
      assert.equal(await shownPaths(page), all);
      assert.ok(await box.isChecked());
      const followed = await page.locator('.candidates tr.selected th').innerText();
      assert.ok((await page.locator('#along-path').innerText()).startsWith(`Path ${followed}`));
    });

    test('the table sorts by any column, both ways, by the keyboard too', async () => {
      const {page} = shared;
      const ranks = () => page.locator('.candidates tbody tr:not(.overturned) th').allInnerTexts();
      const energies = await page.evaluate(
          () => view.paths.filter(p => p.verified_path)
                    .sort((a, b) => a.energy_j - b.energy_j)
                    .map(p => p.label));
      const head = page.locator('.candidates thead button', {hasText: 'Energy'});
      await head.focus();
      await page.keyboard.press('Enter');
      assert.deepEqual(await ranks(), energies);
      await page.keyboard.press('Enter');
      assert.deepEqual(await ranks(), energies.slice().reverse());
      assert.equal(await page.locator('.candidates th[aria-sort=descending]').count(), 1);
    });

    test('playback moves the marker at the speed that was chosen, and pauses', async () => {
      const {page} = shared;
      const play = page.locator('#playback .play');
      await page.locator('#position').fill('0');
      await page.locator('#playback select').selectOption('20');
      const begun_ms = Date.now();
      await play.click();
      await page.waitForTimeout(500);
      await play.click();
      const reached_s = await timeOf(page), most_s = 20 * (Date.now() - begun_ms) / 1000;
      assert.ok(reached_s > 4 && reached_s < most_s, `${reached_s} s of ${most_s} s`);
      await page.waitForTimeout(150);
      assert.equal(await timeOf(page), reached_s);
      assert.match(await page.locator('#playback .clock').innerText(), /of/);
      assert.ok(await page.locator('#vehicle .vehicle-wheel').count() >= 4);
    });

    test('the map plays, steps, zooms and moves by the keyboard', async () => {
      const {page} = shared;
      await page.locator('#position').fill('10');
      await page.locator('#map').focus();
      const before_s = await timeOf(page);
      await page.keyboard.press('.');
      assert.ok(await timeOf(page) > before_s);
      await page.keyboard.press(',');
      assert.equal(await timeOf(page), before_s);
      const axes = () => page.locator('#map .axis').allTextContents();
      const first = await axes();
      await page.keyboard.press('+');
      const zoomed = await axes();
      assert.notDeepEqual(zoomed, first);
      await page.keyboard.press('ArrowLeft');
      assert.notDeepEqual(await axes(), zoomed);
      await page.keyboard.press('Space');
      // A busy machine draws no frame for a while.
      for (let tries = 0; tries < 50 && await timeOf(page) <= before_s; ++tries) {
        await page.waitForTimeout(100);
      }
      assert.ok(await timeOf(page) > before_s);
      await page.keyboard.press('Space');
      const paused_s = await timeOf(page);
      await page.waitForTimeout(150);
      assert.equal(await timeOf(page), paused_s);
    });

    test('a zoomed map follows the vehicle that plays', async () => {
      const {page} = shared;
      await page.locator('#map').focus();
      for (let i = 0; i < 9; ++i) await page.keyboard.press('+');
      await page.locator('#position').fill('0');
      await page.locator('#playback select').selectOption('100');
      await page.locator('#playback .play').click();
      await page.waitForTimeout(400);
      const inside = await page.evaluate(() => {
        const marker = document.querySelector('#map .vehicle').getBoundingClientRect();
        const map = document.getElementById('map').getBoundingClientRect();
        return marker.right > map.left && marker.left < map.right && marker.bottom > map.top &&
            marker.top < map.bottom;
      });
      assert.ok(inside);
    });
  });

describe('a plan', () => {
  const shared = openOnce('plan');

  test('Pareto marks stand where no other candidate is better in everything', async () => {
    const {page} = shared;
    const marked =
        await page.evaluate(() => view.paths.filter(p => p.verified_path && p.pareto).length);
    assert.ok(marked >= 1);
    assert.equal(await page.locator('.candidates tbody tr', {hasText: '\u25c6'}).count(), marked);
  });

  test('a mark of a rejected state says why when it is stepped to', async () => {
    const {page} = shared;
    await page.getByRole('button', {name: 'Next'}).click();
    assert.match(await page.locator('.mark-detail').innerText(), /Rejected for/);
  });

  test(
      'paths and ground take the colours that are chosen, and the pointer reads the ground',
      async () => {
        const {page} = shared;
        const colours = () =>
            page.locator('#map path.piece')
                .evaluateAll(pieces => pieces.map(piece => piece.getAttribute('stroke')).join());
        const picture = () => page.locator('#map canvas').evaluate(canvas => canvas.toDataURL());
        const byMargin = await colours();
        await page.getByLabel('Colour of the paths').selectOption({label: 'Speed, m/s'});
        assert.notEqual(await colours(), byMargin);
        const seen = new Set([await picture()]);
        const grounds =
            await page.getByLabel('Colour of the ground').locator('option').allInnerTexts();
        for (const ground
                 of ['Elevation', 'Slope', 'Margin of driving straight on',
                     'Share of soil draws that bear driving straight on'])
          assert.ok(grounds.includes(ground), ground);
        for (const label of grounds.slice(1)) {
          await page.getByLabel('Colour of the ground').selectOption({label});
          // A busy machine draws no frame for a while.
          for (let tries = 0; tries < 50 && seen.has(await picture()); ++tries)
            await page.waitForTimeout(60);
          seen.add(await picture());
        }
        assert.equal(seen.size, grounds.length);
        await page.getByLabel('Colour of the ground').selectOption({label: 'Slope'});
        await page.locator('#map').scrollIntoViewIfNeeded();
        const box = await page.locator('#map').boundingBox();
        await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
        assert.match(await page.locator('#map-pointer').innerText(), /x\s=.* slope \d+\.\d/);
      });

  test('charts show the other paths when asked to', async () => {
    const {page} = shared;
    assert.equal(await page.locator('#charts .other').count(), 0);
    await page.getByLabel('with the other paths shown').check();
    assert.ok(await page.locator('#charts .other').count() >= 10);
  });
});

test(
    'without a path, changes stand side by side, those that open the way with their paths',
    async () => {
      await withPage('undecided', async page => {
        assert.match(await page.locator('#what-if-title').innerText(), /smallest change/);
        const rows = page.locator('#what-ifs tbody tr');
        const texts = await rows.allInnerTexts();
        for (const change of [/with slope_max_deg/, /goal of radius_m/, /friction_angle_deg/])
          assert.ok(
              texts.some(text => change.test(text) && /no path found/.test(text)), texts.join());
        const opening = rows.filter({hasText: 'opens'});
        assert.equal(await opening.count(), 1);
        assert.match(await opening.innerText(), /^A\s+with margin_min 0\.21\s+opens/);
        assert.match(await page.locator('.candidates tbody').innerText(), /A/);
        const box = page.getByRole('checkbox', {name: /^Show/});
        assert.ok(await box.isChecked());
        assert.equal(await shownPaths(page), 1);
        await box.uncheck();
        assert.equal(await shownPaths(page), 0);
        await opening.getByRole('button').click();
        assert.equal(await shownPaths(page), 1);
        assert.match(await page.locator('#along-path').innerText(), /Path A/);
        assert.match(await readout(page), /\bA\b/);
      });
    });

for (const kind of ['skid evaluation', 'skid drive'])
  test(
      `${kind}: where nothing steers no angle of a wheel is shown`,
      () => withPage(kind, async (page, {errors}) => {
        const charts =
            await page.evaluate(() => CHARTS.map(({title, series}) => [title, series.length]));
        assert.ok(charts.length > 5);
        assert.deepEqual(
            charts.filter(([title, lines]) => lines === 0 || /Steering( angle|$)/.test(title)), []);
        assert.ok(!(await readout(page)).includes('Steering'));
        assert.deepEqual(errors, []);
      }));

// Numbers come to the very edge of the map as it is moved.
test(
    'no number of the map\'s axes is cut off',
    () => withPage('plan', async page => {
      const cut = () => page.evaluate(() => {
        const map = document.querySelector('#map svg').getBoundingClientRect();
        const isCut = text => {
          const {left, right, top, bottom} = text.getBoundingClientRect();
          return left < map.left || right > map.right || top < map.top || bottom > map.bottom;
        };
        return [...document.querySelectorAll('#map .axis text')].filter(isCut).map(
            text => text.textContent);
      });
      await page.locator('#map').scrollIntoViewIfNeeded();
      const box = await page.locator('#map').boundingBox();
      const [x, y] = [box.x + 0.3 * box.width, box.y + 0.3 * box.height];
      await page.mouse.move(x, y);
      await page.mouse.down();
      for (let moved = 0; moved <= 150; moved += 5) {
        await page.mouse.move(x + moved, y + moved);
        assert.deepEqual(await cut(), [], `moved by ${moved} pixels`);
      }
      await page.mouse.up();
    }));
