# SPDX-License-Identifier: Apache-2.0
"""test_virtual_display.py PROGRAM: checks that the program draws without a display. The program starts Xvfb itself, and no Xvfb
remains.

A script named Xvfb on the PATH notes its process. The script then becomes the real Xvfb, or fails as a test needs.
"""
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = ""
REAL = shutil.which("Xvfb")


def is_alive(process):
    """Returns whether a process runs. A zombie does not."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


def eventually(condition, seconds=20.0):
    """Returns whether a condition becomes true before a time limit."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


class VirtualDisplay(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.server(f'exec {REAL} "$@"')

    def server(self, ending):
        """Makes the script Xvfb. The script notes its process, then runs the lines `ending`."""
        script = self.folder / "Xvfb"
        script.write_text(f"#!/bin/sh\necho $$ >>{self.folder}/servers\n{ending}\n", encoding="utf-8")
        script.chmod(0o755)

    def servers(self):
        noted = self.folder / "servers"
        return [int(line) for line in noted.read_text(encoding="utf-8").split()] if noted.exists() else []

    def start(self, name="a.png", display=None, **more):
        environment = {key: text for key, text in os.environ.items() if key not in ("DISPLAY", "XAUTHORITY")}
        environment["PATH"] = f"{self.folder}:{environment['PATH']}"
        environment |= {} if display is None else {"DISPLAY": display}
        command = (PROGRAM, "surface", "--valve", "mitral", "--picture", name, "--picture-size", "200x100", "--quiet")
        return subprocess.Popen(command, cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, **more)

    def draw(self, *arguments, status=0):
        running = self.start(*arguments)
        out, messages = running.communicate(timeout=200)
        self.assertEqual(running.returncode, status, out + messages)
        return messages

    def expect_picture(self, name="a.png"):
        content = (self.folder / name).read_bytes()
        self.assertEqual(struct.unpack(">II", content[16:24]), (200, 100))
        return content

    def test_no_display(self):
        for display in None, "", ":7654", "nonsense":
            with self.subTest(display=display):
                self.assertEqual(self.draw("a.png", display), "")
                self.expect_picture()
                (self.folder / "a.png").unlink()
        self.assertEqual(len(self.servers()), 4)
        self.assertFalse([one for one in self.servers() if pathlib.Path(f"/proc/{one}").exists()])

    def test_two_runs_at_once(self):
        running = [self.start(name) for name in ("a.png", "b.png", "c.png")]
        for one in running:
            _, messages = one.communicate(timeout=200)
            self.assertEqual(one.returncode, 0, messages)
        self.assertEqual(self.expect_picture("a.png"), self.expect_picture("b.png"))
        self.assertEqual(len(set(self.servers())), 3)

    def test_servers_that_fail(self):
        self.server("echo '(EE) Fatal server error:' >&2; echo '(EE) no room left(EE) ' >&2; exit 1")
        self.assertIn("DISPLAY is not set, and Xvfb ends: no room left\n", self.draw(status=1))
        self.server("exit 0")
        self.assertTrue(self.draw("a.png", ":7654", status=1).endswith("DISPLAY :7654 cannot be used, and Xvfb ends\n"))
        self.assertFalse((self.folder / "a.png").exists())

    def test_a_server_without_abstract_sockets(self):
        """If Xvfb cannot listen on an abstract socket alone, the program starts it again with a file."""
        self.server(f'case "$*" in *"-nolisten unix"*) exit 1;; esac\nexec {REAL} "$@"')
        self.draw()
        self.expect_picture()
        self.assertEqual(len(self.servers()), 2)

    def test_a_killed_run(self):
        """Xvfb ends with the program, even after a signal that cannot be caught."""
        self.server("exec sleep 300")
        for ending in signal.SIGKILL, signal.SIGSEGV:
            with self.subTest(ending=ending):
                n_before = len(self.servers())
                running = self.start()
                self.assertTrue(eventually(lambda: len(self.servers()) > n_before))  # pylint: disable=W0640
                running.send_signal(ending)
                running.communicate(timeout=60)
                self.assertEqual(running.returncode, -ending)
                self.assertTrue(eventually(lambda: not is_alive(self.servers()[-1])))

    def test_ctrl_c(self):
        """In a terminal, Ctrl-C reaches the program and all its processes. Ctrl-C does not reach Xvfb, which the picture still
        needs."""
        self.server(f'sleep 1\nexec {REAL} "$@"')
        running = self.start(start_new_session=True)
        self.assertTrue(eventually(self.servers))
        os.killpg(running.pid, signal.SIGINT)
        running.communicate(timeout=200)
        self.assertEqual(running.returncode, -signal.SIGINT)
        self.expect_picture()
        self.assertTrue(eventually(lambda: not is_alive(self.servers()[-1])))

    @unittest.skipUnless(os.environ.get("RIIS_TEST_LONG") == "1", "waits for half a minute")
    def test_a_server_that_never_is_ready(self):
        self.server("exec sleep 300")
        self.assertIn("Xvfb was not ready within 30 s", self.draw(status=1))
        self.assertFalse(is_alive(self.servers()[-1]))


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    if not REAL:
        print("skipped: Xvfb is missing")
        sys.exit(77)
    unittest.main()
