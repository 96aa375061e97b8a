// By the keyboard alone, in the dark, on a tablet with fingers.
import {assert, check, drawn, forgive, say} from '../harness.mjs';

/** A run to look at, where there is none yet. */
async function runOnce(page) {
  const run = page.getByRole('button', {name: /^Run( again)?$/});
  await run.waitFor();
  if ((await run.innerText()) === 'Run') await run.click();
}

/** Finds, opens, runs and breaks without a mouse; every stop of Tab is seen. */
export async function keyboardOnly(page, address) {
  await page.goto(address);
  await page.locator('table.scenarios').waitFor();
  await page.keyboard.press('?');
  await page.getByRole('dialog', {name: 'keys'}).waitFor();
  await check(page, 'keys');
  await page.keyboard.press('Escape');
  await page.keyboard.press('Control+k');
  await page.getByRole('dialog', {name: 'find'}).waitFor();
  await page.waitForFunction(() => document.activeElement?.tagName === 'INPUT');
  await page.keyboard.type('healthy');
  await page.keyboard.press('Enter');
  await page.getByRole('heading', {name: 'healthy.toml'}).waitFor();
  await tabTo(page, /^Run( again)?$/);
  await page.keyboard.press('Enter');
  await page.locator('.verdict').waitFor({timeout: 60000});
  await drawn(page, 'A: position');
  await tabTo(page, /^A: position/);
  for (const key of ['+', 'ArrowRight', 'a', 'Alt+ArrowRight', 'b', '0']) await page.keyboard.press(key);
  await page.waitForFunction(() => /s: x -?[\d.e-]+, y/.test(document.querySelector('#said')?.textContent ?? ''));
  await page.waitForURL(/A=.*B=/);
  await tabTo(page, /^A3, healthy$/);
  await page.keyboard.press('Space');
  await page.locator('.events li', {hasText: 'fault A.coil3'}).waitFor({timeout: 60000});
  await tabTo(page, /^Clear$/);
  await page.keyboard.press('Enter');
  say('found, run, zoomed and broken by keys alone');
}

/** Presses Tab until the focus is on a thing of this name; each stop must be visible. */
async function tabTo(page, name) {
  for (let k = 0; k < 150; ++k) {
    await page.keyboard.press('Tab');
    const at = await page.evaluate(() => {
      const e = document.activeElement;
      const style = e ? getComputedStyle(e) : null;
      return {name: e?.getAttribute('aria-label') ?? e?.textContent?.trim() ?? '', seen: style ? style.outlineStyle !== 'none' || style.strokeWidth !== '1px' || ['INPUT', 'SELECT'].includes(e.tagName) : false};
    });
    if (name.test(at.name)) {
      assert.ok(at.seen, `the focus on ${at.name} is visible`);
      return;
    }
  }
  assert.fail(`no way to ${name} by Tab`);
}

export async function dark(page, address) {
  await page.goto(address);
  await page.getByRole('link', {name: 'healthy.toml', exact: true}).click();
  await runOnce(page);
  await drawn(page, 'A: position');
  await check(page, 'dark');
  await page.getByRole('button', {name: 'light or dark'}).click();
  const paper = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  assert.equal(paper, 'rgb(255, 255, 255)');
  // The panels follow, too: dark ink on light paper.
  await page.waitForFunction(() => {
    const c = document.querySelector('.panel canvas');
    const pixels = c?.getContext('2d').getImageData(0, 0, c.width, c.height).data ?? [];
    let ink = 0;
    for (let k = 0; k < pixels.length; k += 4) if (pixels[k + 3] > 200 && Math.max(pixels[k], pixels[k + 1], pixels[k + 2]) < 80) ++ink;
    return ink > 300;
  }, null, {timeout: 10000});
}
dark.options = {colorScheme: 'dark'};

/** One finger pans, two zoom, a long press sets B; nothing is wider than the screen. */
export async function tablet(page, address) {
  await page.goto(address);
  await page.getByRole('link', {name: 'healthy.toml', exact: true}).tap();
  await runOnce(page);
  await drawn(page, 'A: position');
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  assert.ok(wide <= 0, `the page is ${wide} px wider than the screen`);
  await check(page, 'tablet');
  const box = await page.locator('.panel .u-over').first().boundingBox();
  const fingers = await page.context().newCDPSession(page);
  const at = (shares) => shares.map((s, id) => ({x: box.x + s * box.width, y: box.y + 40, id}));
  const send = (type, shares) => fingers.send('Input.dispatchTouchEvent', {type, touchPoints: at(shares)});
  await send('touchStart', [0.4, 0.6]);
  await send('touchMove', [0.3, 0.7]);
  await send('touchMove', [0.2, 0.8]);
  await send('touchEnd', []);
  await page.waitForURL(/t=[\d.]+,[\d.]+/);
  await page.waitForTimeout(400);  // the last move of the fingers
  // What lay between the fingers, 0.4 to 0.6 of 0.15 s, now fills 0.2 to 0.8 of the width.
  const zoom = /t=([\d.]+),([\d.]+)/.exec(page.url()).slice(1).map(Number);
  assert.ok(Math.abs(zoom[1] - zoom[0] - 0.05) < 0.004, `pinched to ${zoom}`);
  await send('touchStart', [0.6]);
  await send('touchMove', [0.5]);
  await send('touchMove', [0.4]);
  await send('touchEnd', []);
  await page.waitForFunction((before) => !location.hash.includes(before), `t=${zoom[0]}`);
  await page.waitForTimeout(400);  // the last move of the finger
  const panned = /t=([\d.]+),([\d.]+)/.exec(page.url()).slice(1).map(Number);
  assert.ok(Math.abs(panned[0] - zoom[0] - 0.01) < 0.002, `panned from ${zoom} to ${panned}`);
  await send('touchStart', [0.5]);
  await page.waitForTimeout(700);
  await send('touchEnd', []);
  await page.waitForURL(/B=[\d.]+/);
}
tablet.options = {viewport: {width: 820, height: 1180}, hasTouch: true, isMobile: false};

/** Every kind of screen by its address. */
const addresses = ['', 'case/ball/case.toml', 'case/practice/case.toml', 'run/healthy.toml', 'campaign/sweep.toml', 'compare/healthy.toml?vs=opens.toml',
                   'compare/rig.toml?vs=spoiled%2Fcase-0001%2Frig.toml', 'record/ball/data/inductance_em1_05.csv?c=i1_A', 'trend/ball/known.toml', 'new/-', 'rig/rig.toml',
                   'file/bad.toml', 'case/no/such.toml'];

/** Every screen at three widths, light and dark: nothing is wider than the window, nothing serious is found, what is not there is said. */
export async function everyScreen(page, address) {
  await page.goto(address);
  await page.locator('table.scenarios').waitFor();
  for (const at of addresses) {
    await page.evaluate((hash) => (location.hash = '#/' + hash), at);
    await page.locator('main h1').first().waitFor({timeout: 30000});
    await page.locator('.running, [aria-busy="true"]').first().waitFor({state: 'detached', timeout: 60000});
    await page.waitForTimeout(300);  // what comes with the first answers
    for (const [colorScheme, width, height] of [['light', 1280, 800], ['dark', 1024, 768]]) {
      await page.emulateMedia({colorScheme});
      await page.setViewportSize({width, height});
      await page.waitForTimeout(100);
      const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      const name = `screens/${at.replaceAll(/[^a-z]+/gi, '-') || 'folder'}-${width}-${colorScheme}`;
      assert.ok(over <= 0, `${name} is ${over} px wider than the window`);
      await check(page, name);
    }
  }
  assert.match(await page.locator('[role="alert"]').innerText(), /no\/such\.toml/);
  forgive(/status of 400/);  // the browser's word for the file that is not there
}
