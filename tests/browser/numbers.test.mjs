// Numbers on pages, as an engineer writes them.
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';

import {startBrowser, stopBrowser, withPage} from './pages.mjs';

before(startBrowser);
after(stopBrowser);

test('a number keeps its significant digits, whatever its size', async () => {
  await withPage('plan', async page => {
    const shown = await page.evaluate(
        () => [4e5, 814432, -12345, 99960, 1379.6, 0.0362, 0.000123456, 2.5e-7, 3.14159e9].map(
            value => significant(value, 3)));
    assert.deepEqual(shown, [
      '400\u202f000', '814\u202f000', '\u221212\u202f300', '100\u202f000', '1380', '0.0362',
      '1.23e\u22124', '2.5e\u22127', '3.14e9'
    ]);
  });
});

test('a soil number says its unit, the bearing numbers theirs by the exponent of the sinkage', async () => {
  await withPage('plan', async page => {
    const table = await page.locator('body').evaluate(body => body.textContent);
    for (const text of ['kc (N/m\u207f\u207a\u00b9)', 'kphi (N/m\u207f\u207a\u00b2)', 'cohesion (Pa)'])
      assert.ok(table.includes(text), text);
    const units = await page.evaluate(() => ['kx0_m', 'kx1_m', 'ky1_m'].map(key => nameAndUnit(key).unit));
    assert.deepEqual(units, ['m', 'm/rad', 'm/rad']);
  });
});
