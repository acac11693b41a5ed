"""A network camera: a stream of JPEG pictures over HTTP, which can be held up or cut off."""

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import cv2
import numpy as np
from made_up_films import picture

RATE = 30.0  # pictures per second [Hz]


class Stream:
    """What the camera does."""

    def __init__(self) -> None:
        self.url = ""
        self.holds = threading.Event()  # sends nothing
        self.freezes = threading.Event()  # sends the same picture again and again
        self.hangs_up = threading.Event()  # ends every connection
        self.number = 0

    def next_jpeg(self) -> bytes:
        self.number += not self.freezes.is_set()
        shown = picture(0.5 + 0.2 * np.sin(self.number / 10))
        return cv2.imencode(".jpg", shown)[1].tobytes()


@contextmanager
def serving() -> Iterator[Stream]:
    """A camera on a free port of this machine."""
    stream = Stream()

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            if stream.hangs_up.is_set():
                return
            self.send_response(200)
            self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=frame")
            self.end_headers()
            while not stream.hangs_up.is_set():
                time.sleep(1 / RATE)
                if stream.holds.is_set():
                    continue
                jpeg = stream.next_jpeg()
                head = f"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: {len(jpeg)}\r\n\r\n"
                try:
                    self.wfile.write(head.encode() + jpeg + b"\r\n")
                except OSError:
                    return

        def log_message(self, *told: object) -> None:
            """Not a word."""

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.daemon_threads = True
    stream.url = f"http://127.0.0.1:{server.server_port}/stream.mjpg"
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield stream
    finally:
        stream.hangs_up.set()
        server.shutdown()
        server.server_close()
