/** Requests to the server that sent this page. The token comes in the address once and is kept by this tab. */

let token = '';

/** Takes the token out of the address. @returns {boolean} whether there is one */
export function takeToken() {
  const found = /^#token=([0-9a-f]+)/.exec(location.hash);
  if (found) {
    sessionStorage.setItem('ambrig-token', found[1]);
    history.replaceState(null, '', location.pathname + '#/');
  }
  token = sessionStorage.getItem('ambrig-token') ?? '';
  return token !== '';
}

/** What the server said was wrong. */
export class Refused extends Error {
  /** @param {number} status @param {string} text */
  constructor(status, text) {
    super(text);
    this.status = status;
  }
}

/** @param {string} path @param {RequestInit} [options] */
async function request(path, options = {}) {
  const headers = {...(options.headers ?? {}), Authorization: 'Bearer ' + token};
  const answer = await fetch(path, {...options, headers});
  if (answer.ok) return answer;
  let text = answer.statusText;
  try {
    text = (await answer.json()).error ?? text;
  } catch {
    // no JSON: the status says it
  }
  throw new Refused(answer.status, text);
}

/** @param {string} path @returns {Promise<any>} */
export async function getJson(path) {
  return (await request(path)).json();
}

/** @param {string} path @returns {Promise<ArrayBuffer>} */
export async function getBytes(path) {
  return (await request(path)).arrayBuffer();
}

/** @param {string} path @returns {Promise<{text: string, hash: string}>} */
export async function getText(path) {
  const answer = await request(path);
  return {text: await answer.text(), hash: answer.headers.get('ETag') ?? ''};
}

/** @param {string} path @param {object} body @returns {Promise<any>} */
export async function post(path, body = {}) {
  return (await request(path, {method: 'POST', body: JSON.stringify(body)})).json();
}

/** @param {string} path @param {Blob|string} body @param {Record<string, string>} headers @returns {Promise<any>} */
export async function put(path, body, headers = {}) {
  return (await request(path, {method: 'PUT', body, headers})).json();
}

/** @param {string} path @param {Record<string, string>} headers @returns {Promise<any>} */
export async function remove(path, headers = {}) {
  return (await request(path, {method: 'DELETE', headers})).json();
}

/**
 * Listens for ever; after a break it goes on behind the last event, and asks for all anew where that is
 * not possible.
 * @param {(event: any) => void} take @param {() => void} anew
 */
export async function listen(take, anew) {
  let seq = /** @type {number|null} */ (null);
  for (;;) {
    try {
      const answer = await request('/api/events' + (seq === null ? '' : '?after=' + seq));
      const reader = /** @type {ReadableStream<Uint8Array>} */ (answer.body).getReader();
      const decoder = new TextDecoder();
      let rest = '';
      for (;;) {
        const {done, value} = await reader.read();
        if (done) break;
        const lines = (rest + decoder.decode(value, {stream: true})).split('\n');
        rest = lines.pop() ?? '';
        for (const line of lines) {
          const event = JSON.parse(line);
          if (typeof event.seq === 'number') seq = event.seq;
          if (event.event === 'resync') anew();
          else if (event.event !== 'beat' && event.event !== 'hello') take(event);
        }
      }
    } catch (error) {
      if (error instanceof Refused && error.status === 403) return;
    }
    await new Promise((resume) => setTimeout(resume, 1000));
  }
}
