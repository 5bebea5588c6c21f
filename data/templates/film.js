"use strict";
// Draws every film of a page: <script class="film-data"> holds the data of the one around it. The program
// that writes the page only fills in these data; nothing is fetched.
(() => {
  const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  const worth = new Map([...digits].map((letter, i) => [letter, i]));
  const greek = {
    alpha: "α", beta: "β", gamma: "γ", delta: "δ", epsilon: "ε", zeta: "ζ", eta: "η", theta: "θ", iota: "ι", kappa: "κ", lambda: "λ", mu: "μ",
    nu: "ν", xi: "ξ", pi: "π", rho: "ρ", sigma: "σ", tau: "τ", upsilon: "υ", phi: "φ", chi: "χ", psi: "ψ", omega: "ω",
    Gamma: "Γ", Delta: "Δ", Theta: "Θ", Lambda: "Λ", Xi: "Ξ", Pi: "Π", Sigma: "Σ", Phi: "Φ", Psi: "Ψ", Omega: "Ω" };
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const dark = matchMedia("(prefers-color-scheme: dark)");

  function unpack({ lo, hi, d }) {
    const values = new Float64Array(d.length / 3);
    for (let i = 0; i < values.length; i++) {
      const k = 4096 * worth.get(d[3 * i]) + 64 * worth.get(d[3 * i + 1]) + worth.get(d[3 * i + 2]);
      values[i] = lo + (hi - lo) * (k / 262143);
    }
    return values;
  }

  // A series at frame s, which may lie between two: the cubic through the four around it.
  function at(series, s) {
    if (typeof series === "number") return series;
    const last = series.length - 1, i = Math.max(0, Math.min(last - 1, Math.floor(s))), f = s - i;
    if (last < 1) return series[0];
    const b = series[i], c = series[i + 1];
    if (f <= 0) return b;
    if (f >= 1) return c;
    const a = i > 0 ? series[i - 1] : 2 * b - c, d = i + 2 <= last ? series[i + 2] : 2 * c - b;
    return b + 0.5 * f * (c - a + f * (2 * a - 5 * b + 4 * c - d + f * (3 * (b - c) + d - a)));
  }

  function letter(name) {  // theta1 -> θ₁
    const [, stem, number] = /^(.*?)_?(\d*)$/.exec(name);
    return (greek[stem] ?? stem) + [...number].map(n => "₀₁₂₃₄₅₆₇₈₉"[n]).join("");
  }
  const written = text => text.replace(/\^(-?\d+)/g, (_, n) => [...n].map(c => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]).join("")).replace(/ (?=[a-zA-Z])/g, "\u00a0");
  const dotted = name => { const text = letter(name); return text[0] + "\u0307" + text.slice(1); };

  function power(text) {  // 1.2e-9 -> 1.2·10⁻⁹
    const [mantissa, exponent] = text.split("e");
    if (exponent === undefined) return text.replace("-", "−");
    const raised = [...String(+exponent)].map(c => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]).join("");
    return mantissa.replace("-", "−") + "·10" + raised;
  }
  const unsigned = text => /^-[0.]*$/.test(text) ? text.slice(1) : text;  // no sign of a zero
  const exponent = x => Math.floor(Math.log10(x) + 1e-12);
  function number(x, n = 4, scale = Math.abs(x)) {  // n digits of the largest that stands in this place
    if (!Number.isFinite(x)) return "–";
    if (!(scale > 0)) return "0";
    const k = exponent(scale);
    if (k < 5 && k > -3) return unsigned(x.toFixed(Math.max(0, n - 1 - k))).replace("-", "−");
    const mantissa = (x / 10 ** k).toFixed(n - 1);
    return Number(mantissa) === 0 ? "0" : power(`${mantissa}e${k}`);
  }

  function make(tag, attributes = {}, ...children) {
    const element = document.createElement(tag);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children);
    return element;
  }

  function niceStep(width, count) {
    const rough = width / Math.max(1, count), unit = 10 ** Math.floor(Math.log10(rough));
    return unit * ([1, 2, 5].find(m => m * unit >= rough) ?? 10);
  }

  const sized = new Set(["box", "cart"]);                 // their second place is a size
  const endless = new Set(["line", "ground"]);            // only their first place bounds the picture
  const fixed = new Set(["ground", "plane", "field", "axis", "trail", "line", "pivot", "frame"]);  // no ghost

  class Film {
    constructor(data) {
      Object.assign(this, data);
      this.channels = data.channels.map(unpack);
      const series = x => typeof x === "number" ? x : this.channels[x.c];
      const all = list => list?.map(item => item.map(series));
      this.places = all(data.places);
      this.ghost = all(data.ghost);
      this.states = all(data.states);
      this.ghostStates = all(data.ghost_states);
      this.energy = series(data.energy);
      this.kinetic = series(data.kinetic);
      this.distance = data.distance === undefined ? undefined : this.channels[data.distance];
      this.duration = this.end - this.start;
      const spaces = this.parts.flatMap(({ kind, at: list }) => kind === "field" ? [] : sized.has(kind) ? list.slice(0, 1) : list);
      this.solid = spaces.some(k => this.places[k][2] !== 0);
      this.scroll();
      this.bound();
    }
    frame(t) {  // the last interval may be shorter
      const before = this.interval * (this.count - 2);
      const s = (t - this.start) / this.interval;
      if (this.count < 2) return 0;
      if (t - this.start <= before) return Math.max(0, s);
      return this.count - 2 + Math.min(1, (t - this.start - before) / Math.max(this.duration - before, 1e-300));
    }
    time(i) { return Math.min(this.start + i * this.interval, this.end); }
    scroll() {  // how much of the time the graph of the energies shows: some 60 turns of T
      const [lo, hi] = range([this.kinetic]), still = !(hi - lo > 1e-6 * Math.max(Math.abs(lo), Math.abs(hi)));
      let turns = 0, from = at(this.kinetic, 0), way = 0;
      for (let i = 1; i < this.count && !still; i++) {  // what is smaller than a twentieth of its range is none
        const x = at(this.kinetic, i);
        if (way * (x - from) > 0) from = x;
        else if (Math.abs(x - from) > (hi - lo) / 20) { way = Math.sign(x - from); from = x; turns++; }
      }
      this.span = this.duration * Math.min(1, 60 / Math.max(turns, 1));
    }
    box(i) {  // around all that is drawn at frame i
      const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      const take = (r, rho = 0) => r.forEach((x, k) => {
        low[k] = Math.min(low[k], x - rho);
        high[k] = Math.max(high[k], x + rho);
      });
      for (const places of [this.places, this.ghost]) {
        if (!places) continue;
        const r = k => places[k].map(series => at(series, i));
        for (const { kind, at: list } of this.parts) {
          if (kind === "field") continue;
          if (sized.has(kind)) take(r(list[0]), Math.max(...r(list[1]).slice(0, 2)) / 2);
          else if (endless.has(kind)) take(r(list[0]));
          else if (kind === "circle" || kind === "wheel" || kind === "round") {
            const c = r(list[0]), a = r(list[1]);
            take(c, Math.hypot(...a.map((x, k) => x - c[k])));
          } else list.forEach(k => take(r(k)));
        }
      }
      if (!Number.isFinite(low[0])) take([0, 0, 0], 1);
      if (!this.solid) low[2] = high[2] = 0;
      return [low, high];
    }
    bound() {
      const width = ([low, high]) => Math.hypot(...high.map((x, k) => x - low[k]));
      const stride = Math.max(1, Math.floor(this.count / 600));
      let [low, high] = this.box(0);
      this.widest = 0;
      for (let i = 0; i < this.count; i += stride) {
        const box = this.box(i);
        this.widest = Math.max(this.widest, width(this.moving(box, i)));
        low = low.map((x, k) => Math.min(x, box[0][k]));
        high = high.map((x, k) => Math.max(x, box[1][k]));
      }
      this.low = low;
      this.high = high;
      this.extent = width([low, high]) || 1;
      this.far = !this.solid && this.widest > 0 && this.widest < 0.15 * (high[0] - low[0]);  // the camera goes along
    }
    moving(box, i) {  // the same without what stands still
      const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      for (const { kind, at: list } of this.parts) {
        if (kind === "field" || kind === "trail") continue;
        const place = this.places[list[0]];
        if (endless.has(kind) && place.every(series => typeof series === "number")) continue;
        for (const k of sized.has(kind) ? list.slice(0, 1) : list) this.places[k].forEach((series, axis) => {
          low[axis] = Math.min(low[axis], at(series, i));
          high[axis] = Math.max(high[axis], at(series, i));
        });
      }
      return Number.isFinite(low[0]) ? [low, high] : box;
    }
  }

  class Canvas {
    constructor(label, parent) {
      this.canvas = make("canvas", { role: "img", "aria-label": label });
      this.context = this.canvas.getContext("2d");
      parent.append(this.canvas);
    }
    begin() {  // returns the width and the height in CSS pixels
      const { clientWidth: w, clientHeight: h } = this.canvas.parentElement;
      const ratio = Math.min(3, window.devicePixelRatio || 1);
      if (this.canvas.width !== Math.round(w * ratio) || this.canvas.height !== Math.round(h * ratio)) {
        this.canvas.width = Math.round(w * ratio);
        this.canvas.height = Math.round(h * ratio);
      }
      this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
      this.context.clearRect(0, 0, w, h);
      return [w, h];
    }
  }

  // The mechanism.
  class Stage extends Canvas {
    constructor(parent, label) {
      super(label, parent);
      this.azimuth = -1.05;
      this.elevation = 0.45;
      this.element = parent;
    }
    look(film, s, w, h) {  // from places, m, to pixels
      const [sa, ca, se, ce] = [Math.sin(this.azimuth), Math.cos(this.azimuth), Math.sin(this.elevation), Math.cos(this.elevation)];
      const flat = film.solid ? r => [-sa * r[0] + ca * r[1], -se * ca * r[0] - se * sa * r[1] + ce * r[2]] : r => [r[0], r[1]];
      let x0 = Infinity, x1 = -Infinity, y0 = Infinity, y1 = -Infinity;
      let { low, high } = film;
      if (film.far) {
        const [from, to] = film.moving(undefined, s), middle = from.map((x, k) => (x + to[k]) / 2);
        const reach = 0.7 * Math.max(film.widest, high[1] - low[1]);
        low = [middle[0] - reach, low[1], low[2]];
        high = [middle[0] + reach, high[1], high[2]];
      }
      for (let corner = 0; corner < 8; corner++) {
        const [x, y] = flat([0, 1, 2].map(k => corner >> k & 1 ? high[k] : low[k]));
        x0 = Math.min(x0, x); x1 = Math.max(x1, x); y0 = Math.min(y0, y); y1 = Math.max(y1, y);
      }
      const margin = 7 * this.unit + 4, least = film.far ? 0 : 0.25 * film.extent;
      const width = Math.max(x1 - x0, least), height = Math.max(y1 - y0, least);
      this.scale = Math.max(1e-300, Math.min((w - 2 * margin) / width, (h - 2 * margin) / height));
      this.flat = flat;
      this.project = r => {
        const [x, y] = flat(r);
        return [w / 2 + this.scale * (x - (x0 + x1) / 2), h / 2 - this.scale * (y - (y0 + y1) / 2)];
      };
    }
    draw(film, s, colors, { trail, ghost, recent }) {
      const [w, h] = this.begin(), pen = this.context;
      this.unit = Math.max(1.3, Math.min(w, h) / 170);
      this.size = [w, h];
      this.colors = colors;
      this.look(film, s, w, h);
      pen.lineCap = pen.lineJoin = "round";
      pen.font = `${Math.max(13, 4.5 * this.unit)}px system-ui, "DejaVu Sans", sans-serif`;
      if (film.parts.length === 0) return this.dials(film, s);
      const fields = film.parts.filter(part => part.kind === "field");
      if (ghost && film.ghost) this.parts(film, film.ghost, s, true, trail, recent);
      this.parts(film, film.places, s, false, trail, recent);
      fields.forEach((part, i) => this.field(part, film.places[part.at[0]].map(series => at(series, s)), i));
    }
    parts(film, places, s, ghost, trail, recent) {
      const { context: pen, colors } = this;
      pen.setLineDash(ghost ? [3 * this.unit, 3 * this.unit] : []);
      this.ink = ghost ? colors.ghost : colors.body;
      this.fill = ghost ? "transparent" : colors.fill;
      for (const part of film.parts) {
        if (part.kind === "field" || ghost && fixed.has(part.kind)) continue;
        if (part.kind === "trail") { if (trail) this.trail(places[part.at[0]], s, recent); continue; }
        this[part.kind](part.at.map(k => places[k].map(series => at(series, s))));
      }
      pen.setLineDash([]);
    }
    stroke(points, width, color, close = false, fill = undefined) {
      const pen = this.context;
      pen.beginPath();
      points.forEach(([x, y], i) => i ? pen.lineTo(x, y) : pen.moveTo(x, y));
      if (close) pen.closePath();
      if (fill) { pen.fillStyle = fill; pen.fill(); }
      if (color) { pen.strokeStyle = color; pen.lineWidth = width * this.unit; pen.stroke(); }
    }
    dot([x, y], radius, color, edge) {
      const pen = this.context;
      pen.beginPath();
      pen.arc(x, y, radius * this.unit, 0, 2 * Math.PI);
      pen.fillStyle = color;
      pen.fill();
      if (edge) { pen.strokeStyle = edge; pen.lineWidth = this.unit; pen.stroke(); }
    }
    rod(r) { this.stroke(r.map(this.project), 1.7, this.ink); }
    rope(r) { this.stroke(r.map(this.project), 0.8, this.ink); }
    ball([r]) { this.dot(this.project(r), 4, this.fill === "transparent" ? this.colors.panel : this.ink, this.ink); }
    axis(r) {
      this.context.setLineDash([2 * this.unit, 3 * this.unit]);
      this.stroke(r.map(this.project), 0.6, this.colors.faint);
      this.context.setLineDash([]);
    }
    pivot([r]) {
      const [x, y] = this.project(r), u = this.unit;
      this.stroke([[x, y], [x - 3 * u, y - 5 * u], [x + 3 * u, y - 5 * u]], 0.7, this.colors.faint, true, this.colors.grid);
      this.dot([x, y], 1.3, this.colors.ink);
    }
    spring(r) {
      const [a, b] = r.map(this.project), dx = b[0] - a[0], dy = b[1] - a[1], length = Math.hypot(dx, dy) || 1;
      const n = [-dy / length * 3.5 * this.unit, dx / length * 3.5 * this.unit], points = [a];
      for (let i = 0; i <= 24; i++) {
        const f = 0.08 + 0.84 * i / 24, side = i % 24 === 0 ? 0 : i % 2 ? 1 : -1;
        points.push([a[0] + f * dx + side * n[0], a[1] + f * dy + side * n[1]]);
      }
      this.stroke([...points, b], 0.9, this.ink);
    }
    box([c, [w, h, tilt]]) {
      const [cos, sin] = [Math.cos(tilt), Math.sin(tilt)];
      this.polygon([[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([i, j]) =>
        [c[0] + i * w / 2 * cos - j * h / 2 * sin, c[1] + i * w / 2 * sin + j * h / 2 * cos, c[2]]));
    }
    cart([c, [w, h]]) {
      this.box([c, [w, h, 0]]);
      const radius = 0.1875 * h;
      for (const side of [-1, 1]) {
        const centre = [c[0] + side * 0.32 * w, c[1] - h / 2 - radius, c[2]];
        this.round([centre, [centre[0] + radius, centre[1], centre[2]]]);
      }
    }
    polygon(r) { this.stroke(r.map(this.project), 1.1, this.ink, true, this.fill); }
    frame(r) { this.stroke(r.map(this.project), 0.8, this.colors.faint, true); }
    ellipse([c, a, b]) {
      return Array.from({ length: 64 }, (_, i) => {
        const [cos, sin] = [Math.cos(i * Math.PI / 32), Math.sin(i * Math.PI / 32)];
        return this.project(c.map((x, k) => x + (a[k] - x) * cos + (b[k] - x) * sin));
      });
    }
    circle(r) { this.stroke(this.ellipse(r), 1.4, this.ink, true); }
    round([c, a]) {
      const radius = Math.hypot(...a.map((x, k) => x - c[k]));
      this.stroke(this.ellipse([c, [c[0] + radius, c[1], c[2]], [c[0], c[1] + radius, c[2]]]), 1, this.ink, true, this.fill);
    }
    wheel([c, a, b]) {
      this.stroke(this.ellipse([c, a, b]), 1.3, this.ink, true, this.fill);
      for (const end of [a, b]) this.stroke([end, end.map((x, k) => 2 * c[k] - x)].map(this.project), 0.7, this.ink);
      this.dot(this.project(a), 1.8, this.colors.ghost);
      this.dot(this.project(c), 1.3, this.ink);
    }
    through([a, b]) {  // a line beyond the picture's edges
      const [p, q] = [a, b].map(this.project), reach = 2 * (this.size[0] + this.size[1]);
      const length = Math.hypot(q[0] - p[0], q[1] - p[1]) || 1, d = [(q[0] - p[0]) / length, (q[1] - p[1]) / length];
      const hatch = 5 * this.unit, away = (this.size[0] / 2 - p[0]) * d[0] + (this.size[1] / 2 - p[1]) * d[1];
      const near = Math.round(away / hatch) * hatch;  // the picture may be far along it
      p.forEach((_, k) => { p[k] += near * d[k]; });
      return [p, d, [[p[0] - reach * d[0], p[1] - reach * d[1]], [p[0] + reach * d[0], p[1] + reach * d[1]]]];
    }
    line(r) { this.stroke(this.through(r)[2], 0.9, this.colors.faint); }
    ground(r) {
      const [p, d, ends] = this.through(r), n = [-d[1], d[0]], u = this.unit;
      this.stroke(ends, 0.9, this.colors.ink);
      const reach = this.size[0] + this.size[1];
      for (let x = -Math.ceil(reach / (5 * u)) * 5 * u; x < reach; x += 5 * u) {
        const from = [p[0] + x * d[0], p[1] + x * d[1]];
        this.stroke([from, [from[0] + 3 * u * (n[0] - d[0]), from[1] + 3 * u * (n[1] - d[1])]], 0.4, this.colors.faint);
      }
    }
    plane([r]) {
      const film = this.film, pad = 0.08 * film.extent;
      const step = niceStep(Math.max(film.high[0] - film.low[0], film.high[1] - film.low[1]) + 2 * pad, 10);
      const from = [0, 1].map(k => Math.floor((film.low[k] - pad) / step)), to = [0, 1].map(k => Math.ceil((film.high[k] + pad) / step));
      for (let i = from[0]; i <= to[0]; i++) this.stroke([[i * step, from[1] * step, r[2]], [i * step, to[1] * step, r[2]]].map(this.project), 0.4, this.colors.grid);
      for (let j = from[1]; j <= to[1]; j++) this.stroke([[from[0] * step, j * step, r[2]], [to[0] * step, j * step, r[2]]].map(this.project), 0.4, this.colors.grid);
    }
    trail(place, s, recent) {
      const path = (from, to) => {
        const points = [];
        for (let i = Math.max(0, Math.ceil(from)); i <= to; i++) points.push(this.project(place.map(series => at(series, i))));
        points.push(this.project(place.map(series => at(series, s))));
        return points;
      };
      const pen = this.context;
      pen.globalAlpha = 0.35;
      this.stroke(path(0, s), 0.6, this.ink);
      pen.globalAlpha = 0.9;
      this.stroke(path(s - recent, s), 0.9, this.ink);
      pen.globalAlpha = 1;
    }
    field({ label }, r, i) {  // uniform: an arrow in the corner
      const length = Math.hypot(...r), u = this.unit, pen = this.context, [x, y] = [this.size[0] - (14 + 24 * i) * u, 15 * u];
      if (!length) return;
      const [dx, dy] = this.flat(r.map(c => c / length)), tip = [x + 9 * u * dx, y - 9 * u * dy], across = Math.hypot(dx, dy);
      pen.fillStyle = this.colors.second;
      pen.textAlign = "center";
      pen.fillText(label, x - 8 * u, y + 1.5 * u);
      if (across < 0.05) {  // towards the eye, or away
        this.stroke(Array.from({ length: 24 }, (_, k) => [x + 3 * u * Math.cos(k * Math.PI / 12), y + 3 * u * Math.sin(k * Math.PI / 12)]), 0.8, this.colors.second, true);
        const out = r[2] > 0, d = 2 * u;
        if (out) this.dot([x, y], 1, this.colors.second);
        else [[d, d], [d, -d]].forEach(([a, b]) => this.stroke([[x - a, y - b], [x + a, y + b]], 0.8, this.colors.second));
        return;
      }
      const [ex, ey] = [dx / across, -dy / across], start = [2 * x - tip[0], 2 * y - tip[1]];
      this.stroke([start, tip], 1, this.colors.second);
      this.stroke([[tip[0] - 4 * u * ex + 2 * u * ey, tip[1] - 4 * u * ey - 2 * u * ex], tip,
        [tip[0] - 4 * u * ex - 2 * u * ey, tip[1] - 4 * u * ey + 2 * u * ex]], 1, this.colors.second);
    }
    dials(film, s) {  // nothing says where the masses are: each coordinate is a hand or a mark
      const [w, h] = this.size, pen = this.context, n = film.states.length, u = this.unit;
      const columns = Math.min(n, Math.ceil(Math.sqrt(n * w / h))), rows = Math.ceil(n / columns);
      film.states.forEach(([q], i) => {
        const cell = [w / columns, h / rows], c = [(i % columns + 0.5) * cell[0], (Math.floor(i / columns) + 0.5) * cell[1]];
        const radius = 0.34 * Math.min(...cell), x = at(q, s), { name, unit } = film.coordinates[i];
        pen.fillStyle = this.colors.faint;
        pen.textAlign = "center";
        pen.fillText(letter(name), c[0], c[1] + (unit === "rad" ? radius : 0) + 8 * u);
        if (unit === "rad") {
          const circle = Array.from({ length: 64 }, (_, k) => [c[0] + radius * Math.cos(k * Math.PI / 32), c[1] + radius * Math.sin(k * Math.PI / 32)]);
          this.stroke(circle, 0.6, this.colors.grid, true);
          const tip = [c[0] + radius * Math.sin(x), c[1] + radius * Math.cos(x)];
          this.stroke([c, tip], 1.5, this.colors.body);
          this.dot(tip, 3, this.colors.body);
        } else {
          const [lo, hi] = range([q]), f = (x - lo) / (hi - lo || 1);
          this.stroke([[c[0] - radius, c[1]], [c[0] + radius, c[1]]], 0.6, this.colors.faint);
          this.dot([c[0] + radius * (2 * f - 1), c[1]], 3, this.colors.body);
        }
      });
    }
  }

  const largest = series => typeof series === "number" ? Math.abs(series) : series.reduce((most, x) => Math.max(most, Math.abs(x)), 0);

  // From the least to the largest, and some more; what is below `noise` is as good as 0.
  function range(list, noise = 0) {
    let lo = Infinity, hi = -Infinity;
    for (const series of list) {
      if (typeof series === "number") { lo = Math.min(lo, series); hi = Math.max(hi, series); continue; }
      for (const x of series) { if (x < lo) lo = x; if (x > hi) hi = x; }
    }
    if (Math.max(-lo, hi) <= noise) lo = hi = 0;
    const pad = hi - lo > 1e-6 * Math.abs(hi) ? 0.06 * (hi - lo) : 0.5 * Math.abs(hi) || 1;
    return [lo - pad, hi + pad];
  }

  // Curves with axes; each is { x, y, color, width, dash, label }.
  class Graph extends Canvas {
    axes(xs, ys, xLabel, yLabel, colors) {
      const [w, h] = this.begin(), pen = this.context, size = Math.max(12, Math.min(22, w / 28, h / 11));
      Object.assign(this, { w, h, colors, left: 4.2 * size, right: w - 0.8 * size, top: 1.9 * size, bottom: h - 2.6 * size });
      pen.font = `${size}px system-ui, "DejaVu Sans", sans-serif`;
      this.x = x => this.left + (x - xs[0]) / (xs[1] - xs[0]) * (this.right - this.left);
      this.y = y => this.bottom - (y - ys[0]) / (ys[1] - ys[0]) * (this.bottom - this.top);
      pen.lineWidth = 1;
      const label = (v, step) => {
        const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), digits = v ? Math.max(0, exponent(Math.abs(v)) - exponent(step)) : 0;
        if (Math.abs(v) < step / 2) return "0";
        return power(places > 5 || Math.abs(v) >= 1e5 ? v.toExponential(Math.min(digits, 8)) : v.toFixed(places));
      };
      const ticks = ([lo, hi], count) => {
        const step = niceStep(hi - lo, count), list = [];
        for (let k = Math.ceil(lo / step); k * step <= hi; k++) list.push([k * step, label(k * step, step)]);
        return list;
      };
      const upright = ticks(ys, Math.max(2, h / (4 * size)));
      this.left = Math.max(this.left, ...upright.map(([, text]) => pen.measureText(text).width + 0.8 * size));
      pen.strokeStyle = colors.grid;
      pen.fillStyle = colors.faint;
      const rule = (x0, y0, x1, y1) => { pen.beginPath(); pen.moveTo(x0, y0); pen.lineTo(x1, y1); pen.stroke(); };
      pen.textAlign = "center";
      for (const [v, text] of ticks(xs, Math.max(2, w / (6 * size)))) {
        rule(this.x(v), this.top, this.x(v), this.bottom);
        pen.fillText(text, Math.min(this.x(v), w - pen.measureText(text).width / 2), this.bottom + 1.2 * size);
      }
      pen.textAlign = "right";
      for (const [v, text] of upright) {
        rule(this.left, this.y(v), this.right, this.y(v));
        pen.fillText(text, this.left - 0.4 * size, this.y(v) + 0.35 * size);
      }
      pen.fillStyle = colors.ink;
      pen.fillText(xLabel, this.right, this.bottom + 2.3 * size);
      pen.textAlign = "left";
      pen.fillText(yLabel, 0.4 * size, 1.2 * size);
      this.legendAt = this.right;
    }
    curve(xs, ys, count, color, { width = 1.6, dash = [], alpha = 1, first = 0, to = count - 1 } = {}) {
      const pen = this.context;
      pen.save();
      pen.globalAlpha = alpha;
      pen.setLineDash(dash);
      pen.strokeStyle = color;
      pen.lineWidth = width;
      pen.lineJoin = "round";
      pen.beginPath();
      const stride = Math.max(1, Math.floor(count / 3000));
      for (let i = first; i <= Math.min(to, count - 1); i += stride) pen.lineTo(this.x(xs(i)), this.y(ys(i)));
      pen.stroke();
      pen.restore();
    }
    point(x, y, color, radius = 5) {
      const pen = this.context;
      pen.beginPath();
      pen.arc(this.x(x), this.y(y), radius, 0, 2 * Math.PI);
      pen.fillStyle = color;
      pen.fill();
    }
    legend(text, color) {
      const pen = this.context;
      pen.textAlign = "right";
      pen.fillStyle = color;
      pen.fillText(text, this.legendAt, this.top - 0.5 * parseFloat(pen.font));
      this.legendAt -= pen.measureText(text).width + parseFloat(pen.font);
    }
  }

  class Player {
    constructor(section, page) {
      this.section = section;
      this.page = page;
      this.alone = section.dataset.alone !== undefined;
      this.films = page.films.map(film => new Film(film));
      this.which = 0;
      this.coordinate = 0;
      this.speed = 1;
      this.playing = false;
      this.visible = true;
      this.build();
      this.choose(0);
      this.listen();
      if (this.alone && !calm.matches) this.play(true);
    }
    get film() { return this.films[this.which]; }
    build() {
      const { page, section } = this;
      const facts = [page.system, ...page.facts.map(written)].filter(text => text).join(" · ");
      const head = make("div", { class: "head" }, ...this.alone ? [make("h1", {}, page.title)] : [], make("p", { class: "facts" }, facts));
      this.pace = make("p", { class: "facts" });
      head.append(this.pace);
      const stage = make("div", { class: "stage" });
      this.stage = new Stage(stage, `The mechanism in motion: ${page.title}`);
      const controls = make("div", { class: "controls" });
      this.button = make("button", { type: "button" }, "Play");
      this.scrub = make("input", { type: "range", min: 0, max: 1000, step: "any", value: 0, "aria-label": "time" });
      this.tempo = make("select", { "aria-label": "speed of the film" },
        ...[0.1, 0.25, 0.5, 1, 2, 4, 10].map(x => make("option", { value: x }, `×${x}`)));
      this.tempo.value = "1";
      controls.append(this.button, this.scrub, this.tempo);
      if (this.films.length > 1) {
        this.chooser = make("select", { "aria-label": "which film" }, ...this.films.map((film, i) => make("option", { value: i }, film.name + (film.omega === undefined ? "" : `, ω = ${number(film.omega)} rad/s`))));
        controls.append(this.chooser);
      }
      const box = (text, on) => {
        const input = make("input", { type: "checkbox" }), label = make("label", {}, input, text);
        input.checked = on;
        input.addEventListener("change", () => this.draw());
        controls.append(label);
        return Object.assign(input, { label });
      };
      this.trail = box("trail", true);
      this.ghost = box("exact", true);
      this.ghostName = this.ghost.label.lastChild;
      const side = make("div", { class: "side" }), graphs = [make("div", { class: "graph" }), make("div", { class: "graph" })];
      this.phase = new Graph("Phase portrait: velocity against coordinate, with a point that moves", graphs[0]);
      this.energies = new Graph("Energies in time", graphs[1]);
      this.values = make("table", { "aria-label": "values at this moment" });
      this.selector = make("select", { "aria-label": "coordinate of the phase portrait" });
      controls.append(this.selector);
      side.append(...graphs, this.values);
      section.append(head, stage, controls, side);
    }
    choose(which) {
      this.which = which;
      const { film } = this;
      this.time = film.start;
      this.stage.film = film;
      this.stage.element.classList.toggle("solid", film.solid);
      this.coordinate = Math.min(this.coordinate, film.states.length - 1);
      this.selector.replaceChildren(...film.coordinates.map(({ name }, i) => make("option", { value: i }, `${letter(name)}, ${dotted(name)}`)));
      this.selector.value = String(this.coordinate);
      this.selector.hidden = film.states.length < 2;
      this.trail.label.hidden = !film.parts.some(part => part.kind === "trail");
      this.ghost.label.hidden = !film.ghost;
      this.ghostName.textContent = film.reference ?? "";
      const rate = film.omega !== undefined ? `ω = ${number(film.omega)} rad/s` : film.growth !== undefined ? `grows as exp(${number(film.growth)} t/s)` : "";
      const base = film.factor === 1 ? "real time" : film.factor < 1 ? `slow motion, 1 s of film is ${number(film.factor, 2)} s` : `time lapse, 1 s of film is ${number(film.factor, 2)} s`;
      this.pace.textContent = [rate, film.note, base].filter(text => text).join(" · ");
      const cells = [], rows = [];
      const value = (name, unit, get, scale) => {  // an error has no scale: two digits of it are shown
        const cell = make("td");
        cells.push([cell, get, scale]);
        return [make("th", { scope: "row" }, name), cell, make("td", { class: "unit" }, unit === "1" ? "" : written(unit))];
      };
      const series = (name, unit, list) => value(name, unit, s => at(list, s), largest(list));
      rows.push([...value("t", "s", () => this.time, Math.max(Math.abs(film.start), Math.abs(film.end))),
        ...film.distance ? value(`off ${film.reference}`, film.parts.length ? "m" : "", s => { const x = 10 ** at(film.distance, s); return x < 2e-18 ? 0 : x; }) : []]);
      film.coordinates.forEach(({ name, unit }, i) => rows.push([...series(letter(name), unit, film.states[i][0]),
        ...series(dotted(name), unit === "1" ? "1/s" : `${unit}/s`, film.states[i][1])]));
      const e = at(film.energy, 0), energy = (name, get) => value(name, "J", get, Math.max(largest(film.energy), largest(film.kinetic)));
      rows.push([...energy("E", s => at(film.energy, s)), ...film.conserved ? value("E − E(0)", "J", s => at(film.energy, s) - e) : energy("T", s => at(film.kinetic, s))]);
      this.cells = cells;
      this.values.replaceChildren(...rows.map(row => make("tr", {}, ...row)));
      this.draw();
    }
    listen() {
      const { section } = this;
      this.button.addEventListener("click", () => this.play(!this.playing));
      this.scrub.addEventListener("input", () => this.seek(this.film.start + this.scrub.value / 1000 * this.film.duration));
      this.tempo.addEventListener("change", () => { this.speed = +this.tempo.value; });
      this.selector.addEventListener("change", () => { this.coordinate = +this.selector.value; this.draw(); });
      this.chooser?.addEventListener("change", () => this.choose(+this.chooser.value));
      (this.alone ? document : section).addEventListener("keydown", event => this.key(event));
      new ResizeObserver(() => this.draw()).observe(section);
      dark.addEventListener("change", () => this.draw());
      window.addEventListener("beforeprint", () => this.draw());
      if (!this.alone) new IntersectionObserver(entries => { this.visible = entries.at(-1).isIntersecting; }).observe(section);
      const { canvas } = this.stage;
      canvas.addEventListener("pointerdown", event => {
        if (!this.film.solid) return;
        canvas.setPointerCapture(event.pointerId);
        this.grip = [event.clientX, event.clientY];
      });
      canvas.addEventListener("pointermove", event => {
        if (!this.grip) return;
        this.stage.azimuth -= (event.clientX - this.grip[0]) * 0.008;
        this.stage.elevation = Math.max(-1.57, Math.min(1.57, this.stage.elevation + (event.clientY - this.grip[1]) * 0.008));
        this.grip = [event.clientX, event.clientY];
        this.draw();
      });
      for (const kind of ["pointerup", "pointercancel"]) canvas.addEventListener(kind, () => { this.grip = undefined; });
      this.energies.canvas.addEventListener("pointerdown", event => {
        const { left, right } = this.energies, x = event.offsetX;
        this.seek(this.from + Math.max(0, Math.min(1, (x - left) / (right - left))) * this.film.span);
      });
    }
    key(event) {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      const { film } = this, tag = event.target.tagName, second = film.factor * (event.shiftKey ? 1 : 0.1);
      if (tag === "SELECT" || event.key === " " && (tag === "BUTTON" || event.target.type === "checkbox")) return;
      const tempos = [...this.tempo.options].map(option => option.value), i = tempos.indexOf(this.tempo.value);
      const tempo = k => { this.tempo.value = tempos[Math.max(0, Math.min(tempos.length - 1, k))]; this.speed = +this.tempo.value; };
      const actions = {
        " ": () => this.play(!this.playing),
        ArrowRight: () => this.seek(this.time + second), ArrowLeft: () => this.seek(this.time - second),
        ArrowUp: () => tempo(i + 1), ArrowDown: () => tempo(i - 1),
        Home: () => this.seek(film.start), End: () => this.seek(film.end),
      };
      if (!actions[event.key]) return;
      event.preventDefault();
      actions[event.key]();
    }
    play(on) {
      cancelAnimationFrame(this.request);  // paused and played again within one frame, there is still one clock
      this.playing = on;
      this.button.textContent = on ? "Pause" : "Play";
      if (!on) return;
      if (this.time >= this.film.end) this.time = this.film.start;
      let before;
      const tick = now => {
        if (!this.playing) return;
        if (this.visible) {
          const passed = before === undefined ? 0 : Math.min(0.1, (now - before) / 1000);
          this.time += passed * this.film.factor * this.speed;
          if (this.time >= this.film.end) {
            this.time = this.film.loop ? this.film.start + (this.time - this.film.end) % this.film.duration : this.film.end;
            if (!this.film.loop) this.play(false);
          }
          this.draw();
        }
        before = now;
        this.request = requestAnimationFrame(tick);
      };
      this.request = requestAnimationFrame(tick);
    }
    seek(time) {
      this.time = Math.max(this.film.start, Math.min(this.film.end, time));
      this.draw();
    }
    draw() {
      const { film, time } = this, s = film.frame(time), style = getComputedStyle(document.documentElement);
      const colors = Object.fromEntries(["ink", "faint", "grid", "body", "fill", "ghost", "second", "panel"].map(name => [name, style.getPropertyValue(`--${name}`).trim()]));
      const recent = 1.5 * film.factor / film.interval, ghost = this.ghost.checked;
      this.stage.draw(film, s, colors, { trail: this.trail.checked, ghost, recent });
      this.drawPhase(film, s, colors, ghost);
      this.drawEnergies(film, s, colors);
      for (const [cell, get, scale] of this.cells) {
        const x = get(s);
        cell.textContent = scale === undefined ? number(x, 2) : number(x, 4, scale);
      }
      this.fit();
      this.scrub.value = film.duration > 0 ? 1000 * (time - film.start) / film.duration : 0;
      this.scrub.setAttribute("aria-valuetext", `t = ${number(time)} s`);
    }
    fit() {  // what is too wide for its column is written smaller
      const room = this.values.parentElement.clientWidth, { style } = this.values;
      if (room !== this.room) { this.room = room; this.small = 1; style.fontSize = ""; }
      const wide = this.values.offsetWidth / room;
      if (!(wide > 1)) return;
      this.small = Math.max(0.5, 0.98 * this.small / wide);
      style.fontSize = `${this.small}em`;
    }
    drawPhase(film, s, colors, ghost) {
      const [q, v] = film.states[this.coordinate], { name, unit } = film.coordinates[this.coordinate], other = ghost && film.ghostStates?.[this.coordinate];
      const get = series => i => at(series, i), graph = this.phase;
      const bounds = film.phaseRange ??= new Map(), key = `${this.coordinate} ${Boolean(other)}`;
      if (!bounds.has(key)) bounds.set(key, [range(other ? [q, other[0]] : [q]), range(other ? [v, other[1]] : [v], 1e-12 * largest(q) / film.duration)]);
      graph.axes(...bounds.get(key), unit === "1" ? letter(name) : `${letter(name)} [${unit}]`, `${dotted(name)} [${unit}/s]`, colors);
      if (other) graph.curve(get(other[0]), get(other[1]), film.count, colors.ghost, { alpha: 0.5, dash: [5, 4] });
      graph.curve(get(q), get(v), film.count, colors.body, { alpha: 0.35 });
      graph.curve(get(q), get(v), film.count, colors.body, { to: Math.floor(s) });
      if (other) graph.point(at(other[0], s), at(other[1], s), colors.ghost, 4);
      graph.point(at(q, s), at(v, s), colors.body);
    }
    drawEnergies(film, s, colors) {
      const graph = this.energies, { energy, kinetic } = film, rest = i => at(energy, i) - at(kinetic, i), t = i => film.time(i);
      if (!film.energyRange) film.energyRange = range([energy, kinetic, Float64Array.from({ length: film.count }, (_, i) => rest(i))]);
      const from = Math.max(film.start, Math.min(film.end - film.span, this.time - film.span / 2));
      graph.axes([from, film.span > 0 ? from + film.span : from + 1], film.energyRange, "t [s]", "energy [J]", colors);
      this.from = from;
      const limits = { first: Math.floor(film.frame(from)), to: Math.ceil(film.frame(from + film.span)) };
      graph.curve(t, rest, film.count, colors.ghost, limits);
      graph.curve(t, i => at(kinetic, i), film.count, colors.second, limits);
      graph.curve(t, i => at(energy, i), film.count, colors.body, { ...limits, width: 2.4 });
      graph.legend("E − T", colors.ghost);
      graph.legend("T", colors.second);
      graph.legend("E", colors.body);
      const pen = graph.context, x = graph.x(this.time);
      pen.strokeStyle = colors.ink;
      pen.lineWidth = 1;
      pen.beginPath();
      pen.moveTo(x, graph.top);
      pen.lineTo(x, graph.bottom);
      pen.stroke();
      graph.point(this.time, rest(s), colors.ghost, 3.5);
      graph.point(this.time, at(kinetic, s), colors.second, 3.5);
      graph.point(this.time, at(energy, s), colors.body, 3.5);
    }
  }

  for (const script of document.querySelectorAll("script.film-data")) {
    const player = new Player(script.parentElement, JSON.parse(script.textContent));
    (window.films ??= []).push(player);
  }
})();
