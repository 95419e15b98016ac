// The reports under test in a headless Chromium.
import {existsSync, statSync} from 'node:fs';
import {join} from 'node:path';
import {chromium} from 'playwright-core';

export const KINDS = [
  'plan', 'evaluation', 'manoeuvres', 'drive', 'drives', 'drives undecided', 'loop', 'diagnosis',
  'benchmark', 'comparison'
];
const folder = process.env.REGOPLAN_PAGES;
/// The demo's loop and what was diagnosed on the way lie beside its plan.
const FILES = {
  loop: 'plan/drive/report.html',
  drives: 'plan/drive/diagnosis.html',
  'drives undecided': 'drives/report.html',
};
export const fileOf = kind => join(folder, FILES[kind] || `${kind}/report.html`);
export const bytesOf = kind => statSync(fileOf(kind)).size;

/// The shell draws the same pages and starts in less than half the time.
const PROGRAM =
    ['/usr/bin/chromium-headless-shell', '/usr/bin/chromium'].find(program => existsSync(program));

let browser = null;
export async function startBrowser() {
  browser = await chromium.launch({executablePath: PROGRAM, args: ['--no-sandbox']});
}
export const stopBrowser = () => browser.close();

/// A chart learns its width when the page is laid out, and is drawn in the frame after.
const chartsAreDrawn = () => new Promise(
    done => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done))));

/// Browser pages that were closed and may show another report: a new one takes three times as long.
const idle = [];
async function newPage() {
  const context = await browser.newContext({acceptDownloads: true});
  context.setDefaultTimeout(15000);
  return context.newPage();
}

/// Opens a report: its page, what went wrong so far, how long it took, and close(). The browser page
/// has shown other reports before, unless it is `unused`.
export async function openPage(kind, {width = 1600, theme = 'light', unused = false} = {}) {
  const page = !unused && idle.pop() || await newPage(), errors = [], requests = [];
  await page.setViewportSize({width, height: 900});
  await page.emulateMedia({media: 'screen', colorScheme: theme});
  await page.mouse.move(0, 0);
  page.on('console', message => message.type() === 'error' && errors.push(message.text()));
  page.on('pageerror', error => errors.push(error.message));
  page.on('request', request => requests.push(request.url()));
  const before = Date.now();
  let opened_ms;
  try {
    await page.goto(`file://${fileOf(kind)}`);
    await page.waitForSelector('html[data-drawn=yes]');
    opened_ms = Date.now() - before;
    await page.evaluate(chartsAreDrawn);
  } catch (failure) {
    await page.context().close();
    throw new Error(errors.join('; ') || failure.message);
  }
  const close = async () => {
    page.removeAllListeners();
    if (unused)
      await page.context().close();
    else
      idle.push(page);
  };
  return {page, errors, requests, opened_ms, close};
}

/// Opens a report and hands it to `look(page)` with what went wrong so far.
export async function withPage(kind, look, options = {}) {
  const {page, close, ...now} = await openPage(kind, options);
  try {
    await look(page, now);
  } finally {
    await close();
  }
}
