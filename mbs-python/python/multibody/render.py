"""Pictures of a mechanism in motion, as arrays: `with Renderer(mechanism) as renderer: picture = renderer.picture(simulation)`.

The drawing is that of the page of a run, in a Chromium without a window.
"""

from __future__ import annotations

import base64
import json
import os
import select
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import Mechanism, Simulation, UsageError

Picture = NDArray[np.uint8]
"""Red, green and blue: (height, width, 3)."""

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "microsoft-edge")
"""Commands of browsers that can draw, the first one that is found is taken; MULTIBODY_BROWSER names another one."""
PATIENCE = 60.0
"""Longest time for the browser to begin, or to draw one picture [s]; on a busy machine it takes ten seconds."""
SWITCHES = (
    "--headless=new",
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-dev-shm-usage",
    "--no-first-run",
    "--hide-scrollbars",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--remote-debugging-pipe",
)
BEGIN = """
import fcntl, os, sys
files = [fcntl.fcntl(int(file), fcntl.F_DUPFD, 10) for file in sys.argv[1:3]]
for file, to in zip(files, (3, 4)):
    os.dup2(file, to, inheritable=True)
os.execvp(sys.argv[3], sys.argv[3:])
"""
"""Begins the browser, which reads what is asked from its file 3 and answers on its file 4."""
FULL = "body > :not(main), main > :not(#view), #view > :not(.stage) { display: none !important } #view, main, body { margin: 0; padding: 0; border: 0; max-width: none } #view > .stage { height: 100vh; border-radius: 0 }"
"""Style with which the drawing fills the window."""
SCRIPT = """
(() => {
  const style = document.head.appendChild(document.createElement("style"));
  style.textContent = STYLE;
  const page = window.mbsPage, motion = page.motion, view = page.view;
  const first = motion.at(motion.start).slice(), seen = [first], n = motion.n;
  let now = first, isFollowed = false;
  // the view fits what was seen, at times below zero; each pose that leaves it is added
  motion.times = [-1];
  motion.at = (t) => (t < 0 ? seen[-1 - t] : now);
  const box = () => [0, 1, 2].map((i) => { const x = seen.flatMap((p) => Array.from({ length: n }, (_, b) => p[7 * b + i])); return [Math.min(...x), Math.max(...x)]; });
  const heaviest = motion.bodies.reduce((best, body, i) => (body.mass > motion.bodies[best].mass ? i : best), 0);
  const canvas = view.canvas, width = innerWidth, height = innerHeight, rgba = new Uint8Array(4 * width * height), rgb = new Uint8Array(3 * width * height);
  const gl = canvas.getContext("webgl2"), flat = gl ? null : canvas.getContext("2d");
  // what is drawn is read in the same task, rows from below
  const read = () => {
    if (gl) { gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, rgba); return; }
    const found = flat.getImageData(0, 0, width, height).data;
    for (let y = 0; y < height; y++) rgba.set(found.subarray(4 * width * y, 4 * width * (y + 1)), 4 * width * (height - 1 - y));
  };
  window.mbsShow = (pose) => {
    now = Float64Array.from(pose);
    const way = Math.hypot(...[0, 1, 2].map((i) => now[7 * heaviest + i] - first[7 * heaviest + i]));
    if (!isFollowed && way > 2 * motion.length) { isFollowed = true; view.setFollowed(heaviest); }
    const limits = box();
    const leaves = !isFollowed && Array.from({ length: n }).some((_, b) => limits.some(([low, high], i) => now[7 * b + i] < low || now[7 * b + i] > high));
    if (leaves) { seen.push(now); motion.times = seen.map((_, k) => -1 - k); view.fit(); }
    page.clock.seek(0);
    read();
    for (let i = 0, k = 0; i < rgba.length; i += 4) { rgb[k++] = rgba[i]; rgb[k++] = rgba[i + 1]; rgb[k++] = rgba[i + 2]; }
    let text = "";
    for (let i = 0; i < rgb.length; i += 0x8000) text += String.fromCharCode.apply(null, rgb.subarray(i, i + 0x8000));
    return btoa(text);
  };
  // the drawing takes the size of the window a moment later
  return new Promise((done) => {
    const wait = () => {
      if (canvas.width !== width || canvas.height !== height) { setTimeout(wait, 5); return; }
      view.fit();
      done(true);
    };
    wait();
  });
})()
"""


class Renderer:
    """Draws a mechanism at poses of its bodies. It has a browser of its own until `close`."""

    def __init__(self, mechanism: Mechanism, width: int = 640, height: int = 480) -> None:
        if min(width, height) < 1:
            hint = "give whole numbers, one or more"
            raise UsageError(f"a picture of {width} x {height}", code="no-count", argument="width", hint=hint)
        self.mechanism = mechanism
        self._size = width, height
        self._folder = tempfile.TemporaryDirectory(prefix="multibody-", ignore_cleanup_errors=True)
        page = Path(self._folder.name) / "still.html"
        page.write_text(mechanism._still())  # type: ignore[attr-defined]
        self._browser = _Browser(Path(self._folder.name) / "profile", self._size)
        try:
            self._browser.open(page)
            self._browser.evaluate(SCRIPT.replace("STYLE", json.dumps(FULL)))
        except BaseException:
            self.close()
            raise

    def picture(self, simulation: Simulation) -> Picture:
        """The picture of a simulation of this mechanism where it is: (height, width, 3)."""
        poses = np.asarray(simulation.poses(), dtype=np.float64).ravel()
        text = self._browser.evaluate(f"mbsShow({json.dumps(poses.tolist())})")
        width, height = self._size
        return np.frombuffer(base64.b64decode(text), dtype=np.uint8).reshape(height, width, 3)[::-1].copy()

    def close(self) -> None:
        """Ends the browser."""
        self._browser.close()
        self._folder.cleanup()

    def __enter__(self) -> Renderer:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def browser() -> str:
    """The command of a browser that draws; UsageError with what installs one where there is none."""
    names = [os.environ["MULTIBODY_BROWSER"]] if "MULTIBODY_BROWSER" in os.environ else BROWSERS
    found = next(filter(None, map(shutil.which, names)), None)
    if found is None:
        hint = "install one: apt install chromium; or name the command of a Chromium in MULTIBODY_BROWSER"
        raise UsageError("there is no browser that draws pictures", code="no-browser", argument="render_mode", hint=hint)
    return found


class _Browser:
    """A Chromium without a window, asked over a pipe: the protocol of its developer tools, a text of JSON and a zero for each message."""

    def __init__(self, profile: Path, size: tuple[int, int]) -> None:
        to_read, self._to = os.pipe()
        self._from, to_write = os.pipe()
        command = [browser(), *SWITCHES, f"--user-data-dir={profile}", f"--window-size={size[0]},{size[1]}", "about:blank"]
        files, quiet = (to_read, to_write), subprocess.DEVNULL
        begin = [sys.executable, "-S", "-E", "-c", BEGIN, *map(str, files), *command]
        self._process = subprocess.Popen(begin, stdin=quiet, stdout=quiet, stderr=quiet, pass_fds=files, start_new_session=True)
        for file in files:
            os.close(file)
        self._left, self._number, self._session = b"", 0, ""
        target = self._ask("Target.createTarget", url="about:blank")["targetId"]
        self._session = self._ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self._ask("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1, mobile=False)

    def open(self, page: Path) -> None:
        """Opens a page of a run, and waits until it has drawn."""
        self._ask("Page.navigate", url=page.as_uri())
        end = time.monotonic() + PATIENCE
        while self.evaluate("document.documentElement?.dataset.ready") != "yes":
            if time.monotonic() > end:
                raise _silent()
            time.sleep(0.02)

    def evaluate(self, script: str) -> Any:
        """What a script gives."""
        answer = self._ask("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise RuntimeError(details.get("exception", {}).get("description", details["text"]))
        return answer["result"].get("value")

    def close(self) -> None:
        for file in (self._to, self._from):
            os.close(file)
        self._process.terminate()
        try:
            self._process.wait(5.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _ask(self, method: str, **words: Any) -> dict[str, Any]:
        self._number += 1
        message: dict[str, Any] = {"id": self._number, "method": method, "params": words}
        if self._session:
            message["sessionId"] = self._session
        left = memoryview(json.dumps(message).encode() + b"\0")
        try:
            while left:
                left = left[os.write(self._to, left) :]
        except BrokenPipeError:
            raise _silent() from None
        while True:
            answer = json.loads(self._message())
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                found: dict[str, Any] = answer["result"]
                return found

    def _message(self) -> bytes:
        parts = [self._left]
        while b"\0" not in parts[-1]:
            answers, _, _ = select.select([self._from], [], [], PATIENCE)
            part = os.read(self._from, 1 << 20) if answers else b""
            if not part:
                raise _silent()
            parts.append(part)
        text, self._left = b"".join(parts).split(b"\0", 1)
        return text


def _silent() -> UsageError:
    hint = "try it alone: chromium --headless --dump-dom about:blank; or name another browser in MULTIBODY_BROWSER"
    return UsageError("the browser ended, or drew nothing", code="no-browser", argument="render_mode", hint=hint)
