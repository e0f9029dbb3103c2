// The script of report.html: filters of the verdicts, and what the page's other scripts share. They follow in this order:
// report.js, film.js, figures.js.
'use strict';
const ddemPage = (() => {
  const all = (selector, from = document) => [...from.querySelectorAll(selector)];
  const make = (tag, properties = {}, ...children) => {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
  };
  document.documentElement.classList.add('js');
  const palette = JSON.parse(document.getElementById('palette')?.textContent ?? 'null');
  const font = { family: 'system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", Arial, sans-serif', size: 12, color: '#333' };

  // ---- Verdicts: by state, by facet, by words.
  const setUpFilters = () => {
    const cases = all('.case');
    const buttons = all('.filter button');
    const selects = all('.filter select');
    const search = document.querySelector('.filter input');
    const shown = document.querySelector('.shown');
    const openAtFirst = new Map(all('.group').map((group) => [group, group.open]));
    const apply = () => {
      const state = buttons.find((b) => b.getAttribute('aria-pressed') === 'true')?.dataset.show ?? '';
      const words = (search?.value ?? '').toLowerCase().split(/\s+/).filter(Boolean);
      const wanted = selects.filter((s) => s.value).map((s) => [s.name, s.value]);
      const narrowed = Boolean(state || words.length || wanted.length);
      let count = 0;
      for (const group of all('.group')) {
        let inGroup = 0;
        for (const item of all('.case', group)) {
          const text = item.querySelector('summary').textContent.toLowerCase();
          const keep =
            (!state || group.dataset.state === state) &&
            words.every((w) => text.includes(w)) &&
            wanted.every(([facet, value]) => item.getAttribute('data-' + facet) === value);
          item.hidden = !keep;
          if (keep) ++inGroup;
        }
        group.hidden = inGroup === 0;
        group.open = narrowed ? inGroup > 0 : openAtFirst.get(group);
        count += inGroup;
      }
      if (shown) shown.textContent = narrowed ? `${count} of ${cases.length} cases shown` : '';
    };
    for (const button of buttons) {
      button.addEventListener('click', () => {
        for (const other of buttons) other.setAttribute('aria-pressed', String(other === button));
        apply();
      });
    }
    for (const select of selects) select.addEventListener('change', apply);
    search?.addEventListener('input', apply);
    return () => {
      for (const button of buttons) button.setAttribute('aria-pressed', String(button.dataset.show === ''));
      for (const select of selects) select.value = '';
      if (search) search.value = '';
      apply();
    };
  };

  // ---- Long tables: by a column, up and down.
  const digits = '⁰¹²³⁴⁵⁶⁷⁸⁹';
  const numberOf = (text) =>
    Number(
      (text.trim() || 'none')
        .replace('×10', 'e')
        .replace(/[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (c) => (c === '⁻' ? '-' : digits.indexOf(c)))
        .replace(/−/g, '-'),
    );
  const compare = (a, b) => {
    const [x, y] = [numberOf(a), numberOf(b)],
      numbers = Number.isFinite(x) + Number.isFinite(y);
    if (numbers === 1) return Number.isFinite(x) ? -1 : 1; // what is none after all numbers
    return numbers === 2 ? x - y : a.localeCompare(b, 'en', { numeric: true });
  };
  const setUpSorting = () => {
    for (const table of all('table.long')) {
      all('thead th', table).forEach((heading, column) => {
        if (table.querySelector(`tbody tr > :nth-child(${column + 1}).spark`)) return;
        const button = make('button', { type: 'button', title: 'Sort' }, ...heading.childNodes);
        heading.replaceChildren(button);
        button.addEventListener('click', () => {
          const down = heading.getAttribute('aria-sort') === 'ascending';
          for (const other of all('thead th', table)) other.removeAttribute('aria-sort');
          heading.setAttribute('aria-sort', down ? 'descending' : 'ascending');
          const text = (row) => row.children[column].textContent;
          const rows = all('tbody tr', table).sort((a, b) => (down ? -1 : 1) * compare(text(a), text(b)));
          table.tBodies[0].append(...rows);
        });
      });
    }
  };

  // ---- What a link leads to is there, and open.
  let showAll = () => {};
  const named = (hash) => {
    try {
      return document.getElementById(decodeURIComponent(hash.slice(1)));
    } catch {
      return null; // no text
    }
  };
  const openTarget = (hash) => {
    const target = named(hash);
    if (target?.closest('.case[hidden], .group[hidden]')) showAll();
    for (let element = target; element; element = element.parentElement) if (element.matches('details')) element.open = true;
    target?.scrollIntoView();
  };
  window.addEventListener('hashchange', () => openTarget(location.hash));
  // The same link twice changes no address.
  document.addEventListener('click', (event) => {
    const link = event.target.closest?.('a[href^="#case-"]');
    if (link) openTarget(link.hash);
  });

  // ---- On paper details are open, data and cases that passed aside.
  let opened = [];
  window.addEventListener('beforeprint', () => {
    opened = all('details:not(.data, .case)').filter((d) => !d.open);
    for (const d of opened) d.open = true;
  });
  window.addEventListener('afterprint', () => {
    for (const d of opened) d.open = false;
  });

  showAll = setUpFilters();
  setUpSorting();
  if (location.hash) openTarget(location.hash);
  return { all, make, palette, font };
})();
