// A picture of a page, or of one element of it, when all its figures are drawn.
//
//   node tools/page_picture.mjs PAGE.html[#ELEMENT] WIDTHxHEIGHT PICTURE.png
import {existsSync} from 'node:fs';
import {createRequire} from 'node:module';
import {resolve} from 'node:path';

const require = createRequire(new URL('../web/package.json', import.meta.url));
const {chromium} = require('playwright-core');
const [address, size, picture] = process.argv.slice(2);
const executablePath = ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find(existsSync);
if (!picture || !/^\d+x\d+$/.test(size) || !executablePath) {
  console.error(picture && !executablePath ? 'page_picture: no Chromium (tools/setup.sh --tests installs it)' : 'usage: node tools/page_picture.mjs PAGE.html[#ELEMENT] WIDTHxHEIGHT PICTURE.png');
  process.exit(2);
}
const [file, element] = address.split('#');
const [width, height] = size.split('x').map(Number);
const browser = await chromium.launch({executablePath, args: ['--no-sandbox']});
const page = await browser.newPage({viewport: {width, height}});
await page.goto('file://' + resolve(file));
// Figures are drawn when they come into sight.
for (const plot of await page.locator('.plot').all()) {
  await plot.scrollIntoViewIfNeeded();
  await plot.locator('.main-svg').first().waitFor({timeout: 60000});
}
await page.evaluate(() => scrollTo(0, 0));
await page.waitForTimeout(500);  // the last figure's own drawing
if (element)
  await page.locator(`#${element}`).screenshot({path: picture});
else
  await page.screenshot({path: picture});
await browser.close();
