// Walks through the main flow of the workbench as a person would: open a case, see where the model fails, explain, adopt,
// watch the error fall. Fails on a console error, a violation of the content security policy, a request to elsewhere or
// a serious finding of axe-core.
//
//   node walk.mjs AMBRIG SOURCE_FOLDER [SCREENSHOT_FOLDER]
//
// With AMBRIG_PAGE set, the page's files are taken from SOURCE_FOLDER/web/workbench instead of the binary.
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';

const [ambrig, source, screenshots] = process.argv.slice(2).map((p) => resolve(p));
const require = createRequire(join(source, 'web', 'package.json'));
const {chromium} = require('playwright-core');
const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
const browserFile = ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find(existsSync);
if (!browserFile) {
  console.log('no Chromium (tools/setup.sh --tests installs it)');
  process.exit(77);
}

const folder = mkdtempSync(join(tmpdir(), 'ambrig-walk-'));
const problems = [];
const begin = Date.now();
const say = (text) => console.log(`${((Date.now() - begin) / 1000).toFixed(1).padStart(6)} s  ${text}`);

/** A case with a hidden effect, of few records, so that explaining takes seconds. */
function makeCase() {
  execFileSync(ambrig, ['hide', 'cross-coupling@A', '--rig', join(source, 'examples/reference/rig.toml'), '-o', 'practice', '--seed', '3'], {cwd: folder});
  // The third practice case of this seed has a current in the wrong unit.
  execFileSync(ambrig, ['practice', join(source, 'examples/reference/rig.toml'), '--cases', '3', '--make-only', '-o', 'spoiled'], {cwd: folder});
  const spoiled = join(folder, 'spoiled/case-0003/case.toml');
  keepRecords(spoiled, /record-(2|4|8)\.h5/);
  writeFileSync(join(folder, 'rig.toml'), readFileSync(join(source, 'examples/reference/rig.toml')));
  writeFileSync(join(folder, 'healthy.toml'), 'name = "healthy"\nrig = "rig.toml"\nduration = 0.15\nrecord_rate = 12500.0\nseed = 1\n\n[speed]\nprofile = [[0.0, 157.08]]\n');
  const file = join(folder, 'practice', 'case.toml');
  keepRecords(file, /record-(1|4|8)\.h5/);
}

function keepRecords(file, which) {
  const [head, ...records] = readFileSync(file, 'utf8').split('[[record]]');
  writeFileSync(file, head + records.filter((r) => which.test(r)).map((r) => '[[record]]' + r).join(''));
}

function startServer() {
  const child = spawn(ambrig, ['serve', folder, '--address-file', join(folder, 'address.txt')], {stdio: ['ignore', 'pipe', 'inherit']});
  return new Promise((done, failed) => {
    let text = '';
    child.stdout.on('data', (bytes) => {
      text += bytes;
      const found = /http:\S+#token=\w+/.exec(text);
      if (found) done({child, address: found[0]});
    });
    child.on('exit', (code) => failed(new Error(`the server ended with ${code}: ${text}`)));
  });
}

/** Serious findings of axe-core as lines. */
async function findings(page) {
  await page.evaluate(axe);
  const result = await page.evaluate(() => globalThis.axe.run(document, {resultTypes: ['violations']}));
  return result.violations.filter((v) => v.impact === 'serious' || v.impact === 'critical')
    .flatMap((v) => v.nodes.map((n) => `${v.id}: ${v.help}: ${n.html.slice(0, 140)}`));
}

async function shot(page, name) {
  if (!screenshots) return;
  mkdirSync(screenshots, {recursive: true});
  await page.screenshot({path: join(screenshots, `${name}.png`)});
}

async function check(page, name) {
  await shot(page, name);
  const bad = await findings(page);
  assert.deepEqual(bad, [], `axe-core: ${name}`);
  say(`${name}: no serious finding`);
}

async function walk(address) {
  // bypassCSP would hide violations; axe comes by evaluate, which the policy does not forbid.
  const browser = await chromium.launch({executablePath: browserFile, args: ['--no-sandbox']});
  const page = await browser.newPage({viewport: {width: 1280, height: 800}, colorScheme: 'light'});
  page.on('console', (m) => m.type() === 'error' && problems.push(`console: ${m.text()}`));
  page.on('pageerror', (e) => problems.push(`page: ${e.message}`));
  page.on('request', (r) => {
    if (!r.url().startsWith(new URL(address).origin) && !r.url().startsWith('data:')) problems.push(`request elsewhere: ${r.url()}`);
  });
  if (process.env.AMBRIG_PAGE)
    await page.route('**/a/*', (route) => {
      const file = join(source, 'web/workbench', new URL(route.request().url()).pathname.slice(3));
      return existsSync(file) ? route.fulfill({path: file}) : route.fallback();
    });
  try {
    for (const [name, flow] of Object.entries({playground, mendData, mainFlow}))
      if (!process.env.AMBRIG_FLOW || process.env.AMBRIG_FLOW === name) await flow(page, address);
  } catch (error) {
    await shot(page, 'failed');
    throw error;
  } finally {
    await browser.close();
  }
}

async function mainFlow(page, address) {
  await page.goto(address);
  const link = page.getByRole('link', {name: 'practice/case.toml'});
  await link.waitFor();
  assert.ok(!page.url().includes('token'), 'the key stays out of the address');
  await check(page, 'folder');

  await link.click();
  const table = page.locator('table.misfit').first();
  await table.waitFor({timeout: 60000});
  await page.locator('.panel canvas').nth(1).waitFor({timeout: 30000});
  const worst = await page.locator('td.cell button[aria-pressed="true"]').getAttribute('aria-label');
  say(`worst cell: ${worst}`);
  assert.match(worst, /A\./);  // the hidden effect acts at A
  await check(page, 'misfit');

  // Another cell, then the address is the view: going back shows the first one.
  const other = page.locator('td.cell button[aria-pressed="false"]').first();
  const name = await other.getAttribute('aria-label');
  await other.click();
  await page.locator(`td.cell button[aria-pressed="true"][aria-label="${name}"]`).waitFor();
  assert.match(page.url(), /r=record-/);
  await page.goBack();
  await page.locator(`td.cell button[aria-pressed="true"][aria-label="${worst}"]`).waitFor();

  // A drag zooms every panel, once the panels are those of the first cell again.
  const [record, channel] = worst.split(':')[0].split(', ');
  await page.locator(`[aria-busy="false"] > .panel[aria-label^="${channel} ["][aria-label*="${record}"]`).waitFor();
  const over = page.locator('.panel .u-over').first();
  const box = await over.boundingBox();
  await page.mouse.move(box.x + box.width * 0.3, box.y + 30);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.6, box.y + 40, {steps: 5});
  await page.mouse.up();
  await page.waitForURL(/t=0\.\d+,0\.\d+/);
  // 0.3 to 0.6 of the record's 0.35 s, to a pixel.
  const [from, to] = /t=([\d.]+),([\d.]+)/.exec(page.url()).slice(1).map(Number);
  assert.ok(Math.abs(from - 0.105) < 0.003 && Math.abs(to - 0.21) < 0.003, `the zoom shows what was dragged: ${from} to ${to}`);

  await page.getByRole('button', {name: 'Explain', exact: true}).click();
  await page.locator('.stages .now').waitFor();
  await page.waitForFunction(() => Number(document.querySelector('section.explain progress')?.value) >= 2, null, {timeout: 60000});
  await shot(page, 'explain-running');
  say('explain runs and shows its progress');
  // Stop keeps what is there; explaining goes on from it.
  await page.getByRole('button', {name: 'Stop', exact: true}).click();
  const resume = page.getByRole('button', {name: 'Resume explain'});
  await resume.waitFor({timeout: 15000});
  say('explain stopped');
  await resume.click();
  const adopt = page.getByRole('button', {name: 'Adopt cross-coupling at A'});
  await adopt.waitFor({timeout: 480000});
  say('explain names cross-coupling at A');
  assert.match(await page.locator('.names').innerText(), /cross-coupling at A/);
  assert.match(await page.locator('section.explain').innerText(), /of the error above the noise is explained/);
  await check(page, 'explain');

  await adopt.click();
  await page.getByRole('button', {name: 'Write and compare again'}).click();
  const open = page.getByRole('button', {name: 'Open practice/case_2.toml'});
  await open.waitFor({timeout: 120000});
  const steps = await page.locator('section.adopt table.steps tbody tr').allInnerTexts();
  const ratios = steps.map((row) => Number(row.split('\t').at(-1)));
  say(`the ladder: ${ratios.join(' -> ')}`);
  assert.ok(ratios[0] > 2 && ratios.at(-1) < 1.2, `the error fell: ${ratios}`);
  assert.match(readFileSync(join(folder, 'practice/rig_2.toml'), 'utf8'), /cross-coupling/);
  await check(page, 'ladder');

  await open.click();
  await page.getByRole('heading', {name: 'practice/case_2.toml'}).waitFor();
  await page.locator('table.misfit').first().waitFor({timeout: 60000});
  const after = await page.locator('section.misfit-part strong').first().innerText();
  assert.ok(Number(after) < 1.2, `the new case is explained: ${after}`);
  await check(page, 'adopted');

  // A closed page loses nothing.
  await page.goto(address);
  await page.reload();
  await page.getByRole('link', {name: 'practice/case_2.toml'}).waitFor();
  assert.match(await page.locator('main table').innerText(), /cross-coupling at A/);
}

/** A coil is broken by a click, and by the keyboard alone; both runs are real ones. */
async function playground(page, address) {
  await page.goto(address);
  await page.getByRole('link', {name: 'healthy.toml'}).click();
  await page.getByRole('button', {name: 'Run', exact: true}).click();
  await page.locator('.verdict').waitFor({timeout: 60000});
  assert.match(await page.locator('.verdict').innerText(), /stayed up/);
  await page.locator('.stator .orbit').first().waitFor({timeout: 30000});
  await page.getByRole('button', {name: 'A3, healthy'}).click();
  const second = page.getByRole('button', {name: 'A4, healthy'});
  await second.focus();
  await page.keyboard.press('Enter');
  await check(page, 'playground');
  await page.getByRole('button', {name: /these 2 faults and run it/}).click();
  await page.getByRole('heading', {name: 'healthy_2.toml'}).waitFor();
  await page.locator('.events li').first().waitFor({timeout: 60000});
  const events = await page.locator('.events').innerText();
  assert.match(events, /fault A\.coil3/);
  assert.match(events, /fault A\.coil4/);
  assert.match(events, /detected/);
  await page.locator('.panel[aria-label*="healthy_2.toml"]').first().waitFor({timeout: 30000});
  await check(page, 'fault');
  await page.getByRole('button', {name: 'Undo'}).click();
  await page.waitForFunction(() => document.querySelector('.notice')?.textContent?.includes('as it was'));
  assert.ok(!existsSync(join(folder, 'healthy_2.toml')), 'undo takes the written scenario back');
}

/** A record whose unit is wrong: named, mended by a click, and taken back. */
async function mendData(page, address) {
  await page.goto(address);
  await page.getByRole('link', {name: 'spoiled/case-0003/case.toml'}).click();
  const fault = page.locator('.faults li').first();
  await fault.waitFor({timeout: 120000});
  assert.match(await fault.innerText(), /A\.i1: unit/);
  await check(page, 'data-fault');
  await page.getByRole('button', {name: 'Write this line into the case'}).click();
  await page.locator('.faults').waitFor({state: 'detached', timeout: 120000});
  const file = join(folder, 'spoiled/case-0003/case.toml');
  assert.match(readFileSync(file, 'utf8'), /channels\."A\.i1" = \{ column = "A\.i1", unit = "mA" \}/);
  await page.getByRole('button', {name: 'Undo'}).click();
  await page.locator('.faults li').first().waitFor({timeout: 120000});
  assert.doesNotMatch(readFileSync(file, 'utf8'), /mA/);
  say('a wrong unit was mended and the mend undone');
}

makeCase();
const server = await startServer();
try {
  await walk(server.address);
} finally {
  server.child.removeAllListeners('exit');
  server.child.kill('SIGINT');
  await new Promise((ended) => server.child.on('exit', ended));
  if (!process.env.AMBRIG_KEEP) rmSync(folder, {recursive: true});
}
assert.deepEqual(problems, []);
say('done');
