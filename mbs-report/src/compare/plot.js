"use strict";
// Plots: SVG lines over time, distinguished by dash and marker as well as by colour.
const SVG = "http://www.w3.org/2000/svg";
const DASHES = ["", "8 4", "2 3", "10 3 2 3", "14 4", "5 2 1 2 1 2"];
const MARKS = [
  "M-3.2,0a3.2,3.2 0 1,0 6.4,0a3.2,3.2 0 1,0 -6.4,0", "M-3,-3H3V3H-3Z", "M0,-4L3.8,3H-3.8Z",
  "M0,-4L4,0L0,4L-4,0Z", "M-3.5,-3.5L3.5,3.5M-3.5,3.5L3.5,-3.5", "M-4,0H4M0,-4V4",
];

function element(name, attributes, parent) {
  const node = document.createElementNS(SVG, name);
  for (const key in attributes) node.setAttribute(key, attributes[key]);
  if (parent) parent.appendChild(node);
  return node;
}

function pen(i) {
  return { style: `stroke: var(--line-${i % 6})`, "stroke-dasharray": DASHES[i % 6] };
}

// An entry of a legend: swatch, name, and a place for the value under the cursor.
function legendEntry(parent, i, name, marked) {
  const entry = document.createElement("span");
  const swatch = element("svg", { viewBox: "0 0 34 12", "aria-hidden": "true" }, entry);
  element("path", { d: "M1,6H33", ...pen(i) }, swatch);
  if (marked) element("path", { d: MARKS[i % 6], transform: "translate(17,6)", style: pen(i).style }, swatch);
  entry.append(name);
  const value = entry.appendChild(document.createElement("b"));
  parent.appendChild(entry);
  return value;
}

function show(x) {
  if (x === null || x === undefined) return "none";
  const size = Math.abs(x);
  return size !== 0 && (size < 1e-3 || size >= 1e6) ? (+x.toPrecision(4)).toExponential() : String(+x.toPrecision(5));
}

function niceTicks(low, high, wanted) {
  const raw = (high - low) / wanted, base = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * base).find((s) => s >= raw * 0.999);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9 && ticks.length < 50; k++) ticks.push(k * step);
  return ticks;
}

// Index of the last time not after t.
function before(times, t) {
  let low = 0, high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t) low = middle; else high = middle - 1;
  }
  return low;
}

function limits(values) {
  let low = Infinity, high = -Infinity;
  for (const x of values) if (x !== null) { if (x < low) low = x; if (x > high) high = x; }
  return low > high ? [0, 1] : [low, high];
}

function makePlot(panel, clock, parent) {
  const card = document.createElement("section");
  card.className = "card";
  const title = card.appendChild(document.createElement("h2"));
  title.append(panel.title + " ");
  const unit = title.appendChild(document.createElement("span"));
  unit.className = "unit";
  unit.textContent = `[${panel.unit}]`;
  const svg = element("svg", { class: "plot", role: "img", "aria-label": panel.caption }, card);
  const legend = card.appendChild(document.createElement("div"));
  legend.className = "legend";
  const caption = card.appendChild(document.createElement("p"));
  caption.className = "caption";
  caption.textContent = panel.caption;
  parent.appendChild(card);
  const marked = panel.lines.length > 1;
  const values = panel.lines.map((line, i) => legendEntry(legend, i, line.name, marked));
  const when = legend.appendChild(document.createElement("span"));

  // value to be drawn: logarithms of positive numbers only
  const drawn = (y) => (y === null || (panel.log && !(y > 0)) ? null : panel.log ? Math.log10(y) : y);
  const lines = panel.lines.map((line) => ({ t: line.t, y: line.y.map(drawn) }));
  let [t0, t1] = clock.span;
  let [low, high] = limits(lines.flatMap((line) => line.y));
  // zero crossings dip without end on a logarithmic axis: sixteen decades are the digits of a number
  if (panel.log) { high = Math.ceil(high); low = Math.min(Math.max(Math.floor(low), high - 16), high - 1); }
  else if (panel.steps) { low = 0; high += 0.5; }
  else {
    const room = (high - low) * 0.06 || Math.abs(high) * 0.1 || 1;
    low -= room; high += room;
  }

  let x, y, cursor, now, area;
  function draw() {
    const width = Math.max(card.clientWidth - 26, 200), height = Math.round(Math.min(300, Math.max(190, width * 0.5)));
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.style.height = height + "px";
    svg.replaceChildren();
    area = { left: 62, right: width - 10, top: 8, bottom: height - 36 };
    x = (t) => area.left + ((t - t0) / (t1 - t0)) * (area.right - area.left);
    y = (v) => area.bottom - ((Math.max(v, low) - low) / (high - low)) * (area.bottom - area.top);
    axes(width, height);
    lines.forEach((line, i) => trace(line, i));
    if (lines.every((line) => line.y.every((v) => v === null))) {
      const empty = element("text", { x: (area.left + area.right) / 2, y: (area.top + area.bottom) / 2, "text-anchor": "middle" }, svg);
      empty.textContent = panel.log && panel.lines.some((line) => line.y.some((v) => v === 0)) ? "zero throughout" : "no numbers to draw";
    }
    now = element("line", { class: "now", y1: area.top, y2: area.bottom }, svg);
    cursor = element("line", { class: "cursor", y1: area.top, y2: area.bottom, visibility: "hidden" }, svg);
    setNow(clock.now());
  }
  function axes(width, height) {
    const skip = Math.ceil((high - low) / 7);
    const marks = panel.log
      ? Array.from({ length: high - low + 1 }, (_, k) => low + k).filter((_, k) => k % skip === 0)
      : niceTicks(low, high, panel.steps ? Math.min(5, high) : 5).filter((v) => !panel.steps || Number.isInteger(v));
    for (const v of marks) {
      element("line", { class: "grid", x1: area.left, x2: area.right, y1: y(v), y2: y(v) }, svg);
      const label = element("text", { x: area.left - 6, y: y(v) + 4, "text-anchor": "end" }, svg);
      label.textContent = panel.log ? `1e${v}` : Math.abs(v) < (high - low) * 1e-9 ? "0" : show(v);
    }
    for (const t of niceTicks(t0, t1, width < 420 ? 5 : 7)) {
      element("line", { class: "grid", x1: x(t), x2: x(t), y1: area.top, y2: area.bottom }, svg);
      const label = element("text", { x: x(t), y: area.bottom + 16, "text-anchor": "middle" }, svg);
      label.textContent = show(t);
    }
    element("rect", { class: "frame", x: area.left, y: area.top, width: area.right - area.left, height: area.bottom - area.top }, svg);
    element("text", { x: (area.left + area.right) / 2, y: height - 4, "text-anchor": "middle" }, svg).textContent = "time [s]";
  }
  function trace(line, i) {
    let d = "", gap = true;
    line.t.forEach((t, k) => {
      const v = line.y[k];
      if (v === null) { gap = true; return; }
      const px = x(t).toFixed(1), py = y(v).toFixed(1);
      d += gap ? `M${px},${py}` : panel.steps ? `V${py}H${px}` : `L${px},${py}`;
      gap = false;
    });
    element("path", { d, ...pen(i) }, svg);
    if (!marked) return;
    // a marker at even distances, shifted per line so that equal curves stay visible
    for (let k = 0; k < 8; k++) {
      const at = before(line.t, t0 + ((k + (i + 0.5) / lines.length) / 8) * (t1 - t0));
      if (line.t.length && line.y[at] !== null) {
        element("path", { d: MARKS[i % 6], transform: `translate(${x(line.t[at])},${y(line.y[at])})`, style: pen(i).style }, svg);
      }
    }
  }
  function readout(t) {
    when.textContent = t === null ? "" : `t = ${show(t)} s`;
    panel.lines.forEach((line, i) => {
      if (t === null || !line.t.length) { values[i].textContent = ""; return; }
      const k = before(line.t, t), next = Math.min(k + 1, line.t.length - 1);
      const nearest = line.t[next] - t < t - line.t[k] ? next : k;
      values[i].textContent = " = " + show(line.y[nearest]);
    });
  }
  function setNow(t) {
    now.setAttribute("x1", x(t)); now.setAttribute("x2", x(t));
    now.setAttribute("visibility", clock.moves ? "visible" : "hidden");
  }
  const timeAt = (event) => {
    const box = svg.getBoundingClientRect();
    const px = (event.clientX - box.left) * (svg.viewBox.baseVal.width / box.width);
    return Math.min(t1, Math.max(t0, t0 + ((px - area.left) / (area.right - area.left)) * (t1 - t0)));
  };
  svg.addEventListener("pointermove", (event) => {
    const t = timeAt(event);
    cursor.setAttribute("x1", x(t)); cursor.setAttribute("x2", x(t));
    cursor.setAttribute("visibility", "visible");
    readout(t);
  });
  svg.addEventListener("pointerleave", () => { cursor.setAttribute("visibility", "hidden"); readout(null); });
  svg.addEventListener("click", (event) => clock.seek(timeAt(event)));
  clock.listen((t) => setNow(t));
  draw();
  return draw;
}
