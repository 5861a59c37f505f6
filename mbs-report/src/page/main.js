// Puts the page together: texts, one clock for all, plots, stick figure.
function makeClock(data) {
  const all = data.panels.flatMap((panel) => panel.lines.map((line) => line.t));
  if (data.motion) all.push(data.motion.t);
  const [start, end] = limits(all.flatMap((t) => (t.length ? [t[0], t[t.length - 1]] : [])));
  const listeners = [];
  let t = start;
  return {
    span: [start, end > start ? end : start + 1],
    end, moves: Boolean(data.motion),
    now: () => t,
    listen: (f) => listeners.push(f),
    seek(to) { t = Math.min(end, Math.max(start, to)); listeners.forEach((f) => f(t)); },
  };
}

function makeControls(clock) {
  const by = (id) => document.getElementById(id);
  const [start] = clock.span, end = clock.end, slider = by("time");
  let playing = false, last = null;
  by("play").addEventListener("click", () => {
    playing = !playing;
    if (playing && clock.now() >= end) clock.seek(start);
    last = null;
    by("play").textContent = playing ? "Pause" : "Play";
    if (playing) requestAnimationFrame(tick);
  });
  function tick(stamp) {
    if (!playing) return;
    if (last !== null) clock.seek(clock.now() + ((stamp - last) / 1000) * Number(by("speed").value));
    last = stamp;
    if (clock.now() >= end) { playing = false; by("play").textContent = "Play"; return; }
    requestAnimationFrame(tick);
  }
  slider.addEventListener("input", () => clock.seek(start + (slider.value / 1000) * (end - start)));
  clock.listen((t) => {
    slider.value = end > start ? (1000 * (t - start)) / (end - start) : 0;
    by("clock").textContent = `${t.toFixed(3)} s`;
  });
  // an address like run.html#t=1.5 opens at that instant
  const seekAddress = () => {
    const asked = /[#&]t=([-+.\deE]+)/.exec(location.hash);
    clock.seek(asked && Number.isFinite(Number(asked[1])) ? Number(asked[1]) : start);
  };
  window.addEventListener("hashchange", seekAddress);
  seekAddress();
}

function fillTable(id, rows) {
  if (!rows.length) return;
  document.getElementById(id + "-card").hidden = false;
  const table = document.getElementById(id);
  for (const [label, value] of rows) {
    const row = table.insertRow();
    row.insertCell().textContent = label;
    row.insertCell().textContent = value;
  }
}

function fillChoice(rows) {
  if (!rows.length) return;
  document.getElementById("choice-card").hidden = false;
  const table = document.getElementById("choice");
  rows.forEach((cells, i) => {
    const row = i ? table.insertRow() : table.createTHead().insertRow();
    for (const text of cells) {
      const cell = i ? row.insertCell() : row.appendChild(document.createElement("th"));
      cell.textContent = text;
    }
  });
}

(function main() {
  const data = JSON.parse(document.getElementById("data").textContent);
  document.getElementById("scene").textContent = data.scene;
  if (data.error !== null) {
    const box = document.getElementById("error");
    box.hidden = false;
    box.textContent = "The run stopped " + data.error;
  }
  const notes = document.getElementById("notes");
  notes.hidden = !data.notes.length;
  for (const note of data.notes) notes.appendChild(document.createElement("li")).textContent = note;
  fillTable("summary", data.summary);
  fillChoice(data.choice);
  fillTable("provenance", data.provenance);

  const clock = makeClock(data), redraws = [];
  if (data.motion && data.motion.t.length && data.motion.bodies.length) {
    document.getElementById("motion").hidden = false;
    redraws.push(makeMotion(data.motion, clock));
  }
  const panels = document.getElementById("panels");
  for (const panel of data.panels) redraws.push(makePlot(panel, clock, panels));
  makeControls(clock);
  const redraw = () => redraws.forEach((draw) => draw());
  // columns settle only after the last panel is in place
  redraw();
  window.addEventListener("resize", redraw);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
})();
