"""What a film draws, read back from the calls to its canvases: axes with their units, curves through the values, the
mechanism the right way up, every control with its effect, colours that differ and can be read in the light and in the dark."""

RECORD = """(() => {
  const made = new Map();
  const of = canvas => made.get(canvas) ?? made.set(canvas, { texts: [], lines: [], dots: [] }).get(canvas);
  const pen = CanvasRenderingContext2D.prototype, old = {};
  for (const name of ["beginPath", "moveTo", "lineTo", "arc", "stroke", "fill", "fillText"]) old[name] = pen[name];
  let path = [], round;
  pen.beginPath = function () { path = []; round = undefined; old.beginPath.call(this); };
  pen.moveTo = function (x, y) { path.push([x, y]); old.moveTo.call(this, x, y); };
  pen.lineTo = function (x, y) { path.push([x, y]); old.lineTo.call(this, x, y); };
  pen.arc = function (x, y, ...more) { round = [x, y]; old.arc.call(this, x, y, ...more); };
  pen.stroke = function () { of(this.canvas).lines.push([this.strokeStyle, path, this.globalAlpha, this.getLineDash().length]); old.stroke.call(this); };
  pen.fill = function () { if (round) of(this.canvas).dots.push([this.fillStyle, ...round]); old.fill.call(this); };
  pen.fillText = function (text, x, y) { of(this.canvas).texts.push([this.fillStyle, text]); old.fillText.call(this, text, x, y); };
  films[0].draw();
  Object.assign(pen, old);
  return made;
})()"""

FACTS = """(() => {
  const player = films[0], { film, stage, phase, energies } = player, s = film.frame(player.time), made = RECORD;
  const style = getComputedStyle(document.documentElement), color = name => {
    const pen = document.createElement("canvas").getContext("2d");
    pen.fillStyle = style.getPropertyValue("--" + name).trim();
    return pen.fillStyle;
  };
  const at = (series, i) => typeof series === "number" ? series : series[i];
  const near = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]) < 1;
  const drawn = canvas => made.get(canvas.canvas) ?? { texts: [], lines: [], dots: [] };
  const [q, v] = film.states[player.coordinate], i = Math.round(s), E = at(film.energy, i), T = at(film.kinetic, i);
  const curve = (graph, name, x, y) => drawn(graph).lines.some(([c, path]) => c === color(name) && path.length > 2
    && path.some(p => Math.abs(p[0] - graph.x(x)) < 1 && Math.abs(p[1] - graph.y(y)) < 1));
  const dot = (graph, name, x, y) => drawn(graph).dots.some(([c, ...p]) => c === color(name) && near(p, [graph.x(x), graph.y(y)]));
  const shown = player.cells.map(([cell]) => cell.textContent), said = player.cells.map(([cell]) => cell.previousSibling.textContent);
  const springs = film.parts.filter(part => part.kind === "spring").map(part => part.at.map(k => stage.project(film.places[k].map(series => at(series, i)))));
  const row = name => { const text = shown[said.indexOf(name)]; return text === undefined ? undefined : read(text); };
  const read = text => { const [m, e] = text.replaceAll("−", "-").split("·10"); const raised = [...e ?? ""].map(c => c === "⁻" ? "-" : "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c)).join("");
    return +m * 10 ** +raised; };
  const largest = series => (typeof series === "number" ? Math.abs(series) : Math.max(...series.map(Math.abs))) || 1;
  const like = (a, b, scale) => a !== undefined && Math.abs(a - b) < 1e-3 * scale;
  const states = film.states.every(([q, v], n) => like(read(shown[1 + (film.distance ? 1 : 0) + 2 * n]), at(q, i), largest(q))
    && like(read(shown[2 + (film.distance ? 1 : 0) + 2 * n]), at(v, i), largest(v)));
  const changes = typeof film.energy === "number" ? 0 : film.energy.map(x => x - film.energy[0]);
  const rods = film.parts.filter(part => part.kind === "rod").map(part => part.at.map(k => stage.project(film.places[k].map(series => at(series, i)))));
  const [o, x, y] = [[0, 0, 0], [1, 0, 0], [0, 1, 0]].map(r => stage.project(r));
  const names = ["ink", "faint", "grid", "body", "fill", "ghost", "second", "panel"];
  return {
    solid: film.solid, exact: s === i, phaseTexts: drawn(phase).texts.map(t => t[1]), energyTexts: drawn(energies).texts,
    colors: Object.fromEntries(names.map(name => [name, color(name)])), unit: film.coordinates[player.coordinate].unit,
    across: [x[0] - o[0], x[1] - o[1]], up: [y[0] - o[0], y[1] - o[1]],
    phaseCurve: curve(phase, "body", at(q, i), at(v, i)), phaseDot: dot(phase, "body", at(q, i), at(v, i)),
    curves: { body: curve(energies, "body", player.time, E), second: curve(energies, "second", player.time, T),
              ghost: curve(energies, "ghost", player.time, E - T) },
    dots: { body: dot(energies, "body", player.time, E), second: dot(energies, "second", player.time, T),
            ghost: dot(energies, "ghost", player.time, E - T) },
    rods: rods.every(([a, b]) => drawn(stage).lines.some(([c, path]) => path.length === 2 && near(path[0], a) && near(path[1], b))),
    time: like(row("t"), player.time, film.end), states, energy: like(row("E"), E, Math.max(largest(film.energy), largest(film.kinetic))),
    rest: film.conserved ? Math.abs(row("E − E(0)") - at(changes, i)) <= 0.051 * Math.abs(at(changes, i)) : like(row("T"), T, largest(film.kinetic)),
    distance: !film.distance || like(Math.log10(Math.max(2e-18, shown[1] === "0" ? 2e-18 : read(shown[1]))), Math.max(Math.log10(2e-18), at(film.distance, i)), 25),
    springs: springs.every(([a, b]) => drawn(stage).lines.some(([c, path]) => path.length > 20 && near(path[0], a) && near(path.at(-1), b))),
    fields: film.parts.filter(part => part.kind === "field").length, heads: drawn(stage).texts.length,
    pace: player.pace.textContent, told: player.scrub.getAttribute("aria-valuetext"), title: document.querySelector("h1")?.textContent,
    head: document.title, factor: film.factor,
    phaseWay: drawn(phase).lines.some(([c, path]) => c === color("body") && path.length > 2 && near(path.at(-1), [phase.x(at(q, i)), phase.y(at(v, i))])),
    beside: !film.ghostStates || drawn(phase).lines.some(([c, path]) => c === color("ghost") && path.length > 2),
    cursor: drawn(energies).lines.some(([c, path]) => c === color("ink") && path.length === 2 && Math.abs(path[0][0] - energies.x(player.time)) < 1
      && Math.abs(path[0][1] - path[1][1]) > 20),
  };
})()""".replace("RECORD", RECORD)

CLOCK = """() => {  // frames by a clock of our own, so that it does not matter how busy the machine is
  const player = films[0], { film } = player, kept = [requestAnimationFrame, cancelAnimationFrame], waiting = new Map();
  let count = 0;
  window.requestAnimationFrame = what => { waiting.set(++count, what); return count; };
  window.cancelAnimationFrame = which => waiting.delete(which);
  player.seek(film.start);
  for (const on of [true, false, true]) player.play(on);  // within one frame
  for (const now of [1000, 1016, 1050, 1450, 1460]) {
    const due = [...waiting.values()];
    waiting.clear();
    for (const what of due) what(now);
  }
  const advanced = player.time - film.start;
  player.play(false);
  [window.requestAnimationFrame, window.cancelAnimationFrame] = kept;
  return [advanced, (0.016 + 0.034 + 0.1 + 0.01) * film.factor];  // a frame that comes late counts as a tenth of a second
}"""

PICTURE = "document.querySelector('canvas').toDataURL()"


def change(page, selector, what):
    """Whether the first picture changes when a control is used; it is put back."""
    before = page.value(PICTURE)
    page.value(f"(e => {{ {what}; e.dispatchEvent(new Event('change')); }})(document.querySelector({selector!r}))")
    return page.value(PICTURE) != before


def contrast(one, other):
    def light(color):
        parts = [int(color[i:i + 2], 16) / 255 for i in (1, 3, 5)]
        return sum(w * (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4)
                   for w, c in zip((0.2126, 0.7152, 0.0722), parts))
    a, b = sorted((light(one), light(other)))
    return (b + 0.05) / (a + 0.05)


def examine_drawing(browser, path, name, check):
    pages = {}
    for dark in (False, True):
        page = browser.open(path, dark=dark)
        value = page.value
        value("films[0].play(false)")
        value("films[0].seek(films[0].film.time(Math.round(0.37 * films[0].film.count)))")
        facts = pages[dark] = value(FACTS)
        check(f"{name}: stands on a frame", facts["exact"])
        unit, texts = facts["unit"], facts["phaseTexts"]
        check(f"{name}: the phase portrait has a coordinate with its unit", any(t.endswith(f" [{unit}]") for t in texts), str(texts))
        check(f"{name}: and its velocity", any(t.endswith(f" [{unit}/s]") and "\u0307" in t for t in texts), str(texts))
        check(f"{name}: numbers on its axes", sum(t.strip("−0123456789.·⁻⁰¹²³⁴⁵⁶⁷⁸⁹") == "" for t in texts) > 3, str(texts))
        labels = [text for _, text in facts["energyTexts"]]
        check(f"{name}: the energies have a time and a unit", "t [s]" in labels and "energy [J]" in labels, str(labels))
        legend = {text: color for color, text in facts["energyTexts"]}
        for text, color in (("E", "body"), ("T", "second"), ("E − T", "ghost")):
            check(f"{name}: {text} has its colour in the legend", legend.get(text) == facts["colors"][color], str(legend))
            check(f"{name}: the curve of {text}", facts["curves"][color])
            check(f"{name}: the point of {text}", facts["dots"][color])
        check(f"{name}: the phase portrait goes through the state", facts["phaseCurve"])
        check(f"{name}: the state is a point in it", facts["phaseDot"])
        check(f"{name}: the way so far ends there", facts["phaseWay"])
        check(f"{name}: the other motion is in the phase portrait, too", facts["beside"])
        check(f"{name}: the time is a line in the energies", facts["cursor"])
        check(f"{name}: rods are where the masses are", facts["rods"])
        for what in ("time", "states", "energy", "rest", "distance", "springs"):
            check(f"{name}: {what} as the data have it", facts[what])
        check(f"{name}: a field has its arrow and letter", facts["heads"] >= facts["fields"], str(facts["heads"]))
        check(f"{name}: a title", facts.get("title") and facts["title"] == facts["head"], str(facts.get("title")))
        pace = "real time" if facts["factor"] == 1 else "slow motion" if facts["factor"] < 1 else "time lapse"
        check(f"{name}: how fast it plays is said", pace in facts["pace"], facts["pace"])
        check(f"{name}: the slider tells the time to those who do not see it", (facts["told"] or "").startswith("t = "), str(facts["told"]))
        if not facts["solid"]:
            (xx, xy), (yx, yy) = facts["across"], facts["up"]
            check(f"{name}: x to the right, y upwards, to one scale",
                  xx > 0 and yy < 0 and abs(xx + yy) < 1e-6 * xx and abs(xy) + abs(yx) < 1e-6 * xx, str(facts["across"] + facts["up"]))
        colors = facts["colors"]
        for color, least in (("ink", 7), ("faint", 4), ("body", 3), ("ghost", 3), ("second", 3)):
            check(f"{name}: {color} can be read", contrast(colors[color], colors["panel"]) >= least, f"{colors} dark={dark}")
        check(f"{name}: what is told apart by colour differs", len({colors[c] for c in ("body", "ghost", "second")}) == 3)
        if not dark:
            controls(page, name, check)
        page.close()
    check(f"{name}: other colours in the dark", all(pages[False]["colors"][c] != pages[True]["colors"][c] for c in ("ink", "body", "panel")))


def controls(page, name, check):
    """Each has its effect."""
    value = page.value
    advanced, least = value(f"({CLOCK})()")
    check(f"{name}: it plays as fast as it says", abs(advanced - least) < 1e-9 * least, f"{advanced}, not {least}")
    value("(e => { e.value = '4'; e.dispatchEvent(new Event('change')); })(document.querySelector('select[aria-label=\"speed of the film\"]'))")
    check(f"{name}: the speed is chosen", value("films[0].speed") == 4)
    value("films[0].seek(films[0].film.time(Math.round(0.37 * films[0].film.count)))")  # where there is a trail
    for which in ("trail", "ghost"):
        if value(f"films[0].{which}.label.hidden"):
            continue
        if which == "ghost":  # where both motions are the same to the eye, it is drawn beside
            value("films[0].film.ghost = films[0].film.places.map(r => [r[0], r[1], r[2]].map((s, k) => k ? s : typeof s === 'number' ? s + 0.2 : s.map(x => x + 0.2)))")
            dashed, plain = value("(made => ['ghost', 'body'].map(name => { const style = getComputedStyle(document.documentElement), "
                                  "pen = document.createElement('canvas').getContext('2d'); pen.fillStyle = style.getPropertyValue('--' + name).trim(); "
                                  "return (made.get(films[0].stage.canvas)?.lines ?? []).filter(l => l[0] === pen.fillStyle).map(l => l[3]); }))(" + RECORD + ")")
            check(f"{name}: the other motion is dashed, the film's own is not", dashed and all(dashed) and not any(plain), f"{dashed} {plain}")
        before = value(f"films[0].draw(), {PICTURE}")
        value(f"films[0].{which}.click()")
        check(f"{name}: the box '{which}' has its effect", value(PICTURE) != before)
        value(f"films[0].{which}.click()")
    if value("films[0].film.states.length > 1"):
        before = value("films[0].phase.canvas.toDataURL()")
        value("(e => { e.value = '1'; e.dispatchEvent(new Event('change')); })(films[0].selector)")
        check(f"{name}: another coordinate, another portrait", value("films[0].phase.canvas.toDataURL()") != before)
    if value("films.length == 1 && films[0].films.length > 1"):
        before = value(PICTURE)
        value("(e => { e.value = '1'; e.dispatchEvent(new Event('change')); })(films[0].chooser)")
        check(f"{name}: another film of the page", value("films[0].which") == 1 and value("films[0].seek(0.1)," + PICTURE) != before)
    value("films[0].seek(films[0].film.start)")
    box = value("(r => [r.left, r.top, r.width, r.height])(films[0].energies.canvas.getBoundingClientRect())")
    press(page, box[0] + 0.7 * box[2], box[1] + 0.5 * box[3])
    check(f"{name}: a click into the energies goes there", value("films[0].time > films[0].film.start"))
    if value("films[0].film.solid"):
        before = value(PICTURE)
        box = value("(r => [r.left, r.top, r.width, r.height])(films[0].stage.canvas.getBoundingClientRect())")
        press(page, box[0] + 0.5 * box[2], box[1] + 0.5 * box[3], 60)
        check(f"{name}: it turns with the mouse", value(PICTURE) != before)


def press(page, x, y, way=0):
    for kind, at in (("mousePressed", x), ("mouseMoved", x + way), ("mouseReleased", x + way)):
        page.call("Input.dispatchMouseEvent", type=kind, x=at, y=y, button="left", buttons=1, clickCount=1)
