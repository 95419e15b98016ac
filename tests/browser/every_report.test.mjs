// What every report keeps, whatever it is about.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {after, before, describe, test} from 'node:test';

import {bytesOf, fileOf, KINDS, openPage, startBrowser, stopBrowser, withPage} from './pages.mjs';

before(startBrowser);
after(stopBrowser);

const sideways = page => page.evaluate(
    () => document.documentElement.scrollWidth - document.documentElement.clientWidth);

async function fits(page, theme) {
  assert.equal(await sideways(page), 0);
  const ground = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const lightness = ground.match(/\d+/g).slice(0, 3).reduce((sum, c) => sum + +c, 0);
  assert.equal(lightness < 384, theme === 'dark', ground);
}

for (const kind of KINDS)
  describe(kind, () => {
    // Opening a page takes longer than looking at it: these tests look at one, in their order.
    let page, errors, requests, close;
    before(async () => {
      ({page, errors, requests, close} = await openPage(kind));
      await page.waitForTimeout(100);
    });
    after(() => close());

    test('opens without an error, and loads nothing else', async () => {
      assert.ok(bytesOf(kind) < 5e6, `${bytesOf(kind)} bytes`);
      assert.deepEqual(errors, []);
      const others = requests.filter(url => !url.startsWith('data:') && !url.startsWith('blob:'));
      assert.deepEqual(others, [`file://${fileOf(kind)}`]);
      assert.equal(await page.locator('#failure').isVisible(), false);
      const text = await page.locator('body').innerText();
      for (const slip of ['NaN', 'undefined', '[object'])
        assert.ok(!text.includes(slip), `shows ${slip}`);
    });

    // A window of another width, and a theme that changes while the page is open.
    for (const [width, theme] of [[1600, 'light'], [1600, 'dark'], [360, 'light']])
      test(`fits ${width} pixels in the ${theme} theme`, async () => {
        await page.setViewportSize({width, height: 900});
        await page.emulateMedia({colorScheme: theme});
        await page.waitForTimeout(100);
        await fits(page, theme);
        assert.deepEqual(errors, []);
      });
    test('opens on a telephone in the dark theme', async () => {
      await withPage(kind, async (other, now) => {
        await other.waitForTimeout(100);
        await fits(other, 'dark');
        assert.deepEqual(now.errors, []);
      }, {width: 360, theme: 'dark'});
      await page.setViewportSize({width: 1600, height: 900});
    });

    test('every control is reached by the keyboard, and has a name', async () => {
      const controls = 'button, input, select, summary, [role=region], #map';
      const unreached = await page.evaluate(async selector => {
        const shown = [...document.querySelectorAll(selector)].filter(
            node => node.checkVisibility() && !node.disabled);
        const unnamed = shown.filter(
            node =>
                !(node.getAttribute('aria-label') || node.textContent.trim() ||
                  (node.labels && node.labels.length)));
        const untouchable = shown.filter(node => node.tabIndex < 0);
        return [...unnamed, ...untouchable].map(node => node.outerHTML.slice(0, 120));
      }, controls);
      assert.deepEqual(unreached, []);
      // The focus shows: an outline, not only a colour.
      await page.keyboard.press('Tab');
      const outline =
          await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
      assert.notEqual(outline, 'none');
    });

    test('every figure says in words what it shows', async () => {
      const figures = await page.evaluate(
          () => [...document.querySelectorAll('figure svg[role=img]')].map(svg => {
            const textOf = name =>
                document.getElementById(svg.getAttribute(name)).textContent.trim();
            return [textOf('aria-labelledby'), textOf('aria-describedby')];
          }));
      assert.ok(figures.length > 0);
      for (const [title, words] of figures)
        assert.ok(title && words.length > 15, `${title}: ${words}`);
    });

    test('a figure saves as SVG, PNG and CSV', async () => {
      const figure = page.locator('figure.chart').first();
      await figure.locator('summary').click();
      // Chromium makes a picture between two frames: a second later where the page stands still.
      await page.evaluate(() => {
        const again = () => requestAnimationFrame(again);
        again();
      });
      const saved = {};
      for (const type of ['SVG', 'PNG', 'CSV']) {
        const [file] = await Promise.all(
            [page.waitForEvent('download'), figure.getByRole('button', {name: type}).click()]);
        const about = kind.split(' ')[0];
        assert.ok(file.suggestedFilename().startsWith(`${about}-`), file.suggestedFilename());
        saved[type] = readFileSync(await file.path());
      }
      const svg = saved.SVG.toString();
      assert.match(svg, /^<svg [^>]*xmlns="http:\/\/www.w3.org\/2000\/svg"/);
      assert.ok(!/var\(--|class="/.test(svg), 'the picture needs the page');
      assert.equal(saved.PNG.subarray(1, 4).toString(), 'PNG');
      assert.ok(saved.PNG.length > 3000);
      const lines = saved.CSV.toString().trim().split('\n');
      assert.ok(lines.length > 1);
      assert.match(lines[0], /^[a-z0-9_]+(,[a-z0-9_]+)+$/i);
      assert.deepEqual(errors, []);
    });

    test('prints without its controls', async () => {
      await page.emulateMedia({media: 'print'});
      assert.equal(await page.locator('.screen-only:visible').count(), 0);
      assert.ok((await page.pdf()).length > 10000);
      assert.deepEqual(errors, []);
    });
  });
