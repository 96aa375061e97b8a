/** The view in the address: `#/case/practice/case.toml?r=record-4&c=A.y&t=0.29,0.34`. It holds no data and no token. */

/**
 * @typedef {{screen: string, file: string, record: string, channels: string[], from: number|null, to: number|null,
 *            marks: Record<string, number>, vs: string, shift: number}} View  vs: what it is compared with, shifted in time by so many seconds
 */

/** @returns {View} the list of files */
export function emptyView() {
  return {screen: 'folder', file: '', record: '', channels: [], from: null, to: null, marks: {}, vs: '', shift: 0};
}

/** @param {string} hash as location.hash has it @returns {View} what is not understood is left out */
export function parseAddress(hash) {
  const view = emptyView();
  const text = hash.replace(/^#\/?/, '');
  const [path, query = ''] = text.split('?');
  const slash = path.indexOf('/');
  if (slash > 0) {
    view.screen = path.slice(0, slash);
    view.file = path.slice(slash + 1).split('/').map(decoded).join('/');
  }
  const values = new URLSearchParams(query);
  view.record = values.get('r') ?? '';
  view.channels = (values.get('c') ?? '').split(',').filter((c) => c !== '');
  const [from, to] = (values.get('t') ?? '').split(',').map(Number);
  if (Number.isFinite(from) && Number.isFinite(to) && to > from) {
    view.from = from;
    view.to = to;
  }
  for (const name of ['A', 'B']) {
    const t = Number(values.get(name) ?? NaN);
    if (Number.isFinite(t)) view.marks[name] = t;
  }
  view.vs = values.get('vs') ?? '';
  const shift = Number(values.get('shift') ?? 0);
  view.shift = Number.isFinite(shift) ? shift : 0;
  return view;
}

/** @param {View} view */
export function formatAddress(view) {
  if (view.screen === 'folder') return '#/';
  const query = [];
  if (view.record) query.push('r=' + encodeURIComponent(view.record));
  if (view.channels.length > 0) query.push('c=' + view.channels.map(encodeURIComponent).join(','));
  if (view.from !== null && view.to !== null) query.push(`t=${short(view.from)},${short(view.to)}`);
  for (const [name, t] of Object.entries(view.marks)) query.push(`${name}=${short(t)}`);
  if (view.vs) query.push('vs=' + encodeURIComponent(view.vs));
  if (view.shift) query.push(`shift=${short(view.shift)}`);
  const path = view.file.split('/').map(encodeURIComponent).join('/');
  return `#/${view.screen}/${path}` + (query.length > 0 ? '?' + query.join('&') : '');
}

/** @param {number} t seconds, to the microsecond */
function short(t) {
  return String(Number(t.toFixed(6)));
}

/** @param {string} part of an address @returns {string} as it stands where it is no code */
function decoded(part) {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}
