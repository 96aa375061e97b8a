// A bench of one's own from a dropped record, and a measured rig with what is missing from it.
import {readFileSync} from 'node:fs';
import {assert, check, drawn, inFolder, say, text} from '../harness.mjs';

/** The ten numbers of the ball and magnet (examples/new/ball.toml). */
const numbers = {mass: 0.0605, gap: 0.010, resistance: 4.17, inductance_far: 0.11, inductance_near: 0.045, gap_constant: 0.008, bus_voltage: 11.1, i_max: 3.0, switching_frequency: 2000, controller_rate: 1000};

export async function wizard(page, address) {
  await page.goto(address);
  await page.getByRole('link', {name: 'A bench of your own'}).waitFor();
  const data = await page.evaluateHandle((content) => {
    const t = new DataTransfer();
    t.items.add(new File([content], 'steps.csv', {type: 'text/csv'}));
    return t;
  }, readFileSync(inFolder('ball/data/inductance_em1_05.csv'), 'utf8'));
  await page.dispatchEvent('main', 'drop', {dataTransfer: data});
  await page.getByRole('heading', {name: 'A bench of your own'}).waitFor();
  await page.getByLabel('Kind of bench').selectOption('one-axis');
  await page.locator('tr', {hasText: 'i1_A'}).waitFor({timeout: 30000});
  const make = page.getByRole('button', {name: 'Write rig, scenario and case'});
  assert.ok(await make.isDisabled());
  await page.getByLabel('mass', {exact: true}).fill('-1');
  await page.locator('.bad', {hasText: 'allowed:'}).waitFor();
  for (const [key, value] of Object.entries(numbers)) await page.getByLabel(key.replaceAll('_', ' '), {exact: true}).fill(String(value));
  await check(page, 'wizard');
  await make.click();
  await page.getByRole('heading', {name: 'steps/case.toml'}).waitFor({timeout: 30000});
  await page.locator('table.misfit').first().waitFor({timeout: 180000});
  assert.match(text('steps/case.toml'), /data = "\.\.\/steps\.csv"/);
  assert.match(text('steps/rig.toml'), /resistance/);
}

/** The measured ball: the freewheel diode that the plain model lacks is found, adopted, and the error falls. */
export async function measuredRig(page, address) {
  await page.goto(address);
  await page.getByRole('link', {name: 'ball/case.toml', exact: true}).click();
  await page.locator('table.misfit').first().waitFor({timeout: 180000});
  await drawn(page, 'M.i1');
  await page.getByRole('button', {name: 'Explain', exact: true}).click();
  const adopt = page.getByRole('button', {name: 'Adopt freewheel-drop at', exact: false});
  await adopt.waitFor({timeout: 900000});
  await check(page, 'measured-rig');
  await adopt.click();
  await page.getByRole('button', {name: 'Write and compare again'}).click();
  await page.getByRole('button', {name: 'Open ball/case_2.toml'}).waitFor({timeout: 120000});
  const ratios = (await page.locator('section.adopt table.steps tbody tr').allInnerTexts()).map((row) => Number(row.split('\t').at(-1)));
  say(`the measured rig's ladder: ${ratios.join(' -> ')}`);
  assert.ok(ratios[0] > 7 && ratios.at(-1) < 3, `${ratios}`);
}
