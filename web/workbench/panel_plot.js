/** One panel: the plot in its figure, and what mouse, fingers and keys do to it. */
import {columnPath} from './column_path.js';
import {significant} from './numbers.js';

/** Colours of the reports' palette. @param {string} name */
export function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
}

/** @param {import('./panels.js').Line} l @returns {any} */
function line(l) {
  return {label: l.label, stroke: () => colour(l.tone), paths: columnPath(uPlot.paths.linear?.()), width: 1.2, dash: l.dash, points: {show: false}, spanGaps: false,
          value: (/** @type {any} */ _, /** @type {number|null} */ v) => (v === null ? '-' : significant(v, 4))};
}

/** @param {import('./panels.js').Panels} panels @param {import('./panels.js').Plot} what */
export function makePlot(panels, what) {
  const figure = document.createElement('figure');
  figure.tabIndex = 0;
  figure.className = 'panel';
  figure.append(document.createElement('figcaption'));
  panels.place.append(figure);
  const axis = {stroke: () => colour('ink'), grid: {stroke: () => colour('grid'), width: 1}, ticks: {show: false}};
  const plot = new uPlot({
    width: panels.width(), height: what.height,
    scales: {x: {time: false}},
    axes: [{...axis, size: 26, gap: 2, values: (/** @type {any} */ _, /** @type {number[]} */ v) => v.map((t) => String(Number(t.toPrecision(6))))},
           {...axis, size: 64, space: 20, values: (/** @type {any} */ _, /** @type {number[]} */ v) => v.map((y) => String(Number(y.toPrecision(6))))}],
    series: [{label: 't [s]', value: (/** @type {any} */ _, /** @type {number|null} */ t) => (t === null ? '-' : t.toFixed(5))}, ...what.lines.map(line)],
    cursor: {sync: {key: panels.sync.key, setSeries: false}, drag: {x: true, y: false, setScale: false}, bind: {dblclick: () => () => {
      panels.zoom(null, null);
      return null;
    }}},
    hooks: {setSelect: [(/** @type {any} */ u) => u.setSelect({left: 0, width: 0, top: 0, height: 0}, false)], draw: [(/** @type {any} */ u) => panels.drawMarks(u)]},
    select: {show: true, left: 0, top: 0, width: 0, height: 0},
  }, [[0], ...what.lines.map(() => [null])], figure);
  plot.over.addEventListener('mousedown', (/** @type {MouseEvent} */ e) => drag(e, panels, plot));
  plot.root.addEventListener('wheel', (/** @type {WheelEvent} */ e) => wheel(e, panels, plot), {passive: false});
  plot.over.addEventListener('touchstart', (/** @type {TouchEvent} */ e) => touch(e, panels, plot), {passive: false});
  figure.addEventListener('keydown', (e) => pressed(e, panels, plot));
  return plot;
}

/** @param {any} plot @param {number} clientX */
function timeAt(plot, clientX) {
  const box = plot.over.getBoundingClientRect();
  return plot.posToVal(Math.min(Math.max(clientX - box.left, 0), box.width), 'x');
}

/**
 * Zooms to what lies between this press and the release; with Shift the view follows the pointer. The selection that the plot draws is
 * no measure of it: it shows in every linked panel, and a change of size during the drag reports it before the release.
 * @param {MouseEvent} down @param {import('./panels.js').Panels} panels @param {any} plot
 */
function drag(down, panels, plot) {
  if (down.button !== 0) return;
  const start = timeAt(plot, down.clientX);
  const {min, max} = plot.scales.x;
  const perPixel = (max - min) / plot.over.getBoundingClientRect().width;
  const follow = (/** @type {MouseEvent} */ e) => panels.zoom(min - (e.clientX - down.clientX) * perPixel, max - (e.clientX - down.clientX) * perPixel);
  if (down.shiftKey) addEventListener('mousemove', follow);
  addEventListener('mouseup', (up) => {
    removeEventListener('mousemove', follow);
    const end = timeAt(plot, up.clientX);
    if (!down.shiftKey && panels.plots.includes(plot) && Math.abs(up.clientX - down.clientX) > 4) panels.zoom(Math.min(start, end), Math.max(start, end));
  }, {once: true});
}

/** @param {WheelEvent} e @param {import('./panels.js').Panels} panels @param {any} plot */
function wheel(e, panels, plot) {
  e.preventDefault();
  const min = panels.from ?? plot.scales.x.min, max = panels.to ?? plot.scales.x.max;
  const box = plot.over.getBoundingClientRect();
  const at = min + ((e.clientX - box.left) / box.width) * (max - min);
  const by = e.deltaY > 0 ? 1.25 : 0.8;
  panels.zoom(at - (at - min) * by, at + (max - at) * by);
}

const longPress = 500;  // [ms]

/** One finger pans, two zoom, a long press sets B. @param {TouchEvent} down @param {import('./panels.js').Panels} panels @param {any} plot */
function touch(down, panels, plot) {
  down.preventDefault();
  plot.root.parentElement?.focus({preventScroll: true});
  const {min, max} = plot.scales.x;
  const places = (/** @type {TouchEvent} */ e) => [...e.touches].slice(0, 2).map((t) => t.clientX).sort((a, b) => a - b);
  const began = places(down).map((x) => timeAt(plot, x));
  const box = plot.over.getBoundingClientRect();
  const at = places(down)[0];
  const timer = setTimeout(() => began.length === 1 && panels.mark('B', began[0]), longPress);
  const move = (/** @type {TouchEvent} */ e) => {
    const now = places(e);
    if (Math.abs(now[0] - at) > 6 || now.length > 1) clearTimeout(timer);
    if (now.length !== began.length) return;
    if (now.length === 1) {
      const by = ((now[0] - at) / box.width) * (max - min);
      panels.zoom(min - by, max - by);
    } else if (now[1] - now[0] > 4) {
      // What was under the fingers stays under them.
      const scale = (began[1] - began[0]) / (now[1] - now[0]);
      panels.zoom(began[0] - (now[0] - box.left) * scale, began[0] + (box.right - now[0]) * scale);
    }
  };
  const end = () => {
    clearTimeout(timer);
    plot.over.removeEventListener('touchmove', move);
  };
  plot.over.addEventListener('touchmove', move, {passive: false});
  plot.over.addEventListener('touchend', end, {once: true});
}

/** @param {KeyboardEvent} e @param {import('./panels.js').Panels} panels @param {any} plot */
function pressed(e, panels, plot) {
  if (e.ctrlKey || e.metaKey) return;
  // The scale of the plot is that of the last frame: keys come faster.
  const min = panels.from ?? plot.scales.x.min, max = panels.to ?? plot.scales.x.max;
  const middle = min + (max - min) * (plot.cursor.left >= 0 ? plot.cursor.left / plot.over.getBoundingClientRect().width : 0.5);
  const key = e.key.toLowerCase();
  if (key === '+') panels.zoom(middle - (middle - min) / 2, middle + (max - middle) / 2);
  else if (key === '-') panels.zoom(middle - (middle - min) * 2, middle + (max - middle) * 2);
  else if (key === '0') panels.zoom(null, null);
  else if (key === 'a' || key === 'b') panels.mark(key.toUpperCase(), middle);
  else if (key === 'y') panels.held = !panels.held;
  else if (key === 'n') panels.nextEvent(middle);
  else if (key === 'arrowleft' || key === 'arrowright') panels.step(plot, (key === 'arrowright' ? 1 : -1) * (e.altKey ? 1 : 10));
  else return;
  e.preventDefault();
  e.stopPropagation();
}
