#!/usr/bin/env python3
"""Opens the films of all shipped scenes in Chromium, without a window and without a network.

    films.py PROGRAM [SCENE...]     exit status: 0 all holds, 1 something does not, 3 there is no chromium

Of each page: less than 300 kB, nothing on the console, no request, a canvas that changes while it plays, a slider
and keys that move the time, names for everything that can be used, calm and dark where the reader wants that.
"""
import glob
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import chromium  # noqa: E402
import claims  # noqa: E402
import drawing  # noqa: E402
from claims import check  # noqa: E402

NASTY = "</script><script>hacked = 1</script><img src=x onerror=hacked=1> \"q\" <!-- & ''q'' \\u003c"
DRAWN = ("pendulum", "cart_pendulum", "rolling_disk", "double_pendulum_modes", "kepler",
         "coupled_oscillators", "charged_particle", "pendulum_dt_0.1_methods")  # every call to the canvas is read
MOVES = """new Promise(done => {  // whether the picture changes, within ten seconds on a busy machine
  const canvas = document.querySelectorAll('canvas')[INDEX], first = canvas.toDataURL(), end = performance.now() + 10000;
  const look = () => canvas.toDataURL() !== first ? done(true) : performance.now() > end ? done(false) : setTimeout(look, 50);
  look();
})"""


WRITTEN = """(() => {  // what a graph writes beyond its edges
  const pen = CanvasRenderingContext2D.prototype, old = pen.fillText, outside = [];
  pen.fillText = function (text, x, y) {
    const wide = this.measureText(text).width, left = x - { left: 0, center: 0.5, right: 1 }[this.textAlign] * wide;
    const { clientWidth: w, clientHeight: h } = this.canvas.parentElement;
    if (left < -0.5 || left + wide > w + 0.5 || y < 0 || y > h) outside.push([text, left, left + wide, y]);
    old.call(this, text, x, y);
  };
  films[0].draw();
  pen.fillText = old;
  return outside;
})()"""
TWICE = """(() => {  // numbers that stand twice on an axis, where digits that tell them apart are cut off
  const pen = CanvasRenderingContext2D.prototype, old = pen.fillText, seen = new Set(), twice = [];
  const graphs = [films[0].phase.canvas, films[0].energies.canvas];
  pen.fillText = function (text, x, y) {
    const axis = `${graphs.indexOf(this.canvas)} ${this.textAlign} ${text}`;
    if (graphs.includes(this.canvas) && /[0-9]/.test(text) && !/[a-zA-Z]/.test(text)) seen.has(axis) ? twice.push(axis) : seen.add(axis);
    old.call(this, text, x, y);
  };
  films[0].draw();
  pen.fillText = old;
  return twice;
})()"""
UNTITLED = """&scene system = 'earth', method = 'auto', tolerance = 1e-10, duration = 6.4e7, q = 1.471e11, 0, v = 0, 2.059e-7 /
&lagrangian coordinates = 'r', 'phi', parameters = 'm', 'S', 'G', T = 'm/2 (r_dot^2 + r^2 phi_dot^2)', V = '-G S m/r' /
&earth m = 5.972e24, S = 1.989e30, G = 6.674e-11 /
"""
GROUND = """(() => {
  const { film, stage } = films[0], [w, h] = stage.size;
  return film.parts.filter(part => part.kind === "ground").every(part => {
    const [, d, [a, b]] = stage.through(part.at.map(k => film.places[k].map(x => typeof x === "number" ? x : x[0])));
    const middle = (w / 2 - a[0]) * d[0] + (h / 2 - a[1]) * d[1], long = Math.hypot(b[0] - a[0], b[1] - a[1]);
    return middle > (w + h) / 2 && long - middle > (w + h) / 2;
  });
})()"""


def make(program, folder, words):
    done = subprocess.run([program, *words, "--animate", "--quiet", "--output", folder], capture_output=True, text=True)
    check(" ".join(words), done.returncode in (0, 1), done.stderr.strip())


def examine(browser, path, title=None):
    name = os.path.basename(path)
    size = os.path.getsize(path)
    check(f"{name}: less than 300 kB", size < 300000, str(size))
    text = open(path, encoding="utf-8").read()
    check(f"{name}: is complete", text.rstrip().endswith("</html>"))
    check(f"{name}: no address of a network", "http://" not in text and "https://" not in text)

    page = browser.open(path)
    value = page.value
    check(f"{name}: plays by itself", value("films[0].playing && document.querySelector('button').textContent") == "Pause")
    picture = "document.querySelector('canvas').toDataURL()"
    check(f"{name}: the picture moves", value(MOVES.replace("INDEX", "0")))
    value("films[0].play(false)")
    times = []
    for place in (0, 250, 500, 1000):
        value(f"(slider => {{ slider.value = {place}; slider.dispatchEvent(new Event('input')); }})"
              "(document.querySelector('input[type=range]'))")
        times.append((value("films[0].time"), value("films[0].cells[0][0].textContent"), value(picture)))
    check(f"{name}: the slider moves the time", times[0][0] < times[1][0] < times[2][0] < times[3][0])
    check(f"{name}: the slider goes from the start to the end",
          times[0][0] == value("films[0].film.start") and times[3][0] == value("films[0].film.end"))
    check(f"{name}: the table says the time", len({text for _, text, _ in times}) == 4, str([t[1] for t in times]))
    check(f"{name}: the slider changes the picture", len({shot for _, _, shot in times}) > 2)
    value("document.activeElement.blur()")
    page.key("Home")
    check(f"{name}: Home", value("films[0].time == films[0].film.start"))
    page.key("ArrowRight")
    check(f"{name}: an arrow", value("films[0].time > films[0].film.start"))
    page.key("ArrowLeft")
    check(f"{name}: the other arrow", value("films[0].time - films[0].film.start < 1e-9 * films[0].film.duration"))
    page.key("ArrowUp")
    check(f"{name}: faster", value("films[0].speed") > 1)
    page.key("End")
    check(f"{name}: End", value("films[0].time == films[0].film.end"))
    page.key(" ", " ")
    check(f"{name}: the space bar plays", value("films[0].playing"))
    page.key(" ", " ")
    check(f"{name}: the space bar stops", not value("films[0].playing"))
    check(f"{name}: numbers in the table", not value("/NaN|undefined|–/.test(document.querySelector('table').textContent)"),
          value("document.querySelector('table').textContent"))
    if name == "cart_pendulum_modes.html":
        check(f"{name}: an angle that a mode leaves alone is 0", "θ0rad" in value("document.querySelector('table').textContent"),
              value("document.querySelector('table').textContent"))
    check(f"{name}: a zero has no power of ten", not value(r"/(^|[^0-9.])0(\.0*)?·/.test(document.querySelector('table').textContent)"),
          value("document.querySelector('table').textContent"))
    if name.endswith("_modes.html"):
        widest = value("Math.max(...films[0].films.flatMap(film => film.states.flatMap(([q], k) => film.coordinates[k].unit !== 'rad' ? 0 : "
                       "typeof q === 'number' ? 0 : (Math.max(...q) - Math.min(...q)) / 2)))")
        check(f"{name}: no angle is wider than 0.7 rad", widest < 0.7001, str(widest))
    check(f"{name}: words in the line below the title", "_" not in value("document.querySelector('h1').nextElementSibling.textContent")
          .replace("m_block", "").replace("m_wedge", "").replace("i_roll", "").replace("i_yaw", "").replace("k_c", ""))
    twice = value(TWICE)
    check(f"{name}: no number stands twice on an axis", not twice, str(twice))
    check(f"{name}: a pure number has no unit", not value("[...document.querySelectorAll('td.unit')].some(c => c.textContent === '1')"))
    check(f"{name}: numbers have no index", not value(r"/[0-9]e[₀-₉]/.test(document.querySelector('h1').nextElementSibling.textContent)"),
          value("document.querySelector('h1').nextElementSibling.textContent"))
    check(f"{name}: pictures have names",
          value("[...document.querySelectorAll('canvas')].every(c => c.getAttribute('role') == 'img' && c.ariaLabel)"))
    check(f"{name}: controls have names", value(
        "[...document.querySelectorAll('button, input, select')].every(c => c.ariaLabel || c.textContent.trim() || c.closest('label'))"))
    check(f"{name}: nothing is drawn outside", value("document.documentElement.scrollWidth <= innerWidth"))
    if title is not None:
        check(f"{name}: the title as it is", value("document.querySelector('h1').textContent") == title,
              value("document.querySelector('h1').textContent"))
        check(f"{name}: and in the head", value("document.title") == title, value("document.title"))
    check(f"{name}: a text is only a text", value("typeof hacked") == "undefined" and value("document.images.length") == 0)
    for complaint in page.complaints():
        check(f"{name}: quiet", False, complaint)
    light = value("getComputedStyle(document.body).backgroundColor")
    page.close()

    page = browser.open(path, 390, 844, dark=True, calm=True)
    check(f"{name}: calm where that is wanted", not page.value("films[0].playing"))
    check(f"{name}: dark where that is wanted", page.value("getComputedStyle(document.body).backgroundColor") != light)
    check(f"{name}: fits a phone", page.value("document.documentElement.scrollWidth <= innerWidth"))
    for complaint in page.complaints():
        check(f"{name}: quiet on a phone", False, complaint)
    page.close()
    # 1000: the smallest with graphs beside the mechanism; 1920: projected, of some pages
    for width, height in ((390, 844), (1000, 700), (1280, 720)) + ((1920, 1080),) * (name[:-5] in DRAWN):
        page = browser.open(path, width, height)  # a phone widens its window to what is too wide: innerWidth says nothing
        page.value("films[0].play(false)")
        sizes = page.value("['h1', '.facts', 'table'].map(one => parseFloat(getComputedStyle(document.querySelector(one)).fontSize))")
        check(f"{name}: the title is larger than the table at {width} pixels, the facts are readable", sizes[0] > 1.15 * sizes[2] and
              sizes[1] > 0.75 * sizes[2], str(sizes))
        for place in (0, 0.31, 0.6, 1):
            page.value(f"films[0].seek(films[0].film.time(Math.round({place} * (films[0].film.count - 1))))")
            right = page.value("Math.max(...[...document.querySelectorAll('canvas, td, button, select, label')].map(e => e.getBoundingClientRect().right))")
            check(f"{name}: nothing is cut off at {width} pixels, at {place}", right <= width, str(right))
            texts = page.value(WRITTEN)
            check(f"{name}: the graphs' texts are inside them at {width} pixels, at {place}", not texts, str(texts))
            level = page.value(GROUND)
            check(f"{name}: a ground goes from edge to edge, at {place}", level, str(level))
        page.close()


def examine_report(browser, path):
    page = browser.open(path)
    value = page.value
    scenes = value("document.querySelectorAll('main > section').length")
    check("report: a section a scene", scenes == 3, str(scenes))
    check("report: a film each", value("films.length") == scenes)
    check("report: nothing plays by itself", not value("films.some(film => film.playing)"))
    value("document.querySelectorAll('.film')[1].scrollIntoView()")
    second = value("[...document.querySelectorAll('canvas')].indexOf(document.querySelectorAll('.film')[1].querySelector('canvas'))")
    value("document.querySelectorAll('.film')[1].querySelector('button').click()")
    check("report: a film plays", value(MOVES.replace("INDEX", str(second))))
    check("report: links lead somewhere",
          value("[...document.querySelectorAll('a')].every(a => document.querySelector(a.getAttribute('href')))"))
    check("report: names in it differ",
          value("(ids => new Set(ids).size == ids.length)([...document.querySelectorAll('[id]')].map(e => e.id))"))
    check("report: a text is only a text", value("typeof hacked") == "undefined" and value("document.images.length") == 0)
    check("report: nothing is drawn outside", value("document.documentElement.scrollWidth <= innerWidth"))
    pdf = page.call("Page.printToPDF", preferCSSPageSize=True)["data"]
    check("report: prints", len(pdf) > 10000)
    for complaint in page.complaints():
        check("report: quiet", False, complaint)
    page.close()
    page = browser.open(path, 390, 844, dark=True)
    check("report: fits a phone", page.value("document.documentElement.scrollWidth <= innerWidth"))
    page.close()


def main():
    program = os.path.abspath(sys.argv[1])
    if not chromium.find():
        print("not run: no chromium")
        return 3
    scenes = sys.argv[2:] or sorted(os.path.basename(f)[:-4] for f in glob.glob("data/scenes/*.nml"))
    with tempfile.TemporaryDirectory() as folder:
        for scene in scenes:
            make(program, folder, ["run", scene])
        if not sys.argv[2:]:
            for system in ("cart_pendulum", "double_pendulum", "charged_trap", "rotating_hoop"):
                make(program, folder, ["modes", system])
            make(program, folder, ["modes", "hanging_chain", "--set", "hanging_chain%n=12"])
            make(program, folder, ["compare", "pendulum", "--methods", "rk4,verlet", "--set", "scene%dt=0.1"])
            nasty = os.path.join(folder, "nasty.nml")
            text = open("data/scenes/pendulum.nml", encoding="utf-8").read()
            lines = ["  title = '" + NASTY.replace("'", "''").replace("''''", "''") + "'" if "title =" in line else line
                     for line in text.split("\n")]
            with open(nasty, "w", encoding="utf-8") as file:
                file.write("\n".join(lines))
            make(program, folder, ["run", nasty])
            untitled = os.path.join(folder, "earth.nml")
            with open(untitled, "w", encoding="utf-8") as file:
                file.write(UNTITLED)
            make(program, folder, ["run", untitled])
            done = subprocess.run([program, "report", "pendulum", nasty, "sphere", "--quiet", "--output",
                                   os.path.join(folder, "report")], capture_output=True, text=True)
            check("report", done.returncode == 0, done.stderr.strip())
        browser = chromium.Browser()
        try:
            pages = sorted(glob.glob(os.path.join(folder, "*.html")))
            check("every scene has its page", len(pages) >= len(scenes))
            for path in pages:
                name = os.path.basename(path)[:-5]
                if sys.argv[2:] or name in DRAWN:
                    drawing.examine_drawing(browser, path, name, check)
                examine(browser, path, NASTY.replace("''", "'") if path.endswith("nasty.html") else
                        "earth" if name == "earth" else None)
            if not sys.argv[2:]:
                examine_report(browser, os.path.join(folder, "report", "report.html"))
        finally:
            browser.close()
    print(f"{len(pages)} pages, {claims.failed} failed")
    return 1 if claims.failed else 0


sys.exit(main())
