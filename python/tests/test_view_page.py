# SPDX-License-Identifier: Apache-2.0
"""The server of riis view without a browser: who may see the page, and what it refuses. ./run view --check uses a browser."""

import asyncio
import base64
import html
import importlib.util
import io
import json
import os
import re
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import warnings
import zipfile
from random import Random

import numpy
import pytest

import riis

pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")
pytest.importorskip("trame", reason="trame is missing; ./run python installs it")

import aiohttp  # noqa: E402
import msgpack  # noqa: E402
from wslink import chunking  # noqa: E402

from riis.__main__ import main  # noqa: E402
from riis.view import guard, heartbeat, reading, scene  # noqa: E402
from riis.view.model import Model  # noqa: E402
from riis.view.page import Page  # noqa: E402
from test_view_patient import ROOT, synthetic_patient  # noqa: E402


def box(n=12):
    """Returns a box of hexahedra around a valve, of n^3 nodes."""
    image = pyvista.ImageData(dimensions=(n, n, n), spacing=3 * [4.0 / (n - 1)], origin=(-2.0, -2.0, -1.5))
    return image.cast_to_unstructured_grid()


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    """Returns riis view as a process, with its address, its port and its key."""
    try:
        scene.check_of_graphics()
    except RuntimeError as missing:
        pytest.skip(str(missing))
    folder = tmp_path_factory.mktemp("view")
    box().save(folder / "box.vtu")
    words = [sys.executable, "-W", "ignore", "-m", "riis", "view", str(folder / "box.vtu"), "--no-browser"]
    environment = os.environ | {"XDG_RUNTIME_DIR": str(folder)}
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment) as process:
        found = re.search(r"http://127\.0\.0\.1:(\d+)/#([0-9a-f]{64})", process.stdout.readline())
        yield process, int(found[1]), found[2], folder
        process.kill()


def test_hosts_and_origins():
    for host in "127.0.0.1:80", "localhost:80", "LOCALHOST:80", "localhost":
        assert guard.is_own(host, None) and guard.is_own(host, f"http://{host}")
        for origin in "http://evil.example", f"https://{host}", f"http://{host}.evil.example", "null", "", "http://127.0.0.1:81":
            assert not guard.is_own(host, origin), (host, origin)
    for host in (
        "evil.example", "127.0.0.1.evil.example", "", ":80", "10.0.0.1:80", "127.0.0.2:80", "[::1]:80",
        "localhost:80 x", "127x0.0.1",
    ):  # fmt: skip
        assert not guard.is_own(host, None) and not guard.is_own(host, f"http://{host}")
    assert guard.is_key("ab", "ab")
    assert not any(guard.is_key(given, "ab") for given in (None, "", "a", "abc", "AB", "äb", "wslink-secret"))


def test_the_key_opens_the_socket_and_nothing_else_does(server):
    process, port, key, folder = server
    root = f"127.0.0.1:{port}"

    async def hello(session, secret):
        """Sends a greeting over an open socket, and requests the state. Returns both answers."""
        async with session.ws_connect(f"http://{root}/ws?key={key}") as socket:
            parts = chunking.UnChunker()
            parts.set_max_message_size(10**9)

            async def answer(number, method, *values):
                message = {"wslink": "1.0", "id": number, "method": method, "args": list(values), "kwargs": {}}
                for chunk in chunking.generate_chunks(msgpack.packb(message), 100_000):
                    await socket.send_bytes(chunk)
                while True:
                    whole = parts.process_chunk((await socket.receive(timeout=30)).data)
                    whole = msgpack.unpackb(whole) if isinstance(whole, bytes) else whole
                    if whole is not None and whole.get("id") == number:
                        return whole

            return await answer("system:c0:0", "wslink.hello", {"secret": secret}), await answer("rpc:c0:1", "trame.state.get")

    async def try_all():
        async with aiohttp.ClientSession() as session:
            async def status(path, **headers):
                async with session.get(f"http://{root}/{path}", headers=headers, allow_redirects=False) as answer:
                    return answer.status, await answer.text(), answer.headers

            code, text, headers = await status("")
            assert code == 200 and key not in text and "box" not in text
            assert "frame-ancestors 'none'" in headers["Content-Security-Policy"]
            assert "Access-Control-Allow-Origin" not in headers
            for path in "index.html", f"index.html?secret={key[:-1]}":  # without the key only the first page is there
                assert (await status(path))[1] == text
            assert (await status("", Host="evil.example"))[0] == 403
            assert (await status("", Origin="http://evil.example"))[0] == 403
            for query in "", "?key=", "?key=wslink-secret", f"?key={key[:-1]}", f"?secret={key}":
                with pytest.raises(aiohttp.WSServerHandshakeError) as refused:
                    await session.ws_connect(f"http://{root}/ws{query}")
                assert refused.value.status == 403
            with pytest.raises(aiohttp.WSServerHandshakeError) as refused:
                await session.ws_connect(f"http://{root}/ws?key={key}", headers={"Origin": "http://127.0.0.1:1"})
            assert refused.value.status == 403
            for secret in "wslink-secret", "", key[:-1]:
                first, state = await hello(session, secret)
                assert "error" in first and "error" in state and "result" not in state
                assert "picture" not in json.dumps(state)
            first, state = await hello(session, key)
            assert "clientID" in first["result"] and state["result"]["state"]["trame__title"] == "riis view"

    asyncio.run(try_all())
    words = [open(f"/proc/{number}/cmdline", "rb").read() for number in os.listdir("/proc") if number == str(process.pid)]
    assert len(words) == 1 and key.encode() not in words[0]
    (keys,) = folder.glob("riis-view-*")
    assert keys.stat().st_mode & 0o777 == 0o700
    assert sorted(path.name for path in keys.iterdir()) == ["key", "open.html"]
    assert all(path.stat().st_mode & 0o777 == 0o600 and key in path.read_text() for path in keys.iterdir())
    process.send_signal(signal.SIGTERM)
    assert process.wait(30) == 0
    assert not keys.exists()


def test_a_browser_needs_a_desktop(monkeypatch):
    monkeypatch.setattr(sys, "platform", "linux")
    for name in "DISPLAY", "WAYLAND_DISPLAY", "BROWSER":
        monkeypatch.delenv(name, raising=False)
    assert not guard.has_desktop()
    monkeypatch.setenv("WAYLAND_DISPLAY", "wayland-0")
    assert guard.has_desktop()


def test_a_page_loses_nothing(tmp_path):
    """Undo, refusals, and changes during the writing of a movie leave the page as it was."""
    pytest.importorskip("imageio_ffmpeg", reason="imageio-ffmpeg is missing; ./run python installs it")
    try:
        scene.check_of_graphics()
    except RuntimeError as missing:
        pytest.skip(str(missing))
    grid = box()
    grid.cell_data["half"] = numpy.where(grid.cell_centers().points[:, 2] > 0.6, 1, 2)
    grid.save(tmp_path / "box.vtu")
    box(10).save(tmp_path / "other.vtu")

    async def use():
        page = Page(None, folder=str(tmp_path))

        def tell(function, *values):
            page._told(function)(*values)
            return page.state.message

        async def tell_task(work):
            page._begin_task(work)
            while page._tasks:
                await asyncio.wait(page._tasks)
            return page.state.message

        assert await tell_task(page._read(str(tmp_path / "box.vtu"))) == ""
        assert tell(page._on_undo) == "" and len(page.model.valves) == 1  # the page's own first valve is not a step of undo
        assert "the last valve stays" in tell(page._on_remove) and len(page.model.valves) == 1

        page.state.message = ""
        page.model.save(tmp_path / "valve.view.json")
        root = json.loads((tmp_path / "valve.view.json").read_text())
        (tmp_path / "wrong.view.json").write_text(json.dumps(root | {"mesh": str(tmp_path / "other.vtu")}))
        (tmp_path / "empty.view.json").write_text(json.dumps(root | {"valves": []}))
        model = page.model
        for name, text in (("wrong", "is of a mesh with 1728 nodes; this one has 1000"), ("empty", "has no valves")):
            assert text in await tell_task(page._reopen(str(tmp_path / f"{name}.view.json")))
            assert page.model is model and page.state.path.endswith("box.vtu")
        page.model.set(0, "half_thickness", 0.2)
        assert "opened" in await tell_task(page._reopen(str(tmp_path / "valve.view.json")))
        assert page.model is model and page.model.valves[0].half_thickness == root["valves"][0]["half_thickness"]
        shutil.copy(tmp_path / "box.vtu", tmp_path / "moved.vtu")
        assert "opened" in await tell_task(page._reopen(str(tmp_path / "valve.view.json"), str(tmp_path / "moved.vtu")))
        assert page.state.path.endswith("moved.vtu") and not page.model.can_undo

        assert await tell_task(page._read(str(tmp_path / "box.vtu"), cells_where="half=1")) == ""
        assert page._grid.n_cells == 605 and "605 cells with half=1" in page.state.mesh_text
        page.model.save(tmp_path / "half.view.json")
        assert "no cell array no of single" in await tell_task(page._read(str(tmp_path / "box.vtu"), cells_where="no=1"))
        page._on_open("cells", "all")
        await asyncio.wait(page._tasks)
        assert page._grid.n_cells == 1331 and page.model.cells_where is None
        assert "opened" in await tell_task(page._reopen(str(tmp_path / "half.view.json")))
        assert page._grid.n_cells == 605
        page._on_open("cells", "all")
        await asyncio.wait(page._tasks)

        page._need_cycle()
        before = page.model.valves
        (tmp_path / "valve.mp4").write_text("an older movie")
        work = asyncio.ensure_future(page._movie(tmp_path / "valve.mp4", n_frames=3))
        await asyncio.sleep(0)
        for call, values in ((page._on_set, ("half_thickness", "0.3")), (page._on_undo, ()), (page._on_write, ("movie",))):
            page.state.message = ""
            assert tell(call, *values) == "a movie is being written; wait until this is done"
        page._on_size(640, 490)
        with pytest.raises(reading.Refusal, match="a movie is being written"):
            await page._read(str(tmp_path / "other.vtu"))
        assert not work.done() and page.scene.size == (896, 688)
        await work
        assert page.model.valves == before and page.scene.size == (640, 490)
        assert (tmp_path / "valve.mp4").read_bytes()[4:8] == b"ftyp" and not list(tmp_path.glob(".*"))

        page.model.set_cycle(None)  # a surface that moves also gives a case of many times
        page.model.add_surface([numpy.eye(3), 2 * numpy.eye(3)], [[0, 1, 2]], times=[0.0, 0.5], path="leaflet.pvd")
        assert len(json.loads(page._text("case"))["times"]) == 51

        # Two valves beat. The command marks what the page shows, and a saved view opens again as it was.
        page.model.remove(1)
        page._on_add("mitral")
        page._need_cycle()
        page._told(page._at)(0.5)
        text = page._text("command")
        assert text.startswith(f"cat >{tmp_path}/valve.now.case.json <<'END'\n{{")
        case = json.loads(text[text.index("{") : text.index("END\n")])
        assert [valve["opening"] for valve in case["valves"]] == [valve.opening for valve in page.model.valves] != [0.0, 0.0]
        assert "times" not in case and f"--case {tmp_path}/valve.now.case.json" in text
        page.scene.turn_view(0.1, 0.2)
        page.scene.cut_here((0.0, 0.1, 0.0), (0.0, 0.0, 1.0))
        with page.state as state:
            state.wall, state.cells, state.speed, state.replace = "clear", "marked", 0.5, True
        seen, states, time = page._as_saved(), page.model.valves, page.model.time
        page._on_write("view")
        page._look("top")
        with page.state as state:
            state.wall, state.cells, state.speed, state.current = "cut", "none", 1.0, 0
        page._told(page._at)(0.1)
        assert "opened" in await tell_task(page._reopen(str(tmp_path / "valve.view.json")))
        assert page._as_saved() == seen and seen["current"] == 1 and page.model.time == time == page.state.time
        assert [valve.opening for valve in page.model.valves] == [valve.opening for valve in states]
        root, before = json.loads((tmp_path / "valve.view.json").read_text()), page.model.valves
        for name, value in (("wall", "brick"), ("cells", []), ("current", 2), ("speed", True), ("view", 3), ("view", {"up": "z"}),
                            ("view", root["page"]["view"] | {"cut_normal": [0, 0, 0]})):
            (tmp_path / "bad.view.json").write_text(json.dumps(root | {"page": root["page"] | {name: value}}))
            assert "the saved view is damaged: " in await tell_task(page._reopen(str(tmp_path / "bad.view.json")))
            assert page.model.valves == before and page._as_saved() == seen

        # A person's input is refused. A fault of the page says that it is a fault.
        for name, value in (("annulus", "1 2"), ("translation", "1"), ("half_thickness", "1 2"), ("gap", "wide")):
            page.state.current = 0
            assert "fault of riis view" not in tell(page._on_set, name, value) and name in page.state.message
        for error in (TypeError("a list"), KeyError("size"), ValueError("odd")):
            def fails(error=error):
                raise error

            assert "this is a fault of riis view" in tell(fails)

    asyncio.run(use())


def test_leaflets_and_bumps_have_sliders(tmp_path):
    """The page changes one size of all leaflets, and one bump, whose place it draws while its panel is unfolded."""
    try:
        scene.check_of_graphics()
    except RuntimeError as missing:
        pytest.skip(str(missing))
    box().save(tmp_path / "box.vtu")

    async def use():
        page = Page(None, folder=str(tmp_path))
        await page._read(str(tmp_path / "box.vtu"))
        state = page.state

        def choose(**chosen):
            with state:
                state.update(chosen)
            for name in chosen:
                page._told(getattr(page, f"_changed_{name}"))()

        def slots():
            return {slider["name"]: k for k, slider in enumerate(state.sliders) if slider is not None}

        def slide(name, value):
            with state:
                state[f"slider_{slots()[name]}"] = value
            page._told(page._slid)(slots()[name])
            page._show_numbers()

        def valve():
            return page.model.valves[0]

        choose(kind="bicuspid")
        assert state.size == "cusp sector" and "commissure fusion" in state.sizes and state.most_bumps == 6
        assert slots()["annulus"] < slots()["cusp_0.sector"] < slots()["cusp_1.sector"] and state.bumps == []
        assert not any(name.startswith("bump") for name in slots())
        assert not any("." in row["name"] for row in state.rows) and len(state.rows) < 20
        slide("cusp_0.sector", 150.0)
        assert valve().parameters == {"cusp_0.sector": 150.0} and state.sliders[slots()["cusp_0.sector"]]["changed"]
        page._on_set("cusp_0.sector", None)
        assert valve().parameters == {}
        choose(size="commissure height")
        assert "commissure_1.height" in slots() and "cusp_0.sector" not in slots()

        page._on_add_bump()
        page._on_add_bump()
        assert state.bump == 1 and [bump["number"] for bump in state.bumps] == [0, 1]
        of_bump = [name for name in slots() if name.startswith("bump")]
        assert of_bump == [f"bump_1.{name}" for name in ("u", "width", "closed", "open")]
        slide("bump_1.open", 0.25)
        assert valve().parameters["bump_1.open"] == 0.25
        titles = {place["value"]: place["title"] for place in state.bump_places}
        assert titles == {"leaflet 0": "cusp 0", "leaflet 1": "cusp 1", "commissure 0": "between cusp 0 and cusp 1",
                          "commissure 1": "between cusp 1 and cusp 0"}
        choose(bump_place="commissure 1")
        assert page.model.bumps(0)[1] == (1, -1, 1) and "bump_1.u" not in slots()
        page._refresh()
        assert "riis bump" not in page.scene._data
        choose(panels=["bumps"])
        page._refresh()
        drawn = numpy.array(page.scene._data["riis bump place"].points)
        assert numpy.allclose(drawn, page.model.bump_place(0, 1).point, atol=1e-5)
        assert page.scene._data["riis bump"].n_points == sum(map(len, page.model.bump_place(0, 1).lines))
        choose(bump=0)
        page._refresh()
        assert page.scene._data["riis bump"].n_lines == 1 and "bump_0.u" in slots()
        page._told(page._on_set)("bump_0.width", "0.01")
        assert "bump_0.width" in state.message and valve().parameters["bump_0.leaflet"] == 0.0

        text = page._text("command")
        assert "--set=bump_1.open=0.25" in text and "--set=bump_1.commissure=1.0" in text
        assert json.loads(page._text("case"))["valves"][0]["parameters"]["bump_1"]["open"] == 0.25
        assert "'bump_1.open': 0.25" in page._text("python")
        before = page.model.valves
        page._on_write("view")
        page._on_remove_bump()
        page._on_remove_bump()
        assert state.bump == -1 and state.bumps == []
        page._refresh()
        assert "riis bump" not in page.scene._data
        await page._reopen(str(tmp_path / "valve.view.json"))
        assert page.model.valves == before

        choose(kind="tricuspid")
        page._on_add_bump()
        assert "bump_0.lift" in slots() and [entry["label"] for entry in state.legend][:3] == [
            "anterior leaflet", "septal leaflet", "posterior leaflet"]
        page._on_set("skirt_length", "0.2")
        skirt = next(entry for entry in state.legend if entry["label"] == "skirt")
        assert skirt["colour"] == scene.colour_of(0, 3)
        choose(kind="mitral")
        assert state.most_bumps == 0 and state.bumps == [] and state.sizes == []
        # The arrow points downstream, and the z axis to the atrium.
        heights = (numpy.asarray(page.scene._data["riis handle"].points) - valve().origin) @ valve().axis
        assert heights.min() < -1.0 and heights.max() < 0.1

    asyncio.run(use())


def test_a_patient_on_the_page(tmp_path, capsys):
    """Leads from a wall and clicks on it to a placed valve with a skirt, in a mesh that is opened last. The copied command gives
    the marks on the screen, and each refusal is a message."""
    try:
        scene.check_of_graphics()
    except RuntimeError as missing:
        pytest.skip(str(missing))
    make = synthetic_patient()
    root, rng = make.Root(), Random(1)
    make.N_ANGLES, make.SPACING = 60, 1.5
    make.write_stl(tmp_path / "root.stl", make.wall_triangles(root, make.waves(rng)))
    make.write_landmarks(tmp_path / "landmarks.mrk.json", root, rng, 0.3)
    grid = pyvista.ImageData(dimensions=(16, 16, 16), spacing=3 * [2.6], origin=numpy.array(root.centre) - 16.0)
    grid.cast_to_unstructured_grid().save(tmp_path / "box.vtu")

    async def use():
        page = Page(None, wall=str(tmp_path / "root.stl"), folder=str(tmp_path))

        def tell(function, *values):
            page.state.message = ""
            page._told(function)(*values)
            return page.state.message

        async def tell_task(work):
            page.state.message = ""
            page._begin_task(work)
            while page._tasks:
                await asyncio.wait(page._tasks)
            return page.state.message

        assert await tell_task(page._read(**page._begin._asdict())) == ""
        state = page.state
        assert state.mesh_text == "wall root.stl: 7,920 triangles, unit not known" and state.has_wall and state.wall == "cut"
        assert not page.model.can_undo and page.model.valves[0].origin != (0.0, 0.0, 0.0)
        assert "so choose mm, cm or m first" in tell(page._on_place_landmarks)
        state.unit = "mm"
        assert tell(page._changed_unit) == "" and page.model.unit == "mm" and page.model.valves[0].scale == 10.0

        # A click in the cut sets the chosen landmark on the wall, and chooses the next one that is missing.
        assert tell(page._on_landmark, "nadir_right") == "" and state.tool == "landmark"
        assert "the click met no wall" in tell(page._on_click, 0.01, 0.01)
        assert tell(page._on_click, 0.5, 0.5) == "" and state.landmark == "nadir_left"
        at = numpy.array(page.model.landmarks.points["nadir_right"])
        assert page.model.wall.surface.closest_points(at[None]).distance[0] < 1e-3 * 76
        assert tell(page._on_set_landmark, "nadir_right", "1, 2, 3") == "" and state.landmarks[0]["value"] == "1, 2, 3"
        assert tell(page._on_undo) == "" and numpy.array_equal(page.model.landmarks.points["nadir_right"], at)
        assert tell(page._on_set_landmark, "nadir_right", "x, 2") == "nadir_right: 'x' is not a number"
        assert tell(page._on_remove_landmark, "nadir_right") == "" and not page.model.landmarks.points
        assert "missing; pick them on the wall" in tell(page._on_place_landmarks)

        # The landmarks of a file place the valve, and the table has the residuals.
        page._on_open("landmarks", "landmarks.mrk.json")
        assert state.message == ""  # a refusal goes with the next change
        assert state.axes == "LPS" and sum(row["set"] for row in state.landmarks) == 6
        assert tell(page._on_place_landmarks) == "" and state.found["title"] == "Placed by landmarks"
        found = page.model.valves[0].found
        assert state.found["head"] == ["landmark", "residual mm", "warped mm"] and len(state.found["rows"]) == 6
        assert float(state.found["rows"][0][1]) == pytest.approx(found.residuals[0], rel=6e-3)
        assert tell(page._on_report) == "" and state.text == found.report()
        centre = [float(text) for text in state.placement[0]["values"]]
        assert state.placement[0]["label"] == "Centre in mm" and numpy.allclose(centre, page.model.valves[0].origin, rtol=1e-5)
        assert not any("e" in text for text in state.placement[0]["values"])

        # All lengths are in millimetres, and R has its unit.
        slider = next(k for k, one in enumerate(state.sliders) if one and one["name"] == "annulus")
        assert state.sliders[slider]["unit"] == "mm" and state[f"slider_{slider}"] == pytest.approx(
            10.0 * page.model.values(0)["annulus"])
        assert tell(page._on_set, "annulus", "25.5") == "" and page.model.values(0)["annulus"] == 2.55 and state.found == {}
        assert "cm" not in {one["unit"] for one in state.sliders if one} | {row["unit"] for row in state.rows}
        assert tell(page._on_set, "coaptation_height", "90").endswith(" (lengths of parameters in centimetres)")
        assert "no report" in tell(page._on_report)
        assert tell(page._on_undo) == "" and state.found["title"] == "Placed by landmarks"
        assert state.resistance_unit == "kg/(m s)" and tell(page._on_set, "resistance", "2e5 g/(cm s)") == ""
        assert page.model.valves[0].resistance == pytest.approx(2e4) and state.resistance == "20000"
        assert "resistance" in tell(page._on_set, "resistance", "much")

        # The skirt is set, and then the mesh is opened. The valve, the wall and the landmarks stay the same.
        page._on_skirt(True, None)
        assert state.skirt_on and page.model.valves[0].skirt > 0.5
        assert "longest" in tell(page._on_skirt, True, "0.2") and page.model.valves[0].skirt > 0.5
        assert "there is no mesh that could have marks" in tell(page._on_write, "mesh")
        assert "open a mesh first" in tell(page._on_open, "cells", "a=1")
        before = page.model._now()
        assert await tell_task(page._read(str(tmp_path / "box.vtu"))) == ""
        assert page.model.valves == before.valves and page.model.landmarks == before.landmarks and page.model.wall is before.wall
        assert "box.vtu: 4,096 nodes" in state.mesh_text and "wall root.stl" in state.mesh_text
        page._settle()
        assert len(page.model.update().marked) > 30
        page.model.set(0, "opening", 0.3)
        page.model.set(0, "offset", 0.5)
        state.replace = True
        for name, ending in (("placed", ".placed.json"), ("command", ".sh"), ("python", ".py")):
            assert tell(page._on_text, name) == ""
            page._on_write_text()
            assert (tmp_path / f"valve{ending}").exists()
        assert riis.read_placed(tmp_path / "valve.placed.json").valve.kind == "coapting"
        assert tell(page._on_text, "openfoam") == "" and "        patch wall;" in state.text and "        targets" in state.text
        program = os.environ.get("RIIS_PROGRAM") or shutil.which("riis") or str(ROOT / "build/bin/riis")
        if os.access(program, os.X_OK):
            path = os.pathsep.join([os.path.dirname(program), os.environ["PATH"]])
            subprocess.run(["sh", tmp_path / "valve.sh"], check=True, stdout=subprocess.DEVNULL, env=os.environ | {"PATH": path})
            made, shown = pyvista.read(tmp_path / "valve.vtu").point_data, page.model.update()
            assert numpy.array_equal(numpy.flatnonzero(made["riis_marked"]), shown.marked)
            assert numpy.array_equal(made["riis_distance"][shown.marked], shown.distance)

        # A picture has the requested size, and shows no lights.
        state.picture_width, state.picture_height = "700", "300"
        page.scene.show_lights(page.model.lights())
        seen = page.scene._actors["riis handle"].GetVisibility()
        assert "wrote" in tell(page._on_write, "picture")
        picture = pyvista.read(tmp_path / "valve.png")
        assert picture.dimensions[:2] == (700, 300) and page.scene.size == (900, 700)
        assert page.scene._actors["riis handle"].GetVisibility() == seen == 1
        red = numpy.asarray(picture.point_data["PNGImage"])
        assert not (red[:, :3] == (213, 0, 0)).all(axis=1).any()  # the colour of lights
        for side, message in (("5000", "it must be a whole number of pixels from 64 to 4096"), ("?", "'?' is not a number")):
            state.picture_width = side
            assert message in tell(page._on_write, "picture")

        # The files of landmarks and of the view open again.
        assert "wrote" in tell(page._on_write, "landmarks") and "wrote" in tell(page._on_write, "view")
        placed = riis.place(tmp_path / "valve.mrk.json", "coapting", warp="smoothed")
        assert numpy.allclose(placed.residuals, found.residuals, atol=1e-3)
        command = page.model.command()
        page.model.place(0, numpy.array(page.model.valves[0].origin) + 0.05)
        assert "opened" in await tell_task(page._reopen(str(tmp_path / "valve.view.json")))
        assert page.model.command() == command
        assert tell(page._on_open, "placed", "valve.placed.json") == "" and len(page.model.valves) == 1
        assert page.model.valves[0].placed is not None and f"--valve={tmp_path}/valve.placed.json" in page.model.command()
        assert tell(page._on_skirt, False) == "" and page.model.valves[0].skirt == 0.0

        # A fit, on a thread.
        (tmp_path / "points.csv").write_text("x,y,z\n" + "\n".join(
            ",".join(map(repr, point)) for point in page.model.surface(0).vertices[::40].tolist()) + "\n")
        assert "is warped to landmarks" in tell(page._on_fit, "points.csv")
        state.warp = "none"
        assert tell(page._on_place_landmarks) == ""
        assert "write the path" in tell(page._on_fit, " ") and "there is no such file" in tell(page._on_fit, "none.csv")
        state.fit_sizes = ["root_radius"]
        page._on_fit("points.csv")
        await asyncio.sleep(0.01)
        assert "a fit is running" in tell(page._on_fit, "points.csv")
        while page._tasks:
            await asyncio.wait(page._tasks)
        assert state.found["title"] == "Fitted to points" and state.found["rows"][0][1].endswith(" mm")
        page.scene.close()

    asyncio.run(use())
    assert "Traceback" not in capsys.readouterr().err


def test_a_heartbeat_pauses_without_a_browser(tmp_path, monkeypatch):
    """A slow browser that has not yet shown a picture does not pause a heartbeat. When the last browser ends, the heartbeat
    pauses."""
    try:
        scene.check_of_graphics()
    except RuntimeError as missing:
        pytest.skip(str(missing))
    monkeypatch.setattr(heartbeat, "ALONE", 0.05)
    box().save(tmp_path / "box.vtu")

    async def use():
        page = Page(None, folder=str(tmp_path))
        page._begin_task(page._read(str(tmp_path / "box.vtu")))
        while page._tasks:
            await asyncio.wait(page._tasks)
        page._on_sockets(1)
        page._on_sockets(2)
        page._on_play()
        playing = page._playing
        page._on_sockets(1)
        await asyncio.sleep(0.3)
        assert page.state.playing and not playing.done()
        page._on_sockets(0)
        await asyncio.wait_for(playing, 60)
        assert not page.state.playing and page._playing is None
        page._on_sockets(1)
        page._on_play()
        await asyncio.sleep(0.3)
        assert page.state.playing
        page._pause()
        page.scene.close()

    asyncio.run(use())


def test_missing_graphics_name_their_packages(monkeypatch):
    monkeypatch.delenv("VTK_DEFAULT_OPENGL_WINDOW", raising=False)
    monkeypatch.setattr(scene, "_egl_works", lambda: False)
    monkeypatch.setenv("DISPLAY", ":1")
    scene.check_of_graphics()  # VTK draws by X
    monkeypatch.delenv("DISPLAY")
    with pytest.raises(RuntimeError, match="apt-get install libegl1 libgl1-mesa-dri$"):
        scene.check_of_graphics()


def test_a_widget_for_notebooks(monkeypatch):
    """A widget opens no socket, takes over no signal, and leaves asyncio as it is."""
    surface = riis.Surface(riis.Valve("mitral"))
    if not all(importlib.util.find_spec(name) for name in ("trame_vtk", "ipywidgets")):
        with pytest.raises(ImportError, match=r"pip install 'pyvista\[jupyter\]'"):
            riis.plot(surface, interactive=True)
        return
    opened, run = [], asyncio.run
    for name in ("socket", "socketpair", "create_connection", "getaddrinfo"):
        monkeypatch.setattr(socket, name, lambda *words, name=name, **_: opened.append((name, words)))
    value = riis.plot(surface, interactive=True).value
    assert not opened and asyncio.run is run and signal.set_wakeup_fd(-1) == -1
    page = html.unescape(re.search('<iframe srcdoc="([^"]*)"', value)[1])
    packed = base64.b64decode(re.search('base64Str = "([^"]*)"', page)[1])
    scene = json.loads(zipfile.ZipFile(io.BytesIO(packed)).read("index.json"))
    arrays = [numpy.frombuffer(base64.b64decode(each["content"]), each["type"][:-5].lower()) for each in scene["hashes"].values()]
    vertices = numpy.array(surface.vertices).ravel()
    assert any(len(array) == len(vertices) and numpy.allclose(array, vertices, atol=1e-6) for array in arrays)


def test_a_widget_warns_of_a_valve_outside_the_mesh():
    if not all(importlib.util.find_spec(name) for name in ("trame_vtk", "ipywidgets")):
        pytest.skip("pyvista[jupyter] is missing")
    grid = box(12).translate((30.0, 0.0, 0.0))
    model = Model(**reading.arrays_of(grid), unit="cm")
    valve = model.add("coapting")
    text = "no node is marked: the valve is at .* cm, the mesh from .*: move the valve"
    with pytest.warns(riis.MarksWarning, match=text) as found:
        scene.widget(model, grid)
    assert [one.filename for one in found] == [__file__]
    model.place(valve, origin=grid.center)
    with warnings.catch_warnings():
        warnings.simplefilter("error", riis.MarksWarning)
        scene.widget(model, grid)
    assert len(model.update().marked) > 0
    grid = box(12).scale(10.0)  # in millimetres
    model = Model(**reading.arrays_of(grid))
    model.place(model.add("coapting"), origin=grid.center)
    with pytest.warns(riis.MarksWarning, match="the mesh looks as if it were in millimetres: scale the valve by 10"):
        scene.widget(model, grid)


def test_pictures_of_a_scene():
    try:
        scene.check_of_graphics()
    except RuntimeError as missing:
        pytest.skip(str(missing))
    grid = box(20)
    model = Model(**reading.arrays_of(grid))
    model.add("mitral")
    drawn = scene.Scene(model, grid, size=(320, 240))
    drawn.show(model.update())
    drawn.look("oblique", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), 3.0)
    drawn.cut_here((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    drawn.show_cut()
    closed = drawn.picture()
    assert closed[:2] == b"\xff\xd8" and drawn.picture() == closed  # a JPEG file, and the same scene gives the same bytes
    model.set(0, "opening", 0.8)
    drawn.show(model.update())
    assert drawn.picture() != closed
    on_wall = drawn.pick(0.5, 0.5)  # the wall is the box's surface, so one coordinate is that of a side
    sides = numpy.abs(on_wall[:2]) - 2.0, [on_wall[2] + 1.5, on_wall[2] - 2.5]
    assert min(numpy.abs(numpy.concatenate(sides))) < 1e-5, on_wall
    assert drawn.pick(0.001, 0.001) is None
    for name, call in (("wall", drawn.show_wall), ("cells", drawn.show_cells), ("look", drawn.look)):
        with pytest.raises(ValueError, match=f"^{name}: is 'oblong'; it must be one of "):
            call("oblong")
    drawn.close()


def test_wrong_words(tmp_path, capsys):
    for words, text in (
        (["view", str(tmp_path / "no.vtu")], "no.vtu: there is no such file"),
        (["view", "--open", str(tmp_path / "no.json")], "no.json: there is no such file"),
        (["view", "--folder", str(tmp_path / "no")], "--folder: "),
        (["view", "--port", "65536"], "--port: is 65536; it must be from 0 to 65535"),
        (["view", "--wall", str(tmp_path / "no.stl")], "no.stl: there is no such file"),
        (["view", "--wall", __file__, "--landmarks", str(tmp_path / "no.csv")], "no.csv: there is no such file"),
        (["view", "--valve", "mitral", "--wall", __file__], "--valve: mitral is not a placed valve, FILE.json; the page has the"),
        (["view", "--landmarks", __file__], "--valve and --landmarks need MESH or --wall, in which the valve is shown"),
        (["view", "--open", __file__, "--wall", __file__], "--open has no effect with --wall, --valve and --landmarks"),
    ):
        assert main(words) == 2
        assert text in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["vew"])


def test_files_that_are_no_meshes(tmp_path):
    (tmp_path / "text.vtu").write_text("this is no mesh\n")
    (tmp_path / "empty.vtk").write_text("")
    pyvista.Sphere().save(tmp_path / "surface.vtk")
    pyvista.UnstructuredGrid().save(tmp_path / "nothing.vtu")
    for name, text in (
        ("no.vtu", "there is no such file"), ("text.vtu", "is not a mesh"), ("empty.vtk", "is not a mesh"),
        ("surface.vtk", "is a surface"), ("nothing.vtu", "has no nodes"),
    ):  # fmt: skip
        with pytest.raises(reading.Refusal, match=text) as refused:
            reading.read_mesh(str(tmp_path / name), {})
        assert str(tmp_path / name) in str(refused.value)
    (tmp_path / "mesh.stl").write_text("")
    with pytest.raises(reading.Refusal, match="is a surface, and MESH has volume cells. Give it as the wall: riis view --wall"):
        reading.read_mesh(str(tmp_path / "mesh.stl"), {})
    (tmp_path / "mesh.cgns").write_text("")
    with pytest.raises(reading.Refusal, match=r"mesh.cgns: riis view reads [a-z., ]*$"):  # the program does not read it either
        reading.read_mesh(str(tmp_path / "mesh.cgns"), {})
    # The command that the message advises writes a mesh that the view reads.
    pyvista.MultiBlock([box(12)]).save(tmp_path / "two words.vtm")
    pyvista.ImageData(dimensions=(9, 8, 7)).save(tmp_path / "image.vti")
    for name, n_points in (("two words.vtm", box(12).n_points), ("image.vti", 9 * 8 * 7)):
        with pytest.raises(reading.Refusal, match="The program writes what the view reads: riis mark ") as refused:
            reading.read_mesh(str(tmp_path / name), {})
        program = os.environ.get("RIIS_PROGRAM", "")
        if os.path.exists(program):
            words = shlex.split(str(refused.value).split("reads: ")[-1])
            assert words[0] == "riis"
            subprocess.run([program, *words[1:]], cwd=tmp_path, check=True)
            assert reading.read_mesh(str(tmp_path / "mesh.vtu"), {}).n_points == n_points
    with pytest.raises(reading.Refusal, match="a surface is a file .vtp, .stl or .pvd"):
        reading.read_surface(str(tmp_path / "text.vtu"))
    with pytest.raises(reading.Refusal, match="scale: 'wide' is not a number"):
        reading.number_of("wide", "scale")


def test_walls_and_points_from_files(tmp_path, recwarn):
    """Walls are surfaces, or the boundaries of meshes. Points are surfaces, or rows of numbers. Other files are refused."""
    ball = pyvista.Sphere(radius=2.0)
    for name in ("ball.stl", "ball.vtp", "ball.ply"):
        ball.save(tmp_path / name)
        found = reading.read_wall(str(tmp_path / name))
        assert found.path == str(tmp_path / name) and len(found.triangles) == ball.n_cells
        assert numpy.allclose([found.lower, found.upper], [ball.points.min(axis=0), ball.points.max(axis=0)], atol=1e-5)
    grid = box(5)
    grid.save(tmp_path / "box.vtu")
    found = reading.read_wall(str(tmp_path / "box.vtu"))
    assert len(found.triangles) == 2 * 6 * 16 and numpy.allclose(found.sides, (4.0, 4.0, 4.0))
    assert found.surface.closest_points(numpy.array([[0.0, 0.0, 0.5]])).distance[0] == pytest.approx(2.0)
    (tmp_path / "no.stl").write_text("")
    (tmp_path / "no.txt").write_text("no")
    for name in ("stl", "vtp", "ply"):
        (tmp_path / f"half.{name}").write_bytes((tmp_path / f"ball.{name}").read_bytes()[:20000])
    ball.save(tmp_path / "text.ply", binary=False)
    text = (tmp_path / "text.ply").read_text()
    assert len(reading.read_wall(str(tmp_path / "text.ply")).triangles) == ball.n_cells
    (tmp_path / "header.ply").write_text(text[:100])
    (tmp_path / "one_less.ply").write_text("\n".join(text.strip().split("\n")[:-1]))
    (tmp_path / "half_text.ply").write_text(text[: len(text) // 2])
    (tmp_path / "typed.ply").write_text(text.replace("property float x", "property real x"))
    pyvista.PolyData(numpy.eye(3)).save(tmp_path / "points.vtp")
    for name, text in (
        ("none.stl", "there is no such file"), ("no.stl", "is not a surface that VTK can read"),
        ("points.vtp", "has no triangles"), ("half.stl", "is not a surface that VTK can read"),
        ("half.vtp", "is not a surface that VTK can read"), ("half.ply", "is cut off: its header announces at least .* bytes"),
        ("header.ply", "lacks the line end_header"), ("half_text.ply", "has no triangles"),
        ("one_less.ply", "is cut off|faces without corners"), ("typed.ply", "'property real x' has no type"),
        ("no.txt", "a wall is a surface, .stl, .vtp, .obj, .ply, or a mesh, .vtu"),
    ):  # fmt: skip
        with pytest.raises(reading.Refusal, match=text) as refused:
            reading.read_wall(str(tmp_path / name))
        assert str(tmp_path / name) in str(refused.value)
    (tmp_path / "some.csv").write_text("x,y,z\n# none\n1,2,3\n\n4;5;6\n")
    assert reading.read_points(str(tmp_path / "some.csv")).tolist() == [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
    assert reading.read_points(str(tmp_path / "ball.stl")).n_points > 100
    for name, content, text in (
        ("a.csv", "1,2\n", "line 1 has 2 columns; it must have x, y and z"), ("a.csv", "1,2,b\n", "line 1: 'b' is not a number"),
        ("a.csv", "# none\n", "has no points"), ("a.msh", "", "points are a surface, .*, or rows of x, y and z"),
        ("a.stl", "", "is not a surface that VTK can read"),
    ):  # fmt: skip
        (tmp_path / name).write_text(content)
        with pytest.raises(reading.Refusal, match=text):
            reading.read_points(str(tmp_path / name))
    assert [str(one.message) for one in recwarn if issubclass(one.category, UserWarning)] == []


@pytest.mark.parametrize("kinds", [["mitral"], ["coapting", "bileaflet"]])
def test_a_marked_mesh_has_the_marks_of_the_library(tmp_path, kinds):
    grid = box(30)
    model = Model(**reading.arrays_of(grid))
    for k, kind in enumerate(kinds):
        model.add(kind)
        model.set(k, "half_thickness", 0.2)
        model.place(k, (0.1 * k, 0.0, 0.2), (0.3, 0.1, 1.0))
    reading.write_marked(grid, model, str(tmp_path / "marked.vtu"))
    saved = reading.read_mesh(str(tmp_path / "marked.vtu"), {})
    assert saved.points.dtype == numpy.float64 and numpy.array_equal(saved.points, grid.points)
    mesh = riis.Mesh(numpy.ascontiguousarray(grid.points, numpy.float64))
    for k, kind in enumerate(kinds):
        dense = riis.mark(model.surface(k), mesh).dense(leaflet_id=True)
        prefix = "riis" if len(kinds) == 1 else kind
        assert 100 < saved.point_data[f"{prefix}_marked"].sum() == numpy.count_nonzero(dense.mark)
        for name in ("marked", "distance", "leaflet"):
            expected = getattr(dense, {"marked": "mark", "distance": "distance", "leaflet": "leaflet_id"}[name])
            assert numpy.array_equal(saved.point_data[f"{prefix}_{name}"], expected), (prefix, name)


def test_a_surface_from_a_file(tmp_path):
    surface = riis.Surface(riis.Valve("mitral", opening=0.5)).to_pyvista()
    surface.cell_data["riis_leaflet"] = surface.cell_data["leaflet_id"]
    surface.save(tmp_path / "valve.vtp")
    read = reading.read_surface(str(tmp_path / "valve.vtp"))
    assert numpy.array_equal(read["vertices"], surface.points) and read["times"] is None
    assert numpy.array_equal(read["leaflet_id"], surface.cell_data["riis_leaflet"])
    model = Model(**reading.arrays_of(box()))
    assert len(model.update().marked) == 0
    model.add_surface(**read, path=str(tmp_path / "valve.vtp"))
    assert len(model.update().marked) > 0
