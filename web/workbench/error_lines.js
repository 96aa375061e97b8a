/** Where an error of a command says that it is. */

/** "case.toml:31: ..." @param {string} error */
export function placeOf(error) {
  const found = /^([^\s:][^:]*\.toml):(\d+):/.exec(error);
  return found ? {file: found[1], line: Number(found[2])} : null;
}

/** Lines around line `at` of a text, numbered. @param {string} text @param {number} at @param {number} around */
export function linesAround(text, at, around = 3) {
  const lines = text.split('\n');
  const from = Math.max(1, at - around), to = Math.min(lines.length, at + around);
  return Array.from({length: Math.max(0, to - from + 1)}, (_, k) => ({number: from + k, text: lines[from + k - 1], is: from + k === at}));
}
