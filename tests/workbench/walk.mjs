// Walks through the workbench as a person would: a labelled case with a hidden effect, a measured rig, runs, a campaign, a logger's folder.
// Fails on a console error, a violation of the content security policy, a request to elsewhere or a serious finding of axe-core.
//
//   node walk.mjs AMBRIG SOURCE_FOLDER [SCREENSHOT_FOLDER]
//
// AMBRIG_PAGE=1: the page's files are those of SOURCE_FOLDER/web/workbench. AMBRIG_FLOW=playground,watched: only these.
import {cpSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {campaign} from './flows/campaign.mjs';
import {mainFlow, mendData, nextRecord, planned} from './flows/case.mjs';
import {dark, everyScreen, keyboardOnly, tablet} from './flows/manners.mjs';
import {playground} from './flows/playground.mjs';
import {compareRuns, scenarioList} from './flows/runs.mjs';
import {watched} from './flows/watched.mjs';
import {measuredRig, wizard} from './flows/wizard.mjs';
import {command, inFolder, keepRecords, source, text, walk, write} from './harness.mjs';

/** Cases of few records, so that explaining takes seconds. */
function make() {
  command('hide', 'cross-coupling@A', '--rig', join(source, 'examples/reference/rig.toml'), '-o', 'practice', '--seed', '3');
  keepRecords('practice/case.toml', /record-(1|4|8)\.h5/);
  // The third practice case of this seed has a current at half its size.
  command('practice', join(source, 'examples/reference/rig.toml'), '--cases', '3', '--make-only', '-o', 'spoiled');
  keepRecords('spoiled/case-0003/case.toml', /record-(2|4|8)\.h5/);
  cpSync(join(source, 'examples/mls2em'), inFolder('ball'), {recursive: true});
  write('rig.toml', readFileSync(join(source, 'examples/reference/rig.toml')));
  write('healthy.toml', 'name = "healthy"\nrig = "rig.toml"\nduration = 0.15\nrecord_rate = 12500.0\nseed = 1\n\n[speed]\nprofile = [[0.0, 157.08]]\n');
  write('opens.toml', text('healthy.toml').replace('"healthy"', '"opens"') + '\n[[fault]]\ntime = 0.1\ntarget = "A.coil3"\nkind = "open"\n');
  write('bad.toml', 'name = "bad"\nrig = "rig.toml"\nduration = -1\n');
}

await walk({playground, scenarioList, compareRuns, campaign, keyboardOnly, dark, tablet, mendData, measuredRig, wizard, watched, nextRecord, mainFlow, planned, everyScreen}, make);
