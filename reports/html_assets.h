#pragma once
// Style sheet and script of the report. Both are inline, and have neither < nor &, so that the page is also
// XML.

#include <string_view>

namespace ddem::reports {

constexpr std::string_view kStyleSheet = R"css(
:root { --ink: #1b1f24; --soft: #555d66; --line: #dde1e6; --panel: #f6f8fa; --accent: #005a8f;
        --pass: #1a6b45; --fail: #b3261e; --error: #7a1f6b; --skip: #5b636d; }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; scroll-behavior: smooth; }
body { margin: 0; background: #fff; color: var(--ink); font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto,
       "DejaVu Sans", Arial, sans-serif; }
header, main, footer { max-width: 58rem; margin: 0 auto; padding: 0 1.25rem; overflow-wrap: break-word; }
header { padding-top: 2.5rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .6rem; letter-spacing: -.01em; }
h2 { font-size: 1.35rem; margin: 2.8rem 0 .6rem; padding-top: .9rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.05rem; margin: 0 0 .5rem; }
p { margin: 0 0 .8rem; max-width: 46rem; }
a { color: var(--accent); }
code { font: .88em ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
nav ul { display: flex; flex-wrap: wrap; gap: .2rem 1.2rem; list-style: none; margin: 1rem 0 0; padding: 0; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(11rem, 1fr)); gap: .8rem; margin: 1.2rem 0 0; }
.tiles > div { background: var(--panel); border-radius: 8px; padding: .8rem 1rem; }
.tiles dt { color: var(--soft); font-size: .88rem; line-height: 1.3; }
.tiles dd { margin: 0; }
.tiles .value { font-size: 1.6rem; font-weight: 650; line-height: 1.35; font-variant-numeric: tabular-nums; }
.note, .tiles .small { color: var(--soft); font-size: .88rem; }
figure { margin: 1.6rem 0 2.4rem; }
.drawing svg { display: block; width: 100%; height: auto; }
.drawing.narrow { display: none; }
figcaption { margin: .4rem 0 .4rem; font-size: .95rem; max-width: 46rem; }
.scroll { overflow-x: auto; max-width: 100%; margin: .4rem 0 1rem; }
table { border-collapse: collapse; font-size: .88rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding: .3rem 0; }
th, td { padding: .3rem .8rem; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
thead th { border-bottom: 2px solid #b8bfc7; white-space: nowrap; }
tbody th { font-weight: 500; white-space: nowrap; }
.case tbody th { white-space: normal; }
.case th, .case td { padding-left: .5rem; padding-right: .5rem; }
.n { text-align: right; white-space: nowrap; }
td.derivation { min-width: 12rem; color: var(--soft); }
td.accepted { white-space: nowrap; }
.gauge { vertical-align: -3px; margin-right: .6rem; }
summary { cursor: pointer; }
details.data > summary { color: var(--accent); font-size: .9rem; display: inline-block; }
.headcount { font-size: 1.5rem; font-weight: 650; margin: .4rem 0; }
.headcount.pass { color: var(--pass); } .headcount.fail { color: var(--fail); } .headcount.skip { color: var(--skip); }
.bar { display: flex; height: 8px; border-radius: 4px; overflow: hidden; gap: 2px; margin: .4rem 0 1rem; }
.bar span { min-width: 4px; background: var(--skip); }
.bar .pass { background: var(--pass); } .bar .fail { background: var(--fail); } .bar .error { background: var(--error); }
.filter { display: none; flex-wrap: wrap; gap: .4rem; margin: 0 0 1rem; }
.js .filter { display: flex; }
.filter button { font: inherit; font-size: .88rem; padding: .25rem .8rem; border: 1px solid #8a939d; border-radius: 99px;
                 background: #fff; color: var(--ink); cursor: pointer; }
.filter button[aria-pressed=true] { background: var(--ink); color: #fff; border-color: var(--ink); }
.group { margin: 0 0 .8rem; }
.group[hidden] { display: none; }
.group > summary { font-weight: 600; padding: .3rem 0; }
.case { border: 1px solid var(--line); border-radius: 6px; margin: .35rem 0; }
.case > summary { padding: .4rem .7rem; }
.case > .body { padding: .1rem .9rem .5rem; }
.case .title { color: var(--soft); }
.badge { display: inline-block; font-size: .74rem; font-weight: 650; letter-spacing: .02em; padding: .05rem .5rem;
         border-radius: 4px; color: #fff; background: var(--skip); white-space: nowrap; }
.badge.pass { background: var(--pass); } .badge.fail { background: var(--fail); } .badge.error { background: var(--error); }
.reproduce { color: var(--soft); font-size: .9rem; }
.hidden { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
.provenance { display: grid; grid-template-columns: max-content 1fr; gap: .2rem 1.2rem; font-size: .88rem; margin: 0; }
.provenance dt { color: var(--soft); } .provenance dd { margin: 0; overflow-wrap: anywhere; }
footer { padding-bottom: 3rem; }
@media screen and (max-width: 620px) {
  header, main, footer { padding-left: .8rem; padding-right: .8rem; }
  h1 { font-size: 1.5rem; }
  header { padding-top: 1.4rem; }
  .drawing.wide { display: none; }
  .drawing.narrow { display: block; }
  .gauge { display: none; }
  .provenance { grid-template-columns: 1fr; } .provenance dd { margin-bottom: .5rem; }
}
@media print {
  @page { margin: 16mm; }
  body { font-size: 10.5pt; }
  header, main, footer { max-width: none; padding: 0; }
  nav, .filter, .js .filter, details.data { display: none; }
  details::details-content { content-visibility: visible; height: auto; }
  figure, .case, .tiles > div { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
  .scroll { overflow: visible; }
  table { font-size: 8.5pt; }
  .gauge { display: none; }
  td.derivation { min-width: 0; }
  .tiles { grid-template-columns: repeat(auto-fit, minmax(9rem, 1fr)); }
  .tiles .value { font-size: 1.2rem; }
  .badge, .bar, .bar span, .gauge, .drawing svg, .tiles > div { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
)css";

constexpr std::string_view kScript = R"js(
(function () {
  var all = function (s) { return Array.prototype.slice.call(document.querySelectorAll(s)); };
  var buttons = all('.filter button'), groups = all('.group');
  document.documentElement.classList.add('js');
  buttons.forEach(function (button) {
    button.addEventListener('click', function () {
      var state = button.getAttribute('data-show');
      buttons.forEach(function (b) { b.setAttribute('aria-pressed', String(b === button)); });
      groups.forEach(function (g) {
        g.hidden = state ? g.getAttribute('data-state') !== state : false;
        if (state) g.open = !g.hidden;
      });
    });
  });
  var opened = [];
  window.addEventListener('beforeprint', function () {
    opened = all('details:not(.data)').filter(function (d) { return !d.open; });
    opened.forEach(function (d) { d.open = true; });
  });
  window.addEventListener('afterprint', function () { opened.forEach(function (d) { d.open = false; }); });
}());
)js";

}  // namespace ddem::reports
