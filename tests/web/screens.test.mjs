import assert from 'node:assert/strict';
import test from 'node:test';
import {answered, rendered, server, settled} from './page.mjs';
const {explanation} = await import('../../web/workbench/explanation.js');
const {folderScreen} = await import('../../web/workbench/folder_screen.js');
const {secondsLeft} = await import('../../web/workbench/job_parts.js');
const {ladder} = await import('../../web/workbench/ladder.js');
const {misfitTable} = await import('../../web/workbench/misfit_table.js');
const {figures, summary} = await import('../../web/workbench/run_parts.js');
const {asideOf, orbit, stator} = await import('../../web/workbench/stator.js');
const {state} = await import('../../web/workbench/state.js');

test('the ladder: bars on a logarithmic scale, and the same as a table', () => {
  const {text} = rendered(ladder([{added: '', ratio_fit: 100, ratio_validate: 10}, {added: 'eddy', ratio_fit: 1, ratio_validate: null}], 'T'));
  assert.match(text, /aria-label="rig file: fitted 100, unseen 10; eddy: fitted 1.0, unseen -"/);
  const heights = [...text.matchAll(/<rect class=\w+ x=\S+ y=(\S+) width="28" height=([^>\s]+)>/g)].map((m) => [Number(m[1]), Number(m[2])]);
  assert.equal(heights.length, 4);
  for (const [y, h] of heights) assert.ok(Math.abs(y + h - 130) < 1e-9);  // all stand on one line
  assert.equal(heights[0][1], 112);                                      // the largest fills the figure
  assert.ok(Math.abs(heights[1][1] - 112 * (0.06 + 0.94 / 2)) < 1e-9);   // ten of a hundred: half on this scale
  assert.equal(heights[3][1], 0);
  assert.match(text, /<th scope="row">eddy<\/th> <td class="number">1.0<\/td><td class="number">-<\/td>/);
});

const comparison = {records: [
  {data: 'p/r1.h5', scenario: 's1', use: 'fit', ratio: 3, channels: {'A.x': {ratio: 5}, 'A.i1': {ratio: 1}}, blocks: {shaft: 'inf'}},
  {data: 'p/r2.h5', scenario: 's2', use: 'validate', ratio: 1, channels: {'A.x': {ratio: 1.5}}, blocks: {}},
]};

test('a cell of the misfit table opens its record; with Shift it is added', () => {
  const chosen = [];
  const page = rendered(misfitTable(comparison, {record: 'r2', channels: ['A.x']}, (...a) => chosen.push(a)));
  page.click('r1, A.x: 5.0 times the noise', {shiftKey: true});
  page.click('r1, A.i1: 1.0 times the noise', {shiftKey: false});
  assert.deepEqual(chosen, [['r1', 'A.x', true], ['r1', 'A.i1', false]]);
  assert.match(page.text, /class="cell level3"> <button aria-pressed=false aria-label="r1, A.x/);
  assert.match(page.text, /aria-pressed=true aria-label="r2, A.x: 1.5/);
  assert.match(page.text, /<td>unseen<\/td><td class="number">1.0<\/td>.*<td><\/td>/);  // r2 has no A.i1
  assert.match(page.text, /By block.*<th scope="row">r1<\/th> <td class="cell level5">infinite<\/td>/);
  const bare = rendered(misfitTable({records: comparison.records.slice(1)}, {record: '', channels: []}, () => {}));
  assert.doesNotMatch(bare.text, /By block/);
});

test('a coil turns with its angle, is broken by a click or a key, and says so', () => {
  const toggled = [], asked = [];
  const bearing = {name: 'A', coils: [{name: 'A.coil1', angle_deg: 22.5}, {name: 'A.coil2', angle_deg: 67.5}]};
  const page = rendered(stator(bearing, (c) => (c === 'A.coil2' ? 'open' : null), (c) => toggled.push(c), (c, name) => asked.push([c, name])));
  assert.match(page.text, /rotate\(-22.5\)/);
  assert.match(page.text, /aria-pressed=false aria-label="A1, healthy"/);
  assert.match(page.text, /class="pole broken".*aria-pressed=true aria-label="A2, open"/);
  // Of each coil: a click, a right click, a key.
  let stopped = 0;
  const event = {preventDefault: () => ++stopped, stopPropagation() {}};
  for (const key of ['Enter', ' ', 'x']) page.calls[2]({...event, key});
  page.calls[3]();
  assert.deepEqual([toggled, stopped], [['A.coil1', 'A.coil1', 'A.coil2'], 2]);
  page.calls[2]({...event, key: 'm'});
  page.calls[4](event);
  assert.deepEqual([asked, stopped], [[['A.coil1', 'A1'], ['A.coil2', 'A2']], 4]);
});

test('coils of one angle lie beside each other, each can be clicked', () => {
  const collar = [0, 0, 180, -180].map((angle_deg, k) => ({name: `Z.coil${k + 1}`, angle_deg}));
  assert.deepEqual(collar.map((_, k) => asideOf(collar, k, 10, true)), [-22.5, 22.5, -22.5, 22.5]);
  assert.deepEqual(collar.map((_, k) => asideOf(collar, k, 10, false)), [-6, 6, -6, 6]);
  assert.equal(asideOf([{angle_deg: 22.5}, {angle_deg: 67.5}], 1, 10, false), 0);
  const {text} = rendered(stator({name: 'Z', kind: 'thrust', coils: collar}, () => null, () => {}, () => {}));
  const places = [...text.matchAll(/rotate\((\S+)\)"><rect class="pole " x="24" y=(\S+)/g)].map((m) => m.slice(1).join(' '));
  assert.equal(new Set(places).size, 4);
  assert.match(text, /its collar from the side/);
});

test('a run in a line: what failed, what was done about it', () => {
  const of = (events) => rendered(summary({drop: false, touchdown: true, events})).text;
  const fault = {t: 0.1, kind: 'fault', target: 'A.coil3', class: 'open'};
  assert.match(of([{t: 0.05, kind: 'detected', target: 'B.coil1'}, fault, {t: 0.10004, kind: 'detected'}, {t: 0.102, kind: 'redistributed'}]),
               /! Touched down.*: A.coil3 open at 100 ms, detected \+40.0 \u00b5s, redistributed \+2.00 ms/);
  assert.match(of([fault]), /at 100 ms, not detected/);
  assert.doesNotMatch(of([]), /detected/);
  assert.match(rendered(figures({metrics: {max_orbit: {A: 2e-6}, peak_current: 4}, expect: {drop: {wanted: 'false', met: true, got: 'false'}}, events: []})).text,
               /largest orbit A.*2.00 \u00b5m.*4.00 A.*expects drop false<\/th><td>\u2714 false.*None/);
});

test('an orbit fills its clearance, or the drawing where there is none', () => {
  const far = rendered(orbit('A', [1e-4, 0], [0, -2e-4], 4e-4)).text;
  assert.match(far, /points=12.50,0.00 0.00,25.00/);
  assert.match(far, /circle: its clearance/);
  const bare = rendered(orbit('A', [1e-4, null], [0, 5], null)).text;
  assert.match(bare, /points=0.00,0.00/);  // the 5 m count for the scale, their missing x for no point
  assert.match(rendered(orbit('A', [0], [0], null)).text, /points=0.00,0.00/);
});

test('the time that is left is told when a share has been done', () => {
  assert.equal(secondsLeft({share: 0.25, seconds: 30}), 90);
  assert.equal(secondsLeft({share: 0.01, seconds: 30}), null);
  assert.equal(secondsLeft({share: 0.5, seconds: 1}), null);
});

const answer = {verdict: 'effect', set: [{effect: 'eddy-currents', target: 'A', probability: 0.97}, {effect: 'unknown', probability: 0.02}],
  adopted: [{effect: 'eddy-currents', target: 'A', parameters: {corner: {value: 1000, sd: 20, unit: 'Hz'}}}],
  closure: {explained: 0.995, floors_before: 20, floors_after: 1.02, test: {before: 18, after: 1.1}},
  remainder: {text: 'Nothing above the noise.', where: [{channel: 'A.x', record: 'r1', ratio: 1.4}]},
  warnings: ['record 3 is short'], ladder: [], ranking: [], screened: [{effect: 'eddy-currents', target: 'A', ratio_validate: 1.2}]};

test('an explanation: names with probabilities, parameters with sd, closure, what is left', () => {
  Object.assign(state, {jobs: [{id: 1, command: 'explain', subject: 'c.toml', argv: ['explain', 'c.toml'], state: 'done'}]});
  const adopted = [];
  const page = rendered(explanation('c.toml', {job: 1, fresh: false, stale: ['rig.toml'], result: answer}, (a) => adopted.push(a)));
  for (const part of ['Older than rig.toml.', 'An effect is missing from the model', 'eddy-currents at A</span>', '0.97', 'none of these',
                      'corner 1.000 \u00b1 0.020 kHz', '&gt; 99 % of', '20 \u2192 1.0 floors; unseen records 18 \u2192 1.1',
                      'A.x in r1: 1.4 times the noise', 'record 3 is short', 'Screened fitted: eddy-currents at A 1.2', '<code>$ ambrig explain c.toml</code>'])
    assert.ok(page.text.includes(part) || page.text.includes(part.replace('&gt;', '>')), part);
  page.click('Adopt eddy-currents at A');
  assert.deepEqual(adopted, [answer.adopted[0]]);
});

test('an explanation with two names in its set is no identification', () => {
  const half = {...answer, set: [{effect: 'eddy-currents', target: 'A', probability: 0.5}, {effect: 'hysteresis', target: 'A', probability: 0.48}]};
  const text = (result) => rendered(explanation('c.toml', {job: 1, fresh: true, stale: [], result}, () => {})).text;
  assert.match(text(half), /An effect is missing from the model; more than one name remains</);
  assert.doesNotMatch(text(answer), /more than one/);  // one name, and none of these
  const second = {...answer, adopted: [...answer.adopted, {effect: 'sensor-gain', target: 'A.x', parameters: {}, set: half.set}]};
  assert.match(text(second), /more than one name remains/);
});

test('while it runs an explanation shows its stage, and can be stopped; one that was stopped is resumed', async () => {
  state.jobs = [{id: 4, command: 'explain', subject: 'c.toml', argv: [], state: 'running'}];
  state.progress.set(4, {share: 0.5, text: 'fits', stage: 'screening', stages: [], partial: null, seconds: 100});
  const page = rendered(explanation('c.toml', null, () => {}));
  assert.match(page.text, /class=past aria-current=>parameters<\/li>.*class=now aria-current=step>screening/);
  assert.match(page.text, /50 % fits, 2 min left/);
  server.answer = () => answered({});
  page.click('Stop');
  await settled();
  assert.deepEqual([server.asked.at(-1).method, server.asked.at(-1).path], ['DELETE', '/api/jobs/4']);
  state.jobs[0].state = 'stopped';
  assert.match(rendered(explanation('c.toml', null, () => {})).text, /Resume explain/);
  state.jobs = [];
  assert.match(rendered(explanation('c.toml', null, () => {})).text, />Explain<\/button>/);
});

test('the folder: each case with its error and what was found, old answers marked', () => {
  state.folder = null;
  assert.match(rendered(folderScreen()).text, /Reading the folder/);
  state.folder = {folder: '/d', files: [{name: 'a.toml', kind: 'rig'}, {name: 's.toml', kind: 'scenario'}, {name: 'x.toml', kind: 'broken'}], campaigns: [],
                  scenarios: [{name: 's.toml', run: {fresh: false, drop: false, touchdown: false, max_orbit: {A: 1e-6, B: 1.25e-5}, fault: 0.1, detected: 0.10004}}],
                  cases: [{name: 'p/case.toml', records: 3, compare: {ratio: 12, fresh: false}, explain: {adopted: ['eddy-currents'], fresh: true, final_ratio_validate: 1.1}, watch: {records: 4, left: 1}},
                          {name: 'q.toml', records: 1, compare: null, explain: {adopted: [], verdict: 'unknown', fresh: false, final_ratio_validate: 5}}]};
  const {text} = rendered(folderScreen());
  assert.match(text, /<a href=#\/case\/p\/case.toml>p\/case.toml<\/a><\/th><td class="number">3<\/td> <td>12 <em>stale<\/em> \u2192 1.1<\/td> <td>eddy-currents<\/td>/);
  assert.match(text, /<td>- \u2192 5.0<\/td> <td>unknown <em>stale<\/em><\/td>/);
  assert.match(text, /<a href=#\/trend\/p\/case.toml>! 1 of 4 records<\/a>/);
  assert.match(text, /<a href=#\/run\/s.toml>s.toml<\/a><\/th><td>\u2714 up <em>stale<\/em><\/td> <td class="number">12.5 \u00b5m<\/td><td class="number">40.0 \u00b5s<\/td>/);
  assert.match(text, /Files that cannot be read<\/h2><ul class="files "><li> <a href=#\/file\/x.toml>x.toml<\/a><\/li>/);
  assert.doesNotMatch(text, /Campaigns|No case yet/);
  state.folder.cases = [];
  assert.match(rendered(folderScreen()).text, /No case yet/);
});
