// node check_report.js PLAYWRIGHT AXE CHROMIUM REPORT OUTPUT: looks at a report in a headless browser as a reader would, and fails
// with every fault. Leaves OUTPUT/report.png (1280 px wide), report-dark.png, report-phone.png (390 px) and report.pdf.
'use strict';
const fs = require('fs');
const path = require('path');
const [playwright, axe, executablePath, report, output] = process.argv.slice(2);
const { chromium } = require(playwright);

const faults = [];
let checks = 0;
const check = (truth, fault) => {
  ++checks;
  if (!truth) faults.push(fault);
};

// Every request but the page itself and what it makes of its own bytes is one to the network.
const watch = (page, what) => {
  page.on('console', (m) => check(m.type() !== 'error', `${what}: console says ${m.text()}`));
  page.on('pageerror', (e) => check(false, `${what}: ${e.stack}`));
  page.on('request', (r) => check(/^(data|blob):/.test(r.url()) || r.url() === `file://${report}`, `${what}: asks for ${r.url()}`));
};

const drawAll = async (page, what) => {
  const figures = page.locator('figure:has(script.figure-data)');
  for (let i = 0; i < (await figures.count()); ++i) {
    const figure = figures.nth(i);
    await figure.scrollIntoViewIfNeeded();
    await page
      .waitForFunction((f) => f.dataset.drawn === 'true', await figure.elementHandle(), { timeout: 30000 })
      .catch(() => check(false, `${what}: a figure is not drawn: ${i}`));
  }
  const found = await page.evaluate(() =>
    [...document.querySelectorAll('figure:has(script.figure-data)')].map((f) => ({
      id: f.id,
      panels: JSON.parse(f.querySelector('script.figure-data').textContent).figure.panels.length,
      drawn: f.querySelectorAll('.panel').length,
      empty: [...f.querySelectorAll('.panel.plot')].filter((p) => !p.querySelector('.scatterlayer .trace path, .heatmaplayer image'))
        .length,
      blank: [...f.querySelectorAll('.panel.strip canvas')].filter(
        (c) =>
          !c
            .getContext('2d')
            .getImageData(0, 0, c.width, c.height)
            .data.some((v) => v > 0),
      ).length,
      notANumber: /NaN|undefined/.test(f.querySelector('.live').innerHTML),
      still: getComputedStyle(f.querySelector('.drawing')).display,
    })),
  );
  check(found.length > 0, `${what}: no interactive figure`);
  for (const f of found) {
    check(
      f.drawn === f.panels && f.empty === 0 && f.blank === 0,
      `${what}: ${f.id} has ${f.drawn} of ${f.panels} panels, ${f.empty + f.blank} of them blank`,
    );
    check(!f.notANumber, `${what}: ${f.id} shows what is not a number`);
    check(f.still === 'none', `${what}: ${f.id} shows its SVG, too`);
  }
  return found.map((f) => f.id);
};

const checkWidth = async (page, what) => {
  const [wide, seen] = await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
  check(wide <= seen, `${what}: the page is ${wide} px wide in a window of ${seen}`);
};

const checkFilters = async (page) => {
  const visible = () =>
    page.evaluate(() => [...document.querySelectorAll('.case')].filter((c) => !c.hidden && !c.closest('.group').hidden).length);
  const total = await page.locator('.case').count();
  check((await visible()) === total, 'filter: not all cases are there at first');
  const states = await page.evaluate(() =>
    [...document.querySelectorAll('.group')].map((g) => [g.dataset.state, g.querySelectorAll('.case').length]),
  );
  for (const [state, count] of states) {
    await page.locator(`.filter button[data-show="${state}"]`).click();
    check((await visible()) === count, `filter: ${state} shows ${await visible()} of ${count}`);
  }
  await page.locator('.filter button[data-show=""]').click();
  for (const select of await page.locator('.filter select').all()) {
    const name = await select.getAttribute('name');
    const value = await select.locator('option').nth(1).getAttribute('value');
    await select.selectOption(value);
    const expected = await page.locator(`.case[data-${name}="${value}"]`).count();
    check(expected > 0 && (await visible()) === expected, `filter: ${name} = ${value} shows ${await visible()} of ${expected}`);
    await select.selectOption('');
  }
  await page.locator('.filter input').fill('no such case');
  check((await visible()) === 0, 'filter: words that no case has show cases');
  await page.locator('.filter input').fill('');
  check((await visible()) === total, 'filter: not all cases come back');
};

const checkZoomAndLegend = async (page) => {
  const plot = page.locator('.panel.plot .canvas').first();
  await plot.scrollIntoViewIfNeeded();
  const range = () => plot.evaluate((p) => p.layout.xaxis.range.slice());
  const before = await range();
  const box = await plot.locator('.nsewdrag').first().boundingBox();
  await page.mouse.move(box.x + 0.3 * box.width, box.y + 0.3 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.7 * box.height, { steps: 6 });
  await page.mouse.up();
  await page.waitForTimeout(400);
  const after = await range();
  const part = (after[1] - after[0]) / (before[1] - before[0]);
  check(Math.abs(part - 0.3) < 0.02, `zoom: from 0.3 to 0.6 of the axis shows ${part} of it`);
  await plot.locator('.nsewdrag').first().dblclick();
  await page.waitForTimeout(400);
  const back = await range();
  check(Math.abs(back[0] - before[0]) + Math.abs(back[1] - before[1]) < 1e-9, 'zoom: a double click does not lead back');

  const legend = page.locator('figure:has(.legend button)').first();
  const shown = () =>
    legend.evaluate(
      (f) => [...f.querySelectorAll('.canvas')].flatMap((c) => c.data.map((t) => t.visible)).filter((v) => v === false).length,
    );
  await legend.locator('.legend button').first().click();
  check((await shown()) > 0, 'legend: a click hides nothing');
  await legend.locator('.legend button').first().click();
  check((await shown()) === 0, 'legend: a second click does not bring it back');
};

// Labels of logarithmic axes follow the range, and then it is quiet: a change a zoom, and one for the labels.
const checkLogAxis = async (page) => {
  const found = await page.evaluate(async () => {
    const plot = [...document.querySelectorAll('.panel.plot .canvas')].find((c) => c.layout?.yaxis.type === 'log');
    if (!plot) return null;
    const before = plot.layout.yaxis.range.slice();
    let changes = 0;
    plot.on('plotly_relayout', () => ++changes);
    const counts = [];
    for (const range of [[0, 0.3], [-3, 3], before]) {
      changes = 0;
      await Plotly.relayout(plot, { 'yaxis.range': range });
      await new Promise((done) => setTimeout(done, 400));
      counts.push(changes);
    }
    return { counts, labels: plot.querySelectorAll('.ytick text').length };
  });
  if (found) check(found.counts.every((n) => n <= 2) && found.labels >= 2, `logarithmic axis: ${JSON.stringify(found)}`);
};

const checkSlider = async (page) => {
  const film = page.locator('figure:has(input[type=range])').first();
  if ((await film.count()) === 0) return check(false, 'slider: none');
  await film.scrollIntoViewIfNeeded();
  const picture = () => film.evaluate((f) => [...f.querySelectorAll('canvas')].map((c) => c.toDataURL()).join());
  const time = () => film.locator('output').textContent();
  const [first, at] = [await picture(), await time()];
  await film.locator('input[type=range]').focus();
  for (let i = 0; i < 3; ++i) await page.keyboard.press('ArrowRight');
  check((await picture()) !== first && (await time()) !== at, 'slider: three steps on show the same picture');
  const before = await picture();
  await film.locator('select').selectOption('1');
  check((await picture()) !== before, 'slider: another field has the same picture');
  await film.locator('select').selectOption('0');
  await film.getByRole('button', { name: 'Play' }).click();
  const playing = await time();
  await page.waitForTimeout(700);
  check((await time()) !== playing, 'slider: it does not play');
  await film.getByRole('button', { name: 'Pause' }).click();
};

// The file that the page makes has the numbers of the file that the program wrote, in six digits: half a unit of the last is up
// to 5e-6 of the number. Of packed ones 16 bits come before that: 1.53e-5.
const checkCsv = async (page, ids) => {
  const parse = (text) => {
    const [header, ...rows] = text
      .trim()
      .split('\n')
      .map((line) => line.match(/("([^"]|"")*"|[^,]*)(,|$)/g).map((cell) => cell.replace(/,$/, '')));
    return rows.map((row) => Object.fromEntries(header.filter(Boolean).map((key, i) => [key, row[i] ?? ''])));
  };
  for (const id of ids) {
    const { name, thinned, packed, text } = await page.evaluate(async (figure) => {
      const link = document.querySelector(`#${figure} .csv a`);
      const data = JSON.parse(document.querySelector(`#${figure} script.figure-data`).textContent);
      const packed = data.arrays.some((a) => 'packed' in a);
      return { name: link.download, thinned: data.figure.thinned, packed, text: await (await fetch(link.href)).text() };
    }, id);
    const file = path.join(path.dirname(report), 'figures', name);
    if (thinned || !fs.existsSync(file)) continue;
    const [mine, written] = [parse(text), parse(fs.readFileSync(file, 'utf8'))];
    check(mine.length === written.length, `csv: ${id} has ${mine.length} rows, its file ${written.length}`);
    const error = packed ? 2.05e-5 : 5.1e-6,
      tiny = packed ? 1e-37 : 0;
    const same = (a, b) => a === b || (a !== '' && b !== '' && Math.abs(Number(a) - Number(b)) <= error * Math.abs(Number(b)) + tiny);
    const wrong = written.findIndex((row, i) => Object.entries(row).some(([key, value]) => !same(mine[i]?.[key] ?? '', value)));
    check(wrong === -1, `csv: row ${wrong} of ${id} is ${JSON.stringify(mine[wrong])}, in its file ${JSON.stringify(written[wrong])}`);
  }
};

const checkAccessibility = async (page, what) => {
  await page.addScriptTag({ content: fs.readFileSync(path.join(axe, 'axe.min.js'), 'utf8') });
  const { violations } = await page.evaluate(() => axe.run(document, { resultTypes: ['violations'] }));
  for (const v of violations.filter((w) => ['serious', 'critical'].includes(w.impact)))
    check(
      false,
      `${what}: ${v.impact}: ${v.help}: ${v.nodes.length} places, first ${v.nodes[0].html.slice(0, 160)} (${v.nodes[0].failureSummary})`,
    );
  ++checks;
};

const checkPaper = async (page, ids) => {
  await page.emulateMedia({ media: 'print' });
  const seen = await page.evaluate(
    () =>
      [...document.querySelectorAll('figure:has(script.figure-data)')].filter(
        (f) =>
          getComputedStyle(f.querySelector('.live')).display === 'none' &&
          getComputedStyle(f.querySelector('.drawing')).display !== 'none',
      ).length,
  );
  check(seen === ids.length, `paper: ${seen} of ${ids.length} figures are SVG`);
  // A4 within its margins of 16 mm: nothing sticks out at the side, and what does not break fits a page.
  const screen = page.viewportSize();
  await page.setViewportSize({ width: 673, height: 1001 });
  const cut = await page.evaluate(() => {
    const what = (e) => `${e.tagName} ${e.id} ${e.textContent.trim().slice(0, 40)}`;
    const across = (e) => e.closest('.scroll') !== null && getComputedStyle(e.closest('.scroll')).page === 'across';
    const seen = [...document.querySelectorAll('table, figure, svg, pre, tr, p, .tiles > div')].filter((e) => e.checkVisibility());
    const wide = seen.filter((e) => e.getBoundingClientRect().right > (across(e) ? 1002 : 674)).map((e) => `too wide: ${what(e)}`);
    const tall = seen.filter((e) => e.matches('figure, tr, .tiles > div') && e.getBoundingClientRect().height > 1001).map((e) => `too tall: ${what(e)}`);
    const hidden = [...document.querySelectorAll('.scroll')].filter((e) => getComputedStyle(e).overflow !== 'visible').map((e) => `cut: ${what(e)}`);
    const breaking = seen.filter((e) => e.matches('figure, tr') && getComputedStyle(e).breakInside !== 'avoid').map((e) => `breaks: ${what(e)}`);
    return [...wide, ...tall, ...hidden, ...breaking];
  });
  check(cut.length === 0, `paper: ${cut.length} places: ${cut.slice(0, 3).join('; ')}`);
  await page.setViewportSize(screen);
  const pdf = await page.pdf({ path: path.join(output, 'report.pdf'), format: 'A4' });
  check(pdf.subarray(0, 5).toString() === '%PDF-' && pdf.length > 50000, `paper: the PDF has ${pdf.length} bytes`);
  await page.emulateMedia({ media: 'screen' });
};

// Medians of five: when the largest part of the first screen is there, and the longest that the page does not listen. The limits
// are of a machine that lays out a table of 5000 rows in YARDSTICK ms; a slower one, or a busy one, gets as much more.
const YARDSTICK = 450;
const checkOpening = async (browser) => {
  const opened = [];
  for (let i = 0; i < 5; ++i) {
    const page = await (await browser.newContext({ viewport: { width: 1280, height: 900 } })).newPage();
    const yardstick = await page.evaluate(() => {
      const begun = performance.now();
      document.body.innerHTML = `<table>${'<tr><td>1<td>2.5<td>three</tr>'.repeat(5000)}</table>`;
      document.body.getBoundingClientRect();
      return performance.now() - begun;
    });
    await page.addInitScript(() => {
      window.opening = { paint: 0, task: 0 };
      new PerformanceObserver((list) => list.getEntries().forEach((e) => (window.opening.paint = e.startTime))).observe({
        type: 'largest-contentful-paint',
        buffered: true,
      });
      new PerformanceObserver((list) =>
        list.getEntries().forEach((e) => (window.opening.task = Math.max(window.opening.task, e.duration))),
      ).observe({ type: 'longtask', buffered: true });
    });
    await page.goto(`file://${report}`);
    await page.waitForTimeout(1000);
    opened.push({ ...(await page.evaluate(() => window.opening)), yardstick });
    await page.context().close();
  }
  const median = (key) => opened.map((o) => o[key]).sort((a, b) => a - b)[2];
  const slower = Math.max(1, median('yardstick') / YARDSTICK);
  console.log(
    ['paint', 'task', 'yardstick'].map((key) => `${key} ${median(key).toFixed(0)} ms`).join(', ') +
      ` (largest paint, longest task, table of 5000 rows): limits times ${slower.toFixed(2)}`,
  );
  check(median('paint') > 0 && median('paint') < 700 * slower, `opening: the largest paint comes after ${median('paint')} ms`);
  check(median('task') < 200 * slower, `opening: a task takes ${median('task')} ms`);
};

const checkTables = async (page) => {
  for (const table of await page.locator('table.long').all()) {
    for (const fold of await table.locator('xpath=ancestor::details').all()) await fold.evaluate((d) => (d.open = true));
    const heading = table.locator('thead th').first();
    const cells = () => table.evaluate((t) => [...t.tBodies[0].rows].map((r) => r.cells[0].textContent));
    const before = await cells();
    await heading.locator('button').click();
    const up = await cells();
    await heading.locator('button').click();
    const down = await cells();
    const same = (a, b) => a.length === b.length && a.every((text, i) => text === b[i]);
    check(same([...before].sort(), [...up].sort()) && same([...before].sort(), [...down].sort()), 'table: sorting loses rows');
    const last = table.locator('thead th.n button').last();
    if ((await last.count()) > 0) {
      await last.click();
      const values = await table.evaluate((t) => {
        const column = [...t.tHead.rows[0].cells].findIndex((c) => c.hasAttribute('aria-sort'));
        return [...t.tBodies[0].rows].map((r) => r.cells[column].textContent);
      });
      const plain = values.map((v) => Number(v.replace(/−/g, '-'))).filter(Number.isFinite);
      check(
        values.some((v) => v.includes('×')) || plain.every((v, i) => i === 0 || v >= plain[i - 1]),
        `table: sorted as ${plain.slice(0, 8)}`,
      );
    }
    check(new Set(up).size < 2 || up[0] !== down[0], 'table: up and down are the same');
  }
};

// A link to a case opens it.
const checkLinks = async (page) => {
  const link = page.locator('.conclusion a[href^="#case-"]').first();
  if ((await link.count()) === 0) return;
  const id = decodeURIComponent((await link.getAttribute('href')).slice(1));
  await link.click();
  check(await page.evaluate((id) => document.getElementById(id)?.open ?? false, id), `link: ${id} does not open`);
};

const withoutScripts = async (browser) => {
  const page = await (await browser.newContext({ javaScriptEnabled: false })).newPage();
  watch(page, 'without scripts');
  await page.goto(`file://${report}`);
  const figures = page.locator('figure'),
    drawings = page.locator('figure .drawing svg:visible');
  check(
    (await figures.count()) > 0 && (await drawings.count()) === (await figures.count()),
    `without scripts: ${await drawings.count()} of ${await figures.count()} figures are drawn`,
  );
  await page.context().close();
};

const onScreen = async (browser) => {
  const page = await (await browser.newContext({ viewport: { width: 1280, height: 900 }, colorScheme: 'light' })).newPage();
  watch(page, '1280 px');
  await page.goto(`file://${report}`);
  await checkFilters(page);
  const ids = await drawAll(page, '1280 px');
  await checkWidth(page, '1280 px');
  await checkZoomAndLegend(page);
  await checkLogAxis(page);
  await checkSlider(page);
  await checkCsv(page, ids);
  await page.evaluate(() => window.scrollTo(0, 0));
  await page.screenshot({ path: path.join(output, 'report.png'), fullPage: true });
  await checkPaper(page, ids);
  await checkLinks(page);
  await checkTables(page);
  await checkAccessibility(page, '1280 px');
  await page.emulateMedia({ colorScheme: 'dark' });
  await checkAccessibility(page, '1280 px, dark');
  await page.screenshot({ path: path.join(output, 'report-dark.png') });
};

const onPhone = async (browser) => {
  const phone = await (await browser.newContext({ viewport: { width: 390, height: 800 }, isMobile: true, hasTouch: true })).newPage();
  watch(phone, '390 px');
  await phone.goto(`file://${report}`);
  await drawAll(phone, '390 px');
  await checkWidth(phone, '390 px');
  await checkAccessibility(phone, '390 px');
  await phone.screenshot({ path: path.join(output, 'report-phone.png'), fullPage: true });
};

(async () => {
  check(fs.statSync(report).size < 4e6, `the report has ${fs.statSync(report).size} bytes`);
  const browser = await chromium.launch({ executablePath, args: ['--no-sandbox', '--disable-gpu'] });
  try {
    await checkOpening(browser);
    await Promise.all([onScreen(browser), onPhone(browser), withoutScripts(browser)]);
  } finally {
    await browser.close();
  }
  for (const fault of faults) console.error(fault);
  console.log(`${checks} checks, ${faults.length} faults`);
  process.exitCode = faults.length ? 1 : 0;
})().catch((e) => {
  console.error(e);
  process.exitCode = 1;
});
