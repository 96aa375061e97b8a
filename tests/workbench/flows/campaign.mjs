// A sweep of the playground becomes a campaign; its map fills while it runs; stopped, resumed; a click opens a row's report.
import {readdirSync, readFileSync} from 'node:fs';
import {assert, check, drawn, inFolder, say, text, write} from '../harness.mjs';

/** Number of the newest campaign job. */
function lastJob() {
  const all = readdirSync(inFolder('.ambrig/jobs')).map(Number).sort((a, b) => b - a);
  return all.find((n) => JSON.parse(readFileSync(inFolder(`.ambrig/jobs/${n}/job.json`), 'utf8')).command === 'campaign');
}

export async function campaign(page, address) {
  await page.goto(address);
  await page.getByRole('link', {name: 'healthy.toml', exact: true}).click();
  await page.getByRole('button', {name: 'A3, healthy'}).click();
  await page.getByRole('button', {name: 'Sweep'}).click();
  await page.getByRole('heading', {name: 'sweep.toml'}).waitFor();
  assert.match(text('sweep.toml'), /sets = \[\[3\]\]/);
  write('sweep.toml', text('sweep.toml').replace('seeds = 2', 'seeds = 40'));  // long enough to be stopped on any machine
  await page.getByRole('button', {name: 'Run the campaign'}).click();
  const rows = page.locator('table.rows tbody tr');
  await rows.first().waitFor({timeout: 60000});
  const stop = page.getByRole('button', {name: 'Stop', exact: true});
  await stop.click();
  const again = page.getByRole('button', {name: 'Resume'});
  await again.waitFor({timeout: 60000});
  const kept = Number(/(\d+) of 720 runs/.exec(await page.locator('main').innerText())[1]);
  say(`the campaign was stopped with ${kept} rows`);
  assert.ok(kept < 720);
  await again.click();
  await page.locator('main', {hasText: /720 of 720 runs/}).waitFor({timeout: 180000});
  await page.getByRole('button', {name: 'Run again'}).waitFor({timeout: 60000});  // the rows are here before the job has ended
  assert.match(readFileSync(inFolder(`.ambrig/jobs/${lastJob()}/log.txt`), 'utf8'), /resumed, \d+ runs? done before/);
  await check(page, 'campaign');
  // A cell filters, a row opens.
  const cell = page.locator('table.map td.cell button').last();
  await cell.click();
  const shown = await rows.count();
  assert.ok(shown > 0 && shown < 720, `${shown} rows of one cell`);
  await page.getByRole('button', {name: /^open row/}).first().click();
  await page.getByRole('region', {name: 'row'}).locator('.events li').first().waitFor({timeout: 60000});
  await drawn(page, 'A: position');
  await check(page, 'campaign-row');
  const [report] = await Promise.all([page.waitForEvent('popup'), page.getByRole('region', {name: 'row'}).getByRole('button', {name: 'Report'}).click()]);
  await report.waitForLoadState();
  assert.match(report.url(), /\/report\//);
}
