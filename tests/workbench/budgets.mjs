// The budgets of the workbench, measured: frames and zoom at 10^7 samples, first paint, weight of the page, a folder of 1000 files, a click on a
// coil, rows of a campaign, memory of the server. Prints every figure beside its budget.
//
//   node budgets.mjs AMBRIG SOURCE_FOLDER
//
// Times tell something only on a machine of their own: without AMBRIG_SLOW_TESTS=1 (nightly) it measures nothing and ends with exit code 77. A time is the
// best of some attempts; one over its budget fails, unless a thread got less than 0.8 of a core (others kept the machine busy).
import {readdirSync, readFileSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {assert, folder, inFolder, openBrowser, say, source, startServer, write} from './harness.mjs';
import {writeRecord} from './mat_file.mjs';

if (!process.env.AMBRIG_SLOW_TESTS) {
  say('measured with AMBRIG_SLOW_TESTS=1 only');
  rmSync(folder, {recursive: true});
  process.exit(77);
}
const samples = 1e7, channels = ['A.x', 'A.y', 'B.x', 'B.y'];

/** The share of a core that a thread gets now. */
function share() {
  const before = process.cpuUsage(), begin = performance.now();
  while (performance.now() - begin < 100);
  const used = process.cpuUsage(before);
  return (used.user + used.system) / 1000 / (performance.now() - begin);
}

const results = [];
/** 33.4 ms is a sum of doubles. */
const isOver = (value, budget) => value > budget * (1 + 1e-9);
/** @param {string} what @param {number} value @param {number} budget @param {string} unit */
function measured(what, value, budget, unit, calm = true) {
  results.push({what, value, budget, unit, calm});
  say(`${what}: ${value.toPrecision(3)} ${unit} (budget ${budget} ${unit})${isOver(value, budget) ? (calm ? '  OVER' : '  over, but others keep the cores busy') : ''}`);
}

/** The least of some attempts, once one is within the budget. @param {() => Promise<number>} act */
async function best(what, budget, unit, act, tries = 6) {
  let least = Infinity, calm = false;
  for (let k = 0; k < tries && isOver(least, budget); ++k) {
    for (let n = 0; n < 20 && share() < 0.8; ++n) await new Promise((resume) => setTimeout(resume, 250));
    const before = share(), value = await act();
    least = Math.min(least, value);
    calm ||= Math.min(before, share()) >= 0.8;
  }
  measured(what, least, budget, unit, calm);
}

/** Intervals between animation frames while `act` runs [ms]. */
async function frames(page, act) {
  await page.evaluate(() => {
    globalThis.ticks = [];
    const tick = (t) => {
      globalThis.ticks.push(t);
      if (globalThis.ticks) globalThis.ticking = requestAnimationFrame(tick);
    };
    globalThis.ticking = requestAnimationFrame(tick);
  });
  await act();
  const times = await page.evaluate(() => {
    cancelAnimationFrame(globalThis.ticking);
    return globalThis.ticks;
  });
  const intervals = times.slice(1).map((t, k) => t - times[k]).sort((a, b) => a - b);
  return {p95: intervals[Math.floor(0.95 * intervals.length)] ?? Infinity, most: intervals.at(-1) ?? Infinity, count: intervals.length};
}

/** Processor time of all processes below this one [ms]. */
function processorTime() {
  const of = new Map();
  for (const pid of readdirSync('/proc').filter((p) => /^\d+$/.test(p))) {
    try {
      const f = readFileSync(`/proc/${pid}/stat`, 'utf8').replace(/^.*\) /, '').split(' ');
      of.set(Number(pid), {parent: Number(f[1]), ms: 10 * (Number(f[11]) + Number(f[12]))});
    } catch {
      continue;  // it ended
    }
  }
  let sum = 0;
  for (const [pid, p] of of) for (let at = pid; at > 1; at = of.get(at)?.parent ?? 0) if (at === process.pid && pid !== process.pid) sum += p.ms;
  return sum;
}

/** Five seconds of wheel and drag in the first panel. */
async function wheelAndDrag(page) {
  const box = await page.locator('.panel .u-over').first().boundingBox();
  const end = Date.now() + 5000;
  await page.mouse.move(box.x + box.width / 2, box.y + 40);
  for (let k = 0; Date.now() < end; ++k) {
    await page.mouse.wheel(0, k % 24 < 12 ? -100 : 100);
    if (k % 12 === 0) {
      await page.keyboard.down('Shift');
      await page.mouse.down();
      for (let n = 1; n <= 6; ++n) await page.mouse.move(box.x + box.width / 2 + 10 * n, box.y + 40);
      await page.mouse.up();
      await page.keyboard.up('Shift');
      await page.mouse.move(box.x + box.width / 2, box.y + 40);
    }
  }
}

/** Asks the server as the page does; the time of each answer [ms]. */
function ask(page, paths) {
  return page.evaluate(async (all) => {
    const token = sessionStorage.getItem('ambrig-token');
    const times = [];
    let bytes = new ArrayBuffer(0);
    for (const path of all) {
      const begin = performance.now();
      bytes = await (await fetch(path, {headers: {Authorization: 'Bearer ' + token}})).arrayBuffer();
      times.push(performance.now() - begin);
    }
    const peak = all[0].startsWith('/api/series') ? Math.max(...new Float32Array(bytes.slice(4 + new DataView(bytes).getUint32(0, true)))) : NaN;
    return {times: times.sort((a, b) => a - b), bytes: bytes.byteLength, peak};
  }, paths);
}

/** Opens an address of the page and waits for the panels. */
async function openRecord(page, name) {
  const began = Date.now();
  await page.evaluate(([c, n]) => (location.hash = `#/record/${n}?c=${[...c, ...c].join(',')}`), [channels, name]);
  await page.locator('h1', {hasText: name}).waitFor();
  await page.locator('.panel canvas').nth(7).waitFor({timeout: 60000});
  await page.locator('.panels[aria-busy="false"]').waitFor({timeout: 120000});
  return (Date.now() - began) / 1000;
}

async function bigRecord(page) {
  // Each attempt is of a record that was not read before.
  let n = 0;
  await best('first view of 4 channels of 10^7 samples, per channel', 0.6, 's', async () => {
    const name = `big${++n}.mat`;
    writeRecord(inFolder(name), channels, samples);
    return (await openRecord(page, name)) / channels.length;
  }, 3);
  const name = `big${n}.mat`;
  await best('a warm zoom of 4 channels, median', 20, 'ms', async () => (await ask(page, Array.from({length: 40}, (_, k) =>
    `/api/series?p=${name}&c=${channels.join(',')}&px=1200&t0=${10 + k}&t1=${50 + k}`))).times[20]);
  const whole = await ask(page, [`/api/series?p=${name}&c=${channels.join(',')}&px=1200`]);
  measured('answer for 24 lines of 1200 columns', (whole.bytes / 4) * 24 / 1e6, 0.7, 'MB');
  // The one sample that stands out is in every view of it.
  const {peak} = await ask(page, [`/api/series?p=${name}&c=A.x&px=700`]);
  assert.ok(Math.abs(peak - 3e-5) < 1e-10, `the peak is kept: ${peak}`);
  await smoothFrames(page);
}

/** The best of three attempts at wheel and drag, judged by both budgets. */
async function smoothFrames(page) {
  let seen = null, calm = false;
  for (let k = 0; k < 3 && !(seen && !isOver(seen.p95, 33.4) && !isOver(seen.most, 100)); ++k) {
    const free = share(), before = processorTime();
    const f = await frames(page, () => wheelAndDrag(page));
    say(`  ${f.count} frames, p95 ${f.p95.toFixed(1)} ms, longest ${f.most.toFixed(1)} ms, processor time of a frame ${((processorTime() - before) / f.count).toFixed(1)} ms`);
    if (!seen || Math.max(f.p95 / 33.4, f.most / 100) < Math.max(seen.p95 / 33.4, seen.most / 100)) seen = f;
    calm ||= Math.min(free, share()) >= 0.8;
  }
  measured('interval between frames, p95 of 5 s of wheel and drag over eight panels', seen.p95, 33.4, 'ms', calm);
  measured('longest interval between frames', seen.most, 100, 'ms', calm);
}

/** Ten records of 10^7 samples, opened one after the other: the server and its reader together. */
async function tenRecords(page, server) {
  for (let k = 0; k < 10; ++k) {
    const name = `ten${k}.mat`;
    writeRecord(inFolder(name), channels, samples);
    await openRecord(page, name);
    rmSync(inFolder(name));
  }
  const reader = readerOf(server.child.pid);
  measured('server with ten records of 10^7 samples, its reader process included', memory(server.child.pid) + memory(reader), 300, 'MiB');
}

/** From the click on a coil to its verdict, orbit and panels; progress and end of a long run. */
async function playground(page) {
  await page.evaluate(() => (location.hash = '#/run/play.toml'));
  await page.getByRole('button', {name: 'A3, healthy'}).waitFor({timeout: 60000});
  let coil = 0;
  await best('from the click on a coil to its picture', 0.6, 's', async () => {
    const name = `A${(coil++ % 8) + 1}`;
    const begin = Date.now();
    await page.getByRole('button', {name: `${name}, healthy`}).click();
    await page.locator('.verdict', {hasText: `coil${name.slice(1)} open`}).waitFor({timeout: 30000});
    await page.locator('.panels[aria-busy="false"] canvas').first().waitFor({timeout: 30000});
    const took = (Date.now() - begin) / 1000;
    await page.getByRole('button', {name: 'Clear'}).click();
    return took;
  }, 8);
  await page.evaluate(() => (location.hash = '#/run/long.toml'));
  await page.locator('h1', {hasText: 'long.toml'}).waitFor();
  const stop = async () => {
    const begin = Date.now();
    await page.getByRole('button', {name: 'Stop', exact: true}).click();
    await page.getByRole('button', {name: 'Run', exact: true}).waitFor({timeout: 20000});
    return (Date.now() - begin) / 1000;
  };
  const start = async () => {
    await page.getByRole('button', {name: 'Run', exact: true}).click();
    const begin = Date.now();
    await page.locator('main progress').waitFor();
    return (Date.now() - begin) / 1000;
  };
  await best('from the click on Run to its progress', 0.3, 's', async () => {
    const shown = await start();
    await stop();
    return shown;
  });
  await best('a stopped run is gone', 2, 's', async () => {
    await start();
    await page.waitForTimeout(500);
    return stop();
  });
}

/** 10^5 rows of a campaign, filtered and counted by set and load. */
function manyRows(page) {
  return best('10^5 rows of a campaign filtered and counted', 50, 'ms', () => page.evaluate(async () => {
    const {countOf, filtered, mapOf, parseRows} = await import('/a/campaign_rows.js');
    const columns = ['run', 'set', 'kind', 'speed', 'load', 'verdict', 'peak_orbit [m]', 'detection_delay [s]'];
    const lines = Array.from({length: 1e5}, (_, k) => `${k},A:${k % 40},open,157,${(k % 3) / 2},${k % 9 ? 'up' : 'drop'},1e-6,4e-5`);
    const rows = parseRows(lines, columns);
    const begin = performance.now();
    const some = filtered(rows, {set: 'A:3', load: null, verdict: null, from: null, to: null});
    countOf(rows);
    mapOf(rows);
    if (some.length !== 2500) throw new Error(`${some.length} rows`);
    return performance.now() - begin;
  }));
}

/** Resident memory of a process [MiB]. */
const memory = (pid) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))[1]) / 1024;

/** The process of the server that reads records. */
const readerOf = (server) => readdirSync('/proc').find((p) => {
  try {
    return /^\d+$/.test(p) && readFileSync(`/proc/${p}/cmdline`, 'utf8').includes('--reader') && readFileSync(`/proc/${p}/stat`, 'utf8').replace(/^.*\) /, '').split(' ')[1] === String(server);
  } catch {
    return false;  // it ended
  }
});

async function everything(page, server) {
  measured('server at rest', memory(server.child.pid), 60, 'MiB');
  let usable = Infinity;
  await page.goto(server.address);
  await best('first paint', 0.5, 's', async () => {
    const begin = Date.now();
    await page.reload();
    await page.locator('table.scenarios').waitFor();
    usable = Math.min(usable, (Date.now() - begin) / 1000);
    return (await page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? NaN)) / 1000;
  });
  measured('usable, with 1000 scenarios listed', usable, 1, 's', results.at(-1).calm);
  await page.waitForTimeout(500);  // the rest of its scripts
  const weight = await page.evaluate(() => performance.getEntriesByType('resource').filter((r) => r.name.includes('/a/')).reduce((sum, r) => sum + r.decodedBodySize, 0));
  measured('the page and its scripts', weight / 1000, 200, 'kB');
  await best('list of 1000 files', 150, 'ms', async () => (await ask(page, Array(5).fill('/api/folder'))).times[0]);
  await manyRows(page);
  await playground(page);
  await page.evaluate(() => (location.hash = '#/file/many/s1.toml'));
  await page.locator('textarea').waitFor();
  await best('an idle page ticks, p95', 20, 'ms', async () => (await frames(page, () => page.waitForTimeout(1500))).p95);
  await bigRecord(page);
  await tenRecords(page, server);
}

for (let k = 0; k < 1000; ++k) write(`many/s${k}.toml`, `name = "s${k}"\nrig = "rig.toml"\nduration = 0.1\n`);
write('rig.toml', readFileSync(join(source, 'examples/reference/rig.toml')));
const scenario = (name, duration) => write(`${name}.toml`, `name = "${name}"\nrig = "rig.toml"\nduration = ${duration}\nrecord_rate = 12500.0\nseed = 1\n\n[speed]\nprofile = [[0.0, 157.08]]\n`);
scenario('play', 0.15);
scenario('long', 60);
const server = await startServer();
const {browser, page} = await openBrowser(server.address);
try {
  await everything(page, server);
} finally {
  await browser.close();
  server.child.removeAllListeners('exit');
  server.child.kill('SIGINT');
  await new Promise((ended) => server.child.on('exit', ended));
  rmSync(folder, {recursive: true});
}
const over = results.filter((r) => isOver(r.value, r.budget));
assert.deepEqual(over.filter((r) => r.calm), []);
if (over.length > 0) {
  say(`${over.length} over budget: measure again on an idle machine`);
  process.exitCode = 77;
}
say('done');
