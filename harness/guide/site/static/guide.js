// What the theme of Debian 12 leaves out: the reader's own choice of light and dark; and formulas.
document.addEventListener('DOMContentLoaded', () => {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const follow = () => {
    if ((localStorage.getItem('theme') ?? 'auto') === 'auto') document.body.dataset.theme = dark.matches ? 'dark' : 'light';
  };
  follow();
  dark.addEventListener('change', follow);
  for (const box of document.querySelectorAll('pre, .table-wrapper, div.math')) box.tabIndex = 0;  // scrolled by keys, too
  for (const formula of document.querySelectorAll('.math')) {
    const text = formula.textContent.trim();
    katex.render(text.slice(2, -2), formula, { displayMode: text.startsWith('\\['), throwOnError: false });
  }
});
