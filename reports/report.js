// The script of report.html: filters of the verdicts, and figures that move where the page carries plotly.
(() => {
  'use strict';
  const page = document.documentElement;
  const all = (selector, from = document) => [...from.querySelectorAll(selector)];
  const make = (tag, properties = {}, ...children) => {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
  };
  page.classList.add('js');

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
          const keep = (!state || group.dataset.state === state) && words.every((w) => text.includes(w)) &&
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
  };

  // ---- On paper all details are open, data aside.
  let opened = [];
  window.addEventListener('beforeprint', () => {
    opened = all('details:not(.data)').filter((d) => !d.open);
    for (const d of opened) d.open = true;
  });
  window.addEventListener('afterprint', () => {
    for (const d of opened) d.open = false;
  });

  // ---- Figures.
  const palette = JSON.parse(document.getElementById('palette')?.textContent ?? 'null');
  const dashes = { solid: 'solid', dashed: 'dash', dotted: 'dot' };
  const symbols = { circle: 'circle', square: 'square', triangle: 'triangle-up', diamond: 'diamond' };
  const font = { family: 'system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", Arial, sans-serif', size: 12, color: '#333' };
  const coarse = window.matchMedia('(pointer: coarse)').matches;

  const readFigure = (script) => {
    const { figure, arrays } = JSON.parse(script.textContent);
    const array = (a) => (Array.isArray(a) ? a : Array.from({ length: a.count }, (_, i) => a.from + i * a.step));
    const values = arrays.map(array);
    const take = (owner, ...keys) => {
      for (const key of keys) owner[key] = key in owner ? values[owner[key]] : [];
    };
    for (const panel of figure.panels) {
      for (const s of panel.series ?? []) take(s, 'x', 'y', 'error');
      for (const b of panel.bands ?? []) take(b, 'x', 'lower', 'upper');
      if (panel.map) take(panel.map, 'x', 'y', 'value');
      if (panel.type === 'strip') take(panel, 'x', 'y', 'radius', 'value', 'times');
    }
    return figure;
  };

  // Marks of a plot's axis: {title, exponent, lower, upper, log}. Data are shown over 10^exponent.
  const scaled = (values, marks) => {
    const unit = 10 ** -marks.exponent;
    return marks.exponent === 0 ? values : values.map((v) => (v === null ? null : v * unit));
  };
  // A tick a decade, but within one or two decades those that plotly finds.
  const decadeTicks = (range) => (Math.abs(range[1] - range[0]) >= 2 ? Math.ceil(Math.abs(range[1] - range[0]) / 7) : null);
  const decades = (range) => ({ dtick: decadeTicks(range), tickmode: decadeTicks(range) === null ? 'auto' : 'linear' });
  const plotAxis = (marks) => {
    const ends = scaled([marks.lower, marks.upper], marks);
    return {
      ...(marks.log ? decades(ends.map(Math.log10)) : {}),
      type: marks.log ? 'log' : 'linear', range: marks.log ? ends.map(Math.log10) : ends, exponentformat: 'power', minexponent: 4,
      gridcolor: '#e3e6ea', zeroline: false, linecolor: '#7a828c', ticks: '', nticks: marks.log ? 5 : 7, automargin: true, tickfont: { color: '#444' },
      hoverformat: '.5~g',
    };
  };
  const rgba = (hex, alpha) => `rgba(${[1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)).join(',')},${alpha})`;

  const bandTrace = (band, style, panel) => {
    const x = scaled(band.x, panel.xmarks), lower = scaled(band.lower, panel.ymarks), upper = scaled(band.upper, panel.ymarks);
    const outline = { x: [], y: [] };
    for (let begin = 0; begin < x.length;) {
      const whole = (i) => i < x.length && x[i] !== null && lower[i] !== null && upper[i] !== null;
      let end = begin;
      while (whole(end)) ++end;
      if (end > begin) {
        if (outline.x.length) outline.x.push(null), outline.y.push(null);
        outline.x.push(...x.slice(begin, end), ...x.slice(begin, end).reverse());
        outline.y.push(...upper.slice(begin, end), ...lower.slice(begin, end).reverse());
      }
      begin = Math.max(end, begin + 1);
    }
    return { ...outline, type: 'scatter', mode: 'lines', fill: 'toself', fillcolor: rgba(style.color, 0.2), line: { width: 0 }, hoverinfo: 'skip' };
  };

  const seriesTrace = (series, style, panel) => {
    const name = series.name ? `<b>${series.name}</b><br>` : '';
    const trace = {
      type: 'scatter', x: scaled(series.x, panel.xmarks), y: scaled(series.y, panel.ymarks), connectgaps: false,
      mode: { line: 'lines', markers: 'markers', line_markers: 'lines+markers' }[series.kind],
      line: { color: style.color, width: 1.8, dash: dashes[series.dash] },
      marker: { color: style.color, size: 8, symbol: symbols[style.marker], line: { color: '#fff', width: 0.8 } },
      hovertemplate: `${name}${panel.xmarks.title}: %{x}<br>${panel.ymarks.title}: %{y}<extra></extra>`,
    };
    if (series.error.length) trace.error_y = { type: 'data', array: scaled(series.error, panel.ymarks), thickness: 1.3, width: 3.5, color: style.color };
    return trace;
  };

  const pickTrace = (pick, panel) => ({
    type: 'scatter', mode: 'markers', x: scaled([pick.x], panel.xmarks), y: scaled([pick.y], panel.ymarks),
    marker: { symbol: 'circle', size: 10, color: 'rgba(255,255,255,0.6)', line: { color: pick.color, width: 1.8 } },
    hovertemplate: `picked, ${pick.series || pick.label || 'here'}<br>${panel.xmarks.title}: %{x}<extra></extra>`,
  });

  // From values to 0 .. 1 of the colour bar, and its ticks.
  const colorFraction = (map) => {
    const { lower, upper } = map.value_axis.limits;
    const decades = (v) => Math.log(v / lower) / Math.log(upper / lower);
    const hold = (t) => Math.min(1, Math.max(0, t));
    return {
      linear: (v) => hold((v - lower) / (upper - lower)),
      log: (v) => (v > 0 ? hold(decades(v)) : null),
      signed_log: (v) => (Math.abs(v) > lower ? 0.5 + 0.5 * Math.sign(v) * hold(decades(Math.abs(v))) : 0.5),
    }[map.color_scale];
  };
  const mapTrace = (map, panel) => {
    const fraction = colorFraction(map), columns = map.x.length;
    const rows = (of) => map.y.map((_, r) => map.value.slice(r * columns, (r + 1) * columns).map(of));
    const signed = map.color_scale === 'signed_log';
    const colors = signed ? palette.diverging : palette.white_to_blue;
    return {
      type: 'heatmap', x: scaled(map.x, panel.xmarks), y: scaled(map.y, panel.ymarks),
      z: rows((v) => (v === null ? null : fraction(v))), zmin: 0, zmax: 1, customdata: rows((v) => v),
      colorscale: colors.map((c, i) => [i / (colors.length - 1), c]), hoverongaps: false,
      colorbar: { title: { text: map.title, side: 'right', font: { size: 12 } }, thickness: 10, outlinewidth: 0, len: 1, tickvals: map.ticks.map((t) => t.at),
        ticktext: map.ticks.map((t) => t.label), tickfont: { size: 11 } },
      hovertemplate: `${panel.xmarks.title}: %{x}<br>${panel.ymarks.title}: %{y}<br>${map.title}: %{customdata:.3~g}<extra></extra>`,
    };
  };

  const lineShape = (position, horizontal, marks, line, label) => {
    const at = scaled([position], marks)[0];
    const shape = horizontal ? { xref: 'paper', x0: 0, x1: 1, yref: 'y', y0: at, y1: at } : { yref: 'paper', y0: 0, y1: 1, xref: 'x', x0: at, x1: at };
    const text = label ? { label: { text: label, textposition: 'end', font: { size: 12, color: '#333' }, textangle: 0, xanchor: horizontal ? 'right' : 'left', yanchor: horizontal ? 'bottom' : 'top' } } : {};
    return { type: 'line', line, layer: 'above', ...shape, ...text };
  };

  const drawPlot = (host, panel, figure) => {
    const traces = [], styles = [];
    const add = (trace, style) => {
      traces.push({ showlegend: false, ...trace });
      styles.push(style);
    };
    if (panel.map) add(mapTrace(panel.map, panel), -1);
    for (const b of panel.bands ?? []) add(bandTrace(b, figure.styles[b.style], panel), b.style);
    for (const s of panel.series ?? []) add(seriesTrace(s, figure.styles[s.style], panel), s.style);
    for (const p of panel.picks ?? []) if (p.y !== undefined) add(pickTrace(p, panel), p.style ?? -1);
    const shapes = [
      ...(panel.references ?? []).map((r) => lineShape(r.value, r.direction === 'horizontal', r.direction === 'horizontal' ? panel.ymarks : panel.xmarks,
        { color: '#555', width: 1.3, dash: dashes[r.dash] }, r.label)),
      ...(panel.picks ?? []).map((p) => lineShape(p.x, false, panel.xmarks, { color: p.color, width: 1.1, dash: 'dot' }, p.label)),
    ];
    const layout = {
      font, plot_bgcolor: panel.map ? '#c4c4c4' : '#fafbfc', paper_bgcolor: '#fff', margin: { l: 46, r: panel.map ? 8 : 14, t: 26, b: 40 }, shapes, hovermode: 'closest',
      dragmode: coarse ? false : 'zoom', hoverlabel: { bgcolor: '#fff', bordercolor: '#b8bfc7', font: { ...font, color: '#1b1f24' } },
      xaxis: { ...plotAxis(panel.xmarks), title: { text: panel.xmarks.title, standoff: 6, font: { size: 13 } } },
      yaxis: plotAxis(panel.ymarks),
      annotations: [{ text: panel.ymarks.title, xref: 'paper', yref: 'paper', x: 0, y: 1, xanchor: 'left', yanchor: 'bottom', yshift: 4, xshift: -6,
        showarrow: false, font: { size: 13 } }],
    };
    const config = { responsive: true, displaylogo: false, scrollZoom: false, modeBarButtonsToRemove: ['select2d', 'lasso2d', 'autoScale2d'],
      toImageButtonOptions: { format: 'svg', filename: figure.id } };
    return Plotly.newPlot(host, traces, layout, config).then(() => {
      host.on('plotly_relayout', () => {
        const change = {};
        for (const name of ['xaxis', 'yaxis']) {
          const axis = host.layout[name], ticks = axis.type === 'log' ? decades(axis.range) : axis;
          if (ticks.tickmode !== axis.tickmode || (ticks.tickmode === 'linear' && ticks.dtick !== axis.dtick)) {
            change[`${name}.dtick`] = ticks.dtick;
            change[`${name}.tickmode`] = ticks.tickmode;
          }
        }
        if (Object.keys(change).length) Plotly.relayout(host, change);
      });
      return { host, styles };
    });
  };

  // One swatch and name a style; a click hides it in all panels.
  const swatch = (style) => {
    const dash = { solid: '', dashed: '6 4', dotted: '2 3' }[style.dash];
    const parts = [];
    if (style.band) parts.push(`<rect x="0" y="2" width="26" height="10" fill="${style.color}" fill-opacity="0.2"/>`);
    if (style.line) parts.push(`<line x1="0" x2="26" y1="7" y2="7" stroke="${style.color}" stroke-width="2" stroke-dasharray="${dash}"/>`);
    const shapes = { circle: '<circle cx="13" cy="7" r="4"/>', square: '<rect x="9" y="3" width="8" height="8"/>',
      triangle: '<path d="M13 2l5 9h-10z"/>', diamond: '<path d="M13 2l5 5-5 5-5-5z"/>' };
    if (style.points) parts.push(`<g fill="${style.color}">${shapes[style.marker]}</g>`);
    return `<svg width="26" height="14" aria-hidden="true">${parts.join('')}</svg>`;
  };
  const legend = (figure, plots) => {
    const box = make('div', { className: 'legend' });
    box.setAttribute('role', 'group');
    box.setAttribute('aria-label', 'Series shown');
    figure.styles.forEach((style, index) => {
      if (!style.name) return;
      const button = make('button', { type: 'button' });
      button.innerHTML = swatch(style);
      button.append(style.name);
      button.setAttribute('aria-pressed', 'true');
      button.addEventListener('click', () => {
        const on = button.getAttribute('aria-pressed') !== 'true';
        button.setAttribute('aria-pressed', String(on));
        for (const plot of plots) {
          const mine = plot.styles.flatMap((s, i) => (s === index ? [i] : []));
          if (mine.length) Plotly.restyle(plot.host, { visible: on }, mine);
        }
      });
      box.append(button);
    });
    return box.children.length ? box : '';
  };

  // ---- A strip over time: discs on a canvas, coloured by what a field is at a time.
  const colorTable = (anchors) => Array.from({ length: 255 }, (_, i) => {
    const position = (i / 254) * (anchors.length - 1), left = Math.min(anchors.length - 2, Math.floor(position)), f = position - left;
    const channel = (hex, k) => parseInt(hex.slice(k, k + 2), 16);
    return `rgb(${[1, 3, 5].map((k) => Math.round((1 - f) * channel(anchors[left], k) + f * channel(anchors[left + 1], k))).join(',')})`;
  });
  const number = (v) => Number(v.toPrecision(3)).toString().replace('-', '−');

  class StripView {
    constructor(host, strip) {
      this.strip = strip;
      this.levels = strip.fields.map((f) => Uint8Array.from(atob(f.bytes), (c) => c.charCodeAt(0)));
      this.canvas = make('canvas');
      this.canvas.setAttribute('role', 'img');
      this.tip = make('div', { className: 'tip', hidden: true });
      this.bar = make('div', { className: 'colorbar' });
      host.append(make('div', { className: 'stage' }, this.canvas, this.tip), this.bar);
      const r = Math.max(...strip.radius);
      this.left = Math.min(...strip.x) - r;
      this.bottom = Math.min(...strip.y) - r;
      this.wide = Math.max(...strip.x) + r - this.left;
      this.high = Math.max(...strip.y) + r - this.bottom;
      this.canvas.addEventListener('pointermove', (e) => this.point(e));
      this.canvas.addEventListener('pointerleave', () => { this.tip.hidden = true; });
      new ResizeObserver(() => this.draw()).observe(host);
    }

    show(field, frame) {
      if (field !== this.field) this.showBar(this.strip.fields[field]);
      this.field = field;
      this.frame = frame;
      this.draw();
    }

    showBar(field) {
      this.colors = colorTable(field.signed ? palette.diverging : palette.viridis);
      const unit = 10 ** -field.marks.exponent;
      const ends = [field.marks.lower, (field.marks.lower + field.marks.upper) / 2, field.marks.upper].map((v) => number(v * unit));
      this.bar.replaceChildren(make('span', { className: 'ramp', style: `background:linear-gradient(90deg,${this.colors.filter((_, i) => i % 16 === 0).join(',')})` }),
        make('span', { className: 'ends' }, ...ends.map((text) => make('span', { textContent: text }))), make('span', { className: 'what', textContent: field.marks.title }));
    }

    level(disc) { return this.levels[this.field][this.frame * this.strip.x.length + disc]; }

    draw() {
      const width = this.canvas.parentElement.clientWidth;
      if (!width || this.field === undefined) return;
      const { strip } = this, ratio = window.devicePixelRatio || 1, margin = 22;
      this.scale = width / this.wide;
      const height = this.high * this.scale + 2 * margin;
      this.canvas.width = width * ratio;
      this.canvas.height = height * ratio;
      this.canvas.style.height = `${height}px`;
      const g = this.canvas.getContext('2d');
      g.scale(ratio, ratio);
      this.at = (i) => [(strip.x[i] - this.left) * this.scale, height - margin - (strip.y[i] - this.bottom) * this.scale];
      g.lineWidth = 0.5;
      g.strokeStyle = '#9aa3ad';
      for (let i = 0; i < strip.x.length; ++i) {
        const [x, y] = this.at(i);
        g.beginPath();
        g.arc(x, y, strip.radius[i] * this.scale, 0, 2 * Math.PI);
        const level = this.level(i);
        g.fillStyle = level === 255 ? '#c4c4c4' : this.colors[level];
        g.fill();
        g.stroke();
      }
      this.drawProbes(g, height, margin);
    }

    // Labels of a row are moved apart as little as keeps them from touching.
    drawLabels(g, probes, y) {
      const gap = 6, row = probes.map((p) => ({ text: p.label, x: (p.x - this.left) * this.scale, width: g.measureText(p.label).width })).sort((a, b) => a.x - b.x);
      row.forEach((label, i) => {
        if (i > 0) label.x = Math.max(label.x, row[i - 1].x + (row[i - 1].width + label.width) / 2 + gap);
        g.fillText(label.text, label.x, y);
      });
    }

    drawProbes(g, height, margin) {
      g.font = `600 12px ${font.family}`;
      g.textAlign = 'center';
      const probes = this.strip.probes ?? [];
      for (const probe of probes) {
        const x = (probe.x - this.left) * this.scale, y = height - margin - (probe.y - this.bottom) * this.scale;
        g.beginPath();
        g.arc(x, y, Math.max(2.5, this.scale * Math.min(...this.strip.radius) * 0.5), 0, 2 * Math.PI);
        g.fillStyle = '#fff';
        g.strokeStyle = '#111';
        g.lineWidth = 1.5;
        g.fill();
        g.stroke();
      }
      if (this.scale * this.wide < 300) return;
      const above = (p) => p.y - this.bottom > this.high / 2;
      g.fillStyle = '#222';
      this.drawLabels(g, probes.filter(above), 14);
      this.drawLabels(g, probes.filter((p) => !above(p)), height - 6);
    }

    point(event) {
      const box = this.canvas.getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top;
      const disc = this.strip.x.findIndex((_, i) => Math.hypot(this.at(i)[0] - x, this.at(i)[1] - y) <= this.strip.radius[i] * this.scale);
      this.tip.hidden = disc === -1;
      if (disc === -1) return;
      const { marks } = this.strip.fields[this.field], level = this.level(disc);
      const value = (marks.lower + (level / 254) * (marks.upper - marks.lower)) * 10 ** -marks.exponent;
      this.tip.textContent = `disc ${disc}: ${level === 255 ? 'no value' : number(value)}`;
      this.tip.style.left = `${Math.min(x + 12, box.width - 130)}px`;
      this.tip.style.top = `${y + 12}px`;
    }
  }

  const filmControls = (strips, views) => {
    const [first] = strips, frames = first.times.length;
    const select = make('select', {}, ...first.fields.map((f, i) => make('option', { value: i, textContent: f.axis.label })));
    const slider = make('input', { type: 'range', min: 0, max: frames - 1, step: 1, value: Math.floor(frames / 2) });
    const clock = make('output');
    const play = make('button', { type: 'button', textContent: 'Play' });
    const show = () => {
      const frame = Number(slider.value), field = Number(select.value), text = `${(first.times[frame] * 1e6).toFixed(2)} µs`;
      clock.textContent = text;
      slider.setAttribute('aria-valuetext', text);
      views.forEach((view, i) => {
        view.show(field, frame);
        view.canvas.setAttribute('aria-label', `${strips[i].title}: ${first.fields[field].axis.label} of the discs at ${text}`);
      });
    };
    let timer = 0;
    const stop = () => {
      clearInterval(timer);
      timer = 0;
      play.textContent = 'Play';
    };
    play.addEventListener('click', () => {
      if (timer) return stop();
      play.textContent = 'Pause';
      timer = setInterval(() => {
        slider.value = (Number(slider.value) + 1) % frames;
        show();
      }, 160);
    });
    slider.addEventListener('input', () => { stop(); show(); });
    select.addEventListener('change', show);
    show();
    return make('div', { className: 'controls' }, make('label', {}, 'Colour ', select), play, make('label', { className: 'time' }, 'Time ', slider, clock));
  };

  // ---- The numbers of a figure, one row a point, in the order of the CSV of an SVG figure.
  const csvOf = (figure) => {
    const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
    const lines = ['panel,kind,name,x,y,error,lower,upper,radius,value'];
    const row = (panel, kind, name, v) => lines.push([quoted(panel), kind, quoted(name),
      ...['x', 'y', 'error', 'lower', 'upper', 'radius', 'value'].map((key) => v[key] ?? '')].join(','));
    figure.panels.forEach((panel, index) => {
      const title = panel.title || String(index + 1);
      for (const s of panel.series ?? []) s.x.forEach((x, i) => row(title, 'series', s.name ?? '', { x, y: s.y[i], error: s.error[i] }));
      panel.map?.value.forEach((value, i) => row(title, 'cell', panel.map.value_axis.label,
        { x: panel.map.x[i % panel.map.x.length], y: panel.map.y[Math.floor(i / panel.map.x.length)], value }));
      for (const b of panel.bands ?? []) b.x.forEach((x, i) => row(title, 'band', b.name ?? '', { x, lower: b.lower[i], upper: b.upper[i] }));
      for (const r of panel.references ?? []) row(title, 'reference', r.label ?? '', r.direction === 'horizontal' ? { y: r.value } : { x: r.value });
      for (const p of panel.picks ?? []) row(title, 'pick', [p.series, p.label].filter(Boolean).join(', '), p);
      for (const p of panel.probes ?? []) row(title, 'probe', p.label, p);
      if (panel.type === 'strip') panel.x.forEach((x, i) => row(title, 'disc', String(i), { x, y: panel.y[i], radius: panel.radius[i], value: panel.value[i] }));
    });
    return lines.join('\n') + '\n';
  };
  const offerCsv = (host, figure) => {
    const link = make('a', { download: `${figure.id}.csv`, textContent: 'Download CSV', href: URL.createObjectURL(new Blob([csvOf(figure)], { type: 'text/csv' })) });
    link.append(make('span', { className: 'hidden', textContent: ` of ${figure.title}` }));
    host.querySelector('.csv')?.replaceChildren(link, figure.thinned ? ' (SI units, six digits; long series are thinned, their extremes kept)' : ' (SI units, six digits, all points)');
  };

  const draw = (host) => {
    const figure = readFigure(host.querySelector('script.figure-data'));
    const live = host.querySelector('.live'), panels = make('div', { className: 'panels' });
    const plots = [], strips = [], views = [];
    const count = figure.panels.filter((p) => p.type === 'plot').length;
    const columns = count < 2 ? 1 : Math.min(count, figure.columns || (count === 3 ? 3 : 2), 4);
    panels.style.setProperty('--columns', columns);
    panels.classList.toggle('single', columns === 1);
    const jobs = figure.panels.map((panel) => {
      const box = make('div', { className: `panel ${panel.type}` });
      if (figure.panels.some((p) => p.title)) box.append(make('p', { className: 'ptitle', textContent: panel.title || '\u00a0' }));
      panels.append(box);
      if (panel.type === 'plot') {
        const plot = make('div', { className: 'canvas' });
        plot.setAttribute('role', 'group');
        plot.setAttribute('aria-label', `${figure.title}${panel.title ? `, ${panel.title}` : ''}: interactive plot`);
        box.append(plot);
        return () => drawPlot(plot, panel, figure).then((done) => plots.push(done));
      }
      strips.push(panel);
      views.push(new StripView(box, panel));
      return () => Promise.resolve();
    });
    live.append(legend(figure, plots), strips.length ? filmControls(strips, views) : '', panels);
    host.classList.add('is-live');
    offerCsv(host, figure);
    return Promise.all(jobs.map((job) => job())).then(() => {
      host.dataset.drawn = 'true';
    });
  };

  setUpFilters();
  if (typeof Plotly === 'undefined' || !palette) return;
  page.classList.add('with-plotly');
  const waiting = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      if (!entry.isIntersecting) continue;
      waiting.unobserve(entry.target);
      draw(entry.target);
    }
  }, { rootMargin: '800px' });
  for (const script of all('script.figure-data')) waiting.observe(script.closest('figure'));
})();
