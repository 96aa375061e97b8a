/** The binary answer of /api/series: a JSON head, then float32 values of every channel. */

/**
 * @typedef {{mode: 'samples'|'extremes', start: number, step: number, count: number, rate: number,
 *            channels: {name: string, unit: string}[]}} Head
 * @typedef {{head: Head, time: number[], values: (number|null)[][]}} Series  values by channel, on `time`
 */

/**
 * Columns of extremes become two points, at a third and two thirds of the column, so that a line through
 * them fills the band. A value that does not count is a gap.
 * @param {ArrayBuffer} bytes
 * @returns {Series}
 */
export function decodeSeries(bytes) {
  const view = new DataView(bytes);
  const length = view.getUint32(0, true);
  /** @type {Head} */
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
  const floats = new Float32Array(bytes.slice(4 + length));
  const per = head.mode === 'extremes' ? 2 : 1;
  const points = head.count * per;
  if (floats.length !== points * head.channels.length) throw new Error('the series is not whole');
  const time = [];
  for (let k = 0; k < head.count; ++k) {
    const t = head.start + k * head.step;
    if (per === 1) time.push(t);
    else time.push(t + head.step / 3, t + (2 * head.step) / 3);
  }
  const values = head.channels.map((_, c) => {
    const out = /** @type {(number|null)[]} */ ([]);
    for (let k = 0; k < points; ++k) {
      const v = floats[c * points + k];
      out.push(Number.isNaN(v) ? null : v);
    }
    return out;
  });
  return {head, time, values};
}

/** Largest magnitude of the values that count. @param {(number|null)[][]} values */
export function largest(values) {
  let most = 0;
  for (const channel of values)
    for (const v of channel) if (v !== null && Math.abs(v) > most) most = Math.abs(v);
  return most;
}
