"""Checks gem view and gem run --view from outside.

check_view.py server GEM FOLDER    the server: key, host, origin, paths; a pause does not change a run
check_view.py browser GEM FOLDER   the page in Chromium: play, scrub, click, colours, largest load, save; needs h5py

GEM is the program, FOLDER holds the cases. Exit code 77: skipped, with the reason.
"""
import http.client
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import urllib.parse
import xml.etree.ElementTree as ElementTree

import browser

EVIL = "<b>@script@<!--<script>&amp;"
JAM = ["--set", "floes.count=110", "--set", "floes.length_m=130", "--set", "floes.width_m=280", "--set", "floes.start_x_m=-175",
       "--set", "boundary.gap_m=110", "--set", "output.floes_interval_s=5", "--set", "run.duration_s=90"]
THRUSTERS = ["--set", "floes.count=20", "--set", "run.duration_s=20", "--set", "output.floes_interval_s=5", "--set",
             "mooring.stiffness_N_per_m=5e4", "--set", "platform.start_offset_m=[4.0,3.0]"]
THREE = """[run]
name = "@name@"
duration_s = 40.0
[current]
velocity_m_per_s = [0.5, 0.0]
[floes]
source = "listed"
[boundary]
present = false
[platform]
diameter_m = 20.0
mass_kg = 1e6
[output]
floes_interval_s = 1.0
"""
FLOE = """[[floe]]
outline_m = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]]
position_m = [@x@, @y@]
velocity_m_per_s = [0.5, 0.0]
spin_rad_per_s = 0.1
"""


def expect(truth, what):
    if not truth:
        raise SystemExit(f"failed: {what}")


def three_floes():
    places = [(-15, 0), (-20, 6), (-20, -6)]
    floes = [FLOE.replace("@x@", f"{x:.1f}").replace("@y@", f"{y:.1f}") for x, y in places]
    return THREE.replace("@name@", EVIL) + "".join(floes)


def run(gem, case, out, *more):
    command = [gem, "run", case, "--engine", "cpu", "--threads", "2", "--quiet", "--out", out, *more]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


class Served:
    """A gem process that serves a page; `line` begins with its address after the word `http`."""

    def __init__(self, command, from_errors=False):
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        stream = self.process.stderr if from_errors else self.process.stdout
        while not (found := re.search(r"http://(127\.0\.0\.1:(\d+))(/[0-9a-f]{32}/)", line := stream.readline())):
            expect(line, f"no address from {command}")
        self.host, self.port, self.base = found[1], int(found[2]), found[3]

    def ask(self, path, method="GET", base=None, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        connection.request(method, (self.base if base is None else base) + path, headers=headers)
        answer = connection.getresponse()
        body = answer.read()
        connection.close()
        return answer.status, body

    def end(self):
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(20)


def check_gate(gem, file):
    server = Served([gem, "view", file, "--no-browser"])
    try:
        expect(server.ask("")[0] == 200, "the page is there")
        expect(json.loads(server.ask("description")[1])["floes"] == 3, "the description is there")
        expect(server.ask("", Host=server.host.replace("127.0.0.1", "localhost"))[0] == 200, "localhost is this machine")
        expect(server.ask("", Origin=f"http://{server.host}")[0] == 200, "the page itself may ask")
        for refused in ({"Host": "evil.example"}, {"Host": f"evil.example:{server.port}"}, {"Host": "127.0.0.1:1"},
                        {"Origin": "http://evil.example"}, {"Origin": "null"}, {"Origin": f"https://{server.host}"}):
            expect(server.ask("", **refused)[0] == 403, f"refused: {refused}")
        other = "0" * 32 if server.base[1] != "0" else "1" * 32
        for base in ("/", f"/{other}/", server.base[:-1], server.base[:-2] + "/", "//" + server.base):
            expect(server.ask("", base=base)[0] == 403, f"refused: the path {base}")
        for path in ("../etc/passwd", "%2e%2e/%2e%2e/etc/passwd", "..%2f..%2fetc/passwd", os.path.basename(file), "state",
                     "frames", "frames?first=-1", "frames?first=x", "rows?group=shape&first=0", "rows?group=events"):
            expect(server.ask(path)[0] in (403, 404), f"nothing at {path}")
        for path in ("pause", "stop", "description"):
            expect(server.ask(path, method="POST")[0] == 404, f"a file takes no {path}")
        expect(server.ask("", method="PUT")[0] == 405, "PUT is not allowed")
        expect(server.ask("frames?first=999")[0] == 204, "no frames behind the last")
    finally:
        expect(server.end() == 0, "Ctrl-C ends the server in order")


def hash_of(gem, file):
    return json.loads(subprocess.run([gem, "info", "--json", file], check=True, stdout=subprocess.PIPE).stdout)["gem_state_hash"]


def wait_for(server, wanted):
    for _ in range(400):
        state = json.loads(server.ask("state")[1])
        if wanted(state):
            return state
        signal.sigtimedwait([], 0.02)
    raise SystemExit(f"failed: the run did not come so far: {state}")


def check_pause(gem, case, folder):
    still, shown = os.path.join(folder, "still.h5"), os.path.join(folder, "shown.h5")
    run(gem, case, still, *JAM)
    command = [gem, "run", case, "--engine", "cpu", "--threads", "2", "--out", shown, "--view", "--no-browser", *JAM]
    server = Served(command, from_errors=True)
    expect(server.ask("pause", method="POST", Origin="http://evil.example")[0] == 403, "another page cannot pause the run")
    expect(server.ask("pause", method="POST")[0] == 204, "the run can be paused")
    waits = wait_for(server, lambda state: state["paused"] and state["time_s"] > 0)
    signal.sigtimedwait([], 0.3)
    later = json.loads(server.ask("state")[1])
    expect(later["time_s"] - waits["time_s"] < 20 and later["running"], "a paused run waits")
    before = later["time_s"]
    signal.sigtimedwait([], 0.3)
    expect(json.loads(server.ask("state")[1])["time_s"] == before, "a paused run stands still")
    server.ask("go_on", method="POST")
    wait_for(server, lambda state: not state["running"])
    frames = server.ask("frames?first=0")
    expect(frames[0] == 200 and b'"kind":"frames"' in frames[1], "the end of the run can be read")
    server.ask("has_all", method="POST")
    expect(server.process.wait(20) == 0, "a run that was read to its end ends")
    expect(hash_of(gem, still) == hash_of(gem, shown), "a pause does not change the run")


def check_live(page, gem, case, folder):
    """A run that takes the place of an earlier one, seen to its end through a lost network and a slow clock."""
    file, whole = os.path.join(folder, "live.h5"), os.path.join(folder, "whole.h5")
    run(gem, case, file, *JAM, "--set", "run.name=earlier")
    run(gem, case, whole, *JAM)
    server = Served([gem, "run", case, "--engine", "cpu", "--threads", "2", "--out", file, "--overwrite", "--view",
                     "--no-browser", *JAM], from_errors=True)
    page.open(f"http://{server.host}{server.base}")
    page.until("window.gemView && 1", 40)
    expect("earlier" not in page.value("document.querySelector('h1').textContent"), "the page shows the new run")
    page.call("Network.emulateNetworkConditions", offline=True, latency=0, downloadThroughput=-1, uploadThroughput=-1)
    page.until("document.querySelector('.live').textContent.includes('asking again')")
    page.call("Network.emulateNetworkConditions", offline=False, latency=0, downloadThroughput=-1, uploadThroughput=-1)
    page.until("!document.querySelector('.live').textContent.includes('asking again')")
    # as in a hidden tab, whose timers ring once a minute
    page.value("(() => { const ring = setTimeout; window.setTimeout = (f, ms) => ring(f, Math.max(ms, 60000)); })()")
    expect(server.process.wait(40) == 0, "the run ends when the page has all of it")
    expect("ended" in page.value("document.querySelector('.live').textContent"), "the page says that the run ended")
    frames, steps = page.value("[gemView.run.frameCount, gemView.run.end]")
    expect(frames == 19 and steps == 90, f"the page has the last frame: {frames}, {steps}")
    expect(hash_of(gem, file) == hash_of(gem, whole), "the file is that of the run")


def check_goodbye(page, gem, case, folder):
    server = Served([gem, "run", case, "--engine", "cpu", "--out", os.path.join(folder, "left.h5"), "--view",
                     "--no-browser", *JAM], from_errors=True)
    page.open(f"http://{server.host}{server.base}")
    page.until("window.gemView && 1", 40)
    page.open("about:blank")
    expect(server.process.wait(120) == 0, "a run whose page was closed does not wait for it")


def check_server(gem, cases, folder):
    case = os.path.join(folder, "three.toml")
    with open(case, "w", encoding="utf-8") as file:
        file.write(three_floes())
    run(gem, case, os.path.join(folder, "three.h5"))
    check_gate(gem, os.path.join(folder, "three.h5"))
    check_pause(gem, os.path.join(cases, "first.toml"), folder)


def check_numbers(page, file):
    """What the page draws against the file, to the rounding that the page states."""
    import h5py
    import numpy
    with h5py.File(file) as data:
        floes = data["floes"]
        rounding = page.value("gemView.run.description.rounding")
        for n in {0, len(floes["time"]) // 2, len(floes["time"]) - 1}:
            page.value(f"gemView.player.seek({float(floes['time'][n])!r})")
            there = numpy.array(page.value("Array.from(gemView.pose.there)"), bool)
            expect((there == (floes["active"][n] == 1)).all(), f"active floes of frame {n}")
            for name, step in (("x", "place_m"), ("y", "place_m"), ("vx", "speed_m_per_s"), ("omega", "spin_rad_per_s")):
                shown = numpy.array(page.value(f"Array.from(gemView.pose.{name})"))
                wrong = numpy.abs(shown - floes[name][n])[there]
                # half a step, and the single precision of the file
                bound = 0.5 * rounding[step] * (1 + 1e-9) + 1e-6 * numpy.abs(floes[name][n]).max()
                expect(not len(wrong) or wrong.max() <= bound, f"{name} of frame {n}: {wrong.max() if len(wrong) else 0} > {bound}")
            turned = numpy.array(page.value("Array.from(gemView.pose.sine)"))
            wrong = numpy.abs(turned - numpy.sin(floes["theta"][n].astype(float)))[there]
            expect(not len(wrong) or wrong.max() <= 0.51 * rounding["angle_rad"], f"rotation in frame {n}")
        force = numpy.hypot(data["platform/ice_force_mean_x"], data["platform/ice_force_mean_y"])
        largest = page.value("gemView.largest && [gemView.largest.time, gemView.largest.force]")
        if force.max() > 0:
            expect(abs(largest[1] - force.max()) <= 2e-5 * force.max(), "largest load")
            expect(abs(largest[0] - data["platform/time"][int(force.argmax())]) < 1e-6, "time of the largest load")
        events = numpy.sort(data["events/impulse"][:]) if "events" in data else numpy.array([])
        shown = numpy.sort(page.value("Array.from(gemView.hits.impulse)"))
        expect(len(shown) == len(events), "number of hits")
        expect(not len(events) or numpy.abs(shown - events).max() <= 1e-5 * events.max(), "impulses of hits")


def check_forces(page, file):
    """The forces between bodies of a frame against the file: number, bodies, sum; and that they are drawn."""
    import h5py
    import numpy
    with h5py.File(file) as data:
        times, rows = data["floes/time"][:], data["contacts"]
        frame = max(range(len(times)), key=lambda n: (rows["time"][:] == times[n]).sum())
        here = rows["time"][:] == times[frame]
        page.value(f"gemView.player.seek({float(times[frame])!r})")
        shown = page.value("(() => { const f = gemView.run.contactsAt(gemView.time);"
                           " return [Array.from(f.a), Array.from(f.b), Array.from(f.fx), Array.from(f.fy)]; })()")
        expect(here.sum() > 10, "the jam has forces between floes")
        expect(shown[0] == rows["body_a"][here].tolist() and shown[1] == rows["body_b"][here].tolist(), "pairs that press")
        largest = max(abs(rows["force_x"][here]).max(), abs(rows["force_y"][here]).max())
        strongest = float(rows["time"][:][numpy.hypot(rows["force_x"][:], rows["force_y"][:]).argmax()])
        for values, name in ((shown[2], "force_x"), (shown[3], "force_y")):
            wrong = abs(numpy.array(values) - rows[name][here]).max()
            expect(wrong <= largest / 2000 * 0.51, f"{name}: {wrong} of {largest}")
    pixels = "(() => { gemView.draw(); return gemView.canvases.over.toDataURL(); })()"
    page.value("gemView.fitAll()")
    before = page.value(pixels)
    page.value("document.getElementById('chains').click()")
    expect(page.value(pixels) != before, "the button hides the chains")
    page.value("document.getElementById('chains').click()")
    page.value("gemView.colourBy('contact_force')")
    page.value(f"gemView.player.seek({strongest!r})")
    expect(page.value("gemView.shares.some(s => s > 0.2)"), "floes are coloured by their forces")


def time_of_long_sum(file, force):
    """When ice, mooring and drag together are about `force`: their arrow is then long, and on the screen."""
    import h5py
    import numpy
    with h5py.File(file) as data:
        platform = data["platform"]
        x, y = (sum(platform[f"{name}_{axis}"][:] for name in ("ice_force", "mooring_force", "drag_force")) for axis in "xy")
        return float(platform["time"][int(abs(numpy.hypot(x, y) - force).argmin())])


def check_arrows(page, file, time):
    """The arrows of the forces on the platform at a time: their vectors against the file, and that the sum is drawn."""
    import h5py
    import numpy
    page.value(f"gemView.player.seek({time!r})")
    shown = {force["name"]: numpy.array(force["vector"]) for force in page.value("gemView.overlay.platformForces()")}
    with h5py.File(file) as data:
        platform = data["platform"]
        row = int(numpy.abs(platform["time"][:] - time).argmin())
        expect(abs(platform["time"][row] - time) < 1e-6, "the time is that of a row")
        at = {name: numpy.array([platform[f"{name}_{axis}"][row] for axis in "xy"])
              for name in ("ice_force", "ice_force_mean", "mooring_force", "drag_force")}
        holder = [name for name in shown if name not in ("ice", "drag", "total")]
        if "thruster_force_x" in platform:
            c, s = numpy.cos(platform["psi"][row]), numpy.sin(platform["psi"][row])
            fx, fy = (platform[f"thruster_force_{axis}"][row].sum() for axis in "xy")
            wanted = {"thrusters": numpy.array([c * fx - s * fy, s * fx + c * fy])}
            wanted["mooring"] = at["mooring_force"] - wanted["thrusters"]
        else:
            wanted = {holder[0]: at["mooring_force"]}
        wanted |= {"ice": at["ice_force_mean"], "drag": at["drag_force"],
                   "total": at["ice_force"] + at["mooring_force"] + at["drag_force"]}
        bound = 1e-4 * max(numpy.hypot(platform[f"{name}_x"], platform[f"{name}_y"]).max() for name in at)
    expect(shown.keys() == wanted.keys(), f"arrows: {list(shown)}, wanted {list(wanted)}")
    for name, vector in wanted.items():
        expect(numpy.abs(shown[name] - vector).max() <= bound, f"arrow {name} at {time} s: {shown[name]}, wanted {vector}")
    page.value("(() => { const v = gemView; if (!v.camera.follows) v.follow(); v.draw(); })()")
    half, longest = page.value(  # colour half way along the arrow of the total
        "(() => { const v = gemView, {vector} = v.overlay.platformForces().at(-1), {x, y} = v.overlay.platformPose();"
        " const metres = 0.5 * v.run.description.platform.diameter_m / v.largestForce;"
        " const at = v.camera.toScreen(x + metres * vector[0], y + metres * vector[1]), scale = v.canvases.over.width / v.camera.width;"
        " const from = v.camera.toScreen(x, y), [r, g, b] = v.canvases.over.getContext('2d').getImageData("
        "   Math.round(at[0] * scale), Math.round(at[1] * scale), 1, 1).data;"
        " return [[r, g, b], 2 * Math.hypot(at[0] - from[0], at[1] - from[1])]; })()")
    expect(longest > 30, f"the total is long enough to be looked for: {longest} pixels")
    ink = bytes.fromhex(page.value("gemView.theme.ink")[1:])
    expect(max(abs(a - b) for a, b in zip(half, ink)) < 5, f"the total is drawn: colour {half}, wanted {list(ink)}")


def check_drive(page):
    """A current that stays is the same at any time."""
    shown = page.value("[gemView.run.driveAt('current', 0), gemView.run.driveAt('current', 1e9), gemView.run.driveAt('wind', 0)]")
    expect(shown[0] == shown[1] and abs(shown[0][0]) > 0.1 and shown[2] is None, f"current and wind: {shown}")


def check_play(page):
    page.value("gemView.player.seek(0)")
    page.value("document.getElementById('speed').value = '20'; document.getElementById('speed').dispatchEvent(new Event('change'))")
    drawn = page.value("gemView.framesDrawn")
    page.value("document.getElementById('play').click()")
    page.until("gemView.time > 2")
    page.value("document.getElementById('play').click()")
    expect(page.value("gemView.framesDrawn") > drawn + 1, "frames are drawn while it plays")
    time = page.value("gemView.time")
    signal.sigtimedwait([], 0.2)
    expect(page.value("gemView.time") == time, "it stands after a pause")
    middle = page.value("(() => { const s = document.getElementById('scrub'); s.value = s.max / 2;"
                        " s.dispatchEvent(new Event('input')); return gemView.time / gemView.run.end; })()")
    expect(abs(middle - 0.5) < 1e-6, "the scrub bar goes to a time")
    before = page.value("gemView.time")
    page.press("ArrowRight")
    times = page.value("gemView.run.frameTimes")
    expect(page.value("gemView.time") == next(t for t in times if t > before + 1e-6), "a key steps to the next frame")


def check_click(page):
    page.value("gemView.fitAll()")
    floe, x, y = page.value(
        "(() => { const v = gemView, box = v.stage.getBoundingClientRect(), all = [...v.pose.there.keys()];"
        " const i = all.filter(k => v.pose.there[k]).sort((a, b) => v.run.shapes.area[b] - v.run.shapes.area[a])[0];"
        " const [x, y] = v.camera.toScreen(v.pose.x[i], v.pose.y[i]); return [i, box.left + x, box.top + y]; })()")
    page.click(x, y)
    expect(page.value("gemView.selected") == floe, "a click selects the floe")
    text = page.value("document.querySelector('.properties').textContent")
    expect(f"Floe{floe}" in text and "Thickness" in text, "its properties are shown")


def check_colours(page):
    pixels = "(() => { gemView.draw(); return gemView.canvases.field.toDataURL(); })()"
    seen = set()
    for key in ("speed", "spin", "thickness", "since_hit"):
        page.value(f"(() => {{ const s = document.getElementById('colour'); s.value = '{key}';"
                   " s.dispatchEvent(new Event('change')); })()")
        expect(page.value("gemView.quantity.key") == key, f"floes are coloured by {key}")
        seen.add(page.value(pixels))
    expect(len(seen) > 2, "the picture changes with the colours")
    off = page.value("[...document.querySelectorAll('#colour option')].filter(o => o.disabled && !o.title).length")
    expect(off == 0, "what cannot be shown says why")


def check_saved(page):
    page.value("document.getElementById('save_png').click()")
    with open(page.downloaded(".png"), "rb") as file:
        expect(file.read(8) == b"\x89PNG\r\n\x1a\n", "a picture is saved")
    page.value("document.getElementById('save_svg').click()")
    drawn = ElementTree.parse(page.downloaded(".svg")).getroot().iter("{http://www.w3.org/2000/svg}polygon")
    bodies = page.value("gemView.pose.there.reduce((a, b) => a + b, 0) + gemView.run.description.fixed.length + 1")
    expect(len(list(drawn)) == bodies, "a drawing with all bodies is saved")
    page.value("document.getElementById('film').click()")
    page.value("new Promise(done => setTimeout(done, 400))")
    page.value("document.getElementById('film').click()")
    with open(page.downloaded(".webm"), "rb") as file:
        expect(file.read(4) == b"\x1a\x45\xdf\xa3", "a film is saved")
    for name in os.listdir(page.downloads):
        os.remove(os.path.join(page.downloads, name))


def check_page(page, gem, file, with_hits):
    html = file[:-3] + ".html"
    subprocess.run([gem, "view", file, "--out", html], check=True, stdout=subprocess.DEVNULL)
    address = "file://" + urllib.parse.quote(html)
    page.open(address)
    page.until("window.gemView && 1", 40)
    check_numbers(page, file)
    check_drive(page)
    check_play(page)
    check_click(page)
    check_colours(page)
    if page.value("gemView.largest && gemView.largest.force > 0"):
        check_arrows(page, file, time_of_long_sum(file, page.value("gemView.largestForce")))
    if page.value("gemView.run.description.contacts_recorded"):
        check_forces(page, file)
    if with_hits:
        page.value("document.getElementById('largest').click()")
        expect(page.value("gemView.time === gemView.largest.time && gemView.causes.length > 0"), "the largest load is shown")
        page.value("document.querySelector('#hits tbody tr').click()")
        expect(page.value("Number.isInteger(gemView.selected)"), "a hit in the list is shown")
    check_saved(page)
    expect(not page.faults(), f"no faults: {page.faults()}")
    outside = [one for one in page.requests() if not one.startswith(("file:", "blob:", "data:"))]
    expect(not outside, f"nothing is loaded: {outside}")


def check_ship(page, gem, file):
    """A ship on thrusters and a mooring, that starts beside its set point: an arrow each."""
    html = file[:-3] + ".html"
    subprocess.run([gem, "view", file, "--out", html], check=True, stdout=subprocess.DEVNULL)
    page.open("file://" + urllib.parse.quote(html))
    page.until("window.gemView && 1", 40)
    check_arrows(page, file, 4.0)


def check_browser(gem, cases, folder):
    if not browser.program():
        skip("no Chromium (package chromium)")
    try:
        import h5py  # noqa: F401
    except ImportError:
        skip("no h5py (package python3-h5py)")
    made = {name: os.path.join(folder, name + ".h5") for name in ("one", "jam", "three", "thrusters")}
    case = os.path.join(folder, "three.toml")
    with open(case, "w", encoding="utf-8") as file:
        file.write(three_floes())
    run(gem, os.path.join(cases, "004_400_25.toml"), made["one"], "--until", "20")
    run(gem, os.path.join(cases, "first.toml"), made["jam"], *JAM, "--set", "output.contact_forces=true")
    run(gem, case, made["three"])
    run(gem, os.path.join(cases, "dp_drillship.toml"), made["thrusters"], *THRUSTERS)
    with browser.Browser() as page:
        check_page(page, gem, made["one"], False)
        check_page(page, gem, made["jam"], True)
        check_page(page, gem, made["three"], True)
        expect(page.value("document.querySelector('h1').textContent") == EVIL, "names are text")
        expect(page.value("document.querySelectorAll('b').length") == 0, "names are never HTML")
        check_ship(page, gem, made["thrusters"])
        check_live(page, gem, os.path.join(cases, "first.toml"), folder)
        check_goodbye(page, gem, os.path.join(cases, "first.toml"), folder)


def skip(why):
    print("skipped: " + why)
    raise SystemExit(77)


def main():
    what, gem, cases = sys.argv[1:4]
    with tempfile.TemporaryDirectory(prefix="gem view ") as folder:
        {"server": check_server, "browser": check_browser}[what](gem, cases, folder)
    print("all as expected")


if __name__ == "__main__":
    main()
