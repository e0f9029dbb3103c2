// The interactive figures of report.html, where the page carries plotly.
(() => {
  const { all, make, palette, font } = ddemPage;
  const { StripView, filmControls } = ddemFilm;
  const dashes = { solid: 'solid', dashed: 'dash', dotted: 'dot' };
  const symbols = { circle: 'circle', square: 'square', triangle: 'triangle-up', diamond: 'diamond' };
  const coarse = window.matchMedia('(pointer: coarse)').matches;

  // Three bytes a number, the first ones of its single precision; what is not finite is null.
  const unpacked = (text) => {
    const bytes = atob(text),
      bits = new DataView(new ArrayBuffer(4));
    return Array.from({ length: bytes.length / 3 }, (_, i) => {
      for (let k = 0; k < 3; ++k) bits.setUint8(k, bytes.charCodeAt(3 * i + k));
      const value = bits.getFloat32(0);
      return Number.isFinite(value) ? Number(value.toPrecision(6)) : null;
    });
  };

  const readFigure = (script) => {
    const { figure, arrays } = JSON.parse(script.textContent);
    const array = (a) =>
      Array.isArray(a) ? a : 'packed' in a ? unpacked(a.packed) : Array.from({ length: a.count }, (_, i) => a.from + i * a.step);
    const values = arrays.map(array);
    figure.digits = arrays.some((a) => 'packed' in a) ? 'five' : 'six';
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
  // A tick a decade; within two decades at 1, 2 and 5; closer those that plotly finds. range: of logarithms.
  const powerText = (digit, power) =>
    Math.abs(power) < 4
      ? String(Number(`${digit}e${power}`))
      : `${digit === 1 ? '' : `${digit}×`}10${String(power).replace(/./g, (c) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[c] ?? '⁻')}`;
  const logTicks = (range) => {
    const [lower, upper] = [Math.min(...range), Math.max(...range)],
      decades = upper - lower;
    if (decades < 0.6) return { tickmode: 'auto' };
    const digits = decades < 2 ? [1, 2, 5] : [1],
      stride = Math.ceil(decades / 7);
    const ticks = [];
    for (let power = Math.floor(lower / stride) * stride; power <= upper; power += stride)
      ticks.push(...digits.map((digit) => ({ digit, power })).filter((t) => Math.log10(t.digit) + t.power >= lower - 1e-9));
    const shown = ticks.filter((t) => Math.log10(t.digit) + t.power <= upper + 1e-9);
    return {
      tickmode: 'array',
      tickvals: shown.map((t) => Number(`${t.digit}e${t.power}`)),
      ticktext: shown.map((t) => powerText(t.digit, t.power)),
    };
  };
  const plotAxis = (marks) => {
    const ends = scaled([marks.lower, marks.upper], marks);
    return {
      ...(marks.log ? logTicks(ends.map(Math.log10)) : {}),
      type: marks.log ? 'log' : 'linear',
      range: marks.log ? ends.map(Math.log10) : ends,
      exponentformat: 'power',
      minexponent: 4,
      gridcolor: '#e3e6ea',
      zeroline: false,
      linecolor: '#7a828c',
      ticks: '',
      nticks: 7,
      automargin: true,
      tickfont: { color: '#444' },
      hoverformat: '.5~g',
    };
  };
  const rgba = (hex, alpha) => `rgba(${[1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)).join(',')},${alpha})`;

  const bandTrace = (band, style, panel) => {
    const x = scaled(band.x, panel.xmarks),
      lower = scaled(band.lower, panel.ymarks),
      upper = scaled(band.upper, panel.ymarks);
    const outline = { x: [], y: [] };
    for (let begin = 0; begin < x.length;) {
      const whole = (i) => i < x.length && x[i] !== null && lower[i] !== null && upper[i] !== null;
      let end = begin;
      while (whole(end)) ++end;
      if (end > begin) {
        if (outline.x.length) (outline.x.push(null), outline.y.push(null));
        outline.x.push(...x.slice(begin, end), ...x.slice(begin, end).reverse());
        outline.y.push(...upper.slice(begin, end), ...lower.slice(begin, end).reverse());
      }
      begin = Math.max(end, begin + 1);
    }
    return {
      ...outline,
      type: 'scatter',
      mode: 'lines',
      fill: 'toself',
      fillcolor: rgba(style.color, 0.2),
      line: { width: 0 },
      hoverinfo: 'skip',
    };
  };

  const seriesTrace = (series, style, panel) => {
    const name = series.name ? `<b>${series.name}</b><br>` : '';
    const trace = {
      type: 'scatter',
      x: scaled(series.x, panel.xmarks),
      y: scaled(series.y, panel.ymarks),
      connectgaps: false,
      mode: { line: 'lines', markers: 'markers', line_markers: 'lines+markers' }[series.kind],
      line: { color: style.color, width: 1.8, dash: dashes[series.dash] },
      marker: { color: style.color, size: 8, symbol: symbols[style.marker], line: { color: '#fff', width: 0.8 } },
      hovertemplate: `${name}${panel.xmarks.title}: %{x}<br>${panel.ymarks.title}: %{y}<extra></extra>`,
    };
    if (series.error.length)
      trace.error_y = { type: 'data', array: scaled(series.error, panel.ymarks), thickness: 1.3, width: 3.5, color: style.color };
    return trace;
  };

  const pickTrace = (pick, panel) => ({
    type: 'scatter',
    mode: 'markers',
    x: scaled([pick.x], panel.xmarks),
    y: scaled([pick.y], panel.ymarks),
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
    const fraction = colorFraction(map),
      columns = map.x.length;
    const rows = (of) => map.y.map((_, r) => map.value.slice(r * columns, (r + 1) * columns).map(of));
    const signed = map.color_scale === 'signed_log';
    const colors = signed ? palette.diverging : palette.white_to_blue;
    return {
      type: 'heatmap',
      x: scaled(map.x, panel.xmarks),
      y: scaled(map.y, panel.ymarks),
      z: rows((v) => (v === null ? null : fraction(v))),
      zmin: 0,
      zmax: 1,
      customdata: rows((v) => v),
      colorscale: colors.map((c, i) => [i / (colors.length - 1), c]),
      hoverongaps: false,
      colorbar: {
        title: { text: map.title, side: 'right', font: { size: 12 } },
        thickness: 10,
        outlinewidth: 0,
        len: 1,
        tickvals: map.ticks.map((t) => t.at),
        ticktext: map.ticks.map((t) => t.label),
        tickfont: { size: 11 },
      },
      hovertemplate: `${panel.xmarks.title}: %{x}<br>${panel.ymarks.title}: %{y}<br>${map.title}: %{customdata:.3~g}<extra></extra>`,
    };
  };

  const lineShape = (position, horizontal, marks, line, label) => {
    const at = scaled([position], marks)[0];
    const shape = horizontal
      ? { xref: 'paper', x0: 0, x1: 1, yref: 'y', y0: at, y1: at }
      : { yref: 'paper', y0: 0, y1: 1, xref: 'x', x0: at, x1: at };
    const text = label
      ? {
          label: {
            text: label,
            textposition: 'end',
            font: { size: 12, color: '#333' },
            textangle: 0,
            xanchor: horizontal ? 'right' : 'left',
            yanchor: horizontal ? 'bottom' : 'top',
          },
        }
      : {};
    return { type: 'line', line, layer: 'above', ...shape, ...text };
  };

  const drawPlot = (host, panel, figure) => {
    const traces = [],
      styles = [];
    const add = (trace, style) => {
      traces.push({ showlegend: false, ...trace });
      styles.push(style);
    };
    if (panel.map) add(mapTrace(panel.map, panel), -1);
    for (const b of panel.bands ?? []) add(bandTrace(b, figure.styles[b.style], panel), b.style);
    for (const s of panel.series ?? []) add(seriesTrace(s, figure.styles[s.style], panel), s.style);
    for (const p of panel.picks ?? []) if (p.y !== undefined) add(pickTrace(p, panel), p.style ?? -1);
    const shapes = [
      ...(panel.references ?? []).map((r) =>
        lineShape(
          r.value,
          r.direction === 'horizontal',
          r.direction === 'horizontal' ? panel.ymarks : panel.xmarks,
          { color: '#555', width: 1.3, dash: dashes[r.dash] },
          r.label,
        ),
      ),
      ...(panel.picks ?? []).map((p) => lineShape(p.x, false, panel.xmarks, { color: p.color, width: 1.1, dash: 'dot' }, p.label)),
    ];
    const layout = {
      font,
      plot_bgcolor: panel.map ? '#c4c4c4' : '#fafbfc',
      paper_bgcolor: '#fff',
      margin: { l: 46, r: panel.map ? 8 : 14, t: 26, b: 40 },
      shapes,
      hovermode: 'closest',
      dragmode: coarse ? false : 'zoom',
      hoverlabel: { bgcolor: '#fff', bordercolor: '#b8bfc7', font: { ...font, color: '#1b1f24' } },
      xaxis: { ...plotAxis(panel.xmarks), title: { text: panel.xmarks.title, standoff: 6, font: { size: 13 } } },
      yaxis: plotAxis(panel.ymarks),
      annotations: [
        {
          text: panel.ymarks.title,
          xref: 'paper',
          yref: 'paper',
          x: 0,
          y: 1,
          xanchor: 'left',
          yanchor: 'bottom',
          yshift: 4,
          xshift: -6,
          showarrow: false,
          font: { size: 13 },
        },
      ],
    };
    const config = {
      responsive: true,
      displaylogo: false,
      scrollZoom: false,
      modeBarButtonsToRemove: ['select2d', 'lasso2d', 'autoScale2d'],
      toImageButtonOptions: { format: 'svg', filename: figure.id },
    };
    return Plotly.newPlot(host, traces, layout, config).then(() => {
      host.on('plotly_relayout', () => {
        const change = {};
        for (const name of ['xaxis', 'yaxis']) {
          const axis = host.layout[name];
          if (axis.type !== 'log') continue;
          const ticks = logTicks(axis.range);
          const same = ticks.tickmode === 'auto' || String(ticks.ticktext) === String(axis.ticktext);
          if (same && ticks.tickmode === axis.tickmode) continue;
          for (const [key, value] of Object.entries(ticks)) change[`${name}.${key}`] = value;
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
    if (style.line)
      parts.push(`<line x1="0" x2="26" y1="7" y2="7" stroke="${style.color}" stroke-width="2" stroke-dasharray="${dash}"/>`);
    const shapes = {
      circle: '<circle cx="13" cy="7" r="4"/>',
      square: '<rect x="9" y="3" width="8" height="8"/>',
      triangle: '<path d="M13 2l5 9h-10z"/>',
      diamond: '<path d="M13 2l5 5-5 5-5-5z"/>',
    };
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

  // ---- The numbers of a figure, one row a point, in the order of the CSV of an SVG figure.
  const csvOf = (figure) => {
    const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
    const lines = ['panel,kind,name,x,y,error,lower,upper,radius,value'];
    const row = (panel, kind, name, v) =>
      lines.push(
        [quoted(panel), kind, quoted(name), ...['x', 'y', 'error', 'lower', 'upper', 'radius', 'value'].map((key) => v[key] ?? '')].join(
          ',',
        ),
      );
    figure.panels.forEach((panel, index) => {
      const title = panel.title || String(index + 1);
      for (const s of panel.series ?? []) s.x.forEach((x, i) => row(title, 'series', s.name ?? '', { x, y: s.y[i], error: s.error[i] }));
      panel.map?.value.forEach((value, i) =>
        row(title, 'cell', panel.map.value_axis.label, {
          x: panel.map.x[i % panel.map.x.length],
          y: panel.map.y[Math.floor(i / panel.map.x.length)],
          value,
        }),
      );
      for (const b of panel.bands ?? [])
        b.x.forEach((x, i) => row(title, 'band', b.name ?? '', { x, lower: b.lower[i], upper: b.upper[i] }));
      for (const r of panel.references ?? [])
        row(title, 'reference', r.label ?? '', r.direction === 'horizontal' ? { y: r.value } : { x: r.value });
      for (const p of panel.picks ?? []) row(title, 'pick', [p.series, p.label].filter(Boolean).join(', '), p);
      for (const p of panel.probes ?? []) row(title, 'probe', p.label, p);
      if (panel.type === 'strip')
        panel.x.forEach((x, i) => row(title, 'disc', String(i), { x, y: panel.y[i], radius: panel.radius[i], value: panel.value[i] }));
    });
    return lines.join('\n') + '\n';
  };
  const offerCsv = (host, figure) => {
    const link = make('a', {
      download: `${figure.id}.csv`,
      textContent: 'Download CSV',
      href: URL.createObjectURL(new Blob([csvOf(figure)], { type: 'text/csv' })),
    });
    link.append(make('span', { className: 'hidden', textContent: ` of ${figure.title}` }));
    const points = figure.thinned ? 'long series are thinned, their extremes kept' : 'all points';
    const note = ` (SI units, ${figure.digits} digits, ${points}; figures/${figure.id}.csv beside this page has every digit)`;
    const copy = make('button', { type: 'button', textContent: 'Copy' });
    copy.append(make('span', { className: 'hidden', textContent: ` the data of ${figure.title}` }));
    copy.addEventListener('click', async () => {
      await navigator.clipboard.writeText(csvOf(figure));
      copy.firstChild.textContent = 'Copied';
      setTimeout(() => (copy.firstChild.textContent = 'Copy'), 2000);
    });
    host.querySelector('.csv')?.replaceChildren(link, navigator.clipboard ? ' ' : '', navigator.clipboard ? copy : '', note);
  };

  // Between two panels the page listens.
  const breath = () => new Promise((done) => setTimeout(done));
  const draw = async (host) => {
    const figure = readFigure(host.querySelector('script.figure-data'));
    const live = host.querySelector('.live'),
      panels = make('div', { className: 'panels' });
    const plots = [],
      strips = [],
      views = [];
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
    for (const job of jobs) {
      await job();
      await breath();
    }
    host.dataset.drawn = 'true';
  };

  const source = document.getElementById('plotly');
  if (!source || !palette) return;
  // 1.5 MB, for which the page does not listen for 0.4 s: when the first figure comes near, not while it opens.
  let library;
  const plotly = () =>
    (library ??= new Promise((done) => {
      document.head.append(make('script', { textContent: source.textContent }));
      setTimeout(done);
    }));
  let queue = breath();
  const waiting = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) {
        if (!entry.isIntersecting) continue;
        waiting.unobserve(entry.target);
        queue = queue.then(plotly).then(() => draw(entry.target)).catch(console.error); // one figure costs no other
      }
    },
    { rootMargin: '300px' },
  );
  for (const script of all('script.figure-data')) waiting.observe(script.closest('figure'));
})();
