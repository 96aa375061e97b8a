import assert from 'node:assert/strict';
import test from 'node:test';
import {answered, rendered, server, settled} from './page.mjs';
const {openRun, runScreen} = await import('../../web/workbench/run_screen.js');
const {state} = await import('../../web/workbench/state.js');
const {emptyView} = await import('../../web/workbench/address.js');

const rig = {bearings: [{name: 'A', clearance: 2e-4, coils: [{name: 'A.coil1', angle_deg: 22.5}, {name: 'A.coil2', angle_deg: 67.5}]}]};
const scenario = 'name = "s"\nrig = "../rigs/./r.toml"\n[expect]\ndrop = false\n[speed]\nprofile = [[0, 1]]\n';
const outcome = {drop: false, touchdown: false, metrics: {max_orbit: {A: 1.25e-5}, peak_current: 4.5},
                 events: [{t: 0.02012, kind: 'detected', target: 'A.coil1', class: 'open'}]};

/** Two samples of two channels, as /api/series has them. */
function orbit() {
  const head = JSON.stringify({mode: 'samples', start: 0, step: 1, count: 2, rate: 1, channels: [{name: 'A.x', unit: 'm'}, {name: 'A.y', unit: 'm'}]});
  const text = new TextEncoder().encode(head.padEnd(Math.ceil(head.length / 4) * 4));
  const bytes = new Uint8Array(4 + text.length + 16);
  new DataView(bytes.buffer).setUint32(0, text.length, true);
  bytes.set(text, 4);
  [1e-4, 0, 0, -1e-4].forEach((v, k) => new DataView(bytes.buffer).setFloat32(4 + text.length + 4 * k, v, true));
  return new Response(bytes);
}

/** The server with one scenario in p/, its rig in rigs/ and, with `run`, what its run gave. */
async function opened(run) {
  Object.assign(state, {view: {...emptyView(), screen: 'run', file: 'p/s.toml'}, jobs: [], notice: null, folder: {files: [{name: 'p/s.toml'}]}});
  state.results.clear();
  server.asked = [];
  server.answer = (path, options) => {
    if (path.startsWith('/api/result?kind=run')) return answered(run ? {job: 7, fresh: true, stale: [], result: run} : null);
    if (path.startsWith('/api/result?kind=rig')) return answered({job: 6, fresh: true, stale: [], result: rig});
    if (path.startsWith('/api/file') && options.method === 'PUT') return answered({step: 4});
    if (path.startsWith('/api/file')) return answered(scenario);
    if (path.includes('&c=')) return orbit();
    if (path.startsWith('/api/series')) return answered({channels: ['A.x', 'A.y', 'A.i1', 'bus'].map((name) => ({name}))});
    return answered({id: 9, command: 'run', subject: 'p/s_2.toml', argv: [], state: 'queued'});
  };
  const gone = [];
  await openRun('p/s.toml');
  return {gone, screen: () => rendered(runScreen((change) => gone.push(change)))};
}

test('a scenario names its rig beside itself', async () => {
  const page = await opened(null);
  assert.ok(server.asked.some((a) => a.path === '/api/result?kind=rig&p=rigs%2Fr.toml'));
  assert.ok(!server.asked.some((a) => a.method === 'POST'));  // the rig is known and fresh
  const {text} = page.screen();
  assert.match(text, /Not run yet/);
  assert.match(text, />Run<\/button>/);
  assert.match(text, /Click the coils that are to fail/);
});

test('a run: verdict, largest orbit, events, and the orbit in its clearance', async () => {
  const page = await opened(outcome);
  page.screen();
  await settled();
  const {text} = page.screen();
  assert.match(text, /The rotor stayed up/);
  assert.match(text, /largest orbit A<\/th><td class="number">12.5 \u00b5m/);
  assert.match(text, /peak current<\/th><td class="number">4.50 A/);
  assert.match(text, /<li>20.1200 ms detected A.coil1 open<\/li>/);
  assert.match(text, /points=25.00,0.00 0.00,25.00/);  // 0.1 mm of 0.2 mm, which is 50 wide
  assert.match(text, />Run again<\/button>/);
});

test('what touched down and what dropped are told apart', async () => {
  const touched = await opened({...outcome, touchdown: true, events: []});
  assert.match(touched.screen().text, /Touched down, did not drop.*<p>None.<\/p>/);
  assert.match((await opened({...outcome, touchdown: true, drop: true})).screen().text, /The rotor dropped/);
});

test('clicked coils become a scenario with faults beside this one, which is run and shown', async () => {
  const page = await opened(outcome);
  const coil = (screen, name) => screen.calls[Number(new RegExp(`aria-label="${name}[^>]*@click=(\\d+)`).exec(screen.text)[1])]();
  coil(page.screen(), 'A1');
  coil(page.screen(), 'A2');
  coil(page.screen(), 'A2');  // once more: healthy again
  const screen = page.screen();
  assert.match(screen.text, /aria-label="A1, open".*aria-label="A2, healthy"/);
  screen.click('Write a scenario with this fault and run it');
  await settled();
  const written = server.asked.find((a) => a.method === 'PUT');
  assert.equal(written.path, '/api/file?p=p%2Fs_2.toml');
  assert.match(written.body, /\[\[fault\]\]\ntime = 0.1\ntarget = "A.coil1"\nkind = "open"\n$/);
  assert.doesNotMatch(written.body, /expect|drop/);
  assert.deepEqual(JSON.parse(server.asked.at(-1).body), {command: 'run', scenario: 'p/s_2.toml'});
  assert.deepEqual(page.gone, [{screen: 'run', file: 'p/s_2.toml'}]);
  assert.equal(state.notice.step, 4);  // can be undone
});

test('a scenario that cannot be written is told and nothing is run', async () => {
  const page = await opened(outcome);
  const screen = page.screen();
  screen.calls[Number(/aria-label="A1[^>]*@click=(\d+)/.exec(screen.text)[1])]();
  const before = server.answer;
  server.answer = (path, options) => options.method === 'PUT' ? answered({error: 'the folder is read-only'}, {status: 409}) : before(path, options);
  page.screen().click('Write a scenario with this fault and run it');
  await settled();
  assert.equal(state.notice.text, 'the folder is read-only');
  assert.deepEqual(page.gone, []);
  assert.ok(!server.asked.some((a) => a.method === 'POST'));
});
