/** Linked panels over time: measured and model, and the error in units of the noise; runs beside each other. */
import {getBytes} from './api.js';
import {prefixFor, significant} from './numbers.js';
import {colour, makePlot} from './panel_plot.js';
import {betweenText, indexNear, lineName, marksText, nearest} from './panel_text.js';
import {decodeSeries, largest} from './series.js';
import {tellError} from './state.js';

/**
 * @typedef {{channel: string, label: string, tone: string, query?: string, dash?: number[], shift?: number}} Line  `query`: of another record
 * @typedef {{title: string, height: number, lines: Line[]}} Plot
 * @typedef {{query: string, name: string, plots: Plot[], from: number|null, to: number|null, marks?: Record<string, number>, events?: number[]}} What  `query`: which record
 */

const rest = 80;  // [ms] after the last zoom before the address is changed, and between two requests while a zoom goes on

export class Panels {
  /** @param {HTMLElement} place @param {(change: {from: number|null, to: number|null, marks: Record<string, number>}) => void} moved */
  constructor(place, moved) {
    this.place = place;
    this.moved = moved;
    /** @type {any[]} */
    this.plots = [];
    this.key = '';
    this.shape = '';
    /** @type {number|null} */
    this.from = null;
    /** @type {number|null} */
    this.to = null;
    this.timer = 0;
    this.pace = 0;
    this.asked = 0;
    this.sync = uPlot.sync('time');
    /** @type {Record<string, number>} the cursors A and B [s] */
    this.marks = {};
    this.held = false;  // y keeps its range
    this.samples = false;
    this.drawing = 0;
    new ResizeObserver(() => this.resize()).observe(place);
    // A canvas keeps the colours that it was drawn with.
    addEventListener('theme', () => {
      if (this.place.isConnected && this.key) void this.load(true);
    });
  }

  /** @param {What} what */
  async show(what) {
    const key = JSON.stringify([what.query, what.plots]);
    // The same lines of a newer result stay in the plots that are there: a zoom or a drag that is under way goes on.
    const shape = JSON.stringify([what.name, what.plots], (name, value) => (name === 'query' ? undefined : value));
    const same = shape === this.shape;
    const marks = what.marks ?? (same ? this.marks : {});
    const remarked = JSON.stringify(marks) !== JSON.stringify(this.marks);
    this.marks = {...marks};
    this.what = what;
    // While a wheel turns or fingers move, the view that is drawn is that of a moment ago: it does not take them back.
    const moving = same && this.timer !== 0;
    if (moving || (key === this.key && what.from === this.from && what.to === this.to)) {
      this.key = key;
      if (remarked) this.tellMarks();
      return;
    }
    this.stopTimers();  // of another record
    this.key = key;
    this.shape = shape;
    this.from = what.from;
    this.to = what.to;
    await this.load(!same);
  }

  /** Of one record or run, all lines at once. @param {string} query @param {Line[]} lines */
  async fetchLines(query, lines) {
    const shift = lines[0].shift ?? 0;
    let path = `/api/series?${query}&c=${lines.map((l) => encodeURIComponent(l.channel)).join(',')}&px=${Math.max(200, this.width())}`;
    if (this.from !== null && this.to !== null) path += `&t0=${this.from - shift}&t1=${this.to - shift}`;
    const series = decodeSeries(await getBytes(path));
    return {...series, time: shift === 0 ? series.time : series.time.map((t) => t + shift)};
  }

  /** @param {boolean} anew whether other channels are shown */
  async load(anew) {
    const what = this.what;
    if (!what) return;
    const number = ++this.asked;
    const groups = new Map();
    for (const l of what.plots.flatMap((p) => p.lines)) {
      const query = l.query ?? what.query;
      groups.set(query, [...(groups.get(query) ?? []), l]);
    }
    this.place.setAttribute('aria-busy', 'true');
    try {
      const parts = await Promise.all([...groups].map(async ([query, lines]) => ({lines, series: await this.fetchLines(query, lines)})));
      if (number !== this.asked) return;
      if (anew) this.build(what);
      this.fill(parts, what);
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
    for (const plot of what.plots) this.plots.push(makePlot(this, plot));
  }

  /** @param {{lines: Line[], series: import('./series.js').Series}[]} parts @param {What} what */
  fill(parts, what) {
    const main = parts[0].series;
    this.samples = parts.every((p) => p.series.head.mode === 'samples');
    const found = new Map();
    for (const part of parts)
      part.lines.forEach((l, k) => {
        const values = part === parts[0] ? part.series.values[k] : nearest(main.time, part.series.time, part.series.values[k]);
        found.set(l, {values, unit: part.series.head.channels[k].unit});
      });
    this.plots.forEach((plot, k) => {
      const lines = what.plots[k].lines.map((l) => found.get(l));
      const p = prefixFor(largest(lines.map((l) => l.values)), lines[0].unit);
      const shown = lines.map((l) => l.values.map((/** @type {number|null} */ x) => (x === null ? null : x * p.factor)));
      const title = what.plots[k].title + (p.unit ? ` [${p.unit}]` : '');
      const figure = plot.root.parentElement;
      const caption = figure?.querySelector('figcaption');
      if (caption) caption.textContent = title;
      figure?.setAttribute('aria-label', `${title}, ${what.name}, largest ${significant(largest(shown))}`);
      plot.lines = lines.map((l, n) => ({label: lineName(what.plots[k].title, what.plots[k].lines[n].label), values: l.values, unit: l.unit}));
      const {min, max} = plot.scales.y;
      plot.setData([main.time, ...shown], false);
      plot.setScale('x', {min: this.from ?? main.time[0], max: this.to ?? main.time.at(-1) ?? 1});
      if (this.held && min !== null && plot.factor === p.factor) plot.setScale('y', {min, max});
      plot.factor = p.factor;
    });
    this.tellMarks();
  }

  /** Another file is shown: nothing of the last one stays. */
  clear() {
    ++this.asked;
    this.stopTimers();
    this.key = this.shape = '';
    this.from = this.to = null;
    this.marks = {};
    for (const p of this.plots) p.destroy();
    this.plots = [];
    this.place.replaceChildren();
  }

  /** @param {number|null} from @param {number|null} to null: all */
  zoom(from, to) {
    this.from = from;
    this.to = to;
    clearTimeout(this.timer);
    // A wheel turns faster than the screen: one drawing a frame.
    if (from !== null && to !== null && !this.drawing)
      this.drawing = requestAnimationFrame(() => {
        this.drawing = 0;
        if (this.from !== null && this.to !== null) for (const plot of this.plots) plot.setScale('x', {min: this.from, max: this.to});
      });
    this.timer = setTimeout(() => {
      this.timer = 0;
      this.tellMoved();
    }, rest);
    this.follow();
  }

  /** The data follow the view while it moves, one request at a time. */
  follow() {
    if (this.pace !== 0) return;
    const pace = (this.pace = setTimeout(async () => {
      const {from, to} = this;
      await this.load(false);
      if (this.pace !== pace) return;
      this.pace = 0;
      if (from !== this.from || to !== this.to) this.follow();
    }, rest));
  }

  stopTimers() {
    clearTimeout(this.timer);
    clearTimeout(this.pace);
    this.timer = this.pace = 0;
  }

  tellMoved() {
    this.moved({from: this.from, to: this.to, marks: {...this.marks}});
  }

  /** Moves the cursor by a point of the view and says the values there. @param {any} plot @param {number} by */
  step(plot, by) {
    const time = plot.data[0];
    // From where the cursor stands: the index that the plot keeps is that of the data before a zoom.
    const now = plot.cursor.left >= 0 ? indexNear(time, plot.posToVal(plot.cursor.left, 'x')) : Math.floor(time.length / 2);
    const index = Math.min(Math.max(now + by, 0), time.length - 1);
    const left = plot.valToPos(plot.data[0][index], 'x');
    plot.setCursor({left, top: plot.over.clientHeight / 2});
    const said = document.getElementById('said');
    const values = plot.series.slice(1).map((/** @type {any} */ s, /** @type {number} */ k) => `${s.label} ${significant(plot.data[k + 1][index] ?? NaN, 4)}`);
    if (said) said.textContent = `${plot.data[0][index].toFixed(5)} s: ${values.join(', ')}`;
  }

  /** The next event behind the cursor, in the middle of the view. @param {number} after [s] */
  nextEvent(after) {
    const events = this.what?.events ?? [];
    const next = events.find((t) => t > after + 1e-9) ?? events[0];
    if (next === undefined) return;
    const half = this.from !== null && this.to !== null ? (this.to - this.from) / 2 : 0.02;
    this.zoom(Math.max(0, next - half), Math.max(0, next - half) + 2 * half);
  }

  /** @param {string} name @param {number} t */
  mark(name, t) {
    this.marks[name] = t;
    this.tellMarks();
    this.tellMoved();
  }

  tellMarks() {
    for (const plot of this.plots) plot.redraw(false);
    const out = this.place.parentElement?.querySelector('.marks');
    if (!out) return;
    const lines = this.plots.flatMap((p) => p.lines ?? []);
    const between = this.plots.length > 0 ? betweenText(this.marks, this.plots[0].data[0], lines, this.samples) : '';
    out.textContent = [marksText(this.marks), between].filter((t) => t).join('\n');
  }

  /** @param {any} u */
  drawMarks(u) {
    const all = /** @type {[string, number, string][]} */ (Object.entries(this.marks).map(([name, t]) => [name, t, 'ink']));
    for (const t of this.what?.events ?? []) all.push(['', t, 'error']);
    for (const [name, t, tone] of all) {
      const x = u.valToPos(t, 'x', true);
      if (x < u.bbox.left || x > u.bbox.left + u.bbox.width) continue;
      u.ctx.save();
      u.ctx.strokeStyle = u.ctx.fillStyle = colour(tone);
      if (!name) u.ctx.setLineDash([4, 4]);
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
