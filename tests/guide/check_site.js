// node check_site.js PLAYWRIGHT AXE CHROMIUM FOLDER: looks at every page of the guide at 1280 and 390 px, light and dark, as a reader
// without a network would, searches, and fails with every fault.
'use strict';
const fs = require('fs');
const path = require('path');
const [playwright, axe, executablePath] = process.argv.slice(2);
const folder = path.resolve(process.argv[5]);
const { chromium } = require(playwright);

const faults = [];
let checks = 0;
const check = (truth, fault) => {
  ++checks;
  if (!truth) faults.push(fault);
};

const look = async (page, what) => {
  const found = await page.evaluate(() => ({
    wide: document.documentElement.scrollWidth,
    seen: window.innerWidth,
    raw: [...document.querySelectorAll('.math')].filter((m) => !m.querySelector('.katex')).length,
    wrong: document.querySelectorAll('.katex-error').length,
    blank: [...document.images].filter((i) => i.complete && i.naturalWidth === 0).map((i) => i.src),
  }));
  check(found.wide <= found.seen, `${what}: ${found.wide} px wide`);
  check(found.raw + found.wrong === 0, `${what}: ${found.raw + found.wrong} formulas are not typeset`);
  check(found.blank.length === 0, `${what}: no picture: ${found.blank}`);
  await page.addScriptTag({ content: fs.readFileSync(path.join(axe, 'axe.min.js'), 'utf8') });
  const { violations } = await page.evaluate(() => axe.run(document.querySelector('.content'), { resultTypes: ['violations'], preload: false }));
  for (const v of violations.filter((w) => ['serious', 'critical'].includes(w.impact)))
    check(false, `${what}: ${v.help}: ${v.nodes.length} places, first ${v.nodes[0].html.slice(0, 160)} (${v.nodes[0].failureSummary})`);
};

(async () => {
  const pages = fs.readdirSync(folder).filter((f) => f.endsWith('.html') && !['genindex.html', 'search.html'].includes(f));
  check(pages.length >= 15 && pages.includes('index.html'), `only ${pages.length} pages`);
  const browser = await chromium.launch({ executablePath, args: ['--no-sandbox', '--disable-gpu'] });
  try {
    for (const [width, colorScheme] of [
      [1280, 'light'],
      [390, 'dark'],
    ]) {
      const page = await (await browser.newContext({ viewport: { width, height: 900 }, colorScheme })).newPage();
      let what = '';
      page.on('console', (m) => check(m.type() !== 'error', `${what}: console says ${m.text()}`));
      page.on('pageerror', (e) => check(false, `${what}: ${e.message} ${e.stack}`));
      page.on('request', (r) => check(/^(data|blob|file):/.test(r.url()), `${what}: asks for ${r.url()}`));
      for (const name of pages) {
        what = `${name}, ${width} px, ${colorScheme}`;
        await page.goto(`file://${path.join(folder, name)}`);
        await look(page, what);
      }
      what = 'search';
      await page.goto(`file://${path.join(folder, 'search.html')}?q=stiffness`);
      await page.waitForTimeout(1500);
      check((await page.locator('#search-results li').count()) > 0, 'search: stiffness is nowhere');
    }
  } finally {
    await browser.close();
  }
  for (const fault of faults) console.error(fault);
  console.log(`${pages.length} pages, ${checks} checks, ${faults.length} faults`);
  process.exitCode = faults.length ? 1 : 0;
})().catch((e) => {
  console.error(e);
  process.exitCode = 1;
});
