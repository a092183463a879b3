"""The live page as tests see it: its server, a recorded run that is published again in real time, and what is drawn."""

import os
import socket
import subprocess
import threading
import time

import lcm
import numpy as np
import own_address

from reed_tools.paths import PYTHON, ROOT
from reed_tools.record import telemetry_log

URL = own_address.lcm_url()
COMMAND = [str(ROOT / "tools" / "reed_tools" / "__main__.py"), "live"]
LIVE = [str(ROOT / "build" / "venv-live" / "bin" / "python3"), *PYTHON[1:], *COMMAND]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Served:
    """tools/reed live in its own environment."""

    def __init__(self, *argv):
        self.port = free_port()
        self.process = subprocess.Popen([*LIVE, "--port", str(self.port), *map(str, argv)], env={**os.environ, "LCM_DEFAULT_URL": URL},
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.url = f"http://127.0.0.1:{self.port}"
        assert self.url in self.process.stdout.readline(), self.process.stderr.read()

    def listens_on(self):
        """Addresses of the sockets that wait for connections on the page's port."""
        lines = [line.split() for name in ("tcp", "tcp6") for line in open(f"/proc/net/{name}").readlines()[1:]]
        return {line[1].partition(":")[0] for line in lines if line[3] == "0A" and int(line[1].rpartition(":")[2], 16) == self.port}

    def stop(self):
        self.process.terminate()
        self.process.wait(20)


class Player:
    """Publishes the log as the two programs would, message by message in real time."""

    def __init__(self, folder):
        self.events = list(telemetry_log.events(folder / "telemetry.lcmlog"))
        self.lcm = lcm.LCM(URL)
        self.thread = None

    def play(self, until=lambda: True):
        """The run, and again as a new one while `until` does not hold."""
        self.stop_asked = False
        self.thread = threading.Thread(target=self.run, args=(until,))
        self.thread.start()

    def run(self, until):
        while True:
            started = time.monotonic()
            for utime, channel, data in self.events:
                if self.stop_asked:
                    return
                while (ahead_s := utime / 1e6 - (time.monotonic() - started)) > 0:
                    time.sleep(min(ahead_s, 0.005))
                self.lcm.publish(channel, data)
            if until():
                return

    def end(self):
        self.stop_asked = True
        self.thread.join()


SPACE, CURVES = (0.40, 0.72), (0.0, 0.37)  # strips of the picture, parts of its width
HUES = {  # what a pixel of each is, however the page fades in
    "arm": (SPACE, 1e-3, lambda r, g, b: (r - g > 40) & (g - b > 30) & (r > 200)),
    "wall": (SPACE, 4e-3, lambda r, g, b: (b - r > 10) & (g - r > 4) & (b > 225)),
    "arrow": (SPACE, 1e-4, lambda r, g, b: (r - g > 90) & (b - g > 20)),
    "curves": (CURVES, 1e-4, lambda r, g, b: (g - r > 80) & (g - b > 20)),
}


def assert_drawn(page, target):
    """Arm, wall, force arrow and curves are there, by their colours. A rasteriser in software fades them in as the machine has time."""
    end = time.monotonic() + 150
    while True:
        picture = page.picture(target)
        seen = {}
        for name, ((left, right), least, is_it) in HUES.items():
            strip = picture[:, int(left * picture.shape[1]):int(right * picture.shape[1])]
            seen[name] = float(is_it(*np.moveaxis(strip, 2, 0)).mean()) / least
        if min(seen.values()) > 1:
            return
        assert time.monotonic() < end, (seen, str(target))


COUNT = """window.applied = []; new MutationObserver(() => {
  const shown = document.getElementById('reed-updates');
  const number = shown ? Number(shown.textContent.split(' ')[1]) : 0;
  if (number && number !== (applied.at(-1) || [])[1]) applied.push([performance.now() / 1000, number]);
}).observe(document.body, {subtree: true, childList: true, characterData: true})"""


def number(page):
    """Of the newest update that the page has applied."""
    return page.value("(applied.at(-1) || [0, 0])[1]") or 0


def best_rate_hz(page):
    """Updates per second in the best stretch of a second or more: from the numbers that the page itself has shown."""
    applied = page.value("applied")
    rates = [(n - m) / (t - s) for k, (s, m) in enumerate(applied) for t, n in applied[k + 1:] if 1.0 <= t - s < 3.0]
    return max(rates, default=0.0)


def text(page, wanted, patience_s=90):
    page.until(f"document.body.innerText.includes({wanted!r})", patience_s)
