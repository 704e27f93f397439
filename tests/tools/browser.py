# SPDX-License-Identifier: GPL-3.0-or-later
"""Debian's Chromium without a window, driven by its DevTools protocol over a pair of pipes: no further package is needed."""
import base64
import json
import os
import pathlib
import select
import shutil
import subprocess
import tempfile
import time

PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser")
WAIT_S = 120.0


class PageError(Exception):
    """A script of the page, or the browser, failed."""


class Browser:
    """One browser with one page: goto(), evaluate(), press(), drag(), screenshot(); `problems` has errors of the page's console."""

    def __init__(self, width=1280, height=900):
        self.folder = tempfile.mkdtemp(prefix="clatter-browser-")
        to_child, self.write_end = os.pipe()
        self.read_end, from_child = os.pipe()
        # The shell gives the pipes the numbers 3 and 4, at which Chromium expects them.
        command = (f'exec "$0" "$@" 3<&{to_child} 4>&{from_child}')
        self.process = subprocess.Popen(
            ["bash", "-c", command, PROGRAM, "--headless=new", "--remote-debugging-pipe", "--no-sandbox", "--no-first-run",
             "--disable-background-networking", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
             "--hide-scrollbars", "--mute-audio", f"--user-data-dir={self.folder}", f"--window-size={width},{height}", "about:blank"],
            pass_fds=(to_child, from_child), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        os.close(to_child)
        os.close(from_child)
        self.number, self.buffer, self.answers, self.problems, self.loaded = 0, b"", {}, [], False
        target = self.send("Target.getTargets")["targetInfos"]
        page = next(one["targetId"] for one in target if one["type"] == "page")
        self.session = self.send("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.resize(width, height)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        try:
            self.process.wait(timeout=20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        os.close(self.write_end)
        os.close(self.read_end)
        shutil.rmtree(self.folder, ignore_errors=True)

    def send(self, method, session=None, **parameters):
        """One command; returns its result."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.write_end, data):]
        wanted, until = self.number, time.monotonic() + WAIT_S
        while wanted not in self.answers:
            self.receive(until)
        answer = self.answers.pop(wanted)
        if "error" in answer:
            raise PageError(f"{method}: {answer['error']['message']}")
        return answer["result"]

    def call(self, method, **parameters):
        return self.send(method, self.session, **parameters)

    def receive(self, until):
        """Reads what has come; events of the console and of exceptions become problems."""
        ready, _, _ = select.select([self.read_end], [], [], max(0.0, until - time.monotonic()))
        if not ready:
            raise PageError("the browser does not answer")
        part = os.read(self.read_end, 1 << 20)
        if not part:
            raise PageError("the browser ended")
        self.buffer += part
        *messages, self.buffer = self.buffer.split(b"\0")
        for message in map(json.loads, messages):
            if "id" in message:
                self.answers[message["id"]] = message
            else:
                self.event(message["method"], message.get("params", {}))

    def event(self, method, found):
        if method == "Runtime.exceptionThrown":
            detail = found["exceptionDetails"]
            self.problems.append(detail.get("exception", {}).get("description", detail["text"]))
        elif method == "Runtime.consoleAPICalled" and found["type"] in ("error", "warning", "assert"):
            self.problems.append(" ".join(str(one.get("value", one.get("description"))) for one in found["args"]))
        elif method == "Log.entryAdded" and found["entry"]["level"] == "error":
            self.problems.append(found["entry"]["text"])
        elif method == "Network.requestWillBeSent" and not found["request"]["url"].startswith(("file:", "data:", "blob:", "about:")):
            self.problems.append(f"request to {found['request']['url']}")
        elif method == "Page.loadEventFired":
            self.loaded = True

    def resize(self, width, height, phone=False, ratio=1):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=ratio, mobile=phone)

    def colours(self, scheme):
        """"light" or "dark" as the system's choice."""
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def goto(self, path):
        """Opens a file of this computer and waits until the page says that it is drawn."""
        self.loaded = False
        self.call("Page.navigate", url=pathlib.Path(path).resolve().as_uri())
        self.wait_for("document.documentElement?.dataset.drawn")

    def wait_for(self, condition):
        until = time.monotonic() + WAIT_S
        while not self.evaluate(condition):
            if self.problems:
                raise PageError("\n".join(self.problems))
            if time.monotonic() > until:
                raise PageError(f"never true: {condition}")
            time.sleep(0.05)

    def evaluate(self, script):
        """The value of an expression, of a promise when it is kept."""
        found = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in found:
            raise PageError(found["exceptionDetails"].get("exception", {}).get("description", "exception"))
        return found["result"].get("value")

    def rectangle(self, selector):
        """[left, top, width, height] of an element, after it was scrolled into the window."""
        return self.evaluate(f"""(async () => {{ const one = document.querySelector({json.dumps(selector)}); one.scrollIntoView({{ block: "center", behavior: "instant" }});
            await new Promise(done => setTimeout(done, 300)); const at = one.getBoundingClientRect(); return [at.left, at.top, at.width, at.height]; }})()""")

    def drag(self, selector, begin, end):
        """Drags from one place of an element to another, both as shares of its width and height."""
        left, top, width, height = self.rectangle(selector)
        places = [(left + width * (begin[0] + (end[0] - begin[0]) * k / 5), top + height * (begin[1] + (end[1] - begin[1]) * k / 5)) for k in range(6)]
        for k, (x, y) in enumerate(places):
            if k == 0:
                self.call("Input.dispatchMouseEvent", type="mousePressed", x=x, y=y, button="left", buttons=1, clickCount=1)
            self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y, button="left", buttons=1)
        self.call("Input.dispatchMouseEvent", type="mouseReleased", x=places[-1][0], y=places[-1][1], button="left", clickCount=1)

    def press(self, key, text=""):
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, code=key, text=text)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key, code=key)

    def settle(self):
        """Waits for two frames, in which changes are drawn."""
        self.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")

    def screenshot(self, path=None, whole=False):
        """PNG bytes of the window or the whole page, also written to a file."""
        found = base64.b64decode(self.call("Page.captureScreenshot", format="png", captureBeyondViewport=whole,
                                           **({"clip": {**self.page_size(), "scale": 1}} if whole else {}))["data"])
        if path:
            pathlib.Path(path).write_bytes(found)
        return found

    def page_size(self):
        size = self.call("Page.getLayoutMetrics")["cssContentSize"]
        return {"x": 0, "y": 0, "width": size["width"], "height": size["height"]}
