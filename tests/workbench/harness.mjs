// What every walk through the workbench needs: a folder, a server, a page that fails on a console error, a violation of the content
// security policy or a request to elsewhere, and axe-core.
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {dirname, join, resolve} from 'node:path';
import {hasBrowser, launchBrowser} from '../../tools/browser.mjs';

const [ambrig, source, screenshots] = process.argv.slice(2).map((p) => resolve(p));
const require = createRequire(join(source, 'web', 'package.json'));
const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
if (!hasBrowser) {
  console.log('no Chromium (tools/setup.sh --tests installs it)');
  process.exit(77);
}

export {ambrig, assert, source};
export const folder = mkdtempSync(join(tmpdir(), 'ambrig-walk-'));
const problems = [];
const begin = Date.now();
export const seconds = () => (Date.now() - begin) / 1000;
export const say = (text) => console.log(`${seconds().toFixed(1).padStart(6)} s  ${text}`);

export const inFolder = (name) => join(folder, name);
export const text = (name) => readFileSync(inFolder(name), 'utf8');
export function write(name, content) {
  mkdirSync(dirname(inFolder(name)), {recursive: true});
  writeFileSync(inFolder(name), content);
}
export const command = (...words) => execFileSync(ambrig, words, {cwd: folder, stdio: ['ignore', 'pipe', 'pipe']});

/** Only the records of a case whose lines these words are found in. */
export function keepRecords(file, which) {
  const [head, ...records] = text(file).split('[[record]]');
  write(file, head + records.filter((r) => which.test(r)).map((r) => '[[record]]' + r).join(''));
}

export function startServer() {
  const child = spawn(ambrig, ['serve', folder, '--address-file', inFolder('address.txt')], {stdio: ['ignore', 'pipe', 'inherit']});
  return new Promise((done, failed) => {
    let said = '';
    child.stdout.on('data', (bytes) => {
      said += bytes;
      const found = /http:\S+#token=\w+/.exec(said);
      if (found) done({child, address: found[0]});
    });
    child.on('exit', (code) => failed(new Error(`the server ended with ${code}: ${said}`)));
  });
}

/** Serious findings of axe-core as lines. */
async function findings(page) {
  await page.evaluate(axe);
  const result = await page.evaluate(() => globalThis.axe.run(document, {resultTypes: ['violations']}));
  return result.violations.filter((v) => v.impact === 'serious' || v.impact === 'critical')
    .flatMap((v) => v.nodes.map((n) => `${v.id}: ${v.help}: ${n.html.slice(0, 140)}`));
}

export async function shot(page, name) {
  if (!screenshots) return;
  mkdirSync(screenshots, {recursive: true});
  await page.screenshot({path: join(screenshots, `${name}.png`)});
}

export async function check(page, name) {
  await shot(page, name);
  const bad = await findings(page);
  assert.deepEqual(bad, [], `axe-core: ${name}`);
  say(`${name}: no serious finding`);
}

/** Whether the canvas of a panel has ink of this many pixels beside its grid: a line is drawn. */
export async function drawn(page, label) {
  const panel = page.locator(`.panel[aria-label*="${label}"] canvas`).first();
  await panel.waitFor({timeout: 30000});
  await page.waitForFunction((l) => {
    const c = document.querySelector(`.panel[aria-label*="${l}"] canvas`);
    if (!c) return false;
    const pixels = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
    const tones = new Set();
    for (let k = 0; k < pixels.length; k += 4) if (pixels[k + 3] > 200) tones.add((pixels[k] >> 5) * 64 + (pixels[k + 1] >> 5) * 8 + (pixels[k + 2] >> 5));
    let ink = 0;
    for (let k = 0; k < pixels.length; k += 4) if (pixels[k + 3] > 200 && Math.min(pixels[k], pixels[k + 1], pixels[k + 2]) < 150) ++ink;
    return ink > 600;
  }, label, {timeout: 20000});
}

/** A browser whose page uses the files of the source folder when AMBRIG_PAGE is set. */
export async function openBrowser(address, options = {}) {
  // bypassCSP would hide violations; axe comes by evaluate, which the policy does not forbid.
  const browser = await launchBrowser();
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, colorScheme: 'light', acceptDownloads: true, ...options});
  const page = await context.newPage();
  page.on('console', (m) => m.type() === 'error' && problems.push(`console: ${m.text()}`));
  page.on('pageerror', (e) => problems.push(`page: ${e.message}`));
  page.on('request', (r) => {
    if (!/^(data|blob):/.test(r.url()) && !r.url().startsWith(new URL(address).origin)) problems.push(`request elsewhere: ${r.url()}`);
  });
  if (process.env.AMBRIG_PAGE)
    await page.route('**/a/*', (route) => {
      const file = join(source, 'web/workbench', new URL(route.request().url()).pathname.slice(3));
      return existsSync(file) ? route.fulfill({path: file}) : route.fallback();
    });
  return {browser, page};
}

/** A problem that a flow asks for, as a file that is not there, is none. @param {RegExp} which */
export function forgive(which) {
  problems.splice(0, problems.length, ...problems.filter((p) => !which.test(p)));
}

/** One flow in a page of its own. @returns {Promise<Error|null>} why it failed */
async function walkOne(name, flow, address) {
  const {browser, page} = await openBrowser(address, flow.options);
  try {
    await flow(page, address);
    assert.deepEqual(problems, [], name);
    say(`${name} done`);
    return null;
  } catch (error) {
    await shot(page, `failed-${name}`);
    say(`${name} FAILED: ${error.stack}`);
    say(`notice: ${await page.locator('.notice').innerText({timeout: 1000}).catch(() => 'none')}; problems: ${problems.join('; ') || 'none'}`);
    return error;
  } finally {
    problems.length = 0;
    await browser.close();
  }
}

/** Runs the flows one after the other; AMBRIG_FLOW chooses some. One that fails does not hide what the others find. */
export async function walk(flows, make) {
  make();
  const server = await startServer();
  const failed = [];
  try {
    for (const [name, flow] of Object.entries(flows)) {
      if (process.env.AMBRIG_FLOW && !process.env.AMBRIG_FLOW.split(',').includes(name)) continue;
      if (await walkOne(name, flow, server.address)) failed.push(name);
    }
  } finally {
    server.child.removeAllListeners('exit');
    server.child.kill('SIGINT');
    await new Promise((ended) => server.child.on('exit', ended));
    if (!process.env.AMBRIG_KEEP) rmSync(folder, {recursive: true});
  }
  assert.deepEqual(failed, [], 'flows that failed');
  say('done');
}
