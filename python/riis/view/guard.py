# SPDX-License-Identifier: Apache-2.0
"""Who may see the page: the key, the addresses, and the life of the server.

The server listens on 127.0.0.1 only, so other machines never reach it. Other users and other pages on this machine could reach
the server, and these rules keep them out:

- A random key of 256 bits opens the WebSocket, over which all data of the mesh pass. The key is in a file and a folder that only
  this user can read, and in the printed address. - The key is in no command line, because the browser's command line has only the
  file's path.
- In the address the key stands behind '#', which browsers send to no server. The first page keeps it in the tab's session
  storage, which pages of other origins, and therefore of other ports, cannot read.
- The WebSocket opens only for a request with the key. The first message must contain the key again, as trame requires.
- A request must name this machine as its host, and a page of another origin is refused. A foreign page therefore cannot reach the
  server through a name that it resolves to 127.0.0.1.
- The files that need no key are the page's own programs and styles, which anybody can get from PyPI. They have no mesh data.
"""

from __future__ import annotations

import asyncio
import hmac
import os
import re
import secrets
import shutil
import signal
import socket
import sys
import tempfile
import threading
import webbrowser
from collections.abc import Callable
from pathlib import Path
from typing import Any

# Vue compiles the page's template in the browser, which needs 'unsafe-eval'. Nothing is loaded from another origin.
_HEADERS = {
    "Content-Security-Policy": "default-src 'self' 'unsafe-inline' 'unsafe-eval' data: blob:; connect-src 'self' ws://{host}; "
    "frame-ancestors 'none'; form-action 'none'; base-uri 'self'",
    "Cache-Control": "no-store",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}

# The first page takes the key from the address, and passes it to trame's page. A page that was reloaded finds it in the storage.
# If the key is wrong, the server answers with the first page again. The first page then deletes the key, because it may belong to
# an earlier server.
_FIRST_PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>riis view</title></head>
<body><p id="text">riis view needs the whole address that it printed in its terminal, with the part behind #.</p>
<script>
"use strict";
if (new URLSearchParams(location.search).has("secret")) sessionStorage.removeItem("riis-key");
const given = location.hash.slice(1);
if (/^[0-9a-f]{64}$/.test(given)) sessionStorage.setItem("riis-key", given);
const key = sessionStorage.getItem("riis-key");
if (key) {
  const socket = encodeURIComponent(`ws://${location.host}/ws?key=${key}`);
  location.replace(`/index.html?secret=${key}&reconnect=auto&sessionURL=${socket}`);
}
</script></body></html>
"""

_OPENER = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="referrer" content="no-referrer"><title>riis view</title></head>
<body><script>location.replace("{address}");</script><p><a href="{address}">riis view</a></p></body></html>
"""


def is_own(host: str, origin: str | None) -> bool:
    """Returns whether a request has an address of this machine as its host, and comes from a page of the same address."""
    is_own_host = re.fullmatch(r"(127\.0\.0\.1|localhost)(:[0-9]+)?", host, re.IGNORECASE)
    return is_own_host is not None and (origin is None or origin.lower() == f"http://{host.lower()}")


def is_key(given: str | None, key: str) -> bool:
    return given is not None and hmac.compare_digest(given.encode(), key.encode())


def has_desktop() -> bool:
    """Returns whether a browser can show the page. Without a desktop, Python would start a text browser in the terminal."""
    return not sys.platform.startswith("linux") or any(map(os.environ.get, ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER")))


class Guard:
    """The server of a page while it runs. The guard's folder, with the key, exists as long as the guard. The guard calls
    on_sockets with the number of open WebSockets, that is of browsers, whenever one opens or closes."""

    def __init__(self, server: Any, on_sockets: Callable[[int], None]):
        self.server = server
        self.on_sockets = on_sockets
        self._n_open = 0
        self.key = secrets.token_hex(32)
        self.folder: Path | None = None

    def __enter__(self) -> Guard:
        runtime = os.environ.get("XDG_RUNTIME_DIR")
        place = runtime if runtime and os.access(runtime, os.W_OK) else None
        self.folder = Path(tempfile.mkdtemp(prefix="riis-view-", dir=place))  # only this user can read it
        self._write("key", self.key)
        return self

    def __exit__(self, *_: Any) -> None:
        if self.folder is not None:
            shutil.rmtree(self.folder, ignore_errors=True)

    def _write(self, name: str, text: str) -> Path:
        assert self.folder is not None
        path = self.folder / name
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(descriptor, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def start(self, port: int, browser: bool) -> None:
        """Serves until the process gets SIGINT or SIGTERM."""
        with socket.socket() as trial:
            trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                trial.bind(("127.0.0.1", port))
            except OSError as error:
                raise RuntimeError(f"--port: {port} on 127.0.0.1 cannot be had: {os.strerror(error.errno or 0)}") from None
        # trame reads its options from the process's arguments, and takes the key from a file.
        words, sys.argv = sys.argv, ["riis view", "--authKeyFile", str(self.folder / "key" if self.folder else "")]
        self.server.controller.on_server_bind.add(self._bind)
        self.server.controller.on_server_ready.add(lambda **_: self._tell(browser))
        try:
            asyncio.run(self._run(port))
        finally:
            sys.argv = words

    async def _run(self, port: int) -> None:
        served = self.server.start(
            port=port, host="127.0.0.1", open_browser=False, show_connection_info=False, exec_mode="task", timeout=0,
            disable_logging=True, thread=True,
        )  # fmt: skip
        loop = asyncio.get_running_loop()
        ended = asyncio.Event()
        for number in (signal.SIGINT, signal.SIGTERM):
            loop.add_signal_handler(number, ended.set)
        waits = asyncio.ensure_future(ended.wait())
        await asyncio.wait([served, waits], return_when=asyncio.FIRST_COMPLETED)
        if served.done():
            served.result()  # raises, for instance if the port is taken
        else:
            await self.server.stop()

    def _bind(self, wslink_server: Any) -> None:
        """Puts the rules before everything that the server answers."""
        from aiohttp import web

        @web.middleware
        async def rules(request: Any, handler: Any) -> Any:
            host = request.headers.get("Host", "")
            if not is_own(host, request.headers.get("Origin")):
                return web.Response(status=403, text="riis view answers to 127.0.0.1 and localhost only\n")
            if request.path == "/ws" and not is_key(request.query.get("key"), self.key):
                return web.Response(status=403, text="riis view: the key is missing or wrong\n")
            if request.path == "/" or (request.path == "/index.html" and not is_key(request.query.get("secret"), self.key)):
                response = web.Response(text=_FIRST_PAGE, content_type="text/html")
            elif request.path == "/ws":
                self._count(1)
                try:
                    response = await handler(request)  # until the socket closes
                finally:
                    self._count(-1)
            else:
                response = await handler(request)
            if not response.prepared:
                response.headers.pop("Access-Control-Allow-Origin", None)
                response.headers.update({name: text.format(host=host) for name, text in _HEADERS.items()})
            return response

        wslink_server.app.middlewares.insert(0, rules)

    def _count(self, change: int) -> None:
        self._n_open += change
        self.on_sockets(self._n_open)

    def _tell(self, browser: bool) -> None:
        address = f"http://127.0.0.1:{self.server.port}/#{self.key}"
        opener = self._write("open.html", _OPENER.format(address=address))
        print(f"riis view: open {address}", flush=True)
        print("The address is a key to your mesh: do not pass it on. Ctrl C ends riis view.", flush=True)
        if browser and has_desktop():
            # A command line is visible to every user of the machine, so the browser gets the path of a file. Some browsers keep
            # their caller waiting, so a separate thread calls the browser.
            threading.Thread(target=webbrowser.open, args=(opener.as_uri(),), daemon=True).start()
