// The tutorial of the hidden effect in the browser alone, from an empty folder to the fallen error, with the time it took; then the next record
// is planned. Not a part of ctest: a person's pace is not tested, the way is.
//
//   node tutorial.mjs AMBRIG SOURCE_FOLDER [SCREENSHOT_FOLDER]
import {rmSync} from 'node:fs';
import {assert, folder, openBrowser, say, seconds, shot, startServer, text} from './harness.mjs';

const server = await startServer();
const {browser, page} = await openBrowser(server.address);
const begin = seconds();
try {
  await page.goto(server.address);
  await page.getByRole('button', {name: 'Example rig and scenarios'}).click();
  await page.getByLabel('hiding').waitFor({timeout: 60000});
  // Another person chose what the rig hides: as in docs/guide/hidden_effect.md.
  await page.getByLabel('hiding').selectOption('cross-coupling');
  await page.getByLabel('seed').fill('5');
  await page.getByRole('button', {name: 'Practice case'}).click();
  await page.locator('table.misfit').first().waitFor({timeout: 300000});
  const before = Number(await page.locator('section.misfit-part strong').first().innerText());
  say(`the model misses by ${before} times the noise`);
  await page.getByRole('button', {name: 'Explain', exact: true}).click();
  const adopt = page.getByRole('button', {name: /^Adopt /});
  await adopt.waitFor({timeout: 3600000});
  const name = await adopt.innerText();
  say(name);
  assert.match(name, /cross-coupling/);
  await adopt.click();
  await page.getByRole('button', {name: 'Write and compare again'}).click();
  const open = page.getByRole('button', {name: /^Open practice\/case_2/});
  await open.waitFor({timeout: 900000});
  await open.click();
  await page.getByRole('heading', {name: 'practice/case_2.toml'}).waitFor();
  await page.locator('table.misfit').first().waitFor({timeout: 300000});
  const after = Number(await page.locator('section.misfit-part strong').first().innerText());
  assert.ok(after < 1.2, `${after}`);
  say(`the error fell from ${before} to ${after} times the noise in ${(seconds() - begin).toFixed(0)} s`);
  assert.match(text('practice.answer.toml'), /cross-coupling/);
  await shot(page, 'tutorial');
} finally {
  await browser.close();
  server.child.removeAllListeners('exit');
  server.child.kill('SIGINT');
  await new Promise((ended) => server.child.on('exit', ended));
  rmSync(folder, {recursive: true});
}
