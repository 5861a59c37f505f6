// The page of a comparison: diagrams with logarithmic axes, distinguished by mark and dash as well as by colour.
const SHAPES = [
  "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0", "M-3.6,-3.6H3.6V3.6H-3.6Z", "M0,-4.6L4.4,3.4H-4.4Z",
  "M0,-5L5,0L0,5L-5,0Z", "M0,4.6L4.4,-3.4H-4.4Z", "M-4,-4.4H4L-4,4.4H4Z",
];
const STROKES = ["", "8 4", "2 3", "10 3 2 3", "1 4"];
const CROSS = "M-4,-4L4,4M-4,4L4,-4";

function lineStyle(look, plain) {
  return { style: `stroke: var(--line-${look.kind}); fill: none`, "stroke-dasharray": STROKES[look.dash], "stroke-width": look.is_filled ? 1.7 : 1.1, opacity: plain ? 0.9 : 1 };
}

function mark(parent, look, x, y, shape) {
  const colour = `var(--line-${look.kind})`;
  const fill = shape === CROSS ? "none" : look.is_filled ? colour : "var(--card)";
  return element("path", { class: "mark", d: shape || SHAPES[look.kind], transform: `translate(${x},${y})`, style: `stroke: ${colour}; fill: ${fill}` }, parent);
}

function heading(card, text, svg) {
  const save = card.appendChild(document.createElement("button"));
  save.className = "save";
  save.textContent = "Export SVG";
  save.addEventListener("click", () => exportSvg(svg(), text));
  card.appendChild(document.createElement("h2")).textContent = text;
}

// What stands in the page's style goes into the file: it has none of its own.
function exportSvg(svg, name) {
  const copy = svg.cloneNode(true), from = svg.querySelectorAll("*"), to = copy.querySelectorAll("*");
  from.forEach((node, i) => {
    const style = getComputedStyle(node);
    for (const key of ["stroke", "fill", "stroke-width", "stroke-dasharray", "opacity", "font-size"]) to[i].style.setProperty(key, style.getPropertyValue(key));
    if (node.tagName === "text") to[i].style.fontFamily = "sans-serif";
  });
  const [, , width, height] = svg.getAttribute("viewBox").split(" ").map(Number);
  const shown = [...document.querySelectorAll('#keys button[aria-pressed="true"]')];
  const columns = Math.max(1, Math.floor(width / 260)), rows = svg.dataset.keys ? Math.ceil(shown.length / columns) : 0;
  if (rows) shown.forEach((key, i) => {
    const group = element("g", { transform: `translate(${10 + (i % columns) * 260},${height + 14 + Math.floor(i / columns) * 18})` }, copy);
    const swatch = key.querySelector("svg");
    [...swatch.childNodes].forEach((node) => {
      const part = group.appendChild(node.cloneNode(true)), style = getComputedStyle(node);
      for (const k of ["stroke", "fill", "stroke-width", "stroke-dasharray"]) part.style.setProperty(k, style.getPropertyValue(k));
    });
    const text = element("text", { x: 52, y: 10, style: "font: 12px sans-serif" }, group);
    text.textContent = key.textContent;
  });
  copy.setAttribute("xmlns", SVG);
  copy.setAttribute("viewBox", `0 0 ${width} ${height + rows * 18 + (rows ? 10 : 0)}`);
  copy.setAttribute("width", width);
  copy.removeAttribute("style");
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([copy.outerHTML], { type: "image/svg+xml" }));
  link.download = name.toLowerCase().replace(/[^a-z0-9]+/g, "-") + ".svg";
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// Whole decades around positive numbers; never more than 20.
function decades(values) {
  const logs = values.filter((v) => v > 0).map(Math.log10);
  if (!logs.length) return [-1, 0];
  const high = Math.ceil(Math.max(...logs) + 1e-9), low = Math.floor(Math.min(...logs) + 1e-9);
  return [Math.max(Math.min(low, high - 1), high - 20), high];
}

function makeDiagram(panel, looks, parent) {
  const card = document.createElement("section");
  card.className = panel.is_wide ? "card across-all" : "card";
  let svg = null;
  heading(card, panel.title, () => svg);
  svg = element("svg", { class: "plot", role: "img", "aria-label": `${panel.title}. ${panel.caption}` }, card);
  svg.dataset.keys = "1";
  const said = card.appendChild(document.createElement("p"));
  said.className = "said";
  const notes = card.appendChild(document.createElement("ul"));
  notes.className = "notes";
  const caption = card.appendChild(document.createElement("p"));
  caption.className = "caption";
  caption.textContent = panel.caption;
  parent.appendChild(card);
  let spots = [], ring = null;

  function draw() {
    const width = Math.max(card.clientWidth - 30, 240), height = Math.round(panel.is_wide ? Math.min(520, Math.max(300, width * 0.55)) : Math.min(340, Math.max(240, width * 0.62)));
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.style.height = height + "px";
    svg.replaceChildren();
    spots = [];
    const shown = panel.lines.filter((line) => looks[line.method].is_shown);
    const points = shown.flatMap((line) => line.points);
    const onRail = panel.rail ? shown.flatMap((line) => line.failed) : [];
    const [left, top, right, bottom] = [70, panel.rail === "top" && onRail.length ? 30 : 10, width - (panel.rail === "right" && onRail.length ? 44 : 14), height - 46];
    const alongX = panel.rail === "top" ? onRail.map((f) => f[0]) : [], alongY = panel.rail === "right" ? onRail.map((f) => f[0]) : [];
    const [x0, x1] = decades([...points.map((p) => p[0]), ...alongX, ...panel.upright.map((l) => l[0])]);
    const across = panel.across.filter((l) => l[0] > 0);
    const [y0, y1] = decades([...points.map((p) => p[1]), ...alongY, ...across.map((l) => l[0])]);
    const x = (v) => left + ((Math.max(v > 0 ? Math.log10(v) : x0, x0) - x0) / (x1 - x0)) * (right - left);
    const y = (v) => bottom - ((Math.max(v > 0 ? Math.log10(v) : y0, y0) - y0) / (y1 - y0)) * (bottom - top);
    axis([x0, x1], right - left, (k) => x(10 ** k), (p, label) => {
      element("line", { class: label === null ? "minor" : "grid", x1: p, x2: p, y1: top, y2: bottom }, svg);
      if (label) element("text", { x: p, y: bottom + 20, "text-anchor": "middle" }, svg).textContent = label;
    });
    axis([y0, y1], (bottom - top) * 2, (k) => y(10 ** k), (p, label) => {
      element("line", { class: label === null ? "minor" : "grid", x1: left, x2: right, y1: p, y2: p }, svg);
      if (label) element("text", { x: left - 6, y: p + 4, "text-anchor": "end" }, svg).textContent = label;
    });
    element("rect", { class: "frame", x: left, y: top, width: right - left, height: bottom - top }, svg);
    element("text", { x: (left + right) / 2, y: height - 6, "text-anchor": "middle" }, svg).textContent = panel.axes[0];
    const name = element("text", { transform: `translate(14,${(top + bottom) / 2}) rotate(-90)`, "text-anchor": "middle" }, svg);
    name.textContent = panel.axes[1];
    for (const [v, label] of across) {
      element("line", { class: "level", x1: left, x2: right, y1: y(v), y2: y(v) }, svg);
      element("text", { class: "note", x: right - 6, y: y(v) + (y(v) < top + 16 ? 13 : -4), "text-anchor": "end" }, svg).textContent = label;
    }
    for (const [v, label] of panel.upright) {
      element("line", { class: "level", x1: x(v), x2: x(v), y1: top, y2: bottom }, svg);
      element("text", { class: "note", transform: `translate(${x(v) + (x(v) < left + 16 ? 12 : -4)},${bottom - 6}) rotate(-90)` }, svg).textContent = label;
    }
    if (onRail.length) rail({ left, top, right, bottom, width });
    shown.forEach((line) => {
      const look = looks[line.method], places = line.points.map((p) => [x(p[0]), y(p[1])]);
      const d = places.map((p, i) => `${i ? "L" : "M"}${p[0].toFixed(1)},${p[1].toFixed(1)}`).join("");
      if (d) element("path", { d, ...lineStyle(look, panel.is_plain) }, svg);
      places.forEach((p, i) => {
        if (!panel.is_plain || places.length < 3 || i % 4 === line.method % 4) mark(svg, look, p[0], p[1]);
        spots.push([p[0], p[1], line.points[i][2]]);
      });
      if (!panel.rail) return;
      line.failed.forEach(([v, text]) => {
        // side by side where several stop at one place
        const p = panel.rail === "top" ? [v > 0 ? x(v) : left + 6, top - 12] : [right + 20, v > 0 ? y(v) : bottom - 6];
        const taken = spots.filter((s) => s[3] && Math.abs(s[0] - p[0]) < 5 && Math.abs(s[1] - p[1]) < 7).length;
        p[panel.rail === "top" ? 1 : 0] += [0, -5, 5, -9, 9][taken % 5];
        mark(svg, look, p[0], p[1], CROSS);
        spots.push([p[0], p[1], text, true]);
      });
    });
    if (!points.length) element("text", { x: (left + right) / 2, y: (top + bottom) / 2, "text-anchor": "middle" }, svg).textContent = "no completed run is shown";
    ring = element("circle", { class: "chosen", r: 8, visibility: "hidden" }, svg);
    notes.replaceChildren();
    shown.filter((line) => line.note).forEach((line) => { notes.appendChild(document.createElement("li")).textContent = `${looks[line.method].name}: ${line.note}`; });
    notes.hidden = !notes.childNodes.length;
  }
  function axis([low, high], room, place, tick) {
    const every = Math.max(1, Math.ceil((high - low) / (room / 56)));
    for (let k = low; k <= high; k++) {
      const labelled = (k - low) % every === 0;
      tick(place(k), labelled ? (k === 0 ? "1" : `1e${k}`) : "");
      if (high - low <= 4 && k < high) for (const m of [2, 5]) tick(place(k + Math.log10(m)), null);
    }
  }
  function rail({ left, top, right, bottom, width }) {
    const box = panel.rail === "top" ? { x: left, y: 2, width: right - left, height: top - 4 } : { x: right + 6, y: top, width: width - right - 10, height: bottom - top };
    const band = element("rect", { class: "rail", ...box }, null);
    svg.insertBefore(band, svg.firstChild);
    const label = panel.rail === "top"
      ? element("text", { class: "note", x: left - 6, y: 17, "text-anchor": "end" }, svg)
      : element("text", { class: "note", x: width - 2, y: bottom + 20, "text-anchor": "end" }, svg);
    label.textContent = "failed";
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
    ring.setAttribute("visibility", best ? "visible" : "hidden");
    if (best) { ring.setAttribute("cx", best[0]); ring.setAttribute("cy", best[1]); }
  }
  svg.addEventListener("pointermove", say);
  svg.addEventListener("pointerdown", say);
  svg.addEventListener("pointerleave", () => { said.textContent = ""; ring.setAttribute("visibility", "hidden"); });
  return draw;
}

// Exponents of the errors over step and penalty; shades say the same, and x stands where a run stops.
function makeMap(map, parent) {
  const card = document.createElement("section");
  card.className = "card";
  let svg = null;
  heading(card, `Convergence: ${map.formulation}, ${map.precision}`, () => svg);
  svg = element("svg", { class: "plot", role: "img", "aria-label": map.caption }, card);
  const said = card.appendChild(document.createElement("p"));
  said.className = "said";
  const caption = card.appendChild(document.createElement("p"));
  caption.className = "caption";
  caption.textContent = map.caption;
  parent.appendChild(card);
  const [fewest, most] = [-12, 0];
  return function draw() {
    const width = Math.max(card.clientWidth - 30, 240), left = 62, rowHeight = 36;
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
        for (const node of [box, text]) {
          node.addEventListener("pointerenter", () => { said.textContent = words; });
          node.addEventListener("pointerdown", () => { said.textContent = words; });
        }
      });
    });
    const bottom = 6 + map.penalties.length * rowHeight;
    map.steps.forEach((step, j) => {
      element("text", { x: left + (j + 0.5) * wide, y: bottom + 16, "text-anchor": "middle" }, svg).textContent = step.toExponential(wide < 52 ? 0 : 1).replace("+", "");
    });
    element("text", { x: (left + width) / 2, y: bottom + 36, "text-anchor": "middle" }, svg).textContent = "step [s]";
    element("text", { transform: `translate(12,${bottom / 2}) rotate(-90)`, "text-anchor": "middle" }, svg).textContent = `penalty [${map.unit}]`;
  };
}

(function main() {
  const data = JSON.parse(document.getElementById("data").textContent), looks = data.methods;
  const panels = document.getElementById("panels"), maps = document.getElementById("maps");
  const redraws = data.panels.map((panel) => makeDiagram(panel, looks, panels));
  redraws.push(...data.maps.map((map) => makeMap(map, maps)));
  const redraw = () => redraws.forEach((draw) => draw());
  const keys = document.getElementById("keys"), buttons = looks.map((look) => {
    const key = keys.appendChild(document.createElement("button"));
    key.type = "button";
    const swatch = element("svg", { viewBox: "0 0 44 12", "aria-hidden": "true" }, key);
    element("path", { d: "M1,6H43", ...lineStyle(look) }, swatch);
    mark(swatch, look, 22, 6);
    key.append(look.name);
    key.addEventListener("click", () => { look.is_shown = !look.is_shown; refresh(); });
    return key;
  });
  const refresh = () => {
    looks.forEach((look, i) => buttons[i].setAttribute("aria-pressed", look.is_shown));
    redraw();
  };
  const groups = document.getElementById("groups");
  const group = (name, is) => {
    if (!looks.some(is)) return;
    const button = groups.appendChild(document.createElement("button"));
    button.type = "button";
    button.textContent = name;
    button.addEventListener("click", () => { looks.forEach((look) => { look.is_shown = is(look); }); refresh(); });
  };
  group("all", () => true);
  group("double precision", (look) => look.is_filled);
  group("single precision", (look) => !look.is_filled);
  group("fixed steps, double precision", (look) => look.is_filled && look.dash === 0);
  refresh();
  window.addEventListener("resize", redraw);
})();
