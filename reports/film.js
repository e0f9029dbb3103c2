// A strip over time in report.html: discs on a canvas, coloured by what a field is at a time, and the slider.
const ddemFilm = (() => {
  const { make, palette, font } = ddemPage;

  const colorTable = (anchors) =>
    Array.from({ length: 255 }, (_, i) => {
      const position = (i / 254) * (anchors.length - 1),
        left = Math.min(anchors.length - 2, Math.floor(position)),
        f = position - left;
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
      this.canvas.addEventListener('pointerleave', () => {
        this.tip.hidden = true;
      });
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
      this.bar.replaceChildren(
        make('span', {
          className: 'ramp',
          style: `background:linear-gradient(90deg,${this.colors.filter((_, i) => i % 16 === 0).join(',')})`,
        }),
        make('span', { className: 'ends' }, ...ends.map((text) => make('span', { textContent: text }))),
        make('span', { className: 'what', textContent: field.marks.title }),
      );
    }

    level(disc) {
      return this.levels[this.field][this.frame * this.strip.x.length + disc];
    }

    draw() {
      const width = this.canvas.parentElement.clientWidth;
      if (!width || this.field === undefined) return;
      const { strip } = this,
        ratio = window.devicePixelRatio || 1,
        margin = 22;
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
      const gap = 6,
        row = probes
          .map((p) => ({ text: p.label, x: (p.x - this.left) * this.scale, width: g.measureText(p.label).width }))
          .sort((a, b) => a.x - b.x);
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
        const x = (probe.x - this.left) * this.scale,
          y = height - margin - (probe.y - this.bottom) * this.scale;
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
      this.drawLabels(
        g,
        probes.filter((p) => !above(p)),
        height - 6,
      );
    }

    point(event) {
      const box = this.canvas.getBoundingClientRect(),
        x = event.clientX - box.left,
        y = event.clientY - box.top;
      const disc = this.strip.x.findIndex(
        (_, i) => Math.hypot(this.at(i)[0] - x, this.at(i)[1] - y) <= this.strip.radius[i] * this.scale,
      );
      this.tip.hidden = disc === -1;
      if (disc === -1) return;
      const { marks } = this.strip.fields[this.field],
        level = this.level(disc);
      const value = (marks.lower + (level / 254) * (marks.upper - marks.lower)) * 10 ** -marks.exponent;
      this.tip.textContent = `disc ${disc}: ${level === 255 ? 'no value' : number(value)}`;
      this.tip.style.left = `${Math.min(x + 12, box.width - 130)}px`;
      this.tip.style.top = `${y + 12}px`;
    }
  }

  const filmControls = (strips, views) => {
    const [first] = strips,
      frames = first.times.length;
    const select = make('select', {}, ...first.fields.map((f, i) => make('option', { value: i, textContent: f.axis.label })));
    const slider = make('input', { type: 'range', min: 0, max: frames - 1, step: 1, value: Math.floor(frames / 2) });
    const clock = make('output');
    const play = make('button', { type: 'button', textContent: 'Play' });
    const show = () => {
      const frame = Number(slider.value),
        field = Number(select.value),
        text = `${(first.times[frame] * 1e6).toFixed(2)} µs`;
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
    slider.addEventListener('input', () => {
      stop();
      show();
    });
    select.addEventListener('change', show);
    show();
    return make(
      'div',
      { className: 'controls' },
      make('label', {}, 'Colour ', select),
      play,
      make('label', { className: 'time' }, 'Time ', slider, clock),
    );
  };

  return { StripView, filmControls };
})();
