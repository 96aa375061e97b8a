// One case: where the model fails, data faults, explain, adopt, the ladder and the way back, the next record.
import {readFileSync, writeFileSync} from 'node:fs';
import {assert, check, command, drawn, inFolder, say, shot, text} from '../harness.mjs';

export async function mainFlow(page, address) {
  await page.goto(address);
  const link = page.getByRole('link', {name: 'practice/case.toml'});
  await link.waitFor();
  assert.ok(!page.url().includes('token'), 'the key stays out of the address');
  await check(page, 'folder');

  await link.click();
  const table = page.locator('table.misfit').first();
  await table.waitFor({timeout: 180000});
  await page.locator('.panel canvas').nth(1).waitFor({timeout: 30000});
  const worst = await page.locator('td.cell button[aria-pressed="true"]').getAttribute('aria-label');
  say(`worst cell: ${worst}`);
  assert.match(worst, /A\./);  // the hidden effect acts at A
  const [record, channel] = worst.split(':')[0].split(', ');
  await drawn(page, `${channel}: error over noise`);
  await page.getByRole('img', {name: /by frequency/}).waitFor();
  await page.getByRole('img', {name: /by the value of/}).waitFor();
  await check(page, 'misfit');
  await zoomAndBack(page, worst, record, channel);
  await explainWithStop(page);
  await adoptAndGoBack(page);

  // A closed page loses nothing.
  await page.goto(address);
  await page.reload();
  await page.getByRole('link', {name: 'practice/case_2.toml'}).waitFor();
  assert.match(await page.locator('table.cases').innerText(), /cross-coupling at A/);
}

/** A place in an element, at this share of its width. */
async function within(locator, share) {
  return {x: (await locator.boundingBox()).width * share, y: 35};
}

/** Another cell, then the address is the view; a drag zooms every panel; W goes down the worst cells. */
async function zoomAndBack(page, worst, record, channel) {
  const other = page.locator('td.cell button[aria-pressed="false"]').first();
  const name = await other.getAttribute('aria-label');
  await other.click();
  await page.locator(`td.cell button[aria-pressed="true"][aria-label="${name}"]`).waitFor();
  assert.match(page.url(), /r=record-/);
  await page.goBack();
  await page.locator(`td.cell button[aria-pressed="true"][aria-label="${worst}"]`).waitFor();
  await page.locator(`[aria-busy="false"] > .panel[aria-label^="${channel} ["][aria-label*="${record}"]`).waitFor();
  // A hover scrolls to the panel and waits until it stands still: the views below are still being laid out.
  const plot = page.locator('.panel .u-over').first();
  await plot.hover({position: await within(plot, 0.3)});
  await page.mouse.down();
  await plot.hover({position: await within(plot, 0.6)});
  await page.mouse.up();
  await page.waitForURL(/t=0\.\d+,0\.\d+/);
  // 0.3 to 0.6 of the record's 0.35 s, to a pixel.
  const [from, to] = /t=([\d.]+),([\d.]+)/.exec(page.url()).slice(1).map(Number);
  assert.ok(Math.abs(from - 0.105) < 0.003 && Math.abs(to - 0.21) < 0.003, `the zoom shows what was dragged: ${from} to ${to}`);
  // Two cursors by keys: the address has them, the text says what lies between.
  await page.locator('.panel').first().focus();
  await page.keyboard.press('a');
  for (let k = 0; k < 3; ++k) await page.keyboard.press('ArrowRight');
  await page.keyboard.press('b');
  await page.waitForURL(/A=[\d.]+&B=[\d.]+/);
  // A mean and an rms are told of samples only, which arrive after the zoom.
  await page.locator('.marks').filter({hasText: /dt .*rms/s}).waitFor();
  const zoomed = page.url();
  await page.reload();
  await drawn(page, `${channel}: error over noise`);
  assert.equal(page.url(), zoomed);
  await page.locator('body').press('w');
  await page.locator(`td.cell button[aria-pressed="true"]:not([aria-label="${worst}"])`).waitFor();
  await page.goBack();
}

async function explainWithStop(page) {
  await page.getByRole('button', {name: 'Explain', exact: true}).click();
  await page.locator('.stages .now').waitFor();
  await page.waitForFunction(() => Number(document.querySelector('section.explain progress')?.value) >= 2, null, {timeout: 180000});
  await shot(page, 'explain-running');
  say('explain runs and shows its progress');
  // Stop keeps what is there; explaining goes on from it.
  await page.locator('section.explain').getByRole('button', {name: 'Stop', exact: true}).click();
  const resume = page.getByRole('button', {name: 'Resume explain'});
  await resume.waitFor({timeout: 15000});
  say('explain stopped');
  await resume.click();
  const adopt = page.getByRole('button', {name: 'Adopt cross-coupling at A'});
  await adopt.waitFor({timeout: 1200000});
  say('explain names cross-coupling at A');
  assert.match(await page.locator('.names').innerText(), /cross-coupling at A/);
  assert.match(await page.locator('section.explain').innerText(), /of the error above the noise is explained/);
  await check(page, 'explain');
}

async function adoptAndGoBack(page) {
  await page.getByRole('button', {name: 'Adopt cross-coupling at A'}).click();
  await page.getByRole('button', {name: 'Write and compare again'}).click();
  const open = page.getByRole('button', {name: 'Open practice/case_2.toml'});
  await open.waitFor({timeout: 180000});
  const steps = await page.locator('section.adopt table.steps tbody tr').allInnerTexts();
  const ratios = steps.map((row) => Number(row.split('\t').at(-1)));
  say(`the ladder: ${ratios.join(' -> ')}`);
  assert.ok(ratios[0] > 2 && ratios.at(-1) < 1.2, `the error fell: ${ratios}`);
  assert.match(text('practice/rig_2.toml'), /cross-coupling/);
  await check(page, 'ladder');

  await open.click();
  await page.getByRole('heading', {name: 'practice/case_2.toml'}).waitFor();
  await page.locator('table.misfit').first().waitFor({timeout: 180000});
  const after = await page.locator('section.misfit-part strong').first().innerText();
  assert.ok(Number(after) < 1.2, `the new case is explained: ${after}`);
  await check(page, 'adopted');
  // Every step is kept: what differs, and the way back.
  const history = page.locator('section.history');
  assert.match(await history.innerText(), /first case.*practice\/case\.toml/s);
  await history.getByRole('link', {name: 'what differs'}).click();
  await page.locator('tbody tr', {hasText: 'cross-coupling'}).first().waitFor({timeout: 30000});
  await page.goBack();
  await page.getByRole('button', {name: 'Take this step back'}).click();
  await page.getByRole('heading', {name: 'practice/case.toml'}).waitFor();
  await page.waitForFunction(() => document.querySelector('.notice')?.textContent?.includes('taken away'));
  assert.throws(() => text('practice/case_2.toml'));
  await page.getByRole('button', {name: 'Undo'}).click();
  await page.waitForFunction(() => document.querySelector('.notice')?.textContent?.includes('as they were'));
  assert.match(text('practice/case_2.toml'), /rig_2/);
  assert.match(text('practice/rig_2.toml'), /cross-coupling/);
  say('a step was taken back, and the undo brought its case again');
}

/** A record whose unit is wrong: named, mended by a click, and taken back. */
export async function mendData(page, address) {
  await page.goto(address);
  await page.getByRole('link', {name: 'spoiled/case-0003/case.toml'}).click();
  const fault = page.locator('.faults li').first();
  await fault.waitFor({timeout: 120000});
  assert.match(await fault.innerText(), /A\.i1: unit/);
  await check(page, 'data-fault');
  await page.getByRole('button', {name: 'Write this line into the case'}).click();
  await page.locator('.faults').waitFor({state: 'detached', timeout: 120000});
  const file = 'spoiled/case-0003/case.toml';
  assert.match(text(file), /channels\."A\.i1" = \{ column = "A\.i1", unit = "A", gain = 2 \}/);
  await page.getByRole('button', {name: 'Undo'}).click();
  await page.locator('.faults li').first().waitFor({timeout: 120000});
  assert.doesNotMatch(text(file), /gain = 2/);
  say('a wrong unit was mended and the mend undone');
}

/** A file dropped on the page. */
async function drop(page, name, content) {
  const data = await page.evaluateHandle(([n, text]) => {
    const t = new DataTransfer();
    t.items.add(new File([text], n, {type: 'text/csv'}));
    return t;
  }, [name, content]);
  await page.dispatchEvent('main', 'drop', {dataTransfer: data});
}

/** The next record is planned, its scenario taken away, its record made and dropped: the case goes on with it. */
export async function planned(page, address) {
  await page.goto(address);
  await page.getByRole('link', {name: 'practice/case.toml'}).click();
  await page.locator('table.misfit').first().waitFor({timeout: 180000});
  const before = text('practice/case.toml');
  const part = page.getByRole('region', {name: 'next record'});
  await part.getByRole('button', {name: 'Plan the next record'}).click();
  const away = part.getByRole('button', {name: /^Take practice\/next_record/});
  await away.waitFor({timeout: 1200000});
  say(`planned: ${(await part.locator('.verdict').innerText()).trim()}`);
  assert.match(await part.innerText(), /largest orbit [\d.]+ [\u00b5n]?m/);
  await check(page, 'plan');
  const [file] = await Promise.all([page.waitForEvent('download'), away.click()]);
  assert.match(file.suggestedFilename(), /^next_record.*\.toml$/);
  // The bench makes it: here the rig with what it hides.
  const scenario = /Take (\S+) away/.exec(await away.innerText())[1];
  command('run', scenario, '--csv', '--no-report', '--quiet', '--out', 'bench');
  await drop(page, 'planned.csv', readFileSync(inFolder(`bench/${scenario.split('/').at(-1).replace('.toml', '.csv')}`), 'utf8'));
  const form = page.getByRole('region', {name: 'new record'});
  await form.waitFor({timeout: 60000});
  assert.equal(await form.getByLabel('It was made by the scenario').inputValue(), scenario);
  await form.getByRole('button', {name: 'Append to practice/case.toml'}).click();
  await page.locator('table.misfit th', {hasText: 'planned'}).first().waitFor({timeout: 180000});
  await page.getByRole('button', {name: 'Undo'}).click();
  await page.waitForFunction(() => document.querySelector('.notice')?.textContent?.includes('as it was'));
  assert.equal(text('practice/case.toml'), before);
  say('a record was planned, made, dropped and appended');
}

/** A dropped record: offered to the case with its columns, appended, compared; undone. */
export async function nextRecord(page, address) {
  await page.goto(address);
  await page.getByRole('link', {name: 'practice/case.toml'}).click();
  await page.locator('table.misfit').first().waitFor({timeout: 180000});
  // Another record of the same rig, with columns of other names: what a logger on the bench would write.
  command('run', 'practice/record-1.toml', '--csv', '--no-report', '--quiet', '--out', 'bench');
  const csv = readFileSync(inFolder('bench/record-1.csv'), 'utf8');
  const [head, ...rows] = csv.split('\n');
  const columns = head.split(',').map((c) => c.replace(/^A\.x/, 'pos_ax').replace(/^A\.y/, 'pos_ay'));
  writeFileSync(inFolder('bench/log.csv'), [columns.join(','), ...rows].join('\n'));
  const before = text('practice/case.toml');
  await drop(page, 'new-log.csv', readFileSync(inFolder('bench/log.csv'), 'utf8'));
  const form = page.getByRole('region', {name: 'new record'});
  await form.waitFor({timeout: 30000});
  assert.equal(await form.getByLabel('column of A.x').inputValue(), 'pos_ax');  // guessed
  await form.getByLabel('It was made by the scenario').selectOption('practice/record-1.toml');
  await check(page, 'new-record');
  await form.getByRole('button', {name: 'Append to practice/case.toml'}).click();
  await page.locator('table.misfit th', {hasText: 'new-log'}).first().waitFor({timeout: 180000});
  assert.ok(text('practice/case.toml').startsWith(before.trimEnd()), 'text is appended only');
  assert.match(text('practice/case.toml'), /data = "new-log\.csv"\nuse = "fit"\n\[record\.channels\]\n"A\.x" = \{ column = "pos_ax" \}/);
  await page.getByRole('button', {name: 'Undo'}).click();
  await page.waitForFunction(() => document.querySelector('.notice')?.textContent?.includes('as it was'));
  assert.equal(text('practice/case.toml'), before);
  say('a dropped record became one of the case, and the undo took it away');
}
