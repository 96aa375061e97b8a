// Chromium for the tools that look at pages: Debian's, driven by the playwright-core of web/.
import {existsSync} from 'node:fs';
import {createRequire} from 'node:module';

const {chromium} = createRequire(new URL('../web/package.json', import.meta.url))('playwright-core');
const executablePath = ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find(existsSync);

/** Whether this machine has one (tools/setup.sh --tests installs it). */
export const hasBrowser = executablePath !== undefined;

export const launchBrowser = () => chromium.launch({executablePath, args: ['--no-sandbox']});
