/** The screens: each is loaded when it is first opened, so that the page is there at once. */

/**
 * @typedef {{open: (file: string, vs: string) => void|Promise<void>, view: (go: (change: object) => void) => any,
 *            draw?: (go: (change: object) => void) => void, next?: (go: (change: object) => void) => void}} Screen
 *   open: another file is shown; view: the template; draw: after it stands, what is no template; next: the key W
 */

/** @type {Record<string, () => Promise<Screen>>} */
const loaders = {
  case: () => import('./case_screen.js').then((m) => ({open: m.openCase, view: m.caseScreen, draw: m.drawPanels, next: m.nextWorst})),
  run: () => import('./run_screen.js').then((m) => ({open: m.openRun, view: m.runScreen, draw: m.drawRun})),
  campaign: () => import('./campaign_screen.js').then((m) => ({open: m.openCampaign, view: m.campaignScreen, draw: m.drawCampaign})),
  compare: () => import('./compare_screen.js').then((m) => ({open: m.openCompare, view: m.compareScreen, draw: m.drawCompare})),
  record: () => import('./record_screen.js').then((m) => ({open: m.openRecord, view: m.recordScreen, draw: m.drawRecord})),
  trend: () => import('./trend_screen.js').then((m) => ({open: m.openTrend, view: m.trendScreen})),
  new: () => import('./wizard_screen.js').then((m) => ({open: (file) => m.openWizard(file === '-' ? '' : file), view: m.wizardScreen})),
  rig: () => import('./rig_screen.js').then((m) => ({open: m.openRig, view: m.rigScreen})),
  file: () => import('./file_screen.js').then((m) => ({open: m.openFile, view: m.fileScreen})),
};

/** @type {Map<string, Screen>} */
const loaded = new Map();

/** The screen where it was loaded; null else, and where there is none of this name. @param {string} name */
export function screenNow(name) {
  return loaded.get(name) ?? null;
}

/** @param {string} name @returns {Promise<Screen|null>} null: no screen of this name */
export async function screenOf(name) {
  const known = loaded.get(name);
  if (known || !loaders[name]) return known ?? null;
  const screen = await loaders[name]();
  loaded.set(name, screen);
  return screen;
}
