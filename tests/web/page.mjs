/**
 * What tests of the workbench's screens need: the few parts of a browser that the scripts touch, with a server that a
 * test scripts, and templates of lit-html as text. Import this before anything of web/workbench.
 */
import {register} from 'node:module';

// The page loads ./lit-html.js from the server; node has the same library made for programs without a document.
const lit = new URL('../../web/node_modules/lit-html/node/lit-html.js', import.meta.url).href;
const hooks = `export async function resolve(name, context, next) {
  return name === './lit-html.js' ? {url: ${JSON.stringify(lit)}, format: 'module', shortCircuit: true} : next(name, context);
}`;
register('data:text/javascript,' + encodeURIComponent(hooks));

/** Requests that the page made, and what it is answered: a function of (path, options) or nothing for {}. */
export const server = {asked: [], answer: null};

/** An answer as fetch gives it. */
export function answered(body, {status = 200, headers = {}} = {}) {
  return new Response(typeof body === 'string' || body instanceof ReadableStream ? body : JSON.stringify(body), {status, headers});
}

/** The bytes of /api/series. @param {{name: string, unit: string}[]} channels @param {number[][]} values of each @param {object} more of the head */
export function seriesAnswer(channels, values, more = {}) {
  const head = JSON.stringify({mode: 'samples', start: 0, step: 1, count: values[0].length, rate: 1, channels, ...more});
  const text = new TextEncoder().encode(head.padEnd(Math.ceil(head.length / 4) * 4));
  const bytes = new Uint8Array(4 + text.length + 4 * values.flat().length);
  new DataView(bytes.buffer).setUint32(0, text.length, true);
  bytes.set(text, 4);
  values.flat().forEach((v, k) => new DataView(bytes.buffer).setFloat32(4 + text.length + 4 * k, v, true));
  return new Response(bytes);
}

const kept = new Map();
const elements = new Map();
Object.assign(globalThis, {
  location: {hash: '', pathname: '/'},
  sessionStorage: {getItem: (k) => kept.get(k) ?? null, setItem: (k, v) => kept.set(k, v)},
  history: {replaceState: (_, __, address) => void (location.hash = address.slice(address.indexOf('#')))},
  requestAnimationFrame: (f) => setTimeout(f, 0),
  document: {getElementById: (id) => elements.get(id) ?? null, createTreeWalker: () => ({})},
  fetch: async (path, options = {}) => {
    server.asked.push({path, method: options.method ?? 'GET', headers: options.headers, body: options.body});
    return server.answer ? server.answer(path, options) : answered({});
  },
});

/** An element of the page that takes text. */
export function element(id) {
  const made = {textContent: ''};
  elements.set(id, made);
  return made;
}

/** Lets everything run that waits for an answer or a frame. */
export async function settled() {
  for (let k = 0; k < 20; ++k) await new Promise((resume) => setTimeout(resume, 0));
}

/** A template as text; what a click calls stands as its number in `calls`. */
export function rendered(template) {
  const calls = [];
  const text = (value) => {
    if (value === null || value === undefined || typeof value === 'symbol') return '';
    if (Array.isArray(value)) return value.map(text).join('');
    if (typeof value === 'function') return String(calls.push(value) - 1);
    if (typeof value !== 'object') return String(value);
    return value.strings.map((s, k) => s + (k < value.values.length ? text(value.values[k]) : '')).join('');
  };
  const out = text(template).replace(/\s+/g, ' ');
  /** Calls the handler of the button with this text or label. */
  const click = (label, event = {}) => {
    const quoted = label.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');
    const found = new RegExp(`<button(?=[^>]*@click=(\\d+))(?:[^>]*aria-label="${quoted}"[^>]*>|[^>]*>\\s*${quoted}\\s*</button>)`).exec(out);
    if (!found) throw new Error(`no button "${label}" in ${out}`);
    return calls[Number(found[1])](event);
  };
  return {text: out, calls, click};
}
