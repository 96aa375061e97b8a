import assert from 'node:assert/strict';
import test from 'node:test';
import {answered, rendered, seriesAnswer, server, settled} from './page.mjs';
const {openRun, runScreen} = await import('../../web/workbench/run_screen.js');
const {state} = await import('../../web/workbench/state.js');
const {emptyView} = await import('../../web/workbench/address.js');

const rig = {bearings: [{name: 'A', clearance: 2e-4, axes: ['A.x', 'A.y'], coils: [{name: 'A.coil1', angle_deg: 22.5}, {name: 'A.coil2', angle_deg: 67.5}]}]};
const scenario = 'name = "s"\nrig = "../rigs/./r.toml"\nduration = 0.2\n[expect]\ndrop = false\n[speed]\nprofile = [[0, 1]]\n';
const outcome = {drop: false, touchdown: false, metrics: {max_orbit: {A: 1.25e-5}, peak_current: 4.5},
                 events: [{t: 0.02012, kind: 'detected', target: 'A.coil1', class: 'open'}]};

/** Two samples of two channels. */
const orbit = () => seriesAnswer([{name: 'A.x', unit: 'm'}, {name: 'A.y', unit: 'm'}], [[1e-4, 0], [0, -1e-4]]);

const pause = () => new Promise((resume) => setTimeout(resume, 120));  // longer than the playground waits after a click
const played = () => server.asked.filter((a) => a.method === 'POST').map((a) => JSON.parse(a.body)).filter((o) => o.command === 'play');

/** The server with one scenario in p/, its rig in rigs/ and, with `run`, what its run gave. A job has ended when it is asked for. */
async function opened(run) {
  Object.assign(state, {view: {...emptyView(), screen: 'run', file: 'p/s.toml'}, jobs: [], notice: null, folder: {files: [{name: 'p/s.toml'}]}});
  state.results.clear();
  server.asked = [];
  let id = 8;
  server.answer = (path, options) => {
    if (path.startsWith('/api/result?kind=run')) return answered(run ? {job: 7, fresh: true, stale: [], result: run} : null);
    if (path.startsWith('/api/result?kind=rig')) return answered({job: 6, fresh: true, stale: [], result: rig});
    if (path.startsWith('/api/file') && options.method === 'PUT') return answered({step: 4});
    if (path.startsWith('/api/file')) return answered(scenario);
    if (path.includes('&c=')) return orbit();
    if (path.startsWith('/api/series')) return answered({channels: ['A.x', 'A.y', 'A.i1', 'bus'].map((name) => ({name}))});
    if (/^.api.jobs.\d+.result/.test(path)) return answered({...outcome, touchdown: true});
    if (path === '/api/jobs' && options.method === 'POST') return answered({id: ++id, ...JSON.parse(options.body), subject: 'p/s.toml', argv: [], state: 'done'});
    return answered(path === '/api/folder' ? {files: [{name: 'p/s.toml'}]} : state.jobs);
  };
  const gone = [];
  await openRun('p/s.toml');
  return {gone, screen: () => rendered(runScreen((change) => gone.push(change)))};
}

/** Clicks a coil of the drawing. */
const coil = (screen, name) => screen.calls[Number(new RegExp(`aria-label="${name}[^>]*@click=(\\d+)`).exec(screen.text)[1])]();

test('a scenario names its rig beside itself', async () => {
  const page = await opened(null);
  assert.ok(server.asked.some((a) => a.path === '/api/result?kind=rig&p=rigs%2Fr.toml'));
  assert.ok(!server.asked.some((a) => a.method === 'POST'));  // the rig is known and fresh
  const {text} = page.screen();
  assert.match(text, /Not run yet/);
  assert.match(text, />Run<\/button>/);
  assert.match(text, /Click a coil, or M on it for every fault/);
  assert.match(text, />Run it unchanged<\/button>/);
  assert.doesNotMatch(text, /Save as scenario/);
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

test('clicked coils are run, beside the healthy run, and nothing is written', async () => {
  const page = await opened(outcome);
  coil(page.screen(), 'A1');
  coil(page.screen(), 'A2');
  coil(page.screen(), 'A2');  // once more: healthy again
  const screen = page.screen();
  assert.match(screen.text, /aria-label="A1, open".*aria-label="A2, healthy"/);
  assert.match(screen.text, /role="status">running: the run</);
  await pause();
  await settled();
  const [broken, healthy, ...more] = played();  // three clicks are one run
  assert.match(broken.scenario.text, /\[\[fault\]\]\ntime = 0.1\ntarget = "A.coil1"\nkind = "open"\n$/);
  assert.equal(broken.scenario.beside, 'p/s.toml');
  assert.doesNotMatch(broken.scenario.text, /expect|drop/);
  assert.doesNotMatch(healthy.scenario.text, /fault/);
  assert.deepEqual(more, []);
  assert.ok(!server.asked.some((a) => a.method === 'PUT'));
  const {text} = page.screen();
  assert.match(text, /Touched down, did not drop/);  // of the playground's run, no more of the scenario's own
  assert.match(text, /<th scope="col">as chosen<\/th><th scope="col">healthy<\/th><\/tr>/);
  assert.doesNotMatch(text, /role="status">running/);
});

test('the scenario that was made is saved beside this one, run and shown', async () => {
  const page = await opened(outcome);
  coil(page.screen(), 'A1');
  page.screen().click('Save as scenario');
  await settled();
  const written = server.asked.find((a) => a.method === 'PUT');
  assert.equal(written.path, '/api/file?p=p%2Fs_2.toml');
  assert.match(written.body, /\[\[fault\]\]\ntime = 0.1\ntarget = "A.coil1"\nkind = "open"\n$/);
  assert.doesNotMatch(written.body, /expect|drop/);
  const ordered = server.asked.filter((a) => a.method === 'POST').map((a) => JSON.parse(a.body)).filter((o) => o.command === 'run');
  assert.deepEqual(ordered, [{command: 'run', scenario: 'p/s_2.toml'}]);
  assert.deepEqual(page.gone, [{screen: 'run', file: 'p/s_2.toml'}]);
  assert.deepEqual(state.notice.steps, [4]);  // can be undone
});

test('a test expects what its own text did, not what was run before the last click', async () => {
  const page = await opened(outcome);
  coil(page.screen(), 'A1');
  await pause();
  await settled();
  coil(page.screen(), 'A2');
  page.screen().click('Make it a test');  // its run has not begun
  await settled();
  assert.match(played().at(-1).scenario.text + played().at(-2).scenario.text, /A.coil2/);
  const written = server.asked.find((a) => a.method === 'PUT');
  assert.match(written.body, /target = "A.coil2"[^]*\[expect\]\ntouchdown = true\ndrop = false\n$/);
});

test('a run of a file that is left is shown nowhere', async () => {
  const page = await opened(outcome);
  coil(page.screen(), 'A1');
  await openRun('p/s.toml');
  await pause();
  await settled();
  assert.deepEqual(played(), []);
  assert.match(page.screen().text, /The rotor stayed up/);
});

test('a run takes back what was broken', async () => {
  const page = await opened(outcome);
  coil(page.screen(), 'A1');
  page.screen().click('take back A.coil1 open');
  assert.match(page.screen().text, /aria-label="A1, healthy"/);
  coil(page.screen(), 'A1');
  page.screen().click('Clear');
  assert.match(page.screen().text, /aria-label="A1, healthy".*Run it unchanged/);
  await pause();
  assert.deepEqual(played(), []);
});

test('a scenario that cannot be written is told and nothing is run', async () => {
  const page = await opened(outcome);
  coil(page.screen(), 'A1');
  const before = server.answer;
  server.answer = (path, options) => options.method === 'PUT' ? answered({error: 'the folder is read-only'}, {status: 409}) : before(path, options);
  page.screen().click('Save as scenario');
  await settled();
  assert.equal(state.notice.text, 'the folder is read-only');
  assert.deepEqual(page.gone, []);
  assert.ok(!server.asked.some((a) => a.method === 'POST' && JSON.parse(a.body).command === 'run'));
});
