import assert from 'node:assert/strict';
import test from 'node:test';
import {answered, rendered, server, settled} from './page.mjs';
const {campaignScreen, openCampaign} = await import('../../web/workbench/campaign_screen.js');
const {takeEvent} = await import('../../web/workbench/actions.js');
const {drawWith, state} = await import('../../web/workbench/state.js');
const {emptyView} = await import('../../web/workbench/address.js');

const columns = ['run', 'seed', 'set', 'kind', 'speed', 'load', 'verdict', 'peak_orbit [m]', 'detection_delay [s]'];
const row = (n, verdict = 'up') => `${n},1,A:3,open,157,${n % 2 ? 0.5 : 0},${verdict},${(n + 1) * 1e-6},4e-05`;
const job = (state, id = 5) => ({id, command: 'campaign', subject: 'c.toml', argv: ['campaign', 'c.toml'], new_files: [], state, error: '', code: 0});

/** A campaign of four runs that runs; each question finds one row more. The page draws as often as it is told to. */
async function opened(there = 0) {
  Object.assign(state, {view: {...emptyView(), screen: 'campaign', file: 'c.toml'}, jobs: [job('running')], notice: null, folder: {files: []}});
  state.results.clear();
  state.progress.clear();
  server.asked = [];
  server.answer = (path, options) => {
    if (path.startsWith('/api/rows')) {
      const from = Number(/from=(\d+)/.exec(path)[1]);
      const rows = [0, 1, 2, 3].slice(from, ++there).map((n) => row(n, n === 3 ? 'drop' : 'up'));
      return answered({columns, runs: 4, total: Math.min(there, 4), from, rows});
    }
    if (/^.api.jobs.\d+.result/.test(path)) return answered({drop: true, touchdown: true, metrics: {max_orbit: {A: 4e-6}, peak_current: 3}, events: []});
    if (path === '/api/jobs' && options.method === 'POST') return answered({...job('done', 6), ...JSON.parse(options.body)});
    if (path === '/api/jobs') return answered(state.jobs);
    return answered(path.startsWith('/api/result') ? null : path.startsWith('/api/series') ? {channels: []} : {});
  };
  await openCampaign('c.toml');
  const screen = () => rendered(campaignScreen());
  drawWith(screen);
  screen();
  await settled();
  return screen;
}
const asked = () => server.asked.filter((a) => a.path.startsWith('/api/rows')).map((a) => a.path);

test('the map fills while the campaign runs, however often its progress is drawn', async () => {
  const screen = await opened();
  assert.match(screen().text, />1 of 4 runs/);
  const end = Date.now() + 2300;
  for (let k = 0; Date.now() < end; ++k) {
    takeEvent({event: 'progress', job: 5, share: k / 100, text: '', seconds: 1});
    await new Promise((resume) => setTimeout(resume, 50));
  }
  assert.deepEqual(asked(), ['/api/rows?job=5&from=0', '/api/rows?job=5&from=1', '/api/rows?job=5&from=2']);
  assert.match(screen().text, />3 of 4 runs/);
  takeEvent({event: 'job', job: job('done')});
  await settled();
  screen();
  await settled();
  assert.match(screen().text, />4 of 4 runs: .*\u2716 dropped 1<.*\u2714 up 3</);
  screen();
  await settled();
  assert.equal(asked().length, 4);  // all are here: nothing more is asked
});

test('a cell of the map filters the rows, twice shows all; a row is run again with its report', async () => {
  const screen = await opened(4);
  takeEvent({event: 'job', job: job('done')});
  screen();
  await settled();
  assert.match(screen().text, /4 of 4 rows/);
  assert.match(screen().text, /aria-label="A:3, load 0.5: 1\/2 did not stay up"/);
  screen().click('A:3, load 0.5: 1/2 did not stay up');
  assert.match(screen().text, /2 of 4 rows/);
  screen().click('A:3, load 0.5: 1/2 did not stay up');
  assert.match(screen().text, /4 of 4 rows/);
  screen().click('open row 3');
  await settled();
  assert.deepEqual(JSON.parse(server.asked.find((a) => a.method === 'POST').body), {command: 'row', campaign: 'c.toml', row: 3});
  assert.match(screen().text, /<h2>Row 3<\/h2>.*The rotor dropped/);
});
