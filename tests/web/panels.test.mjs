import assert from 'node:assert/strict';
import test from 'node:test';
import {answered, element, seriesAnswer, server, settled} from './page.mjs';

/** As much of uPlot as the panels use: a scale of 100 pixels, and what was done to it. */
class Plot {
  constructor(options, data, parent) {
    Object.assign(this, {options, data, scales: {x: {min: 0, max: 10}, y: {min: null, max: null}}, cursor: {left: -1, idx: null}, redrawn: 0, width: options.width, height: options.height,
                         series: options.series, over: new EventTarget(), root: new EventTarget()});
    this.over.getBoundingClientRect = () => ({left: 50, width: 100});
    this.over.clientHeight = 80;
    this.root.parentElement = parent;
  }
  posToVal(pixel) {
    const {min, max} = this.scales.x;
    return min + (pixel / 100) * (max - min);
  }
  valToPos(value) {
    const {min, max} = this.scales.x;
    return ((value - min) / (max - min)) * 100;
  }
  setScale(name, range) { this.scales[name] = range; }
  setData(data) { this.data = data; }
  setCursor(at) { this.cursor = {...this.cursor, ...at}; }
  setSize(size) { Object.assign(this, size); }
  redraw() { ++this.redrawn; }
  destroy() { this.gone = true; }
}
Plot.sync = (key) => ({key});
Plot.paths = {linear: () => () => null};

/** An element that panels are put into. */
function box() {
  const marks = {textContent: ''};
  const made = {children: [], attributes: {}, clientWidth: 802, parentElement: {querySelector: () => marks}, marks,
                append(child) { this.children.push(child); }, replaceChildren() { this.children = []; },
                setAttribute(name, value) { this.attributes[name] = value; }};
  return made;
}

function figure() {
  const made = new EventTarget();
  return Object.assign(made, {children: [], attributes: {}, append(c) { this.children.push(c); },
                              setAttribute(name, value) { this.attributes[name] = value; }, querySelector() { return this.children[0]; }});
}

/** An event with what a browser's would carry. */
const event = (kind, more) => Object.assign(new Event(kind, {cancelable: true}), more);

const events = new EventTarget();
Object.assign(globalThis, {uPlot: Plot, ResizeObserver: class { observe() {} }, addEventListener: events.addEventListener.bind(events),
                           removeEventListener: events.removeEventListener.bind(events)});
document.createElement = (kind) => kind === 'figure' ? figure() : {textContent: ''};
const {Panels} = await import('../../web/workbench/panels.js');

/** A series of one channel, samples 1 s apart. */
const series = (values) => seriesAnswer([{name: 'A.x', unit: 'm'}], [values]);

const what = {query: 'job=3&record=r1', name: 'r1', from: null, to: null, plots: [{title: 'A.x', height: 100, lines: [{channel: 'A.x.measured', label: 'measured', tone: 'measured'}]}]};

async function shown(more = {}) {
  server.asked = [];
  server.answer = () => series([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10].map((v) => v * 1e-6));
  const place = box(), moves = [];
  const panels = new Panels(place, (change) => moves.push(change));
  await panels.show({...what, ...more});
  return {panels, place, moves, plot: panels.plots[0]};
}
const pause = () => new Promise((resume) => setTimeout(resume, 120));  // longer than the panels wait after a zoom

test('a panel asks for what it can show, in its unit, with a caption that says so', async () => {
  const {place, plot} = await shown();
  assert.equal(server.asked[0].path, '/api/series?job=3&record=r1&c=A.x.measured&px=800');
  assert.equal(plot.data[1][10].toFixed(4), '10.0000');  // 1e-5 m as 10 um
  assert.equal(place.children[0].children[0].textContent, 'A.x [\u00b5m]');
  assert.equal(place.children[0].attributes['aria-label'], 'A.x [\u00b5m], r1, largest 10.0');
  assert.deepEqual(plot.scales.x, {min: 0, max: 10});
  assert.equal(place.attributes['aria-busy'], 'false');
});

test('the same view is not asked for twice, another stretch of time is, and the panel stays', async () => {
  const {panels, plot} = await shown();
  await panels.show({...what});
  assert.equal(server.asked.length, 1);
  await panels.show({...what, from: 2, to: 3});
  assert.equal(server.asked[1].path, '/api/series?job=3&record=r1&c=A.x.measured&px=800&t0=2&t1=3');
  assert.equal(panels.plots[0], plot);
  await panels.show({...what, query: 'job=3&record=r2', name: 'r2'});
  assert.notEqual(panels.plots[0], plot);
  assert.equal(plot.gone, true);
});

test('a newer result of the same record is drawn into the plots that are there, a zoom under way goes on', async () => {
  const {panels, plot, moves} = await shown();
  await panels.show({...what, query: 'job=4&record=r1'});
  assert.match(server.asked[1].path, /job=4/);
  assert.equal(panels.plots[0], plot);
  plot.over.dispatchEvent(event('mousedown', {button: 0, clientX: 70}));
  await panels.show({...what, query: 'job=5&record=r1'});
  events.dispatchEvent(event('mouseup', {clientX: 110}));
  await panels.show({...what, query: 'job=6&record=r1'});  // before the rest of a zoom is over
  await pause();
  assert.deepEqual(moves, [{from: 2, to: 6, marks: {}}]);
  assert.match(server.asked.at(-1).path, /job=6&record=r1.*t0=2&t1=6$/);
});

test('an answer that comes after another question is not shown', async () => {
  const {panels} = await shown();
  let late;
  server.answer = () => new Promise((resume) => { late = resume; });
  const first = panels.show({...what, from: 1, to: 2});
  await settled();
  server.answer = () => series([7e-6, 7e-6]);
  await panels.show({...what, from: 3, to: 4});
  late(series([1e-6, 1e-6]));
  await first;
  assert.equal(panels.plots[0].data[1][0].toFixed(3), '7.000');
});

test('keys zoom about the cursor, or the middle where there is none; 0 shows all', async () => {
  const {panels, place, plot, moves} = await shown();
  const press = (key) => {
    const pressed = event('keydown', {key});
    place.children[0].dispatchEvent(pressed);
    return pressed.defaultPrevented;
  };
  press('+');
  assert.deepEqual([panels.from, panels.to], [2.5, 7.5]);
  plot.cursor.left = 0;  // at the left edge: that stays where it is
  press('+');
  assert.deepEqual([panels.from, panels.to], [2.5, 5]);
  press('-');
  assert.deepEqual([panels.from, panels.to], [2.5, 7.5]);
  press('0');
  assert.deepEqual([panels.from, panels.to], [null, null]);
  await pause();
  assert.deepEqual(moves, [{from: null, to: null, marks: {}}]);  // once, after the last of them
  assert.equal(press('-'), true);
  assert.equal(press('Tab'), false);  // other keys are the browser's
  await pause();
});

test('a view that is drawn while a zoom goes on does not take it back', async () => {
  const {panels, moves} = await shown();
  panels.zoom(2, 8);
  await panels.show({...what, from: 1, to: 9});  // of a moment ago
  assert.deepEqual([panels.from, panels.to], [2, 8]);
  await pause();
  assert.deepEqual(moves, [{from: 2, to: 8, marks: {}}]);
  await panels.show({...what, from: 1, to: 9});  // Back
  assert.deepEqual([panels.from, panels.to], [1, 9]);
  panels.zoom(3, 4);
  await panels.show({...what, query: 'job=3&record=r2', name: 'r2'});  // another record shows all, whatever was about to come
  await pause();
  assert.deepEqual([panels.from, moves.length], [null, 1]);
});

test('while a wheel turns the data follow, one request at a time, and the address waits until it rests', async () => {
  const {panels, moves} = await shown();
  const before = server.asked.length;
  let open = 0, most = 0;
  server.answer = async () => {
    most = Math.max(most, ++open);
    await new Promise((resume) => setTimeout(resume, 30));
    --open;
    return series([0, 1, 2]);
  };
  for (let k = 0; k < 20; ++k) {
    panels.zoom(k / 10, 5);
    await new Promise((resume) => setTimeout(resume, 20));
  }
  assert.ok(server.asked.length - before >= 2, 'data came while it turned');
  assert.equal(moves.length, 0);
  await pause();
  await pause();
  assert.equal(most, 1);
  assert.match(server.asked.at(-1).path, /t0=1\.9&t1=5/);
  assert.deepEqual(moves.map((m) => m.from), [1.9]);
});

test('the wheel keeps the instant under the pointer', async () => {
  const {panels, plot} = await shown();
  const turned = event('wheel', {clientX: 75, deltaY: -1});
  plot.root.dispatchEvent(turned);  // a quarter of the way: 2.5 s
  assert.equal(turned.defaultPrevented, true);  // the page stays where it is
  assert.deepEqual([panels.from, panels.to], [2.5 - 2, 2.5 + 6]);
  plot.root.dispatchEvent(event('wheel', {clientX: 75, deltaY: 1}));
  assert.ok(Math.abs(panels.from) < 1e-12 && Math.abs(panels.to - 10) < 1e-12);
  await pause();
});

test('a drag zooms to what it went over, either way and within the panel; a click does not', async () => {
  const {panels, plot} = await shown();
  const drag = (from, to) => {
    plot.over.dispatchEvent(event('mousedown', {button: 0, clientX: from}));
    events.dispatchEvent(Object.assign(new Event('mouseup'), {clientX: to}));
  };
  drag(90, 70);
  assert.deepEqual([panels.from, panels.to], [2, 4]);
  panels.zoom(null, null);
  plot.scales.x = {min: 0, max: 10};
  drag(90, 500);
  assert.deepEqual([panels.from, panels.to], [4, 10]);
  panels.zoom(null, null);
  drag(90, 93);
  plot.over.dispatchEvent(event('mousedown', {button: 2, clientX: 50}));
  events.dispatchEvent(event('mouseup', {clientX: 90}));
  assert.equal(panels.from, null);
  await pause();
});

test('two marks tell their distance in time and as a frequency', async () => {
  const {panels, plot, place, moves} = await shown();
  const drawn = plot.redrawn;
  panels.mark('A', 2);
  assert.equal(place.marks.textContent, 'A 2.00000 s');
  panels.mark('B', 2.02);
  assert.equal(place.marks.textContent, 'A 2.00000 s   B 2.02000 s   dt 0.02000 s, 1/dt 50.00 Hz\nA.x measured: dy 0, mean 2.00, rms 2.00, peak 2.00 \u00b5m');
  panels.mark('A', 2.02);
  assert.doesNotMatch(place.marks.textContent, /dt/);  // no frequency of nothing
  assert.equal(plot.redrawn - drawn, 3);
  assert.deepEqual(moves.at(-1), {from: null, to: null, marks: {A: 2.02, B: 2.02}});  // they stand in the address
});

test('arrows walk from sample to sample, say the values, and stop at the ends', async () => {
  const {panels, plot} = await shown();
  const said = element('said');
  panels.step(plot, 1);  // from the middle
  assert.equal(said.textContent, '6.00000 s: measured 6.000');
  assert.equal(plot.cursor.left, 60);
  plot.cursor.idx = 2;  // of the data before a zoom: where the cursor stands counts
  panels.step(plot, 1);
  assert.equal(said.textContent, '7.00000 s: measured 7.000');
  plot.cursor.left = 100;
  panels.step(plot, 1);
  assert.equal(said.textContent, '10.00000 s: measured 10.00');
  plot.cursor.left = 0;
  panels.step(plot, -1);
  assert.equal(plot.cursor.left, 0);
});

test('what cannot be had is told, and the panel is not busy for ever', async () => {
  const {panels, place} = await shown();
  const {state} = await import('../../web/workbench/state.js');
  server.answer = () => answered({error: 'no record r9'}, {status: 404});
  await panels.show({...what, query: 'job=3&record=r9'});
  assert.equal(state.notice.text, 'no record r9');
  assert.equal(place.attributes['aria-busy'], 'false');
});
