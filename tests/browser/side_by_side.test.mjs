// Paths side by side: what their margins spread over, their table and their drawings.
import assert from 'node:assert/strict';
import {after, before, describe, test} from 'node:test';

import {startBrowser, stopBrowser, withPage} from './pages.mjs';

before(startBrowser);
after(stopBrowser);

for (const kind of ['evaluation', 'manoeuvres'])
  describe(kind, () => {
    test('every margin of every path is a dot that says what it is', async () => {
      await withPage(kind, async page => {
        const svg = page.locator('#spreads svg[role=img]').first();
        const expected = await page.evaluate(() => 3 * REPORT.courses.length);
        await svg.focus();
        const said = new Set();
        for (let i = 0; i < expected; ++i) {
          await page.keyboard.press('ArrowRight');
          said.add(await page.locator('#spreads .tooltip').first().innerText());
        }
        assert.equal(said.size, expected);
        for (const text of said) assert.match(text, /margin: .* in 90 % of the draws/);
      });
    });

    test('a dot lies within its interval, and that within the axis', async () => {
      await withPage(kind, async page => {
        const outside = await page.evaluate(
            () => REPORT.courses.flatMap(
                course => course.spreads.filter(s => s.p05 > s.p50 || s.p50 > s.p95)));
        assert.deepEqual(outside, []);
        const box = await page.locator('#spreads svg[role=img]').first().boundingBox();
        for (const path of await page.locator('#spreads svg[role=img]')
                 .first()
                 .locator('path[transform]')
                 .all()) {
          const dot = await path.boundingBox();
          assert.ok(dot.x >= box.x && dot.x + dot.width <= box.x + box.width);
        }
      });
    });

    test('the limit of the margins runs through no path\'s name', async () => {
      await withPage(kind, async page => {
        const boxes = await page.evaluate(() => {
          const of = found => [...document.querySelectorAll(found)].map(node => {
            const {left, right, top, bottom} = node.getBoundingClientRect();
            return {left, right, top, bottom};
          });
          return {lines: of('#spreads .limit'), names: of('#spreads .row-name')};
        });
        assert.ok(boxes.lines.length > 0);
        for (const line of boxes.lines)
          for (const name of boxes.names) {
            // A box of letters reaches a little below them.
            const meets = line.left < name.right && line.right > name.left &&
                line.top < name.bottom - 2 && line.bottom > name.top;
            assert.ok(!meets, JSON.stringify({line, name}));
          }
      });
    });

    test('rows are no higher than their first cell, which stays in sight', async () => {
      await withPage(kind, async page => {
        const rows = await page.evaluate(
            () => [...document.querySelectorAll('.one-line tbody tr')].map(row => {
              const range = document.createRange();
              range.selectNodeContents(row.cells[0]);
              return {row: row.clientHeight, first: range.getBoundingClientRect().height};
            }));
        assert.ok(rows.length >= 2);
        for (const {row, first} of rows) assert.ok(row < first + 16, `${row} px for ${first} px`);
        const scroll = page.locator('.scroll', {has: page.locator('.one-line')});
        await scroll.evaluate(node => (node.scrollLeft = node.scrollWidth));
        const [outer, cell] = [
          await scroll.boundingBox(),
          await page.locator('.one-line tbody th').first().boundingBox(),
        ];
        assert.ok(Math.abs(cell.x - outer.x) < 2, `${cell.x} for ${outer.x}`);
      }, {width: 400});
    });

    test('each path is drawn, and says how it was judged', async () => {
      await withPage(kind, async page => {
        const articles = page.locator('article', {has: page.locator('.course')});
        assert.equal(await articles.count(), await page.evaluate(() => REPORT.courses.length));
        for (const article of await articles.all()) {
          assert.ok(await article.locator('svg[role=img] line').count() > 10);
          assert.match(await article.innerText(), /is (not )?feasible/);
        }
      });
    });
  });

test('a refused path is marked where it was refused', async () => {
  await withPage('manoeuvres', async page => {
    const refused = await page.evaluate(() => REPORT.courses.filter(c => c.refused).length);
    assert.ok(refused > 0);
    assert.equal(await page.locator('article .refused').count(), refused);
  });
});

for (const kind of ['plan', 'evaluation'])
  test(`${kind}: a name of sixty letters does not widen the page`, async () => {
    await withPage(kind, async page => {
      await page.evaluate(() => {
        const letters = 'a_name_of_sixty_letters_'.repeat(3).slice(0, 60);
        for (const node of document.querySelectorAll('h3, .key, .layers li, .candidates td, p'))
          for (const child of node.childNodes)
            if (child.nodeType === Node.TEXT_NODE && child.textContent.trim())
              child.textContent = letters;
      });
      const sideways = await page.evaluate(
          () => document.documentElement.scrollWidth - document.documentElement.clientWidth);
      assert.equal(sideways, 0);
    }, {width: 400});
  });
