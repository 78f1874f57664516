# SPDX-License-Identifier: Apache-2.0
"""Uses riis view as a person does, in Chromium without a window, and leaves a picture of each step (./run view --check).

    python check_view.py FOLDER [PROGRAM]

FOLDER gets the pictures and the files that the page writes. PROGRAM is the program riis, which runs the copied command. Each step
ends with checks, and the first check that fails ends the run. Times are measured and printed, but not checked. Every step waits
for what it needs, so a machine that does other work only makes the run longer.
"""

import hashlib
import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import statistics
import subprocess
import sys
import time
import urllib.error
import urllib.request

import numpy
import pyvista
from selenium import webdriver
from selenium.common.exceptions import (
    ElementClickInterceptedException, ElementNotInteractableException, JavascriptException, StaleElementReferenceException,
)  # fmt: skip
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from tube import mesh as mesh_of_tube

N_MOVES = 50
LIMIT = 600  # seconds that a step may take
ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOT_CENTRE = (-14.3, -172.6, -1083.4)  # of the annulus in examples/patient/make_patient.py


def tube(n_across=41, n_along=61, scale=1.0):
    """Returns a tube of tetrahedra around the z axis, of radius 1.26, with n_across^2 n_along nodes."""
    points, cells = mesh_of_tube(n_across, radius=1.26, length=3.2, n_z=n_along, middle=0.7)
    rows = numpy.column_stack([numpy.full(len(cells), 4), cells])
    return pyvista.UnstructuredGrid(rows.ravel(), numpy.full(len(cells), pyvista.CellType.TETRA), scale * points)


class Server:
    """riis view as a separate process."""

    def __init__(self, folder, *words):
        self.log = folder / "server.log"
        with open(self.log, "w", encoding="utf-8") as log:
            self.process = subprocess.Popen(
                [sys.executable, "-W", "ignore", "-m", "riis", "view", *map(str, words), "--no-browser", "--folder", str(folder)],
                stdout=log, stderr=subprocess.STDOUT, env={name: text for name, text in os.environ.items() if name != "DISPLAY"},
            )  # fmt: skip
        end = time.monotonic() + LIMIT
        while True:
            found = re.search(r"(http://127\.0\.0\.1:(\d+)/)#([0-9a-f]{64})", self.log.read_text(encoding="utf-8"))
            if found:
                break
            assert self.process.poll() is None and time.monotonic() < end, self.log.read_text(encoding="utf-8")
            time.sleep(0.1)
        self.address, self.root, self.port, self.key = found[0], found[1], int(found[2]), found[3]

    def end(self):
        """Ends the process as Ctrl C does. The process must end by itself, without an error."""
        self.process.send_signal(signal.SIGINT)
        assert self.process.wait(LIMIT) == 0, self.log.read_text(encoding="utf-8")


class Browser:
    """Chromium without a window."""

    def __init__(self, folder):
        options = webdriver.ChromeOptions()
        for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1500,1040", "--disable-dev-shm-usage"):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
        self.driver.command_executor.client_config.timeout = LIMIT  # otherwise Selenium waits two minutes for an answer
        self.driver.set_page_load_timeout(LIMIT)
        self.folder = folder

    def open(self, address):
        self.driver.get(address)
        self.rest()

    def get(self, name):
        return self.driver.execute_script("return window.trame.state.get(arguments[0])", name)

    def wait(self, condition, what):
        end = time.monotonic() + LIMIT
        while time.monotonic() < end:
            try:
                if condition():
                    return
            except (JavascriptException, StaleElementReferenceException):  # the page is not there yet, or draws itself again
                pass
            time.sleep(0.1)
        self.shot("failed")
        raise AssertionError(f"waited {LIMIT} s in vain: {what}")

    def rest(self):
        """Waits until the server has answered, the lights belong to the last change, and no new picture has come for a while."""
        ask = "window.riis_seen = false; window.trame.trigger('riis_seen', [0]).finally(() => { window.riis_seen = true; });"
        self.wait(lambda: self.driver.execute_script(ask + "return true"), "the page is there")
        self.wait(lambda: self.driver.execute_script("return window.riis_seen"), "the server has taken all changes")
        still, last = 0, -1

        def rests():
            nonlocal still, last
            time.sleep(0.15)
            is_at_rest = self.get("fresh") and self.get("at_rest") and self.get("progress") is None
            number = self.get("picture_number") if is_at_rest else -1
            still = still + 1 if number == last != -1 else 0
            last = number
            return still >= 6

        self.wait(rests, "the page comes to rest")

    def shot(self, name):
        self.driver.save_screenshot(str(self.folder / f"{name}.png"))

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def settle(self):
        """Waits for the end of all transitions, such as those of dialogs and of parts that unfold. Sliders move as long as a
        heartbeat plays, so their transitions do not count."""
        script = """return document.getAnimations().every(each => each.playState !== "running" ||
          each.effect.getComputedTiming().iterations === Infinity || each.effect.target.closest(".v-slider"))"""
        self.wait(lambda: self.driver.execute_script(script), "the end of all transitions")

    def click(self, find):
        """Clicks an element, once it is in sight and nothing lies over it. Returns the element."""
        clicked = []

        def click():
            element = find()
            self.driver.execute_script("arguments[0].scrollIntoView({ block: 'center' })", element)
            self.settle()
            try:
                element.click()
            except (ElementClickInterceptedException, ElementNotInteractableException):
                return False
            clicked.append(element)
            return True

        self.wait(click, "an element that can be clicked")
        return clicked[0]

    def press(self, selector):
        self.click(lambda: self.find(selector))

    def unfold(self, title):
        """Opens a folded part of the page, and leaves it open."""
        titles = self.driver.find_elements(By.CSS_SELECTOR, ".v-expansion-panel-title")
        for element in titles:
            if title in element.text and element.get_attribute("aria-expanded") != "true":
                self.click(lambda element=element: element)
                self.wait(lambda element=element: element.get_attribute("aria-expanded") == "true", f"{title} is open")
                self.settle()

    def write(self, selector, text):
        element = self.click(lambda: self.find(selector))
        element.send_keys(Keys.CONTROL, "a")
        element.send_keys(str(text) + Keys.ENTER)

    def close_text(self):
        self.press("#text-close")
        self.wait(lambda: not self.get("text_shown"), "the text is closed")
        self.settle()

    def drag_slider(self, name, pixels):
        thumb = self.find(f"[data-parameter='{name}'] .v-slider-thumb")
        ActionChains(self.driver, duration=40).click_and_hold(thumb).move_by_offset(pixels // 2, 0).move_by_offset(
            pixels - pixels // 2, 0
        ).release().perform()

    def drag_picture(self, start, *steps):
        picture = self.find("#riis-picture")
        chain = ActionChains(self.driver, duration=40).move_to_element_with_offset(picture, *start).click_and_hold()
        for step in steps:
            chain = chain.move_by_offset(*step)
        chain.release().perform()

    def click_picture(self, x, y):
        ActionChains(self.driver).move_to_element_with_offset(self.find("#riis-picture"), x, y).click().perform()

    def refused(self, text):
        self.wait(lambda: text in (self.get("message") or ""), f"a message with '{text}'")
        assert self.find("#message").is_displayed()

    def light(self, name):
        return next(light for light in self.get("lights") if light["name"] == name)


def digest_of(grid):
    """Returns the digest of the marks in a file, computed as the page does for its own marks."""
    ids = numpy.flatnonzero(grid.point_data["riis_marked"]).astype(numpy.int64)
    distance, leaflet = (numpy.asarray(grid.point_data[f"riis_{name}"])[ids] for name in ("distance", "leaflet"))
    return hashlib.sha256(ids.tobytes() + distance.tobytes() + leaflet.astype(numpy.int32).tobytes()).hexdigest()


def say(text):
    print(f"  {text}", flush=True)


def load_and_move(browser):
    browser.shot("1-loaded")
    assert browser.get("message") == "", browser.get("message")
    assert browser.light("sealed")["level"] == "good", browser.light("sealed")
    first = browser.get("digest")
    browser.drag_slider("opening", 190)
    browser.rest()
    assert 0.3 < browser.get("slider_0") < 0.9 and browser.get("digest") != first
    browser.shot("2-opening-moved")
    say(f"a drag of the slider gives opening {browser.get('slider_0')} and other marks")
    number = browser.get("picture_number")
    browser.drag_picture((150, 0), (-90, 25), (-90, 25))
    browser.wait(lambda: browser.get("picture_number") > number, "the camera turns")
    browser.rest()
    browser.shot("3-view-turned")
    for look in ("top", "side", "oblique"):
        browser.press(f"#look-{look}")
        browser.rest()
        browser.shot(f"3-look-{look}")
    browser.press("#undo")
    browser.wait(lambda: browser.get("digest") == first, "undo gives the first marks")
    say("one undo gives the first marks")


def place_by_clicks(browser):
    browser.unfold("Placement")
    before = browser.get("placement")
    browser.press("#click-three")
    browser.wait(lambda: browser.get("tool") == "click", "the page waits for clicks")
    for k, (x, y) in enumerate(((-150, 60), (10, 25), (160, 60))):
        browser.click_picture(x, y)
        if k < 2:
            browser.wait(lambda k=k: browser.get("n_clicks") == k + 1, f"click {k + 1} meets the wall")
            browser.shot(f"4-landmark-{k + 1}")
    browser.wait(lambda: browser.get("tool") == "look", "three clicks are enough")
    browser.rest()
    browser.shot("4-placed-by-landmarks")
    assert browser.get("message") == "", browser.get("message")
    assert browser.get("placement") != before
    say("three clicks place the valve")
    browser.press("#undo")
    browser.rest()
    assert browser.get("placement") == before
    browser.press("button[value=move]")
    browser.drag_picture((0, 60), (15, 0), (15, -10))
    browser.rest()
    assert browser.get("placement")[0]["values"] != before[0]["values"]
    browser.shot("5-moved-by-hand")
    browser.press("#undo")
    browser.press("button[value=look]")
    browser.write("#place-origin-2", "0.05")
    browser.wait(lambda: browser.get("placement")[0]["values"][2] == "0.05", "a typed number moves the valve")
    browser.rest()
    say("a drag in the picture and a typed number move the valve")


def watch_times(browser):
    """Waits until the page has shown eight times of a heartbeat."""
    times, end = [], time.monotonic() + LIMIT
    while len(set(times)) < 8 and time.monotonic() < end:
        times.append(browser.get("time"))
        time.sleep(0.05)
        if 0.1 < times[-1] < 0.35:
            browser.shot("6-playing")
    assert len(set(times)) >= 8, sorted(set(times))


def play(browser):
    browser.press("#play")
    browser.wait(lambda: browser.get("playing") and len(browser.get("curves")) == 3, "it plays, with curves")
    watch_times(browser)
    # The heartbeat continues if the event "load" of a picture comes before the picture's number, or not at all.
    browser.driver.execute_script(
        "window.riis_hide = (event) => event.stopImmediatePropagation();"
        'document.getElementById("riis-picture").addEventListener("load", window.riis_hide, true)'
    )
    watch_times(browser)
    browser.driver.execute_script(
        'document.getElementById("riis-picture").removeEventListener("load", window.riis_hide, true)'
    )
    browser.press("#play")
    browser.wait(lambda: not browser.get("playing"), "it pauses")
    browser.rest()
    browser.shot("6-paused")
    say("it plays and pauses")


def write_and_reopen(browser, folder, program):
    browser.write("#slider-opening", "0.4")
    browser.unfold("Sizes of the whole valve")
    browser.write("#parameter-skirt_length, #slider-skirt_length", "0.1")
    browser.rest()
    digest = browser.get("digest")
    browser.write("#slider-offset", "0.75")
    browser.wait(lambda: browser.get("digest") != digest, "the offset gives other marks")
    browser.rest()
    browser.shot("7-parameters")
    names = ("slider_0", "sliders", "rows", "placement", "legend")
    digest, state = browser.get("digest"), {name: browser.get(name) for name in names}
    for name in ("case", "command", "python", "openfoam"):
        browser.press(f"#text-{name}")
        browser.wait(lambda: browser.get("text_shown"), f"the text of {name}")
        browser.settle()
        browser.shot(f"8-text-{name}")
        browser.press("#text-write")
        browser.wait(lambda: "wrote" in browser.get("message"), f"the file of {name}")
        browser.close_text()
    for name, ending in (("view", ".view.json"), ("mesh", ".vtu"), ("picture", ".png"), ("movie", ".mp4")):
        browser.press(f"#write-{name}")
        browser.wait(lambda e=ending: f"valve{e}" in browser.get("message"), f"the file of {name}")
        assert (folder / f"valve{ending}").stat().st_size > 500
    browser.rest()
    browser.shot("8-written")
    in_file = digest_of(pyvista.read(folder / "valve.vtu"))
    assert in_file == digest, "the saved mesh has other marks than the page"
    say("the marks in the saved mesh are those of the page, to the last bit")
    lines = {"sh": "--offset=0.75", "case.json": '"offset": 0.75', "py": "offset=0.75", "foam.txt": "offset 0.75;"}
    for name, line in lines.items():
        assert line in (folder / f"valve.{name}").read_text(encoding="utf-8"), f"valve.{name} lacks {line}"
    if program:
        command = (folder / "valve.sh").read_text(encoding="utf-8")
        words = shlex.split(command.replace("\\\n", " "))
        words = [program, *words[1:-1], f"--output={folder / 'by_command.vtu'}"]
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
        assert digest_of(pyvista.read(folder / "by_command.vtu")) == digest, "the copied command gives other marks"
        say("the copied command gives the same bits")
    script = (folder / "valve.py").read_text(encoding="utf-8") + "\nimport hashlib\nfor m in marks.values():\n    print(len(m))\n"
    said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=folder)
    assert int(said.stdout.split()[-1]) == browser.get("n_marked")
    say("the Python lines mark as many nodes")
    browser.write("#slider-opening", "0.9")
    browser.wait(lambda: browser.get("digest") != digest, "another opening gives other marks")
    browser.rest()
    browser.unfold("Mesh, wall, landmarks")
    browser.write("#open-view", "valve.view.json")
    browser.wait(lambda: "opened" in browser.get("message"), "the saved view opens")
    browser.rest()
    browser.shot("9-reopened")
    assert browser.get("digest") == digest
    differ = [name for name in names if browser.get(name) != state[name]]
    assert not differ, f"the reopened view differs in {differ}"
    say("the saved view opens again as it was")


def several_valves(browser, folder, program):
    """Two valves beat. The copied command marks what the page shows, and the saved view opens again with its camera."""
    browser.press("#add-valve")
    browser.wait(lambda: len(browser.get("valve_names")) == 2, "a second valve")
    browser.driver.execute_script("window.trame.state.set('kind', 'mitral')")
    browser.wait(lambda: browser.get("valve_names")[1] == "mitral", "a mitral valve")
    browser.write("#place-origin-2", "0.9")
    browser.rest()
    browser.press("#play")
    browser.wait(lambda: browser.get("playing") and browser.get("time") > 0.2, "two valves play")
    browser.press("#play")
    browser.wait(lambda: not browser.get("playing"), "they pause")
    browser.press("#look-side")
    browser.rest()
    names = (
        "digest", "valve_names", "current", "time", "slider_0", "sliders", "rows", "placement", "legend", "curves", "picture",
    )  # fmt: skip
    shown = {name: browser.get(name) for name in names}
    browser.shot("9-two-valves")
    browser.write("#file-name", "two")
    browser.press("#write-view")
    browser.wait(lambda: "two.view.json" in browser.get("message"), "the view of two valves")
    browser.press("#text-command")
    browser.wait(lambda: browser.get("text_shown"), "the command of two valves")
    browser.settle()
    browser.shot("9-two-valves-command")
    browser.press("#text-write")
    browser.wait(lambda: "two.sh" in browser.get("message"), "the file of the command")
    browser.close_text()
    if program:
        path = {"PATH": f"{pathlib.Path(program).resolve().parent}:{os.environ['PATH']}"}
        subprocess.run(["bash", "-e", folder / "two.sh"], check=True, stdout=subprocess.DEVNULL, env=os.environ | path)
        made = pyvista.read(folder / "two.vtu").point_data
        is_marked = numpy.logical_or.reduce([made[f"{name}_marked"] == 1 for name in shown["valve_names"]])
        assert numpy.count_nonzero(is_marked) == browser.get("n_marked"), "the command of two valves marks other nodes"
        say("the copied command of two valves that beat marks the nodes that are seen")
    browser.press("#look-top")
    browser.write("#slider-half_thickness", "0.2")
    browser.rest()
    assert browser.get("digest") != shown["digest"]
    browser.write("#open-view", "two.view.json")
    browser.wait(lambda: "opened" in browser.get("message"), "the view of two valves opens")
    browser.rest()
    browser.shot("9-two-valves-reopened")
    differ = [name for name in names if browser.get(name) != shown[name]]
    assert not differ, f"reopened, two valves differ in {differ}"
    say("the saved view of two valves opens again as it was, with the same picture")
    browser.driver.execute_script("window.trame.state.set('current', 0)")  # the coapting valve again
    browser.wait(lambda: browser.get("kind") == "coapting", "the first valve")
    browser.rest()


def disease(browser):
    """A bicuspid valve with unequal cusps and a bump, whose place is shown on the free edge."""
    browser.driver.execute_script("window.trame.state.set('kind', 'bicuspid')")
    browser.wait(lambda: browser.get("most_bumps") == 6, "a bicuspid valve")
    browser.rest()
    browser.unfold("Sizes of single leaflets")
    browser.rest()
    browser.drag_slider("cusp_0.sector", 20)
    browser.rest()
    assert browser.get("sliders")[12]["changed"] and browser.get("slider_12") > 185.0
    browser.write("[id='slider-cusp_0.sector']", "200")
    browser.write("[id='slider-cusp_1.sector']", "160")
    browser.write("#slider-opening", "1")
    browser.rest()
    browser.shot("12-unequal-cusps")
    healthy, n_marked = browser.get("digest"), browser.get("n_marked")
    browser.unfold("Disease at one place")
    browser.press("#add-bump")
    browser.wait(lambda: browser.get("bump") == 0, "a bump")
    browser.rest()
    assert browser.get("n_marked") == n_marked, "a new bump changes the marks"
    browser.write("[id='slider-bump_0.width']", "0.25")
    browser.write("[id='slider-bump_0.open']", "0.1")
    browser.press("#look-top")
    browser.rest()
    assert browser.get("digest") != healthy, "a bump changes no mark"
    browser.shot("12-a-bump")
    browser.drag_slider("bump_0.u", 30)
    browser.rest()
    browser.shot("12-the-bump-moved")
    browser.press("#remove-bump")
    browser.rest()
    assert browser.get("digest") == healthy, "without its bump the valve has other marks"
    say("a bicuspid valve has sectors and a bump, and without the bump it has its marks again")
    browser.driver.execute_script("window.trame.state.set('kind', 'coapting')")
    browser.rest()


def bad_input(browser, folder):
    browser.rest()
    digest = browser.get("digest")
    (folder / "text.vtu").write_text("this is no mesh\n", encoding="utf-8")
    (folder / "empty.vtk").write_text("", encoding="utf-8")
    pyvista.Sphere().save(folder / "surface.vtk")
    pyvista.Sphere().cast_to_unstructured_grid().save(folder / "triangles.vtu")
    for name, text in (
        ("no such.vtu", "there is no such file"), ("text.vtu", "is not a mesh"), ("empty.vtk", "is not a mesh"),
        ("surface.vtk", "is a surface"), ("triangles.vtu", "volume cell"), ("server.log", "riis view reads"),
    ):  # fmt: skip
        browser.write("#open-mesh", name)
        browser.refused(name)
        browser.refused(text)
        browser.shot(f"10-refused-{name.split('.')[0].replace(' ', '-')}-{name.split('.')[1]}")
    for selector, value, text in (
        ("#slider-opening", "1.5", "opening"), ("#slider-annulus", "-1", "annulus"), ("#place-scale-0", "0", "scale"),
    ):  # fmt: skip
        browser.write(selector, value)
        browser.refused(text)
        browser.rest()
        assert browser.find(selector).get_property("value") != value, f"{selector} still shows {value}"
    browser.shot("10-refused-parameter")
    assert browser.get("digest") == digest, "a refusal changed the marks"
    tube(25, 31, 10.0).save(folder / "millimetres.vtu")
    browser.write("#open-mesh", "millimetres.vtu")
    browser.wait(lambda: "millimetres" in browser.get("mesh_text"), "the mesh in millimetres opens")
    browser.rest()
    browser.shot("11-millimetres")
    assert browser.light("unit")["level"] != "good" and "millimetres" in browser.light("unit")["advice"]
    browser.press("#cure-unit")
    browser.rest()
    browser.shot("11-millimetres-cured")
    assert browser.find(".v-app-bar").rect["y"] == 0, "the page has scrolled"
    assert browser.light("unit")["level"] == "good", browser.light("unit")
    say("bad files and values give a message; a mesh in millimetres gives a light, and a click cures it")


def patient(folder, program):
    """From a patient's wall, by clicks on landmarks, to a placed valve with a skirt in a mesh. The copied command gives its
    marks."""
    folder = folder / "patient"
    folder.mkdir()
    subprocess.run([sys.executable, ROOT / "examples/patient/make_patient.py", folder], check=True)
    wall = pyvista.read(folder / "root.stl")
    grid = pyvista.ImageData(dimensions=(40, 40, 40), spacing=3 * [1.0], origin=numpy.array(ROOT_CENTRE) - 20.0)
    grid.cast_to_unstructured_grid().save(folder / "box.vtu")
    server, browser = Server(folder, "--wall", folder / "root.stl", "--unit", "mm"), Browser(folder.parent)
    try:
        browser.open(server.address)
        browser.unfold("Landmarks and wall")
        browser.rest()
        browser.shot("9-patient-first")
        browser.press("#landmark-nadir_right")
        browser.click_picture(0, 40)
        browser.wait(lambda: browser.get("landmark") == "nadir_left", "the next landmark is chosen")
        point = [float(text) for text in browser.get("landmarks")[0]["value"].split(",")]
        found = pyvista.PolyData(numpy.array([point])).compute_implicit_distance(wall)
        assert abs(found.point_data["implicit_distance"][0]) < 0.1, point
        browser.click_picture(40, 60)
        browser.wait(lambda: browser.get("landmarks")[1]["set"], "a second landmark")
        browser.shot("9-patient-picked")
        browser.press("#place-landmarks")
        browser.refused("missing; pick them on the wall")
        browser.press("#undo")
        browser.press("#undo")
        browser.wait(lambda: not any(row["set"] for row in browser.get("landmarks")), "undo removes both landmarks")
        browser.unfold("Mesh, wall, landmarks")
        browser.write("#open-landmarks", "landmarks.mrk.json")
        browser.wait(lambda: sum(row["set"] for row in browser.get("landmarks")) == 6, "the landmarks of the file")
        browser.press("#place-landmarks")
        browser.wait(lambda: browser.get("found").get("title") == "Placed by landmarks", "the valve is placed")
        browser.rest()
        assert not browser.get("message"), "a refusal stays after it is cured"
        browser.shot("9-patient-placed")
        browser.press("#skirt-on")
        browser.wait(lambda: browser.get("skirt_on"), "the skirt")
        browser.write("#open-mesh", "box.vtu")
        browser.wait(lambda: "box.vtu" in browser.get("mesh_text"), "the mesh")
        browser.write("#slider-opening", "0.4")
        browser.rest()
        assert browser.get("skirt_on") and browser.get("n_marked") > 500
        browser.shot("9-patient-in-its-mesh")
        browser.press("#text-command")
        browser.wait(lambda: browser.get("text_shown"), "the command")
        command = browser.get("text")
        browser.close_text()
        if program:
            path = os.pathsep.join([str(pathlib.Path(program).resolve().parent), os.environ["PATH"]])
            subprocess.run(["sh", "-c", command], check=True, stdout=subprocess.DEVNULL, env=os.environ | {"PATH": path})
            assert digest_of(pyvista.read(folder / "valve.vtu")) == browser.get("digest"), "the command gives other marks"
            say("the command copied from the patient's page gives the same bits, with its warp and skirt")
        browser.write("#picture-width", "3840")
        browser.write("#picture-height", "2160")
        browser.rest()
        browser.press("#write-picture")
        browser.wait(lambda: "valve.png" in browser.get("message"), "the picture")
        assert pyvista.read(folder / "valve.png").dimensions[:2] == (3840, 2160)
        say("landmarks place the valve in its wall, and a picture has 3840 x 2160 pixels")
    finally:
        browser.driver.quit()
        server.end()


def status_of(server, path, **headers):
    request = urllib.request.Request(server.root + path, headers={name.replace("_", "-"): text for name, text in headers.items()})
    try:
        with urllib.request.urlopen(request, timeout=LIMIT) as answer:
            return answer.status, answer.read()
    except urllib.error.HTTPError as error:
        return error.code, error.read()


def strangers(server):
    upgrade = {
        "Connection": "Upgrade", "Upgrade": "websocket", "Sec_WebSocket_Version": "13",
        "Sec_WebSocket_Key": "MDEyMzQ1Njc4OWFiY2RlZg==",
    }  # fmt: skip
    assert status_of(server, "")[0] == 200 and b"tube" not in status_of(server, "")[1]
    assert status_of(server, "", Host="evil.example")[0] == 403
    assert status_of(server, "", Origin="http://evil.example")[0] == 403
    for path in ("ws", "ws?key=", "ws?key=wslink-secret", f"ws?key={server.key[:-1]}"):
        assert status_of(server, path, **upgrade)[0] == 403, path
    assert status_of(server, f"ws?key={server.key}", **upgrade, Origin="http://127.0.0.1:1")[0] == 403
    words = subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True, check=True).stdout
    assert "riis" in words and server.key not in words, "the key is in a command line"
    say("foreign hosts and origins, and sockets without the key, are refused; the key is in no command line")


def two_browsers(browser, server, folder):
    other = Browser(folder)
    other.open(server.address)
    browser.write("#slider-opening", "0.7")
    other.wait(lambda: other.get("slider_0") == 0.7, "the second browser follows the first")
    other.rest()
    other.shot("12-second-browser")
    other.press("#play")
    browser.wait(lambda: browser.get("playing"), "it plays in both")
    other.driver.quit()
    time.sleep(1)
    browser.press("#play")
    browser.wait(lambda: not browser.get("playing"), "the first browser pauses it")
    say("two browsers show the same")


def closed_while_it_plays(server, folder):
    browser = Browser(folder)
    browser.open(server.address)
    browser.press("#play")
    browser.wait(lambda: browser.get("playing"), "it plays")
    browser.driver.quit()
    time.sleep(7)
    again = Browser(folder)
    again.open(server.address)
    assert again.get("playing") is False
    again.write("#slider-opening", "0.2")
    again.rest()
    again.driver.quit()
    say("a browser that is closed while it plays stops the heartbeat; the server lives on")


def measure(browser):
    script = """
      const n = arguments[0], image = document.getElementById("riis-picture");
      window.riis_times = [];
      function next() {
        if (window.riis_times.length === n) return;
        const before = Number(image.dataset.number), start = performance.now();
        const loaded = () => {
          if (Number(image.dataset.number) <= before) return;
          image.removeEventListener("load", loaded);
          window.riis_times.push([performance.now() - start, window.trame.state.get("milliseconds")]);
          setTimeout(next, 20);
        };
        image.addEventListener("load", loaded);
        window.trame.state.set("slider_0", 0.2 + 0.6 * ((window.riis_times.length * 7) % n) / n);
      }
      next();
    """
    browser.driver.execute_script(script, N_MOVES)
    n_done = "return window.riis_times.length"
    for n in range(5, N_MOVES + 1, 5):
        browser.wait(lambda n=n: browser.driver.execute_script(n_done) >= n, f"the picture of move {n}")
    times, marks = zip(*browser.driver.execute_script("return window.riis_times"))
    print(
        f"median of {N_MOVES} moves, {browser.get('mesh_text')}: new marks {statistics.median(marks):.1f} ms, from the move to "
        f"the picture in the browser {statistics.median(times):.0f} ms"
    )


def main(folder, program=None):
    folder = pathlib.Path(folder).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    tube().save(folder / "tube.vtu")
    server = Server(folder, folder / "tube.vtu")
    browser = None
    try:
        start = time.monotonic()
        browser = Browser(folder)
        browser.open(server.address)
        say(f"the page is at rest {time.monotonic() - start:.1f} s after the browser's start")
        strangers(server)
        load_and_move(browser)
        measure(browser)
        place_by_clicks(browser)
        play(browser)
        write_and_reopen(browser, folder, program)
        several_valves(browser, folder, program)
        two_browsers(browser, server, folder)
        bad_input(browser, folder)
        disease(browser)
        patient(folder, program)
        complaints = [line["message"] for line in browser.driver.get_log("browser") if line["level"] == "SEVERE"]
        assert not complaints, json.dumps(complaints, indent=2)
        browser.driver.quit()
        closed_while_it_plays(server, folder)
        server.end()
        say("Ctrl C ends the server cleanly")
    finally:
        if server.process.poll() is None:
            server.process.kill()
        if browser is not None:
            browser.driver.quit()
    print(f"{len(list(folder.glob('*.png')))} pictures are in {folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
