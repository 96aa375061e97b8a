import assert from 'node:assert/strict';
import test from 'node:test';
import {guessColumns, namedFile, recordCopied, relativeName, topText, withRecord, withTopValue} from '../../web/workbench/case_text.js';
import {linesAround, placeOf} from '../../web/workbench/error_lines.js';
import {csvOf, svgOf} from '../../web/workbench/export_text.js';
import {complaint} from '../../web/workbench/questions.js';
import {limitAbove, speedOf, sweepText, withExpectations, withFaults, withLoads, withoutTables, withSpeed, withTolerance} from '../../web/workbench/scenario_text.js';

test('names are relative to the file that holds them, and back', () => {
  for (const [from, to, name] of [['a/case.toml', 'a/b.csv', 'b.csv'], ['case.toml', 'logs/b.csv', 'logs/b.csv'], ['a/b/case.toml', 'a/c/d.h5', '../c/d.h5'], ['a/case.toml', 'b.csv', '../b.csv']]) {
    assert.equal(relativeName(from, to), name);
    assert.equal(namedFile(from, name), to);
  }
});

test('a record is appended with the columns that are called otherwise', () => {
  const out = withRecord('rig = "rig.toml"\n\n\n', {scenario: 'next.toml', data: '../log.csv', use: 'validate', columns: [
    {channel: 'A.x', column: 'pos_ax', unit: 'um', gain: -1}, {channel: 'bus', column: 'bus', unit: '', gain: 1}]});
  assert.equal(out, 'rig = "rig.toml"\n\n[[record]]\nscenario = "next.toml"\ndata = "../log.csv"\nuse = "validate"\n[record.channels]\n' +
    '"A.x" = { column = "pos_ax", unit = "um", gain = -1.0 }\n');
  assert.ok(!withRecord('', {scenario: 's', data: 'd', use: 'fit', columns: [{channel: 'bus', column: 'bus', unit: '', gain: 1}]}).includes('channels'));
});

test('a record of a logger takes the lines of the one that it repeats', () => {
  const text = 'rig = "rig.toml"\n\n[[record]]  # rest\nscenario = "s-1.toml"\ndata = "d/step-1.csv"\nuse = "validate"\n[record.channels]\n"A.x" = "x"\n\n[[record]]\nscenario = "s-10.toml"\ndata = "d/step-10.csv"\n';
  const out = recordCopied(text, 'step-1', 'logger/step-1-may.csv');
  assert.ok(out.startsWith(text));
  assert.equal(out.slice(text.length), '\n[[record]]  # rest\nscenario = "s-1.toml"\ndata = "logger/step-1-may.csv"\nuse = "fit"\n[record.channels]\n"A.x" = "x"\n');
  assert.throws(() => recordCopied(text, 'step-2', 'x.csv'), /no record step-2/);
});

test('a value of the top is replaced where it stands, its comment stays', () => {
  assert.equal(withTopValue('a = 1  # why\n[t]\na = 2\n', 'a', '5'), 'a = 5  # why\n[t]\na = 2\n');
  assert.equal(withTopValue('a = 1\n[t]\nb = 2\n', 'b', '3'), 'a = 1\nb = 3\n\n[t]\nb = 2\n');
  assert.equal(topText('rig = "x.toml"\n[t]\nname = "no"\n', 'name'), '');
});

test('columns are taken by name, never two for one', () => {
  const columns = ['A.x', 'pos_ay', 'i_a1', 'time'].map((name) => ({name, unit: ''}));
  assert.deepEqual(guessColumns(['A.x', 'A.y', 'A.i1'], columns).map((m) => m.channel + '=' + m.column), ['A.x=A.x', 'A.y=pos_ay']);
  assert.deepEqual(guessColumns(['A.y'], [{name: 'left_ay', unit: ''}, {name: 'right_ay', unit: ''}]), []);
});

const scenario = 'name = "a"\nrig = "rig.toml"\nduration = 0.4\n\n[speed]\nprofile = [[0.0, 157.08]]\n\n[expect]\ndrop = false\n';

test('faults, loads, speed and tolerance of the playground', () => {
  const text = withFaults(withoutTables(scenario, ['expect']), [{target: 'A.coil3', kind: 'open', time: 0.2, parameters: {}}, {target: 'B.coil1', kind: 'partial-short', time: 1, parameters: {fraction: 0.5}}]);
  assert.ok(!text.includes('[expect]'));
  assert.ok(text.endsWith('\n[[fault]]\ntime = 0.2\ntarget = "A.coil3"\nkind = "open"\n\n[[fault]]\ntime = 1.0\ntarget = "B.coil1"\nkind = "partial-short"\nparameters = { fraction = 0.5 }\n'));
  assert.equal(speedOf(scenario), 157.08);
  assert.equal(speedOf(withSpeed(scenario, 10)), 10);
  assert.equal(withSpeed(scenario, 10).match(/\[speed\]/g).length, 1);
  assert.match(withTolerance(scenario, false).split('[speed]')[0], /^fault_tolerance = false$/m);
  assert.match(withLoads(scenario, [{plane: 'A', fx: 5, fy: 0, start: 0}, {plane: 'B', fx: 0, fy: 0, start: 0}]), /plane = "A"\nforce = \[5\.0, 0\.0\]\nstart = 0\.0\n$/);
});

test('a test holds what the run did, with a tenth of room', () => {
  const result = {events: [{kind: 'fault', t: 0.2, target: 'A.coil3'}, {kind: 'detected', t: 0.20012, target: 'A.coil3'}, {kind: 'classified', t: 0.20012, target: 'A.coil3', class: 'open'}, {kind: 'redistributed', t: 0.20012}],
                  metrics: {detection_delay: 1.2e-4, max_orbit: {A: 6.176e-6, B: 2e-6}}, touchdown: false, drop: false};
  const text = withExpectations(scenario, result);
  assert.match(text, /detected_within = 0\.00014\n/);
  assert.match(text, /classified = "open"\nredistributed = true\ntouchdown = false\ndrop = false\nmax_orbit = 0\.0000068\n/);
  assert.equal(text.match(/\[expect\]/g).length, 1);
  assert.equal(limitAbove(6.176e-6), 6.8e-6);
  // A second fault that was not named: no class is expected.
  const two = withExpectations(scenario, {...result, events: [...result.events, {kind: 'fault', t: 0.2, target: 'A.coil4'}]});
  assert.doesNotMatch(two, /classified|detected_within/);
});

test('a sweep is a campaign of the coils of one bearing', () => {
  const text = sweepText({name: 's', rig: 'rig.toml', duration: 0.15, speed: 157.08, faults: [{target: 'A.coil4', kind: 'open', time: 0.1, parameters: {}}, {target: 'A.coil3', kind: 'open', time: 0.1, parameters: {}}, {target: 'B.coil1', kind: 'open', time: 0.1, parameters: {}}]});
  assert.match(text, /bearings = \["A"\]\nhealthy = true\nsets = \[\[3, 4\]\]/);
  assert.match(text, /speeds = \[0\.0, 157\.08, 314\.16\]/);
  assert.equal(sweepText({name: 's', rig: 'r', duration: 1, speed: 1, faults: [{target: 'rig', kind: 'bus-sag', time: 0, parameters: {}}]}), '');
});

test('an error says its file and line', () => {
  assert.deepEqual(placeOf('a/case.toml:31: record[4].data = "x", allowed: a file'), {file: 'a/case.toml', line: 31});
  assert.equal(placeOf('no file here: 3: x'), null);
  assert.deepEqual(linesAround('a\nb\nc', 2, 1), [{number: 1, text: 'a', is: false}, {number: 2, text: 'b', is: true}, {number: 3, text: 'c', is: false}]);
  assert.deepEqual(linesAround('a', 9, 1), []);
});

test('exports have every sample and no markup of a name', () => {
  const series = {head: {channels: [{name: 'A.x', unit: 'm'}]}, time: [0, 0.1], values: [[1.23456789e-6, null]]};
  assert.equal(csvOf(series), 't [s],A.x [m]\n0,0.00000123456789\n0.1,\n');
  assert.match(svgOf([{title: '<b>', time: [0, 1], values: [[0, 1]], tones: ['red']}]), /&lt;b>.*<polyline fill="none" stroke="red" points="60\.0,130\.0 890\.0,30\.0"\/>/);
});

test('an answer out of its range is said', () => {
  const q = {key: 'mass', unit: 'kg', doc: '', lo: 0.1, hi: 10, fallback: null};
  assert.equal(complaint(q, ''), 'is needed');
  assert.equal(complaint(q, 'x'), 'is no number');
  assert.equal(complaint(q, '11'), 'allowed: 0.100 to 10.0 kg');
  assert.equal(complaint(q, '2'), '');
  assert.equal(complaint({...q, fallback: 1}, ' '), '');
});
