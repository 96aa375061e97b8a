// A sweep of the playground becomes a campaign; its map fills while it runs; stopped, resumed; a click opens a row's report.
import {assert, check, drawn, say, text} from '../harness.mjs';

export async function campaign(page, address) {
  await page.goto(address);
  await page.getByRole('link', {name: 'healthy.toml', exact: true}).click();
  await page.getByRole('button', {name: 'A3, healthy'}).click();
  await page.getByRole('button', {name: 'Sweep'}).click();
  await page.getByRole('heading', {name: 'sweep.toml'}).waitFor();
  assert.match(text('sweep.toml'), /sets = \[\[3\]\]/);
  await page.getByRole('button', {name: 'Run the campaign'}).click();
  const rows = page.locator('table.rows tbody tr');
  await rows.first().waitFor({timeout: 60000});
  const stop = page.getByRole('button', {name: 'Stop', exact: true});
  if (await stop.isVisible()) await stop.click();
  const again = page.getByRole('button', {name: /^(Resume|Run again)$/});
  await again.waitFor({timeout: 60000});
  const kept = await rows.count();
  say(`the campaign was stopped with ${kept} rows`);
  await again.click();
  await page.locator('main', {hasText: /36 of 36 runs/}).waitFor({timeout: 180000});
  await check(page, 'campaign');
  // A cell filters, a row opens.
  const cell = page.locator('table.map td.cell button').last();
  await cell.click();
  const shown = await rows.count();
  assert.ok(shown > 0 && shown < 36, `${shown} rows of one cell`);
  await page.getByRole('button', {name: /^open row/}).first().click();
  await page.getByRole('region', {name: 'row'}).locator('.events li').first().waitFor({timeout: 60000});
  await drawn(page, 'A: position');
  await check(page, 'campaign-row');
  const [report] = await Promise.all([page.waitForEvent('popup'), page.getByRole('region', {name: 'row'}).getByRole('button', {name: 'Report'}).click()]);
  await report.waitForLoadState();
  assert.match(report.url(), /\/report\//);
}
