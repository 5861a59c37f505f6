// Diagrams of points: one number over another. Lines differ by mark and dash as well as by colour; what is under the pointer is said below.
const SVG = "http://www.w3.org/2000/svg";
const SHAPES = [
  "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0", "M-3.6,-3.6H3.6V3.6H-3.6Z", "M0,-4.6L4.4,3.4H-4.4Z",
  "M0,-5L5,0L0,5L-5,0Z", "M0,4.6L4.4,-3.4H-4.4Z", "M-4,-4.4H4L-4,4.4H4Z",
];
const STROKES = ["", "8 4", "2 3", "10 3 2 3", "14 4", "5 2 1 2 1 2"];
const CROSS = "M-4,-4L4,4M-4,4L4,-4";
// Decades of a logarithmic axis: more are rounding.
const MANY_DECADES = 20;

function element(name, attributes, parent) {
  const node = document.createElementNS(SVG, name);
  for (const key in attributes) node.setAttribute(key, attributes[key]);
  if (parent) parent.appendChild(node);
  return node;
}

function lineStyle(look) {
  return { style: `stroke: var(--line-${look.kind}); fill: none`, "stroke-dasharray": STROKES[look.dash], "stroke-width": look.is_thin ? 1 : 1.7 };
}

function mark(parent, look, x, y, shape) {
  const colour = `var(--line-${look.kind})`, fill = shape === CROSS ? "none" : look.is_filled ? colour : "var(--card)";
  return element("path", { class: "mark", d: shape || SHAPES[look.kind], transform: `translate(${x},${y})`, style: `stroke: ${colour}; fill: ${fill}` }, parent);
}

// What stands in the page's style goes into the file: it has none of its own.
function exportSvg(svg, keys, name) {
  const copy = svg.cloneNode(true), from = svg.querySelectorAll("*"), to = copy.querySelectorAll("*");
  const styled = (part, node, names) => { const style = getComputedStyle(node); for (const k of names) part.style.setProperty(k, style.getPropertyValue(k)); };
  const drawn = ["stroke", "fill", "stroke-width", "stroke-dasharray"];
  from.forEach((node, i) => {
    styled(to[i], node, [...drawn, "opacity", "font-size"]);
    if (node.tagName === "text") to[i].style.fontFamily = "sans-serif";
  });
  const [, , width, height] = svg.getAttribute("viewBox").split(" ").map(Number);
  const columns = Math.max(1, Math.floor(width / 260)), rows = Math.ceil(keys.length / columns);
  keys.forEach((key, i) => {
    const group = element("g", { transform: `translate(${10 + (i % columns) * 260},${height + 14 + Math.floor(i / columns) * 18})` }, copy);
    key.querySelectorAll("svg > *").forEach((node) => styled(group.appendChild(node.cloneNode(true)), node, drawn));
    element("text", { x: 52, y: 10, style: `font: 12px sans-serif; fill: ${getComputedStyle(key).color}` }, group).textContent = key.textContent;
  });
  const whole = height + rows * 18 + (rows ? 10 : 0), back = element("rect", { width, height: whole, fill: getComputedStyle(svg.parentElement).backgroundColor });
  copy.insertBefore(back, copy.firstChild);
  copy.setAttribute("xmlns", SVG);
  copy.setAttribute("viewBox", `0 0 ${width} ${whole}`);
  copy.setAttribute("width", width);
  copy.removeAttribute("style");
  saveBlob(new Blob([copy.outerHTML], { type: "image/svg+xml" }), name.toLowerCase().replace(/[^a-z0-9]+/g, "-") + ".svg");
}

// An axis to the data: a function that gives the share of a value along it, and its ticks; text of minor ones is null.
function makeAxis(values, isLog, room) {
  const usable = values.filter((v) => Number.isFinite(v) && (!isLog || v > 0)).map((v) => (isLog ? Math.log10(v) : v));
  let low = Math.min(...usable), high = Math.max(...usable);
  if (!usable.length) [low, high] = [0, 1];
  if (isLog) low = Math.max(low, high - MANY_DECADES);
  const margin = 0.04 * (high - low) || (isLog ? 0.5 : Math.abs(high) * 0.1 || 1);
  low -= margin; high += margin;
  const of = (v) => (isLog ? (v > 0 ? Math.log10(v) : low) : v), at = (v) => Math.min(1, Math.max(0, (of(v) - low) / (high - low)));
  const ticks = [];
  if (!isLog) for (const v of niceTicks(low, high, Math.max(2, Math.min(8, room / 80)))) ticks.push([v, Math.abs(v) < (high - low) * 1e-9 ? "0" : show(v)]);
  else {
    const every = Math.max(1, Math.ceil((high - low) / (room / 56)));
    for (let k = Math.floor(low); k <= high; k++) {
      if (k >= low) ticks.push([10 ** k, k % every === 0 ? (k === 0 ? "1" : `1e${k}`) : ""]);
      if (high - low <= 4) for (const m of [2, 5]) if (k + Math.log10(m) >= low && k + Math.log10(m) <= high) ticks.push([m * 10 ** k, high - low < 1.3 && room > 200 ? `${m}e${k}` : null]);
    }
  }
  return { at, ticks, has: (v) => of(v) >= low && of(v) <= high };
}

function makeDiagram(figure, panel, looks) {
  const svg = figure.querySelector("svg.plot"), said = figure.querySelector(".said"), notes = figure.querySelector(".marks");
  let spots = [], ring = null;
  figure.querySelector(".save").addEventListener("click", () => exportSvg(svg, panel.has_keys ? [...document.querySelectorAll('#keys button[aria-pressed="true"]')] : [], panel.title));

  function draw() {
    const room = figure.clientWidth - 30;
    if (room <= 0) return;
    const width = Math.max(room, 240), height = Math.round(panel.has_keys ? Math.min(520, Math.max(300, width * 0.55)) : Math.min(340, Math.max(240, width * 0.62)));
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.style.height = height + "px";
    svg.replaceChildren();
    spots = [];
    const shown = panel.lines.filter((line) => looks[line.look].is_shown), points = shown.flatMap((line) => line.points);
    const onRail = panel.rail ? shown.flatMap((line) => line.failed) : [];
    const [left, top, right, bottom] = [70, panel.rail === "top" && onRail.length ? 30 : 10, width - (panel.rail === "right" && onRail.length ? 44 : 14), height - 46];
    const across = makeAxis(points.map((p) => p[0]), panel.is_log[0], right - left), along = makeAxis(points.map((p) => p[1]), panel.is_log[1], 1.6 * (bottom - top));
    const x = (v) => left + across.at(v) * (right - left), y = (v) => bottom - along.at(v) * (bottom - top);
    for (const [v, label] of across.ticks) {
      element("line", { class: label === null ? "minor" : "grid", x1: x(v), x2: x(v), y1: top, y2: bottom }, svg);
      if (label) element("text", { x: x(v), y: bottom + 20, "text-anchor": "middle" }, svg).textContent = label;
    }
    for (const [v, label] of along.ticks) {
      element("line", { class: label === null ? "minor" : "grid", x1: left, x2: right, y1: y(v), y2: y(v) }, svg);
      if (label) element("text", { x: left - 6, y: y(v) + 4, "text-anchor": "end" }, svg).textContent = label;
    }
    element("rect", { class: "frame", x: left, y: top, width: right - left, height: bottom - top }, svg);
    element("text", { x: (left + right) / 2, y: height - 6, "text-anchor": "middle" }, svg).textContent = panel.axes[0];
    element("text", { transform: `translate(14,${(top + bottom) / 2}) rotate(-90)`, "text-anchor": "middle" }, svg).textContent = panel.axes[1];
    for (const [v, label] of panel.across.filter(([v]) => along.has(v))) {
      element("line", { class: "level", x1: left, x2: right, y1: y(v), y2: y(v) }, svg);
      element("text", { class: "note", x: right - 6, y: y(v) + (y(v) < top + 16 ? 13 : -4), "text-anchor": "end" }, svg).textContent = label;
    }
    for (const [v, label] of panel.upright.filter(([v]) => across.has(v))) {
      element("line", { class: "level", x1: x(v), x2: x(v), y1: top, y2: bottom }, svg);
      element("text", { class: "note", transform: `translate(${x(v) + (x(v) < left + 16 ? 12 : -4)},${bottom - 6}) rotate(-90)` }, svg).textContent = label;
    }
    if (onRail.length) rail({ left, top, right, bottom, width });
    shown.forEach((line) => trace(line, x, y, { left, top, right }));
    if (!points.length) element("text", { x: (left + right) / 2, y: (top + bottom) / 2, "text-anchor": "middle" }, svg).textContent = "nothing to draw is shown";
    ring = element("circle", { class: "chosen", r: 8, visibility: "hidden" }, svg);
    notes.replaceChildren();
    shown.filter((line) => line.note).forEach((line) => { notes.appendChild(document.createElement("li")).textContent = `${looks[line.look].name}: ${line.note}`; });
    notes.hidden = !notes.childNodes.length;
  }
  function trace(line, x, y, { left, top, right }) {
    const look = looks[line.look], places = line.points.map((p) => [x(p[0]), y(p[1])]), group = element("g", { class: "line", "data-look": line.look }, svg);
    const d = places.map((p, i) => `${i ? "L" : "M"}${p[0].toFixed(1)},${p[1].toFixed(1)}`).join("");
    if (d && !panel.is_scatter) element("path", { d, ...lineStyle(look) }, group);
    places.forEach((p, i) => {
      if (!panel.is_plain || places.length < 3 || i % 4 === line.look % 4) mark(group, look, p[0], p[1]);
      spots.push([p[0], p[1], line.points[i][2]]);
    });
    if (!panel.rail) return;
    line.failed.forEach(([v, text]) => {
      // side by side where several stop at one place
      const p = panel.rail === "top" ? [v > 0 ? x(v) : left + 6, top - 12] : [right + 20, y(v)];
      const taken = spots.filter((s) => s[3] && Math.abs(s[0] - p[0]) < 5 && Math.abs(s[1] - p[1]) < 7).length;
      p[panel.rail === "top" ? 1 : 0] += [0, -5, 5, -9, 9][taken % 5];
      mark(group, look, p[0], p[1], CROSS);
      spots.push([p[0], p[1], text, true]);
    });
  }
  function rail({ left, top, right, bottom, width }) {
    const box = panel.rail === "top" ? { x: left, y: 2, width: right - left, height: top - 4 } : { x: right + 6, y: top, width: width - right - 10, height: bottom - top };
    svg.insertBefore(element("rect", { class: "rail", ...box }), svg.firstChild);
    const at = panel.rail === "top" ? { x: left - 6, y: 17 } : { x: width - 2, y: bottom + 36 };
    element("text", { class: "note", "text-anchor": "end", ...at }, svg).textContent = "failed";
  }
  function say(event) {
    const box = svg.getBoundingClientRect(), scale = svg.viewBox.baseVal.width / box.width;
    const px = (event.clientX - box.left) * scale, py = (event.clientY - box.top) * scale;
    let best = null, least = 40;
    for (const spot of spots) {
      const d = Math.hypot(spot[0] - px, spot[1] - py);
      if (d < least) { least = d; best = spot; }
    }
    said.textContent = best ? best[2] : "";
    ring?.setAttribute("visibility", best ? "visible" : "hidden");
    if (best) { ring.setAttribute("cx", best[0]); ring.setAttribute("cy", best[1]); }
  }
  svg.addEventListener("pointermove", say);
  svg.addEventListener("pointerdown", say);
  svg.addEventListener("pointerleave", () => { said.textContent = ""; ring?.setAttribute("visibility", "hidden"); });
  // what is folded has no width until it is opened
  let seen = 0;
  new ResizeObserver(() => { if (figure.clientWidth !== seen) { seen = figure.clientWidth; draw(); } }).observe(figure);
  return draw;
}

// Exponents of the errors over step and penalty; shades say the same, and x stands where a run stops.
function makeMap(figure, map) {
  const svg = figure.querySelector("svg.plot"), said = figure.querySelector(".said"), [fewest, most] = [-12, 0];
  figure.querySelector(".save").addEventListener("click", () => exportSvg(svg, [], figure.querySelector("h2").textContent));
  function draw() {
    const width = figure.clientWidth - 30, left = 62, rowHeight = 36;
    if (width <= 0) return;
    const height = map.penalties.length * rowHeight + 54, wide = (width - left - 8) / map.steps.length;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.style.height = height + "px";
    svg.replaceChildren();
    map.penalties.forEach((penalty, i) => {
      const top = 6 + (map.penalties.length - 1 - i) * rowHeight;
      element("text", { x: left - 6, y: top + rowHeight / 2 + 4, "text-anchor": "end" }, svg).textContent = penalty.toExponential(0).replace("+", "");
      map.steps.forEach((step, j) => {
        const cell = map.cells[i][j], x = left + j * wide;
        const size = cell.error > 0 ? Math.min(most, Math.max(fewest, Math.floor(Math.log10(cell.error)))) : fewest;
        const shade = cell.error === null ? 0 : (size - fewest) / (most - fewest);
        const box = element("rect", { x, y: top, width: wide, height: rowHeight, style: `fill: var(--ink); opacity: ${(shade * 0.85).toFixed(2)}` }, svg);
        element("rect", { class: "frame", x, y: top, width: wide, height: rowHeight }, svg);
        const stops = cell.failure || cell.error === null, ink = `fill: var(${shade > 0.5 ? "--card" : "--ink"})`;
        if (stops) element("path", { d: `M${x},${top + rowHeight}L${x + wide},${top}`, style: "stroke: var(--rule); fill: none" }, svg);
        const text = element("text", { x: x + wide / 2, y: top + (stops ? 22 : 16), "text-anchor": "middle", style: ink }, svg);
        text.textContent = stops ? "x" : cell.error === 0 ? "0" : Math.floor(Math.log10(cell.error));
        if (!stops) element("text", { class: "note", x: x + wide / 2, y: top + 30, "text-anchor": "middle", style: ink }, svg).textContent = cell.iterations.toFixed(1);
        const words = `step ${show(step)} s, penalty ${show(penalty)} ${map.unit}: ` + (cell.failure ? `stops, ${cell.failure}` : `error ${show(cell.error)}, ${cell.iterations.toFixed(2)} iterations a step`);
        for (const node of [box, text]) for (const event of ["pointerenter", "pointerdown"]) node.addEventListener(event, () => { said.textContent = words; });
      });
    });
    const bottom = 6 + map.penalties.length * rowHeight;
    map.steps.forEach((step, j) => {
      element("text", { x: left + (j + 0.5) * wide, y: bottom + 16, "text-anchor": "middle" }, svg).textContent = step.toExponential(wide < 52 ? 0 : 1).replace("+", "");
    });
    element("text", { x: (left + width) / 2, y: bottom + 36, "text-anchor": "middle" }, svg).textContent = "step [s]";
    element("text", { transform: `translate(12,${bottom / 2}) rotate(-90)`, "text-anchor": "middle" }, svg).textContent = `penalty [${map.unit}]`;
  }
  new ResizeObserver(draw).observe(figure);
  return draw;
}

// The keys of all lines: each hides and shows its own, and stands out while the pointer is on it.
function makeKeys(place, looks, redraw) {
  const buttons = looks.map((look, i) => {
    const key = place.appendChild(document.createElement("button"));
    key.type = "button";
    const swatch = element("svg", { viewBox: "0 0 44 12", "aria-hidden": "true" }, key);
    element("path", { d: "M1,6H43", ...lineStyle(look) }, swatch);
    mark(swatch, look, 22, 6);
    key.append(look.name);
    const others = (faint) => document.querySelectorAll("g.line").forEach((line) => line.classList.toggle("faint", faint && Number(line.dataset.look) !== i));
    for (const [event, faint] of [["pointerenter", true], ["focus", true], ["pointerleave", false], ["blur", false]]) key.addEventListener(event, () => others(faint && look.is_shown));
    key.addEventListener("click", () => { look.is_shown = !look.is_shown; refresh(); });
    return key;
  });
  const refresh = () => { looks.forEach((look, i) => buttons[i].setAttribute("aria-pressed", look.is_shown)); redraw(); };
  const groups = document.getElementById("groups");
  const sorts = [...new Set(looks.flatMap((look) => look.groups))];
  for (const sort of sorts.length ? ["all", ...sorts] : []) {
    const button = groups.appendChild(document.createElement("button"));
    Object.assign(button, { type: "button", textContent: sort });
    button.addEventListener("click", () => { looks.forEach((look) => { look.is_shown = sort === "all" || look.groups.includes(sort); }); refresh(); });
  }
  refresh();
}

// All diagrams and maps of a page; a function that draws them again.
function makeDiagrams({ looks, panels, maps }) {
  const figures = (name) => [...document.querySelectorAll(`figure[data-${name}]`)];
  const draws = figures("diagram").map((figure) => makeDiagram(figure, panels[figure.dataset.diagram], looks));
  draws.push(...figures("map").map((figure) => makeMap(figure, maps[figure.dataset.map])));
  const redraw = () => draws.forEach((draw) => draw()), keys = document.getElementById("keys");
  if (keys) makeKeys(keys, looks, redraw); else redraw();
  return redraw;
}
