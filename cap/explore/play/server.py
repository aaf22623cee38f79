"""``python -m cap.explore play``: the page in the browser, from this machine to itself alone.

It listens on 127.0.0.1, and takes websockets only from pages that it has served itself.  When a tab
is closed, what runs for it ends; when the command ends, all of it does.
"""

import socket
import webbrowser
from collections.abc import Callable

from bokeh.application import Application
from bokeh.application.handlers.function import FunctionHandler
from bokeh.document import Document
from bokeh.server.server import Server

from cap.errors import BadInput
from cap.explore.play.page import Page, World

HERE = "127.0.0.1"
LEFT, LOOKS = 1000, 500  # milliseconds: after a tab has closed, and between two looks


def play(world: World, port: int, *, opens: bool, say: Callable[[str], None]) -> None:
    """Serve the page until interrupted; port 0 is any that is free.

    Raises `BadInput` if the port is taken.
    """
    world.sea(world.begin)  # compiled, if it was not; what cannot be followed is told at once
    pages: set[Page] = set()
    server = _server(world, port, pages)
    url = f"http://{HERE}:{server.port}/"
    say(f"the page is {url}  (ctrl-C ends it)")
    if opens:
        webbrowser.open(url)
    try:
        server.io_loop.start()
    finally:
        for page in pages:
            page.close()
        server.stop(wait=False)


def _server(world: World, port: int, pages: set[Page]) -> Server:
    def begin(document: Document) -> None:
        page = Page(world)
        pages.add(page)
        page.show(document)

        def end(_context: object) -> None:
            pages.discard(page)
            page.close()

        document.on_session_destroyed(end)

    application = Application(FunctionHandler(begin))
    try:
        port = port or _free()
        server = Server(
            {"/": application},
            address=HERE,
            port=port,
            allow_websocket_origin=[f"{HERE}:{port}", f"localhost:{port}"],
            unused_session_lifetime_milliseconds=LEFT,
            check_unused_sessions_milliseconds=LOOKS,
        )
    except OSError as error:
        raise BadInput(f"cannot listen on port {port}: {error.strerror}") from None
    server.start()
    return server


def _free() -> int:
    """Return a port that is free now; those who may connect are told by its number."""
    with socket.socket() as tried:
        tried.bind((HERE, 0))
        return int(tried.getsockname()[1])
