// How long Chromium takes to open a report: to the first paint, to the last figure, and the time the page's own thread computed for the
// figures in sight and for all, which is what they would take on a core without other work.
//
//   node tools/open_report.mjs REPORT.html [ATTEMPTS]
import {statSync} from 'node:fs';
import {resolve} from 'node:path';
import {hasBrowser, launchBrowser} from './browser.mjs';

const [file, attempts = '3'] = process.argv.slice(2);
if (!file || !hasBrowser) {
  console.error(file ? 'open_report: no Chromium (tools/setup.sh --tests installs it)' : 'usage: node tools/open_report.mjs REPORT.html [ATTEMPTS]');
  process.exit(2);
}
const browser = await launchBrowser();
for (let k = 0; k < Number(attempts); ++k) {
  const page = await browser.newPage({viewport: {width: 1300, height: 900}});
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable', {timeDomain: 'threadTicks'});
  const computed = async () => (await session.send('Performance.getMetrics')).metrics.find((m) => m.name === 'TaskDuration').value.toFixed(2);
  await page.goto('file://' + resolve(file), {waitUntil: 'commit'});
  await page.waitForFunction(() => document.readyState !== 'loading' && [...document.querySelectorAll('.plot')].every(
    (p) => p.classList.contains('js-plotly-plot') || p.getBoundingClientRect().top > innerHeight), null, {polling: 10});
  const sight = await computed();
  await page.waitForFunction(() => document.querySelectorAll('.plot:not(.js-plotly-plot)').length === 0);
  const [first, last, figures] = await page.evaluate(() => [
    performance.getEntriesByType('paint')[0].startTime, performance.now(), document.querySelectorAll('.plot').length]);
  console.log(`first paint ${(first / 1000).toFixed(2)} s, ${figures} figures after ${(last / 1000).toFixed(2)} s; computed: those in sight ${sight} s, ` +
    `all ${await computed()} s; ${(statSync(file).size / 1e6).toFixed(1)} MB`);
  await page.close();
}
await browser.close();
