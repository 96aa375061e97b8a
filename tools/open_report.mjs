// How long Chromium takes to open a report: to the first paint, to the last figure, and the time the page's own thread computed for it,
// which is what the last figure would take on a core without other work.
//
//   node tools/open_report.mjs REPORT.html [ATTEMPTS]
import {existsSync, statSync} from 'node:fs';
import {createRequire} from 'node:module';
import {resolve} from 'node:path';

const require = createRequire(new URL('../web/package.json', import.meta.url));
const {chromium} = require('playwright-core');
const [file, attempts = '3'] = process.argv.slice(2);
const executablePath = ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find(existsSync);
if (!file || !executablePath) {
  console.error(file ? 'open_report: no Chromium (tools/setup.sh --tests installs it)' : 'usage: node tools/open_report.mjs REPORT.html [ATTEMPTS]');
  process.exit(2);
}
const browser = await chromium.launch({executablePath, args: ['--no-sandbox']});
for (let k = 0; k < Number(attempts); ++k) {
  const page = await browser.newPage({viewport: {width: 1300, height: 900}});
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable', {timeDomain: 'threadTicks'});
  await page.goto('file://' + resolve(file));
  await page.waitForFunction(() => document.querySelectorAll('.plot:not(.js-plotly-plot)').length === 0);
  const [first, last, figures] = await page.evaluate(() => [
    performance.getEntriesByType('paint')[0].startTime, performance.now(), document.querySelectorAll('.plot').length]);
  const {metrics} = await session.send('Performance.getMetrics');
  const computed = metrics.find((m) => m.name === 'TaskDuration').value;
  console.log(`first paint ${(first / 1000).toFixed(2)} s, ${figures} figures drawn ${(last / 1000).toFixed(2)} s, ` +
    `computed ${computed.toFixed(2)} s, ${(statSync(file).size / 1e6).toFixed(1)} MB`);
  await page.close();
}
await browser.close();
