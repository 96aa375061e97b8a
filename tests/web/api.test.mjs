import assert from 'node:assert/strict';
import test from 'node:test';
import {answered, server, settled} from './page.mjs';
const {Refused, getJson, getText, listen, post, put, remove, takeToken} = await import('../../web/workbench/api.js');

test('the token of the address is kept by the tab and leaves the address', async () => {
  assert.equal(takeToken(), false);
  location.hash = '#token=0123abcd';
  assert.equal(takeToken(), true);
  assert.equal(location.hash, '#/');
  assert.equal(takeToken(), true);
  await getJson('/api/folder');
  assert.equal(server.asked.at(-1).headers.Authorization, 'Bearer 0123abcd');
});

test('a request says method, body and its own headers', async () => {
  server.asked = [];
  await post('/api/jobs', {command: 'run'});
  await put('/api/file?p=a.toml', 'x = 1', {'If-Match': '"5"'});
  await remove('/api/jobs/3');
  const [posted, stored, removed] = server.asked;
  assert.deepEqual([posted.method, posted.body], ['POST', '{"command":"run"}']);
  assert.deepEqual([stored.method, stored.body, stored.headers['If-Match']], ['PUT', 'x = 1', '"5"']);
  assert.equal(stored.headers.Authorization, 'Bearer 0123abcd');
  assert.deepEqual([removed.method, removed.path], ['DELETE', '/api/jobs/3']);
});

test('a text comes with its hash', async () => {
  server.answer = () => answered('name = "a"', {headers: {ETag: '"77"'}});
  assert.deepEqual(await getText('/api/file?p=a.toml'), {text: 'name = "a"', hash: '"77"'});
});

test('what the server refuses is told in its own words, or by its status', async () => {
  server.answer = () => answered({error: 'rig.toml, line 3: no key "mas"'}, {status: 400});
  await assert.rejects(getJson('/api/x'), (e) => e instanceof Refused && e.status === 400 && e.message === 'rig.toml, line 3: no key "mas"');
  server.answer = () => new Response('not JSON', {status: 502, statusText: 'Bad Gateway'});
  await assert.rejects(getJson('/api/x'), (e) => e.status === 502 && e.message === 'Bad Gateway');
});

/** A stream that ends after these pieces, whatever lines they cut through. */
function streamOf(pieces) {
  return new ReadableStream({
    start(to) {
      for (const p of pieces) to.enqueue(new TextEncoder().encode(p));
      to.close();
    },
  });
}

test('events are whole lines; after a break the page asks for those behind the last one', async () => {
  const streams = [
    streamOf(['{"event":"hello","seq":4}\n{"event":"jo', 'b","seq":5,"job":{"id":1}}\n{"event":"beat"}\n', '{"event":"cut off']),
    streamOf(['{"event":"resync","seq":9}\n']),
  ];
  const asked = [], taken = [];
  let anew = 0;
  server.answer = (path) => {
    asked.push(path);
    return streams.length > 0 ? answered(streams.shift()) : answered({error: 'no key'}, {status: 403});
  };
  const wait = globalThis.setTimeout;
  globalThis.setTimeout = (f, ms, ...rest) => wait(f, ms >= 1000 ? 0 : ms, ...rest);  // the pause before it asks again
  await listen((event) => taken.push(event), () => ++anew);  // ends at 403: the key is not the server's
  globalThis.setTimeout = wait;
  await settled();
  assert.deepEqual(asked, ['/api/events', '/api/events?after=5', '/api/events?after=9']);
  assert.deepEqual(taken, [{event: 'job', seq: 5, job: {id: 1}}]);
  assert.equal(anew, 1);
});
