// A picture of a page, or of one element of it, when all its figures are drawn.
//
//   node tools/page_picture.mjs PAGE.html[#ELEMENT] WIDTHxHEIGHT PICTURE.png
import {resolve} from 'node:path';
import {hasBrowser, launchBrowser} from './browser.mjs';

const [address, size, picture] = process.argv.slice(2);
if (!picture || !/^\d+x\d+$/.test(size) || !hasBrowser) {
  console.error(picture && !hasBrowser ? 'page_picture: no Chromium (tools/setup.sh --tests installs it)' : 'usage: node tools/page_picture.mjs PAGE.html[#ELEMENT] WIDTHxHEIGHT PICTURE.png');
  process.exit(2);
}
const [file, element] = address.split('#');
const [width, height] = size.split('x').map(Number);
const browser = await launchBrowser();
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
