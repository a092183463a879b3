"""A headless Chromium spoken to over its DevTools protocol: what a page logs, runs and looks like."""

import base64
import io
import json
import subprocess
import time
import urllib.request

import numpy as np
from PIL import Image
from websockets.sync.client import connect

START_s, ANSWER_s = 60.0, 60.0
OPTIONS = ("--headless=new", "--no-sandbox", "--enable-unsafe-swiftshader", "--hide-scrollbars", "--no-first-run", "--disable-gpu-sandbox",
           "--disable-background-networking", "--disable-component-update", "--remote-debugging-port=0")


class Page:
    """One tab. errors: what its console and its exceptions said; requests: every address it asked for."""

    def __init__(self, url: str, profile, width: int = 1200, height: int = 800):
        self.process = subprocess.Popen(["chromium", *OPTIONS, f"--user-data-dir={profile}", f"--window-size={width},{height}", "about:blank"],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.errors, self.requests, self.number = [], [], 0
        self.socket = connect(self.endpoint(profile), max_size=None, legacy=True)
        for domain in ("Runtime", "Log", "Network", "Page"):
            self.call(f"{domain}.enable")
        self.call("Page.navigate", url=url)

    def endpoint(self, profile) -> str:
        end = time.monotonic() + START_s
        port = profile / "DevToolsActivePort"
        while not (port.exists() and port.read_text().count("\n")):
            assert self.process.poll() is None and time.monotonic() < end, "chromium did not start"
            time.sleep(0.05)
        with urllib.request.urlopen(f"http://127.0.0.1:{port.read_text().splitlines()[0]}/json") as answer:
            return next(tab["webSocketDebuggerUrl"] for tab in json.load(answer) if tab["type"] == "page")

    def call(self, method: str, **parameters) -> dict:
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.recv(timeout=ANSWER_s))
            if message.get("id") == self.number:
                assert "error" not in message, message
                return message["result"]
            self.note(message)

    def note(self, message: dict) -> None:
        said = message.get("params", {})
        if message["method"] == "Runtime.exceptionThrown":
            self.errors.append(said["exceptionDetails"].get("exception", {}).get("description", said["exceptionDetails"]["text"]))
        elif message["method"] == "Runtime.consoleAPICalled" and said["type"] in ("error", "assert"):
            self.errors.append(" ".join(str(part.get("value", part.get("description"))) for part in said["args"]))
        elif message["method"] == "Log.entryAdded" and said["entry"]["level"] == "error":
            self.errors.append(f"{said['entry']['text']} {said['entry'].get('url', '')}")
        elif message["method"] == "Network.requestWillBeSent":
            self.requests.append(said["request"]["url"])

    def value(self, expression: str):
        return self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)["result"].get("value")

    def until(self, expression: str, patience_s: float = 60.0):
        end = time.monotonic() + patience_s
        while not (found := self.value(expression)):
            assert time.monotonic() < end, f"{expression} never came; {self.errors}"
            time.sleep(0.1)
        return found

    def picture(self, target=None) -> np.ndarray:
        """[height, width, 3] of what is seen."""
        data = base64.b64decode(self.call("Page.captureScreenshot")["data"])
        if target:
            target.write_bytes(data)
        return np.asarray(Image.open(io.BytesIO(data)).convert("RGB")).astype(int)

    def close(self) -> None:
        self.socket.close()
        self.process.terminate()
        self.process.wait(20)
