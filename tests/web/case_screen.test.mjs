import assert from 'node:assert/strict';
import test from 'node:test';
import {answered, rendered, seriesAnswer, server, settled} from './page.mjs';
const {caseScreen, openCase} = await import('../../web/workbench/case_screen.js');
const {state} = await import('../../web/workbench/state.js');
const {emptyView} = await import('../../web/workbench/address.js');

const comparison = {ratio: 8, ratio_fit: 9, ratio_validate: 7, data: [], records: [
  {data: 'p/r1.h5', scenario: 's1', use: 'fit', ratio: 9, channels: {'A.x': {ratio: 9}, 'A.i1': {ratio: 2}}, blocks: {}},
  {data: 'p/r2.h5', scenario: 's2', use: 'validate', ratio: 7, channels: {'A.x': {ratio: 7}}, blocks: {}},
]};
const known = (result, more = {}) => ({job: 3, fresh: true, stale: [], result, ...more});

/** What the page ordered. @type {() => any[]} */
let posted;

/** A case that was compared; what the screen asked the view to become stands in `gone`. */
function opened({result = comparison, view = {}, ...more} = {}) {
  Object.assign(state, {view: {...emptyView(), screen: 'case', file: 'p/case.toml', ...view}, jobs: [], notice: null,
                        folder: {files: [{name: 'p/rig.toml'}, {name: 'p/case.toml'}], cases: [{name: 'p/case.toml', rig: 'rig.toml'}]}});
  state.progress.clear();
  state.results.clear();
  state.results.set('compare p/case.toml', known(result, more));
  server.asked = [];
  const job = {id: 9, command: 'adopt', subject: 'p/case.toml', argv: ['adopt', 'p/case.toml'], new_files: [], state: 'queued'};
  const errors = [{name: 'A.x.error', unit: ''}, {name: 'A.x.measured', unit: 'm'}];
  server.answer = (path) => path.startsWith('/api/series') ? seriesAnswer(errors, [[3, 4, 3, 4], [0, 1, 0, 1]]) : answered(job);
  const gone = [];
  posted = () => server.asked.filter((a) => a.method === 'POST').map((a) => JSON.parse(a.body));
  return {gone, screen: () => rendered(caseScreen((change) => gone.push(change)))};
}

test('a case opens at its worst cell', () => {
  const {text} = opened().screen();
  assert.match(text, /All records <strong>8.0<\/strong> times the noise; fitted 9.0, unseen 7.0/);
  assert.match(text, /<h2>A.x in r1<\/h2>/);
  assert.match(text, /aria-pressed=true aria-label="r1, A.x: 9.0/);
  assert.match(opened({view: {record: 'r2', channels: ['A.x']}}).screen().text, /<h2>A.x in r2<\/h2>/);
  assert.match(opened({view: {record: 'gone', channels: ['A.x']}}).screen().text, /<h2>A.x in r1<\/h2>/);  // no such record
});

test('a cell shows its channel; Shift adds one of the same record; another record shows all its time', () => {
  const page = opened({view: {record: 'r1', channels: ['A.x'], from: 0.1, to: 0.2}});
  const screen = page.screen();
  screen.click('r1, A.i1: 2.0 times the noise', {shiftKey: false});
  screen.click('r1, A.i1: 2.0 times the noise', {shiftKey: true});
  screen.click('r1, A.x: 9.0 times the noise', {shiftKey: true});   // is shown already
  screen.click('r2, A.x: 7.0 times the noise', {shiftKey: true});   // nothing to add to
  assert.deepEqual(page.gone, [{record: 'r1', channels: ['A.i1']}, {record: 'r1', channels: ['A.x', 'A.i1']},
                               {record: 'r1', channels: ['A.x']}, {record: 'r2', channels: ['A.x'], from: null, to: null, marks: {}}]);
});

test('no more than eight channels stand below each other, the last ones', () => {
  const channels = Object.fromEntries([...'12345678'].map((n) => [`A.s${n}`, {ratio: 2}]).concat([['A.y', {ratio: 3}]]));
  const shown = Object.keys(channels).filter((c) => c !== 'A.y');
  const page = opened({result: {...comparison, records: [{...comparison.records[0], channels}]}, view: {record: 'r1', channels: shown}});
  page.screen().click('r1, A.y: 3.0 times the noise', {shiftKey: true});
  assert.deepEqual(page.gone[0].channels, [...shown.slice(1), 'A.y']);
});

test('an old comparison says what changed since, and is made anew', async () => {
  const page = opened({fresh: false, stale: ['p/rig.toml']});
  const screen = page.screen();
  assert.match(screen.text, /Older than p\/rig.toml./);
  screen.click('Compare again');
  await settled();
  assert.deepEqual(posted(), [{command: 'compare', case: 'p/case.toml'}]);
});

test('a data fault comes with the line that mends it, if there is one', async () => {
  const data = [{record: 'r1.h5', channel: 'A.x', fault: 'unit', probability: 0.999, mend: 'channels = { "A.x" = 1e-6 }'},
                {record: 'r2.h5', channel: '', fault: 'lag', probability: 0.6, mend: ''}];
  const screen = opened({result: {...comparison, data}}).screen();
  assert.match(screen.text, /r1.h5, A.x: unit<\/strong> \(probability > 0.99\).*r2.h5, all channels: lag<\/strong> \(probability 0.60\)/);
  assert.equal(screen.text.match(/Write this line into the case/g).length, 1);
  screen.click('Write this line into the case');
  await settled();
  assert.deepEqual(posted()[0], {case: 'p/case.toml', record: 'r1.h5', mend: 'channels = { "A.x" = 1e-6 }'});
  assert.doesNotMatch(opened().screen().text, /<h2>The data/);
});

test('adopting asks first, names free files, and can be declined', async () => {
  const page = opened();
  const effect = {effect: 'eddy-currents', target: 'A', parameters: {}};
  state.results.set('explain p/case.toml', known({verdict: 'effect', set: [], adopted: [effect], ladder: []}));
  state.folder.files.push({name: 'p/rig_2.toml'});
  page.screen().click('Adopt eddy-currents at A');
  assert.deepEqual(posted(), []);
  let asking = page.screen();
  assert.match(asking.text, /<h2>Adopt eddy-currents at A<\/h2>.*<code>p\/rig_3.toml<\/code>.*<code>p\/case_2.toml<\/code>/);
  asking.click('Not now');
  assert.doesNotMatch(page.screen().text, /Write and compare again/);
  page.screen().click('Adopt eddy-currents at A');
  page.screen().click('Write and compare again');
  await settled();
  assert.deepEqual(posted(), [{command: 'adopt', case: 'p/case.toml', effect: 'eddy-currents', target: 'A',
                               rig: 'p/rig_3.toml', new_case: 'p/case_2.toml'}]);
  assert.match(page.screen().text, /aria-label=adopt><\/progress>/);  // runs now
});

test('what was adopted leads to the new case', () => {
  const page = opened();
  state.jobs = [{id: 9, command: 'adopt', subject: 'p/case.toml', argv: [], state: 'done', new_files: ['p/rig_2.toml', 'p/case_2.toml']}];
  state.results.set('adopt p/case.toml', known({ratio_validate: 1.04, ladder: [{added: '', ratio_fit: 9, ratio_validate: 7}, {added: 'eddy-currents at A', ratio_fit: 1, ratio_validate: 1.04}]}));
  assert.doesNotMatch(page.screen().text, /Written p/);  // the step was taken back: its case is not there
  state.folder.files.push({name: 'p/rig_2.toml'}, {name: 'p/case_2.toml'});
  const screen = page.screen();
  assert.match(screen.text, /Written p\/rig_2.toml and p\/case_2.toml.*The error fell to 1.0 times the noise/);
  screen.click('Open p/case_2.toml');
  assert.deepEqual(page.gone, [{screen: 'case', file: 'p/case_2.toml', record: '', channels: [], from: null, to: null, marks: {}}]);
  state.jobs.push({...state.jobs[0], id: 10, command: 'refine'});
  state.results.set('refine p/case.toml', known({ratio_before: 7, ratio_after: 1.02}));
  assert.match(page.screen().text, /<h2>Refined<\/h2>.*Error over noise 7.0 \u2192 1.0/);
});

test('a comparison that failed says why', () => {
  const page = opened();
  state.results.delete('compare p/case.toml');
  state.jobs = [{id: 1, command: 'compare', subject: 'p/case.toml', argv: ['compare', 'p/case.toml'], state: 'failed', error: 'record 2: no column A.x'}];
  assert.match(page.screen().text, /class="bad" role="alert">record 2: no column A.x<\/p>/);
  state.jobs[0].state = 'running';
  assert.match(page.screen().text, /aria-label=compare><\/progress>.*<code>\$ ambrig compare p\/case.toml<\/code>/);
  assert.doesNotMatch(page.screen().text, /no column/);
});

test('the first comparison of a case is started once by itself', async () => {
  opened();
  server.answer = (path) => answered(path.startsWith('/api/result') ? null : {id: 1, command: 'x', subject: 'y', argv: [], state: 'done'});
  await openCase('new/case.toml');
  await openCase('new/case.toml');
  const started = server.asked.filter((a) => a.method === 'POST').map((a) => JSON.parse(a.body));
  assert.deepEqual(started, [{command: 'compare', case: 'new/case.toml'}]);
});
