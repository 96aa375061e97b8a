// The budgets of the workbench, measured: frames and zoom at 10^7 samples, first paint, weight of the page, a folder of 1000 files, memory of
// the server. Prints every figure and fails when one is over its budget.
//
//   node budgets.mjs AMBRIG SOURCE_FOLDER
//
// Where others keep the cores busy (load average above their number) a figure over its budget says nothing: exit code 77.
import {closeSync, openSync, readdirSync, readFileSync, writeSync} from 'node:fs';
import {cpus} from 'node:os';
import {assert, inFolder, openBrowser, say, startServer, write} from './harness.mjs';

const samples = 1e7, channels = ['A.x', 'A.y', 'B.x', 'B.y'];

/** A MAT file of version 5: `rate`, and single-precision vectors with a tone, noise and one peak each. */
function writeRecord(name) {
  const file = openSync(inFolder(name), 'w');
  const header = Buffer.alloc(128, ' ');
  header.write('MATLAB 5.0 MAT-file, made by tests/workbench/budgets.mjs');
  header.writeUInt16LE(0x0100, 124);
  header.write('IM', 126);
  writeSync(file, header);
  const vector = (label, kind, bytes, count, fill) => {
    const text = Buffer.alloc(Math.ceil(label.length / 8) * 8);
    text.write(label);
    const data = Buffer.alloc(Math.ceil((bytes * count) / 8) * 8);
    fill(data);
    const head = Buffer.alloc(8 + 16 + 16 + 8 + text.length + 8);
    head.writeUInt32LE(14, 0);
    head.writeUInt32LE(head.length - 8 + data.length, 4);
    head.writeUInt32LE(6, 8);
    head.writeUInt32LE(8, 12);
    head.writeUInt32LE(kind === 'single' ? 7 : 6, 16);
    head.writeUInt32LE(5, 24);
    head.writeUInt32LE(8, 28);
    head.writeInt32LE(count, 32);
    head.writeInt32LE(1, 36);
    head.writeUInt32LE(1, 40);
    head.writeUInt32LE(label.length, 44);
    text.copy(head, 48);
    head.writeUInt32LE(kind === 'single' ? 7 : 9, 48 + text.length);
    head.writeUInt32LE(bytes * count, 52 + text.length);
    writeSync(file, head);
    writeSync(file, data);
  };
  vector('rate', 'double', 8, 1, (d) => d.writeDoubleLE(1e5, 0));
  channels.forEach((c, n) => vector(c.replace('.', '_'), 'single', 4, samples, (d) => {
    const v = new Float32Array(d.buffer, d.byteOffset, samples);
    let s = 1 + n;
    for (let k = 0; k < samples; ++k) {
      s = (s * 1664525 + 1013904223) >>> 0;
      v[k] = 1e-5 * Math.sin(k * 1e-3 * (n + 1)) + 2e-6 * (s / 4294967296 - 0.5);
    }
    v[7654321] = 3e-5;  // one sample that must not be lost
  }));
  closeSync(file);
}

const results = [];
/** @param {string} what @param {number} value @param {number} budget @param {string} unit */
function measured(what, value, budget, unit) {
  results.push({what, value, budget, unit});
  say(`${what}: ${value.toPrecision(3)} ${unit} (budget ${budget} ${unit})${value > budget ? '  OVER' : ''}`);
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

async function bigRecord(page) {
  const began = Date.now();
  await page.evaluate((c) => (location.hash = `#/record/big.mat?c=${[...c, ...c].join(',')}`), channels);
  await page.locator('.panel canvas').nth(7).waitFor({timeout: 60000}).catch(async () => assert.fail(await page.locator('body').innerText()));
  await page.locator('[aria-busy="false"]').waitFor({timeout: 120000});
  measured('first view of 4 channels of 10^7 samples, per channel', (Date.now() - began) / 1000 / channels.length, 0.6, 's');
  const times = await page.evaluate(async (c) => {
    const out = [];
    const token = sessionStorage.getItem('ambrig-token');
    let bytes = 0;
    for (let k = 0; k < 40; ++k) {
      const t0 = 10 + k, begin = performance.now();
      const answer = await fetch(`/api/series?p=big.mat&c=${c.join(',')}&px=1200&t0=${t0}&t1=${t0 + 40}`, {headers: {Authorization: 'Bearer ' + token}});
      bytes = (await answer.arrayBuffer()).byteLength;
      out.push(performance.now() - begin);
    }
    return {times: out.sort((a, b) => a - b), bytes};
  }, channels);
  measured('a warm zoom of 4 channels, median', times.times[20], 20, 'ms');
  measured('answer for 24 lines of 1200 columns', (times.bytes / 4) * 24 / 1e6, 0.7, 'MB');
  // The one sample that stands out is in every view of it.
  const peak = await page.evaluate(async () => {
    const token = sessionStorage.getItem('ambrig-token');
    const answer = await fetch('/api/series?p=big.mat&c=A.x&px=700', {headers: {Authorization: 'Bearer ' + token}});
    const bytes = await answer.arrayBuffer();
    return Math.max(...new Float32Array(bytes.slice(4 + new DataView(bytes).getUint32(0, true))));
  });
  assert.ok(Math.abs(peak - 3e-5) < 1e-10, `the peak is kept: ${peak}`);
  let best = {p95: Infinity, most: Infinity, count: 0};
  for (let n = 0; n < 3; ++n) {
    const before = processorTime();
    const f = await frames(page, () => wheelAndDrag(page));
    say(`  eight panels, 5 s of wheel and drag: ${f.count} frames, p95 ${f.p95.toFixed(1)} ms, longest ${f.most.toFixed(1)} ms, processor time of a frame ${((processorTime() - before) / f.count).toFixed(1)} ms`);
    if (f.p95 < best.p95) best = f;
  }
  measured('interval between frames, p95', best.p95, 33.4, 'ms');
  measured('longest interval between frames', best.most, 100, 'ms');
}

/** Resident memory of a process [MiB]. */
const memory = (pid) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))[1]) / 1024;

for (let k = 0; k < 1000; ++k) write(`many/s${k}.toml`, `name = "s${k}"\nrig = "rig.toml"\nduration = 0.1\n`);
const server = await startServer();
const {browser, page} = await openBrowser(server.address);
try {
  measured('server at rest', memory(server.child.pid), 60, 'MiB');
  const begin = Date.now();
  await page.goto(server.address);
  await page.locator('table.scenarios').waitFor();
  const usable = (Date.now() - begin) / 1000;
  await page.waitForTimeout(500);  // the rest of its scripts
  const weight = await page.evaluate(() => performance.getEntriesByType('resource').filter((r) => r.name.includes('/a/')).reduce((sum, r) => sum + r.decodedBodySize, 0));
  const paint = await page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? NaN);
  measured('first paint', paint / 1000, 0.5, 's');
  measured('usable, with 1000 scenarios listed', usable, 1, 's');
  measured('the page and its scripts', weight / 1000, 200, 'kB');
  const list = await page.evaluate(async () => {
    const token = sessionStorage.getItem('ambrig-token');
    const times = [];
    for (let k = 0; k < 5; ++k) {
      const t = performance.now();
      await (await fetch('/api/folder', {headers: {Authorization: 'Bearer ' + token}})).json();
      times.push(performance.now() - t);
    }
    return Math.min(...times);
  });
  measured('list of 1000 files', list, 150, 'ms');
  await page.evaluate(() => (location.hash = '#/file/many/s1.toml'));
  await page.locator('textarea').waitFor();
  const idle = await frames(page, () => page.waitForTimeout(1500));
  say(`idle: ${idle.count} frames, p95 ${idle.p95.toFixed(1)} ms`);
  writeRecord('big.mat');
  await bigRecord(page);
  measured('server with a record of 10^7 samples open', memory(server.child.pid), 300, 'MiB');
  const reader = readdirSync('/proc').find((p) => /^\d+$/.test(p) && readFileSync(`/proc/${p}/cmdline`, 'utf8').includes('--reader') && / (\d+)/.exec(readFileSync(`/proc/${p}/stat`, 'utf8').replace(/^.*\) ./, ''))[1] === String(server.child.pid));
  if (reader) say(`  its reader process, which is limited to 1024 MiB, holds ${memory(reader).toFixed(0)} MiB: 4 channels as doubles are 305`);
  const over = results.filter((r) => r.value > r.budget);
  const load = Number(readFileSync('/proc/loadavg', 'utf8').split(' ')[0]);
  assert.ok(idle.p95 < 20, `an idle page ticks at 60 Hz: ${idle.p95} ms`);
  if (over.length > 0 && load > cpus().length + 1) {
    say(`${over.length} over budget, but the load average is ${load} on ${cpus().length} cores: measure again on an idle machine`);
    process.exitCode = 77;
  } else {
    assert.deepEqual(over, []);
  }
} finally {
  await browser.close();
  server.child.removeAllListeners('exit');
  server.child.kill('SIGINT');
  await new Promise((ended) => server.child.on('exit', ended));
}
say('done');
