/** Linked panels over time: measured and model, and the error in units of the noise. */
import {getBytes} from './api.js';
import {prefixFor, significant} from './numbers.js';
import {decodeSeries, largest} from './series.js';
import {tellError} from './state.js';

/** Colours of the reports' palette. @param {string} name */
function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
}

/** @param {string} label @param {string} tone @param {number[]} [dash] @returns {any} */
function line(label, tone, dash) {
  return {label, stroke: () => colour(tone), width: 1.2, dash, points: {show: false}, spanGaps: false,
          value: (/** @type {any} */ _, /** @type {number|null} */ v) => (v === null ? '-' : significant(v, 4))};
}

/**
 * @typedef {{title: string, height: number, lines: {channel: string, label: string, tone: string}[]}} Plot
 * @typedef {{query: string, name: string, plots: Plot[], from: number|null, to: number|null}} What  `query`: which record
 */

const rest = 80;  // [ms] after the last zoom before the server is asked

export class Panels {
  /** @param {HTMLElement} place @param {(from: number|null, to: number|null) => void} moved */
  constructor(place, moved) {
    this.place = place;
    this.moved = moved;
    /** @type {any[]} */
    this.plots = [];
    this.key = '';
    /** @type {number|null} */
    this.from = null;
    /** @type {number|null} */
    this.to = null;
    this.timer = 0;
    this.asked = 0;
    this.sync = uPlot.sync('time');
    /** @type {Record<string, number>} the cursors A and B [s] */
    this.marks = {};
    new ResizeObserver(() => this.resize()).observe(place);
  }

  /**
   * @param {What} what
   */
  async show(what) {
    const key = JSON.stringify([what.query, what.plots]);
    if (key === this.key && what.from === this.from && what.to === this.to) return;
    const same = key === this.key;
    this.key = key;
    this.what = what;
    this.from = what.from;
    this.to = what.to;
    if (!same) this.marks = {};
    await this.load(!same);
  }

  /** @param {boolean} anew whether other channels are shown */
  async load(anew) {
    const what = this.what;
    if (!what) return;
    const number = ++this.asked;
    const names = what.plots.flatMap((p) => p.lines.map((l) => l.channel));
    let path = `/api/series?${what.query}&c=${names.map(encodeURIComponent).join(',')}&px=${Math.max(200, this.width())}`;
    if (this.from !== null && this.to !== null) path += `&t0=${this.from}&t1=${this.to}`;
    this.place.setAttribute('aria-busy', 'true');
    try {
      const series = decodeSeries(await getBytes(path));
      if (number !== this.asked) return;
      if (anew) this.build(what);
      this.fill(series, what);
    } catch (error) {
      tellError(error);
    }
    if (number === this.asked) this.place.setAttribute('aria-busy', 'false');
  }

  width() {
    return Math.max(300, Math.floor(this.place.clientWidth) - 2);
  }

  /** @param {What} what */
  build(what) {
    for (const p of this.plots) p.destroy();
    this.plots = [];
    this.place.replaceChildren();
    for (const plot of what.plots) this.add(plot.height, plot.lines.map((l) => line(l.label, l.tone)));
  }

  /** @param {number} height @param {any[]} lines */
  add(height, lines) {
    const figure = document.createElement('figure');
    figure.tabIndex = 0;
    figure.className = 'panel';
    const caption = document.createElement('figcaption');
    figure.append(caption);
    this.place.append(figure);
    const axis = {stroke: () => colour('ink'), grid: {stroke: () => colour('grid'), width: 1}, ticks: {show: false}};
    const plot = new uPlot({
      width: this.width(), height,
      scales: {x: {time: false}},
      axes: [{...axis, values: (/** @type {any} */ _, /** @type {number[]} */ v) => v.map((t) => String(Number(t.toPrecision(6))))},
             {...axis, size: 64, space: 24}],
      series: [{label: 't [s]', value: (/** @type {any} */ _, /** @type {number|null} */ t) => (t === null ? '-' : t.toFixed(5))}, ...lines],
      cursor: {sync: {key: this.sync.key, setSeries: false}, drag: {x: true, y: false, setScale: false}, bind: {dblclick: () => () => {
        this.zoom(null, null);
        return null;
      }}},
      hooks: {setSelect: [(/** @type {any} */ u) => u.setSelect({left: 0, width: 0, top: 0, height: 0}, false)], draw: [(/** @type {any} */ u) => this.drawMarks(u)]},
      select: {show: true, left: 0, top: 0, width: 0, height: 0},
    }, [[0], ...lines.map(() => [null])], figure);
    plot.over.addEventListener('mousedown', (/** @type {MouseEvent} */ e) => this.drag(e, plot));
    plot.root.addEventListener('wheel', (/** @type {WheelEvent} */ e) => this.wheel(e, plot), {passive: false});
    figure.addEventListener('keydown', (e) => this.pressed(e, plot));
    this.plots.push(plot);
  }

  /** @param {import('./series.js').Series} series @param {What} what */
  fill(series, what) {
    let at = 0;
    this.plots.forEach((plot, k) => {
      const count = what.plots[k].lines.length;
      const values = series.values.slice(at, at + count);
      const p = prefixFor(largest(values), series.head.channels[at].unit);
      at += count;
      const shown = values.map((v) => v.map((x) => (x === null ? null : x * p.factor)));
      const title = what.plots[k].title + (p.unit ? ` [${p.unit}]` : '');
      const figure = plot.root.parentElement;
      const caption = figure?.querySelector('figcaption');
      if (caption) caption.textContent = title;
      figure?.setAttribute('aria-label', `${title}, ${what.name}, largest ${significant(largest(shown))}`);
      plot.setData([series.time, ...shown], false);
      plot.setScale('x', {min: series.time[0], max: series.time.at(-1) ?? 1});
    });
  }

  /** Another file is shown: nothing of the last one stays. */
  clear() {
    ++this.asked;
    this.key = '';
    this.from = this.to = null;
    for (const p of this.plots) p.destroy();
    this.plots = [];
    this.place.replaceChildren();
  }

  /** @param {number|null} from @param {number|null} to null: all */
  zoom(from, to) {
    this.from = from;
    this.to = to;
    clearTimeout(this.timer);
    if (from !== null && to !== null) for (const plot of this.plots) plot.setScale('x', {min: from, max: to});
    this.timer = setTimeout(() => {
      void this.load(false);
      this.moved(this.from, this.to);
    }, rest);
  }

  /**
   * Zooms to what lies between this press and the release. The selection that the plot draws is no measure of it: it shows
   * in every linked panel, and a change of size during the drag reports it before the release.
   * @param {MouseEvent} down @param {any} plot
   */
  drag(down, plot) {
    if (down.button !== 0) return;
    const valueAt = (/** @type {MouseEvent} */ e) => {
      const box = plot.over.getBoundingClientRect();
      return plot.posToVal(Math.min(Math.max(e.clientX - box.left, 0), box.width), 'x');
    };
    const start = valueAt(down);
    addEventListener('mouseup', (up) => {
      const end = valueAt(up);
      if (this.plots.includes(plot) && Math.abs(up.clientX - down.clientX) > 4) this.zoom(Math.min(start, end), Math.max(start, end));
    }, {once: true});
  }

  /** @param {WheelEvent} e @param {any} plot */
  wheel(e, plot) {
    e.preventDefault();
    const {min, max} = plot.scales.x;
    const at = plot.posToVal(e.clientX - plot.over.getBoundingClientRect().left, 'x');
    const by = e.deltaY > 0 ? 1.25 : 0.8;
    this.zoom(at - (at - min) * by, at + (max - at) * by);
  }

  /** @param {KeyboardEvent} e @param {any} plot */
  pressed(e, plot) {
    const {min, max} = plot.scales.x;
    const middle = plot.cursor.left >= 0 ? plot.posToVal(plot.cursor.left, 'x') : (min + max) / 2;
    const key = e.key.toLowerCase();
    if (key === '+') this.zoom(middle - (middle - min) / 2, middle + (max - middle) / 2);
    else if (key === '-') this.zoom(middle - (middle - min) * 2, middle + (max - middle) * 2);
    else if (key === '0') this.zoom(null, null);
    else if (key === 'a' || key === 'b') this.mark(key.toUpperCase(), middle);
    else if (key === 'arrowleft' || key === 'arrowright') this.step(plot, key === 'arrowright' ? 1 : -1);
    else return;
    e.preventDefault();
  }

  /** Moves the cursor by a point of the view and says the values there. @param {any} plot @param {number} by */
  step(plot, by) {
    const index = Math.min(Math.max((plot.cursor.idx ?? Math.floor(plot.data[0].length / 2)) + by, 0), plot.data[0].length - 1);
    const left = plot.valToPos(plot.data[0][index], 'x');
    plot.setCursor({left, top: plot.over.clientHeight / 2});
    const said = document.getElementById('said');
    const values = plot.series.slice(1).map((/** @type {any} */ s, /** @type {number} */ k) => `${s.label} ${significant(plot.data[k + 1][index] ?? NaN, 4)}`);
    if (said) said.textContent = `${plot.data[0][index].toFixed(5)} s: ${values.join(', ')}`;
  }

  /** @param {string} name @param {number} t */
  mark(name, t) {
    this.marks[name] = t;
    for (const plot of this.plots) plot.redraw();
    const {A, B} = this.marks;
    const out = this.place.parentElement?.querySelector('.marks');
    if (!out) return;
    const texts = Object.entries(this.marks).map(([n, at]) => `${n} ${at.toFixed(5)} s`);
    if (A !== undefined && B !== undefined && A !== B)
      texts.push(`dt ${significant(B - A, 4)} s, 1/dt ${significant(Math.abs(1 / (B - A)), 4)} Hz`);
    out.textContent = texts.join('   ');
  }

  /** @param {any} u */
  drawMarks(u) {
    for (const [name, t] of Object.entries(this.marks)) {
      const x = u.valToPos(t, 'x', true);
      if (x < u.bbox.left || x > u.bbox.left + u.bbox.width) continue;
      u.ctx.save();
      u.ctx.strokeStyle = u.ctx.fillStyle = colour('ink');
      u.ctx.beginPath();
      u.ctx.moveTo(x, u.bbox.top);
      u.ctx.lineTo(x, u.bbox.top + u.bbox.height);
      u.ctx.stroke();
      u.ctx.fillText(name, x + 3, u.bbox.top + 12);
      u.ctx.restore();
    }
  }

  resize() {
    for (const plot of this.plots) {
      if (plot.width !== this.width()) plot.setSize({width: this.width(), height: plot.height});
    }
  }
}
