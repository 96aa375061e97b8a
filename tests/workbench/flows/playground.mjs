// Coils are broken by a click and by the keyboard; every picture is a real run, beside the healthy one and the one without tolerance.
import {assert, check, drawn, say, text} from '../harness.mjs';

const table = (page) => page.locator('table.beside');

export async function playground(page, address) {
  await page.goto(address);
  await page.getByRole('link', {name: 'healthy.toml', exact: true}).click();
  await page.getByRole('button', {name: 'Run', exact: true}).click();
  await page.locator('.verdict').waitFor({timeout: 60000});
  assert.match(await page.locator('.verdict').innerText(), /stayed up/);
  await page.locator('.stator .orbit').first().waitFor({timeout: 30000});
  await drawn(page, 'A: position');

  const began = Date.now();
  await page.getByRole('button', {name: 'A3, healthy'}).click();
  await page.locator('.events li', {hasText: 'fault A.coil3'}).waitFor({timeout: 30000});
  say(`from the click on a coil to its events: ${Date.now() - began} ms (design: 600)`);
  await page.locator('.orbit.ghost').first().waitFor({timeout: 30000});  // the healthy run beside it
  const second = page.getByRole('button', {name: 'A4, healthy'});
  await second.focus();
  await page.keyboard.press('Enter');
  await page.getByRole('button', {name: 'without fault tolerance'}).click();
  await page.locator('.events li', {hasText: 'fault A.coil4'}).waitFor({timeout: 30000});
  await page.waitForFunction(() => document.querySelectorAll('table.beside thead th').length === 4, null, {timeout: 60000});
  const said = await table(page).innerText();
  assert.match(said, /as chosen\s+healthy\s+without fault tolerance/);
  await page.evaluate(() => scrollTo(0, 0));
  await check(page, 'fault');

  // Every fault of a coil by M; a load and the speed by the keyboard.
  await page.getByRole('button', {name: 'A4, open'}).press('m');
  await page.getByRole('group', {name: 'faults of A4'}).getByRole('button', {name: /partial-short/}).click();
  await page.getByRole('button', {name: 'A4, partial-short'}).waitFor();
  await page.getByLabel('load on A in x [N]').press('ArrowRight');
  await page.getByLabel('speed [rpm]').press('ArrowRight');
  await page.getByText('5 N', {exact: false}).first().waitFor();
  await page.getByText('1600 rpm').waitFor();
  await page.getByRole('status').filter({hasText: 'running'}).waitFor({state: 'detached', timeout: 60000});
  await check(page, 'playground');
  assert.throws(() => text('healthy_2.toml'), 'nothing but .ambrig is written before it is saved');
  await save(page);
}

async function save(page) {
  await page.getByRole('button', {name: 'Make it a test'}).click();
  await page.getByRole('heading', {name: 'healthy_2.toml'}).waitFor();
  const test = text('healthy_2.toml');
  assert.match(test, /\[\[load\]\]\nplane = "A"\nforce = \[5\.0, 0\.0\]/);
  assert.match(test, /target = "A\.coil4"\nkind = "partial-short"/);
  assert.match(test, /\[expect\]\n(.*\n)*touchdown = (true|false)\ndrop = (true|false)\n/);
  // The saved test is met by the run that follows.
  await page.locator('.verdict').waitFor({timeout: 60000});
  await page.locator('tr', {hasText: 'expects drop'}).waitFor({timeout: 30000});
  for (const row of await page.locator('tr', {hasText: /^expects/}).allInnerTexts()) assert.match(row, /\t\u2714/, row);
  await page.getByRole('button', {name: 'Undo'}).click();
  await page.waitForFunction(() => document.querySelector('.notice')?.textContent?.includes('as it was'));
  assert.throws(() => text('healthy_2.toml'), 'undo takes the written scenario back');
}
