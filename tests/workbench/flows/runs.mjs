// The list of scenarios with their results; a wrong one with its line; two runs and only what differs.
import {assert, check, drawn, say, text, write} from '../harness.mjs';

export async function scenarioList(page, address) {
  await page.goto(address);
  await page.getByRole('button', {name: 'run opens.toml'}).click();
  const row = page.locator('table.scenarios tr', {hasText: 'opens.toml'});
  await row.filter({hasText: '\u2714 up'}).waitFor({timeout: 60000});
  assert.match(await row.innerText(), /\u00b5s|ms/);  // detected after
  // A scenario that is wrong: the command's line, with the lines around it.
  await page.getByRole('link', {name: 'bad.toml', exact: true}).click();
  await page.getByRole('button', {name: 'Run', exact: true}).click();
  const lines = page.locator('.lines .is').first();
  await lines.waitFor({timeout: 30000});
  assert.match(await lines.innerText(), /3 {2}duration = -1/);
  assert.match(await page.locator('[role="alert"]').first().innerText(), /bad\.toml:3: duration/);
  await check(page, 'error');
  // A long run is stopped.
  write('long.toml', text('healthy.toml').replace('0.15', '60'));
  await page.goto(address);
  await page.reload();
  await page.getByRole('link', {name: 'long.toml', exact: true}).click();
  await page.getByRole('button', {name: 'Run', exact: true}).click();
  await page.getByRole('button', {name: 'Stop', exact: true}).click();
  const began = Date.now();
  await page.waitForFunction(() => document.querySelector('.notice')?.textContent?.includes('run stopped'), null, {timeout: 15000});
  say(`a stopped run was gone after ${Date.now() - began} ms (design: 2000)`);
}

export async function compareRuns(page, address) {
  await page.goto(address);
  for (const name of ['healthy.toml', 'opens.toml']) {
    const run = page.getByRole('button', {name: `run ${name}`});
    await run.click();
    await page.locator('table.scenarios tr', {hasText: name}).filter({hasText: '\u2714 up'}).waitFor({timeout: 60000});
    await page.getByLabel(`compare ${name}`).check();
  }
  await page.getByRole('link', {name: 'Compare healthy.toml and opens.toml'}).click();
  await drawn(page, 'A: position');
  await page.locator('table tr', {hasText: 'A.i3'}).waitFor({timeout: 60000});
  const said = await page.locator('main').innerText();
  assert.match(said, /largest orbit A/);
  assert.doesNotMatch(said, /expects/);
  await check(page, 'compare');
  const address1 = page.url();
  await page.locator('body').press(']');
  await page.waitForURL(/shift=0\.001/);
  await page.goBack();
  assert.equal(page.url(), address1);
  // What was exported is every sample in view.
  const [file] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', {name: /^CSV/}).click()]);
  const stream = await file.createReadStream();
  let csv = '';
  for await (const part of stream) csv += part;
  assert.equal(csv.trim().split('\n').length, 1 + 1875);  // 0.15 s at 12.5 kHz
  for (const kind of ['PNG', 'SVG']) {
    const [picture] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', {name: kind, exact: true}).click()]);
    assert.match(picture.suggestedFilename(), new RegExp(`\\.${kind.toLowerCase()}$`));
  }
}
