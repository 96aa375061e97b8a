/** The table of a comparison: where does the model fail? What it computes; misfit_table.js draws it. */

/**
 * @typedef {{ratio: number|string|null, rms_error: number, noise: number}} ChannelError
 * @typedef {{data: string, scenario: string, use: string, ratio: number|string|null,
 *            channels: Record<string, ChannelError>, blocks: Record<string, number|string|null>}} RecordError
 * @typedef {{record: string, use: string, title: string, ratio: number|string|null,
 *            cells: {channel: string, ratio: number|string|null}[]}} Row
 */

/** The name of a record: its data file without folder and extension, as `compare --series` names groups. @param {string} data */
export function recordName(data) {
  const name = data.slice(data.lastIndexOf('/') + 1);
  const dot = name.lastIndexOf('.');
  return (dot > 0 ? name.slice(0, dot) : name).replaceAll('.', '_');
}

/** A number to sort by: infinite beats all, unknown none. @param {number|string|null|undefined} r */
export function sizeOf(r) {
  if (r === 'inf') return Infinity;
  return typeof r === 'number' ? r : -1;
}

/** Columns: what the bearings measure first, currents, set-points and duties of single coils behind. @param {RecordError[]} records */
export function columnsOf(records) {
  /** @type {string[]} */
  const names = [];
  for (const r of records)
    for (const c of Object.keys(r.channels)) if (!names.includes(c)) names.push(c);
  const ofCoil = (/** @type {string} */ c) => /\.[isd]\d+$/.test(c);
  return [...names.filter((c) => !ofCoil(c)), ...names.filter(ofCoil)];
}

/** @param {RecordError[]} records @param {string[]} columns @returns {Row[]} */
export function rowsOf(records, columns) {
  return records.map((r) => ({
    record: recordName(r.data), use: r.use, title: r.scenario, ratio: r.ratio,
    cells: columns.map((channel) => ({channel, ratio: r.channels[channel]?.ratio ?? null})),
  }));
}

/** The worst cell, the first of equals; null without any. @param {RecordError[]} records */
export function worstCell(records) {
  let worst = /** @type {{record: string, channel: string, ratio: number}|null} */ (null);
  for (const r of records)
    for (const [channel, e] of Object.entries(r.channels)) {
      const size = sizeOf(e.ratio);
      if (size >= 0 && (!worst || size > worst.ratio)) worst = {record: recordName(r.data), channel, ratio: size};
    }
  return worst;
}

/** All cells, worst first. @param {RecordError[]} records */
export function worstCells(records) {
  return records.flatMap((r) => Object.entries(r.channels).map(([channel, e]) => ({record: recordName(r.data), channel, size: sizeOf(e.ratio)})))
    .filter((c) => c.size >= 0).sort((a, b) => b.size - a.size);
}

/** How strong a cell is coloured, 0 (noise) to 5. @param {number|string|null} r */
export function levelOf(r) {
  const size = sizeOf(r);
  if (size < 1.3) return 0;
  if (size < 2) return 1;
  if (size < 4) return 2;
  if (size < 8) return 3;
  return size < 20 ? 4 : 5;
}

/** The first free name: rig.toml -> rig_2.toml, rig_3.toml. @param {string} name @param {string[]} taken */
export function freeName(name, taken) {
  const found = /^(.*?)(?:_(\d+))?\.toml$/.exec(name);
  if (!found) return name;
  for (let k = Number(found[2] ?? 1) + 1; ; ++k) {
    const next = `${found[1]}_${k}.toml`;
    if (!taken.includes(next)) return next;
  }
}

/**
 * Height of a bar, 0 to 1, on a logarithmic scale from noise alone to the first step's error.
 * @param {number|string|null} r @param {number} most
 */
export function barOf(r, most) {
  const size = sizeOf(r);
  if (size <= 0) return 0;
  const top = Math.log(Math.max(most, 2));
  return Math.min(1, 0.06 + 0.94 * Math.max(0, Math.log(Math.max(size, 1)) / top));
}
