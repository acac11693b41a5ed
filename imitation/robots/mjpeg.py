"""A camera on the network: JPEGs over HTTP, one after the other (MJPEG), as OpenCV opens them."""

import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

BOUNDARY = "frame"
PATIENCE = 1.0  # how long a viewer waits for a frame before it looks whether all is over [s]


class MjpegServer:
    """Serves the newest picture to whoever looks, on 127.0.0.1.

    Args:
        port: 0 chooses a free one.
    """

    def __init__(self, port: int) -> None:
        self._came, self._jpeg, self._number = threading.Condition(), b"", 0
        self._over = False
        try:
            self._server = ThreadingHTTPServer(("127.0.0.1", port), _handler(self))
        except (OSError, OverflowError) as error:
            raise ValueError(f"port {port} on 127.0.0.1 cannot be used: {error}") from error
        self._server.daemon_threads = True
        self.url = f"http://127.0.0.1:{self._server.server_address[1]}/camera.mjpg"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def publish(self, jpeg: bytes) -> None:
        """Show a new picture."""
        with self._came:
            self._jpeg, self._number = jpeg, self._number + 1
            self._came.notify_all()

    def pictures(self) -> Iterator[bytes]:
        """Pictures from now on, until the server is closed."""
        shown = self._number
        while not self._over:
            with self._came:
                if self._number == shown:
                    self._came.wait(PATIENCE)
                jpeg, new, shown = self._jpeg, self._number != shown, self._number
            if new:
                yield jpeg

    def close(self) -> None:
        """End; harmless when repeated."""
        with self._came:
            self._over = True
            self._came.notify_all()
        self._server.shutdown()
        self._server.server_close()


def _handler(source: MjpegServer) -> type[BaseHTTPRequestHandler]:
    class Viewer(BaseHTTPRequestHandler):
        """One who looks."""

        def do_GET(self) -> None:
            """Send pictures until the viewer goes away."""
            self.send_response(200)
            self.send_header("Content-Type", f"multipart/x-mixed-replace; boundary={BOUNDARY}")
            self.end_headers()
            try:
                for jpeg in source.pictures():
                    head = f"--{BOUNDARY}\r\nContent-Type: image/jpeg\r\n"
                    head += f"Content-Length: {len(jpeg)}\r\n\r\n"
                    self.wfile.write(head.encode() + jpeg + b"\r\n")
            except OSError:
                return  # the viewer has gone

        def log_message(self, format: str, *args: Any) -> None:
            """Say nothing."""

    return Viewer
