import assert from 'node:assert/strict';
import test from 'node:test';
import {rendered} from './page.mjs';

globalThis.document = {...globalThis.document, activeElement: null, querySelector: () => null};
const {dialog, matching, openDialog} = await import('../../web/workbench/keys.js');
const {state} = await import('../../web/workbench/state.js');

const files = [{name: 'bad.toml', kind: 'scenario'}, {name: 'healthy.toml', kind: 'scenario'}, {name: 'sub/healthy.csv', kind: 'record'}, {name: 'notes.txt', kind: 'other'}];

test('files are found by all words of their names, what no screen opens is not listed', () => {
  assert.deepEqual(matching(files, 'HEALTHY sub').map((f) => f.name), ['sub/healthy.csv']);
  assert.deepEqual(matching(files, '').map((f) => f.name), ['bad.toml', 'healthy.toml', 'sub/healthy.csv']);
});

test('Enter opens the first file of what is typed, though the list on the screen is older', () => {
  state.folder = {files};
  openDialog('find');
  const page = rendered(dialog());
  const enter = page.calls[Number(/@keydown=(\d+)/.exec(page.text)[1])];
  enter({key: 'h', target: {value: 'h'}});
  assert.equal(location.hash, '');
  enter({key: 'Enter', target: {value: 'healthy'}});
  assert.equal(location.hash, '#/run/healthy.toml');
});
