// Plots on a canvas: lines over time that differ by dash and marker as well as by colour. All share the window in time and the cursor.
const DASHES = [[], [8, 4], [2, 3], [10, 3, 2, 3], [14, 4], [5, 2, 1, 2, 1, 2]];
// Marks of lines: a disc, a square, triangles, crosses.
const MARKS = [
  (p, r) => p.arc(0, 0, r, 0, 7), (p, r) => p.rect(-r, -r, 2 * r, 2 * r), (p, r) => { p.moveTo(0, -1.3 * r); p.lineTo(1.2 * r, r); p.lineTo(-1.2 * r, r); p.closePath(); },
  (p, r) => { p.moveTo(0, -1.3 * r); p.lineTo(1.3 * r, 0); p.lineTo(0, 1.3 * r); p.lineTo(-1.3 * r, 0); p.closePath(); },
  (p, r) => { p.moveTo(-r, -r); p.lineTo(r, r); p.moveTo(-r, r); p.lineTo(r, -r); }, (p, r) => { p.moveTo(-r, 0); p.lineTo(r, 0); p.moveTo(0, -r); p.lineTo(0, r); },
];

function show(x) {
  if (x === undefined || !Number.isFinite(x)) return "none";
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

// The window in time of all plots, and the cursor above them.
function makeWindow([start, end]) {
  const listeners = [];
  const shared = {
    span: [start, end], cursor: null,
    listen: (f) => listeners.push(f),
    set(from, to) {
      const length = Math.min(end - start, Math.max(to - from, (end - start) * 1e-5)), low = Math.min(Math.max(from, start), end - length);
      shared.span = [low, low + length];
      listeners.forEach((f) => f());
    },
    reset: () => shared.set(start, end),
    point(t) { shared.cursor = t; listeners.forEach((f) => f()); },
  };
  return shared;
}

function makePlot(figure, panel, column, clock, shared) {
  const canvas = figure.querySelector("canvas"), legend = figure.querySelector(".legend"), pencil = canvas.getContext("2d");
  // values of logarithmic panels are exponents of ten already
  const lines = panel.lines.map((line) => ({ name: line.name, t: column(line.t), x: line.x && column(line.x, true), y: column(line.y, true), on: true }));
  const band = panel.band && { t: column(panel.band.t), low: column(panel.band.low, true), high: column(panel.band.high, true) };
  const edges = band ? [band.low, band.high].map((y) => ({ t: band.t, y, on: true })) : [];
  // one column over another: the window in time says which part of the curve is drawn
  const isCurve = Boolean(panel.across), abscissa = (line, k) => (line.x ? line.x[k] : line.t[k]);
  let log = panel.log, asked = false, area = null, drag = null, scales = null;
  const entries = lines.map((line, i) => {
    const button = legend.appendChild(document.createElement("button"));
    button.type = "button";
    button.className = "key";
    button.setAttribute("aria-pressed", "true");
    const swatch = button.appendChild(document.createElement("canvas"));
    const name = button.appendChild(document.createElement("span"));
    name.textContent = line.name;
    const value = button.appendChild(document.createElement("b"));
    button.addEventListener("click", () => { line.on = !line.on; button.setAttribute("aria-pressed", line.on); draw(); });
    return { swatch, value, i };
  });
  const when = legend.appendChild(document.createElement("span"));
  when.className = "when";
  const tools = figure.appendChild(document.createElement("div"));
  tools.className = "tools";
  const tool = (name, act, title, kind = "tool") => {
    const button = tools.appendChild(document.createElement("button"));
    Object.assign(button, { type: "button", textContent: name, title, className: kind });
    button.addEventListener("click", act);
    return button;
  };
  const file = (text, type, ending) => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(text instanceof Blob ? text : new Blob([text], { type }));
    link.download = `${panel.title.replace(/[^\p{L}\p{N}]+/gu, "-")}.${ending}`;
    link.click();
  };
  tool("SVG", () => file(svg(), "image/svg+xml", "svg"), "as a drawing", "save");
  tool("PNG", () => canvas.toBlob((blob) => file(blob, "image/png", "png")), "as a picture");
  tool("CSV", () => file(csv(), "text/csv", "csv"), "the points as drawn");
  const positive = !log && lines.every((line) => line.y.every((y) => !(y <= 0)));
  if (panel.log || positive) {
    const button = tool(log ? "linear" : "log", () => { log = !log; button.textContent = log ? "linear" : "log"; draw(); }, "axis of values");
    button.className = "scale";
  }

  const value = (y) => (panel.log === log ? y : log ? (y > 0 ? Math.log10(y) : NaN) : 10 ** y);
  const plain = (y) => (panel.log ? 10 ** y : y);
  // Least and largest of what the lines have in the window.
  function extent(of, all = lines) {
    let low = Infinity, high = -Infinity;
    const [t0, t1] = shared.span;
    for (const line of all) {
      if (!line.on || !line.t.length) continue;
      const from = before(line.t, t0), to = Math.min(before(line.t, t1) + 1, line.t.length - 1);
      for (let k = from; k <= to; k++) { const y = of(line, k); if (y < low) low = y; if (y > high) high = y; }
    }
    return [low, high];
  }
  function roomy([low, high]) {
    if (!(low <= high)) return [0, 1];
    const room = (high - low) * 0.06 || Math.abs(high) * 0.1 || 1;
    return [low - room, high + room];
  }
  // Range of the values in the window.
  function range() {
    const [low, high] = extent((line, k) => value(line.y[k]), [...lines, ...edges]);
    if (!(low <= high)) return [0, 1];
    if (log) { const top = Math.ceil(high + 1e-9); return [Math.min(Math.max(Math.floor(low), top - 16), top - 1), top]; }
    if (panel.steps && !panel.log) return [0, high + 0.5];
    return roomy([low, high]);
  }

  // Draws with a pencil of a canvas, or of an SVG.
  function paint(p, width, height, colour) {
    const [t0, t1] = shared.span, [low, high] = range();
    const [x0, x1] = isCurve ? roomy(extent(abscissa)) : [t0, t1];
    area = { left: 62, right: width - 10, top: 8, bottom: height - 36, t0, t1 };
    const x = (v) => area.left + ((v - x0) / (x1 - x0)) * (area.right - area.left);
    const y = (v) => area.bottom - ((Math.max(v, low) - low) / (high - low)) * (area.bottom - area.top);
    p.font = "12px system-ui, sans-serif";
    p.fillStyle = colour("soft"); p.strokeStyle = colour("grid"); p.lineWidth = 1;
    const skip = Math.ceil((high - low) / 7);
    const marks = log ? Array.from({ length: Math.round(high - low) + 1 }, (_, k) => low + k).filter((_, k) => k % skip === 0)
      : niceTicks(low, high, panel.steps ? Math.min(5, high) : 5).filter((v) => !panel.steps || panel.log || Number.isInteger(v));
    p.textAlign = "right";
    for (const v of marks) {
      p.beginPath(); p.moveTo(area.left, y(v)); p.lineTo(area.right, y(v)); p.stroke();
      p.fillText(log ? `1e${v}` : Math.abs(v) < (high - low) * 1e-9 ? "0" : show(v), area.left - 6, y(v) + 4);
    }
    p.textAlign = "center";
    for (const v of niceTicks(x0, x1, width < 420 ? 4 : 7)) {
      p.beginPath(); p.moveTo(x(v), area.top); p.lineTo(x(v), area.bottom); p.stroke();
      p.fillText(show(Math.abs(v) < (x1 - x0) * 1e-9 ? 0 : v), x(v), area.bottom + 16);
    }
    p.fillText(panel.across || "time [s]", (area.left + area.right) / 2, height - 4);
    p.strokeStyle = colour("rule");
    p.strokeRect(area.left, area.top, area.right - area.left, area.bottom - area.top);
    p.save();
    p.beginPath(); p.rect(area.left, area.top, area.right - area.left, area.bottom - area.top); p.clip();
    if (band) fillBand(p, x, y, colour);
    lines.forEach((line, i) => { if (line.on) trace(p, line, i, x, y, colour); });
    p.restore();
    if (lines.every((line) => line.y.every((v) => Number.isNaN(v)))) p.fillText(panel.log ? "zero throughout" : "no numbers to draw", (area.left + area.right) / 2, (area.top + area.bottom) / 2);
    return [x, y];
  }
  // Between the edges of the band; gaps are left out.
  function fillBand(p, x, y, colour) {
    const at = [...band.t.keys()].filter((k) => Number.isFinite(value(band.low[k])) && Number.isFinite(value(band.high[k])));
    p.beginPath();
    at.forEach((k, i) => (i ? p.lineTo(x(band.t[k]), y(value(band.high[k]))) : p.moveTo(x(band.t[k]), y(value(band.high[k])))));
    at.reverse().forEach((k) => p.lineTo(x(band.t[k]), y(value(band.low[k]))));
    p.closePath();
    p.fillStyle = colour("soft"); p.globalAlpha = 0.2; p.fill(); p.globalAlpha = 1;
  }
  function trace(p, line, i, x, y, colour) {
    p.strokeStyle = colour(`line-${i % 6}`); p.lineWidth = 1.7; p.setLineDash(DASHES[i % 6]);
    p.beginPath();
    const from = before(line.t, area.t0), to = Math.min(before(line.t, area.t1) + 1, line.t.length - 1);
    let gap = true, last = 0;
    for (let k = from; k <= to; k++) {
      const v = value(line.y[k]);
      if (Number.isNaN(v)) { gap = true; continue; }
      const px = x(abscissa(line, k)), py = y(v);
      if (gap) p.moveTo(px, py);
      else { if (panel.steps) p.lineTo(x(line.t[last]), py); p.lineTo(px, py); }
      gap = false; last = k;
    }
    p.stroke();
    p.setLineDash([]);
    if (lines.length < 2) return;
    // a marker at even distances, shifted per line so that equal curves stay visible
    for (let k = 0; k < 8 && line.t.length; k++) {
      const at = before(line.t, area.t0 + ((k + (i + 0.5) / lines.length) / 8) * (area.t1 - area.t0)), v = value(line.y[at]);
      if (!Number.isNaN(v)) mark(p, i, x(abscissa(line, at)), y(v));
    }
  }
  function mark(p, i, px, py) {
    p.save(); p.translate(px, py); p.beginPath(); MARKS[i % 6](p, 3.2); p.stroke(); p.restore();
  }

  function draw() {
    const width = canvas.clientWidth, height = canvas.clientHeight, ratio = devicePixelRatio || 1;
    if (!width || !height || !asked) return;
    canvas.width = width * ratio; canvas.height = height * ratio;
    pencil.setTransform(ratio, 0, 0, ratio, 0, 0);
    const style = getComputedStyle(document.documentElement), colour = (name) => style.getPropertyValue("--" + name).trim();
    const [x, y] = scales = paint(pencil, width, height, colour);
    const upright = (t, name, dash) => {
      if (t < area.t0 || t > area.t1) return;
      if (isCurve) {
        pencil.fillStyle = colour(name);
        for (const line of lines) if (line.on && line.t.length) { const k = nearest(line.t, t); pencil.beginPath(); pencil.arc(x(abscissa(line, k)), y(value(line.y[k])), 4.5, 0, 7); pencil.fill(); }
        return;
      }
      pencil.strokeStyle = colour(name); pencil.lineWidth = 1.3; pencil.setLineDash(dash);
      pencil.beginPath(); pencil.moveTo(x(t), area.top); pencil.lineTo(x(t), area.bottom); pencil.stroke();
      pencil.setLineDash([]);
    };
    upright(clock.now(), "accent", []);
    if (shared.cursor !== null) upright(shared.cursor, "soft", [3, 3]);
    if (drag?.zooms) { pencil.fillStyle = colour("accent"); pencil.globalAlpha = 0.15; pencil.fillRect(Math.min(drag.x, drag.to), area.top, Math.abs(drag.to - drag.x), area.bottom - area.top); pencil.globalAlpha = 1; }
    entries.forEach(({ swatch, i }) => {
      swatch.width = 34 * ratio; swatch.height = 12 * ratio;
      const p = swatch.getContext("2d");
      p.setTransform(ratio, 0, 0, ratio, 0, 0);
      p.strokeStyle = colour(`line-${i % 6}`); p.lineWidth = 1.7; p.setLineDash(DASHES[i % 6]);
      p.beginPath(); p.moveTo(1, 6); p.lineTo(33, 6); p.stroke();
      p.setLineDash([]);
      if (lines.length > 1) mark(p, i, 17, 6);
    });
    readout(shared.cursor ?? clock.now());
  }
  function readout(t) {
    when.textContent = `t = ${show(t)} s`;
    lines.forEach((line, i) => {
      if (!line.t.length) return;
      const k = nearest(line.t, t);
      entries[i].value.textContent = " = " + show(plain(line.y[k]));
    });
  }

  // on a curve, the time of the point that is nearest to the pointer
  function timeOnCurve(event) {
    const box = canvas.getBoundingClientRect(), [x, y] = scales, at = [event.clientX - box.left, event.clientY - box.top];
    let best = area.t0, least = Infinity;
    for (const line of lines) if (line.on) line.t.forEach((t, k) => {
      const d = Math.hypot(x(abscissa(line, k)) - at[0], y(value(line.y[k])) - at[1]);
      if (t >= area.t0 && t <= area.t1 && d < least) { least = d; best = t; }
    });
    return best;
  }
  const timeAt = (event) => isCurve ? timeOnCurve(event) : area.t0 + ((event.clientX - canvas.getBoundingClientRect().left - area.left) / (area.right - area.left)) * (area.t1 - area.t0);
  const placeOf = (event) => event.clientX - canvas.getBoundingClientRect().left;
  canvas.addEventListener("pointerdown", (event) => {
    if (!area || event.button) return;
    if (isCurve) { clock.seek(timeAt(event)); return; }
    drag = { x: placeOf(event), to: placeOf(event), t: timeAt(event), span: [...shared.span], zooms: false, pans: event.shiftKey || event.pointerType === "touch" };
    try { canvas.setPointerCapture(event.pointerId); } catch { /* it was let go already */ }
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!area) return;
    if (drag) {
      drag.to = placeOf(event);
      if (drag.pans) { const by = ((drag.x - drag.to) / (area.right - area.left)) * (drag.span[1] - drag.span[0]); shared.set(drag.span[0] + by, drag.span[1] + by); return; }
      drag.zooms = Math.abs(drag.to - drag.x) > 5;
    }
    shared.point(Math.min(area.t1, Math.max(area.t0, timeAt(event))));
  });
  canvas.addEventListener("pointerup", (event) => {
    if (!drag) return;
    const { zooms, t, pans, x } = drag;
    drag = null;
    if (zooms) { const to = timeAt(event); shared.set(Math.min(t, to), Math.max(t, to)); } else if (!pans || Math.abs(placeOf(event) - x) < 5) clock.seek(timeAt(event));
  });
  canvas.addEventListener("pointercancel", () => { drag = null; });
  canvas.addEventListener("pointerleave", () => { if (!drag) shared.point(null); });
  canvas.addEventListener("dblclick", () => shared.reset());
  // the wheel alone scrolls the page past a plot that was not clicked
  canvas.addEventListener("wheel", (event) => {
    if (!area || isCurve || !(event.ctrlKey || document.activeElement === canvas)) return;
    event.preventDefault();
    const t = timeAt(event), factor = Math.exp(0.0015 * event.deltaY), [a, b] = shared.span;
    shared.set(t - (t - a) * factor, t + (b - t) * factor);
  }, { passive: false });
  clock.listen(draw);
  shared.listen(draw);
  // plots that are not in sight wait
  new IntersectionObserver((seen) => { const is = seen.some((s) => s.isIntersecting); if (is && !asked) { asked = true; draw(); } else asked = asked && is; if (is) draw(); }, { rootMargin: "300px" }).observe(canvas);

  function csv() {
    const rows = [isCurve ? "line,t,x,y" : "line,t,value"];
    for (const line of lines) line.t.forEach((t, k) => rows.push(`${JSON.stringify(line.name)},${+t.toPrecision(9)},${line.x ? `${+line.x[k].toPrecision(6)},` : ""}${Number.isNaN(line.y[k]) ? "" : +plain(line.y[k]).toPrecision(6)}`));
    return rows.join("\n") + "\n";
  }
  // The same drawing as SVG: a pencil that writes elements.
  function svg() {
    const style = getComputedStyle(document.documentElement), colour = (name) => style.getPropertyValue("--" + name).trim(), width = 720, height = 360;
    const out = [];
    let d = "", dx = 0, dy = 0, dash = [];
    const n = (v) => v.toFixed(2), text = (s) => String(s).replace(/&/g, "&amp;").replace(/</g, "&lt;");
    const pen = {
      beginPath() { d = ""; }, moveTo(x, y) { d += `M${n(x + dx)},${n(y + dy)}`; }, lineTo(x, y) { d += `L${n(x + dx)},${n(y + dy)}`; }, closePath() { d += "Z"; },
      arc(x, y, r) { d += `M${n(x + dx - r)},${n(y + dy)}a${r},${r} 0 1,0 ${2 * r},0a${r},${r} 0 1,0 ${-2 * r},0`; },
      rect(x, y, w, h) { d += `M${n(x + dx)},${n(y + dy)}h${n(w)}v${n(h)}h${n(-w)}Z`; },
      stroke() { out.push(`<path d="${d}" fill="none" stroke="${pen.strokeStyle}" stroke-width="${pen.lineWidth}"${dash.length ? ` stroke-dasharray="${dash.join(" ")}"` : ""}/>`); },
      fill() { out.push(`<path d="${d}" fill="${pen.fillStyle}" fill-opacity="${pen.globalAlpha}"/>`); },
      strokeRect(x, y, w, h) { d = ""; pen.rect(x, y, w, h); pen.stroke(); },
      fillText(s, x, y) { out.push(`<text x="${n(x)}" y="${n(y)}" font-size="12" font-family="sans-serif" fill="${pen.fillStyle}" text-anchor="${{ right: "end", center: "middle" }[pen.textAlign]}">${text(s)}</text>`); },
      setLineDash(x) { dash = x; }, translate(x, y) { dx = x; dy = y; }, save() {}, restore() { dx = dy = 0; }, clip() { d = ""; },
    };
    paint(pen, width, height, colour);
    draw();
    return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}"><title>${text(panel.title)} [${text(panel.unit)}]</title><rect width="${width}" height="${height}" fill="${colour("card")}"/>${out.join("")}</svg>`;
  }
  return { figure, panel, draw, title: `${panel.title} ${lines.map((line) => line.name).join(" ")}`.toLowerCase() };
}
