/** The text of a case file, changed as its user would: text is appended, nothing else moves. */

/** A TOML string. @param {string} s */
export function quoted(s) {
  return '"' + s.replaceAll('\\', '\\\\').replaceAll('"', '\\"') + '"';
}

/** How a file is named in a file of another folder. @param {string} from "practice/case.toml" @param {string} to "logs/a.csv" */
export function relativeName(from, to) {
  const a = from.split('/').slice(0, -1), b = to.split('/');
  let same = 0;
  while (same < a.length && same < b.length - 1 && a[same] === b[same]) ++same;
  return [...a.slice(same).map(() => '..'), ...b.slice(same)].join('/');
}

/** The file that a name in another file means. @param {string} from "practice/case.toml" @param {string} name "../rig.toml" */
export function namedFile(from, name) {
  const out = /** @type {string[]} */ ([]);
  for (const p of (from.slice(0, from.lastIndexOf('/') + 1) + name).split('/')) {
    if (p === '..') out.pop();
    else if (p !== '' && p !== '.') out.push(p);
  }
  return out.join('/');
}

/** What a key of the top of a TOML file says, where it is a plain text; "" else. @param {string} text @param {string} key */
export function topText(text, key) {
  const top = text.split(/^\s*\[/m)[0];
  return new RegExp(`^\\s*${key}\\s*=\\s*"([^"]*)"`, 'm').exec(top)?.[1] ?? '';
}

/**
 * @typedef {{channel: string, column: string, unit: string, gain: number}} Mapping
 * @typedef {{scenario: string, data: string, use: string, columns: Mapping[], imposed?: boolean}} NewRecord  names as in the case file
 */

/** The case with one more [[record]]. @param {string} text @param {NewRecord} r */
export function withRecord(text, r) {
  let out = text.replace(/\n*$/, '\n') + `\n[[record]]\nscenario = ${quoted(r.scenario)}\ndata = ${quoted(r.data)}\nuse = ${quoted(r.use)}\n`;
  if (r.imposed) out += 'imposed = "motion"\n';
  const own = r.columns.filter((c) => c.channel !== c.column || c.unit !== '' || c.gain !== 1);
  if (own.length > 0) out += '[record.channels]\n';
  for (const c of own) {
    out += `${quoted(c.channel)} = { column = ${quoted(c.column)}`;
    if (c.unit) out += `, unit = ${quoted(c.unit)}`;
    if (c.gain !== 1) out += `, gain = ${Number.isInteger(c.gain) ? c.gain.toFixed(1) : c.gain}`;
    out += ' }\n';
  }
  return out;
}

/** The case with a copy of the [[record]] of this data file that reads another one. @param {string} text @param {string} stem @param {string} data */
export function recordCopied(text, stem, data) {
  const parts = text.split(/^(?=\s*\[\[record\]\])/m);
  const found = parts.find((p) => /^\s*\[\[record\]\]/.test(p) && new RegExp(`^\\s*data\\s*=\\s*"(?:[^"]*/)?${stem.replaceAll(/[.*+?^${}()|[\]\\]/g, '\\$&')}\\.[^".]+"`, 'm').test(p));
  if (!found) throw new Error(`the case has no record ${stem}`);
  return text.replace(/\n*$/, '\n\n') + found.replace(/^\s*/, '').replace(/^(\s*data\s*=\s*)"[^"]*"/m, (_, head) => head + JSON.stringify(data)).replace(/^(\s*use\s*=\s*)"[^"]*"/m, '$1"fit"').replace(/\n*$/, '\n');
}

/** The same text with another number for a key of the top; appended there when it is missing. @param {string} text @param {string} key @param {string} value as TOML writes it */
export function withTopValue(text, key, value) {
  const at = text.search(/^\s*\[/m);
  const top = at < 0 ? text : text.slice(0, at), rest = at < 0 ? '' : text.slice(at);
  const line = new RegExp(`^([ \\t]*${key}[ \\t]*=[ \\t]*)([^#\\n]*?)([ \\t]*(?:#[^\\n]*)?)$`, 'm');
  if (line.test(top)) return top.replace(line, (_, a, __, c) => a + value + c) + rest;
  return top.replace(/\n*$/, '\n') + `${key} = ${value}\n` + (rest ? '\n' + rest.replace(/^\n+/, '') : '');
}

const letters = (/** @type {string} */ s) => s.toLowerCase().replaceAll(/[^a-z0-9]/g, '');

/**
 * Which column is which channel, as far as names say: the same name, or the same letters ("pos_ax" ends with that of A.x).
 * @param {string[]} channels of the rig @param {{name: string, unit: string}[]} columns of the file @returns {Mapping[]}
 */
export function guessColumns(channels, columns) {
  const out = /** @type {Mapping[]} */ ([]);
  const taken = new Set();
  const take = (/** @type {(channel: string, column: string) => boolean} */ fits) => {
    for (const channel of channels) {
      if (out.some((m) => m.channel === channel)) continue;
      const found = columns.filter((c) => !taken.has(c.name) && fits(channel, c.name));
      if (found.length !== 1) continue;
      taken.add(found[0].name);
      out.push({channel, column: found[0].name, unit: '', gain: 1});
    }
  };
  take((channel, column) => channel === column);
  take((channel, column) => letters(channel) === letters(column));
  take((channel, column) => letters(channel).length > 1 && letters(column).endsWith(letters(channel)));
  return out.sort((a, b) => channels.indexOf(a.channel) - channels.indexOf(b.channel));
}

/** Units that a column of this SI unit may be written in. @param {string} unit */
export function unitsFor(unit) {
  /** @type {Record<string, string[]>} */
  const known = {m: ['m', 'mm', 'um'], A: ['A', 'mA'], V: ['V', 'mV'], N: ['N', 'kN'], 'rad/s': ['rad/s', 'rpm', 'Hz']};
  return known[unit] ?? [unit];
}
