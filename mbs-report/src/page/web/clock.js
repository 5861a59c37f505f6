// One clock for the view and all plots, its buttons, its keys, and the address: run.html#t=6.4&follow=chassis&view=side.
function makeClock([start, end]) {
  const listeners = [];
  let t = start;
  return {
    start, end,
    now: () => t,
    listen: (f) => listeners.push(f),
    seek(to) { t = Math.min(end, Math.max(start, to)); for (const f of listeners) f(t); },
  };
}

// What the address asks for, by name.
function readAddress() {
  const asked = {};
  for (const part of location.hash.replace(/^#/, "").split("&")) {
    const [name, value] = part.split("=");
    if (value !== undefined) asked[name] = decodeURIComponent(value);
  }
  return asked;
}

function writeAddress(changes) {
  const all = { ...readAddress(), ...changes };
  const parts = Object.keys(all).filter((name) => all[name] !== "").map((name) => `${name}=${encodeURIComponent(all[name])}`);
  // the address of a file may not be replaced in every browser
  try { history.replaceState(null, "", "#" + parts.join("&")); } catch { /* it stays as it is */ }
}

function makeControls(clock, step) {
  const by = (id) => document.getElementById(id);
  const { start, end } = clock, slider = by("time");
  let playing = false, last = null;
  function play(on) {
    playing = on;
    last = null;
    by("play").textContent = playing ? "Pause" : "Play";
    if (!playing) { writeAddress({ t: clock.now().toFixed(4) }); return; }
    if (clock.now() >= end) clock.seek(start);
    requestAnimationFrame(tick);
  }
  function tick(stamp) {
    if (!playing) return;
    if (last !== null) clock.seek(clock.now() + ((stamp - last) / 1000) * Number(by("speed").value));
    last = stamp;
    if (clock.now() >= end) {
      if (!by("loop").checked) { play(false); return; }
      clock.seek(start);
    }
    requestAnimationFrame(tick);
  }
  by("play").addEventListener("click", () => play(!playing));
  slider.addEventListener("input", () => clock.seek(start + (slider.value / 1000) * (end - start)));
  slider.addEventListener("change", () => writeAddress({ t: clock.now().toFixed(4) }));
  clock.listen((t) => {
    slider.value = end > start ? (1000 * (t - start)) / (end - start) : 0;
    by("clock").textContent = `${t.toFixed(3)} s`;
  });
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT|TEXTAREA|BUTTON|SUMMARY)$/.test(event.target.tagName)) return;
    const jump = { Home: start, End: end, ArrowLeft: clock.now() - step, ArrowRight: clock.now() + step }[event.key];
    if (event.key === " ") play(!playing);
    else if (jump !== undefined) clock.seek(jump);
    else return;
    event.preventDefault();
  });
  return { play, isPlaying: () => playing };
}
