// A logger's folder is watched: a record of the rig as it was, one of a rig whose coil became warm; the trend says what changed.
import {copyFileSync, mkdirSync, renameSync, utimesSync} from 'node:fs';
import {assert, check, command, inFolder, say, text, write} from '../harness.mjs';

/** A simulated record of the ball's rig, ten seconds old. */
function record(name, rig, seed) {
  write('ball/now.toml', `seed = ${seed}\n` + text('ball/steps-05.toml').replace('"rig.toml"', `"${rig}"`));
  command('run', 'ball/now.toml', '--no-report', '--quiet', '--out', 'made');
  mkdirSync(inFolder('ball/logger'), {recursive: true});
  copyFileSync(inFolder('made/now.h5'), inFolder('ball/logger/.part'));
  const old = Date.now() / 1000 - 10;
  utimesSync(inFolder('ball/logger/.part'), old, old);
  renameSync(inFolder('ball/logger/.part'), inFolder('ball/logger/' + name));
}

export async function watched(page, address) {
  command('run', 'ball/steps-05.toml', '--no-report', '--quiet', '--out', 'known');
  write('ball/known.toml', 'rig = "rig.toml"\nnoise = { "M.i1" = 0.0065 }\n[[record]]\nscenario = "steps-05.toml"\ndata = "../known/steps-05.h5"\nchannels = { "M.fx" = { column = "M.fx", use = false } }\n');
  write('ball/warm.toml', text('ball/rig.toml').replace('{ value = 4.17, sd = 0.05 }', '{ value = 4.17, sd = 0.05, fitted = 4.6 }'));
  record('steps-05-april.h5', 'rig.toml', 2);
  await page.goto(address);
  await page.getByRole('link', {name: 'ball/known.toml', exact: true}).click();
  await page.locator('table.misfit').first().waitFor({timeout: 180000});
  const part = page.getByRole('region', {name: 'watch'});
  await part.getByLabel('Folder of the logger').selectOption('ball/logger');
  await part.getByRole('button', {name: 'Watch'}).click();
  await part.getByText('1 records examined').waitFor({timeout: 180000});
  assert.match(await part.innerText(), /all within their bands/);
  say('the first record was examined');
  await part.getByRole('link', {name: 'Trend of the records'}).click();
  record('steps-05-june.h5', 'warm.toml', 3);
  const alarm = page.locator('.alarms li', {hasText: 'steps-05-june.h5'});
  await alarm.waitFor({timeout: 120000});
  assert.match(await alarm.innerText(), /bearings\.M\.resistance = 4\.\d+ ohm, was 4\.17 ohm/);
  await alarm.filter({hasText: 'explained by'}).waitFor();
  await page.locator('figure.trend', {hasText: 'bearings.M.resistance'}).filter({hasText: 'left its band'}).waitFor();
  await check(page, 'trend');
  await alarm.getByRole('button', {name: 'Add it to the case'}).click();
  await page.locator('table.misfit th', {hasText: 'steps-05-june'}).first().waitFor({timeout: 180000});
  await page.getByRole('button', {name: 'Undo'}).click();
  await page.waitForFunction(() => document.querySelector('.notice')?.textContent?.includes('as it was'));
  assert.doesNotMatch(text('ball/known.toml'), /june/);
  await page.goto(address);
  await page.getByRole('link', {name: '! 1 of 2 records'}).waitFor();
}
