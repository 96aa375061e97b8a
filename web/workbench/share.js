/** Take it away: the address of the view, the panels as PNG or SVG, the samples in view as CSV. */
import {html} from './lit-html.js';
import {getBytes} from './api.js';
import {csvOf, svgOf} from './export_text.js';
import {decodeSeries} from './series.js';
import {state, tell, tellError} from './state.js';

/** @param {Blob} blob @param {string} name */
export function download(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** Every sample of what is shown, of the range in view. @param {import('./panels.js').Panels} panels */
async function exportCsv(panels) {
  const what = panels.what;
  if (!what) return;
  try {
    const lines = what.plots.flatMap((p) => p.lines).filter((l) => !l.query || l.query === what.query);
    const names = [...new Set(lines.map((l) => l.channel))];
    let path = `/api/series?${what.query}&c=${names.map(encodeURIComponent).join(',')}&all=1`;
    if (panels.from !== null && panels.to !== null) path += `&t0=${panels.from}&t1=${panels.to}`;
    download(new Blob([csvOf(decodeSeries(await getBytes(path)))], {type: 'text/csv'}), what.name.replaceAll('/', '_') + '.csv');
  } catch (error) {
    tellError(error);
  }
}

/** All panels below each other, as they stand. @param {import('./panels.js').Panels} panels */
function exportPng(panels) {
  const pictures = panels.plots.map((p) => /** @type {HTMLCanvasElement} */ (p.ctx.canvas));
  if (pictures.length === 0) return;
  const ratio = devicePixelRatio, line = 18 * ratio;
  const out = document.createElement('canvas');
  out.width = Math.max(...pictures.map((c) => c.width));
  out.height = pictures.reduce((sum, c) => sum + c.height + line, 0);
  const ink = /** @type {CanvasRenderingContext2D} */ (out.getContext('2d'));
  const style = getComputedStyle(document.body);
  ink.fillStyle = style.backgroundColor;
  ink.fillRect(0, 0, out.width, out.height);
  ink.fillStyle = style.color;
  ink.font = `${13 * ratio}px sans-serif`;
  let y = 0;
  panels.plots.forEach((p, k) => {
    ink.fillText(p.root.parentElement?.getAttribute('aria-label') ?? '', 4 * ratio, y + 14 * ratio);
    ink.drawImage(pictures[k], 0, y + line);
    y += pictures[k].height + line;
  });
  out.toBlob((blob) => blob && download(blob, (panels.what?.name ?? 'view').replaceAll('/', '_') + '.png'));
}

/** @param {import('./panels.js').Panels} panels */
function exportSvg(panels) {
  const drawn = panels.plots.map((p, k) => ({
    title: p.root.parentElement?.querySelector('figcaption')?.textContent ?? '', time: p.data[0], values: p.data.slice(1),
    tones: panels.what?.plots[k].lines.map((l) => getComputedStyle(document.documentElement).getPropertyValue('--' + l.tone).trim()) ?? [],
  }));
  download(new Blob([svgOf(drawn)], {type: 'image/svg+xml'}), (panels.what?.name ?? 'view').replaceAll('/', '_') + '.svg');
}

async function copyAddress() {
  const address = location.href;
  try {
    await navigator.clipboard.writeText(address);
    tell('The address of this view is in the clipboard; it holds no key.');
  } catch {
    tell(address);
  }
}

/** @param {() => import('./panels.js').Panels|null} panels */
export function shareBar(panels) {
  const act = (/** @type {(p: import('./panels.js').Panels) => void} */ how) => () => {
    const p = panels();
    if (p) how(p);
  };
  return html`<p class="share" role="group" aria-label="share ${state.view.file}"><button @click=${copyAddress}>Copy address</button>
    <button @click=${act(exportPng)}>PNG</button> <button @click=${act(exportSvg)}>SVG</button> <button @click=${act(exportCsv)}>CSV, every sample in view</button></p>`;
}
