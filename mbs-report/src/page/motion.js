// The stick figure: planar scenes as they are, spatial scenes by orthographic projection.
function makeMotion(motion, clock) {
  const stage = document.getElementById("stage"), pencil = stage.getContext("2d");
  const spatial = motion.dimension === 3, n = motion.dimension;
  // numbers that are not finite come as null: they must not be drawn at zero
  motion.frames = motion.frames.map((frame) => frame.map((x) => (x === null ? NaN : x)));
  const home = { yaw: -0.6, pitch: 0.35 };
  let view = { ...home };

  // axes of the picture: up against gravity, the others across it
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const unit = (a) => { const s = Math.hypot(...a); return s > 0 ? a.map((x) => x / s) : [0, 0, 1]; };
  const up = unit(motion.up);
  const first = unit(cross(cross(up, Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0]), up));
  const second = cross(up, first);

  function project(p) {
    if (!spatial) return [p[0], p[1]];
    const a = dot(p, first), b = dot(p, second), c = dot(p, up);
    const sin = Math.sin(view.yaw), cos = Math.cos(view.yaw);
    const depth = -sin * a + cos * b;
    return [cos * a + sin * b, c * Math.cos(view.pitch) + depth * Math.sin(view.pitch)];
  }
  const point = (frame, i) => frame.slice(i * n, i * n + n);

  // box of all positions: in the plane as it is, in space as a ball so that turning does not zoom
  const low = Array(n).fill(Infinity), high = Array(n).fill(-Infinity);
  const include = (p) => p.forEach((x, k) => {
    if (Number.isFinite(x) && k < n) { low[k] = Math.min(low[k], x); high[k] = Math.max(high[k], x); }
  });
  motion.frames.forEach((frame) => { for (let i = 0; i * n < frame.length; i++) include(point(frame, i)); });
  motion.ground.forEach(include);
  const center = low.map((x, k) => (x <= high[k] ? (x + high[k]) / 2 : 0));
  const extent = low.map((x, k) => Math.max(high[k] - x, 0) || 0);
  let reach = 0;
  const reaches = (p) => { const r = Math.hypot(...p.map((x, k) => x - center[k])); if (r > reach) reach = r; };
  motion.frames.forEach((frame) => { for (let i = 0; i * n < frame.length; i++) reaches(point(frame, i)); });
  motion.ground.forEach((p) => reaches(p.slice(0, n)));

  function draw(t) {
    const ratio = window.devicePixelRatio || 1, width = stage.clientWidth, height = stage.clientHeight;
    if (!width) return;
    stage.width = width * ratio; stage.height = height * ratio;
    pencil.scale(ratio, ratio);
    const colours = getComputedStyle(document.documentElement);
    const colour = (name) => colours.getPropertyValue("--" + name).trim();
    const ball = 2 * reach || 1, flat = 1e-9 + ball * 1e-3;
    const [w, h] = spatial ? [ball, ball] : [Math.max(extent[0], flat), Math.max(extent[1], flat)];
    const scale = Math.min((width - 70) / w, (height - 70) / h);
    const [cx, cy] = project(center);
    const place = (p) => {
      const [a, b] = project(p);
      return [width / 2 + (a - cx) * scale, height / 2 - (b - cy) * scale];
    };
    const k = before(motion.t, t), frame = motion.frames[k], next = motion.frames[Math.min(k + 1, motion.t.length - 1)];
    const length = (motion.t[Math.min(k + 1, motion.t.length - 1)] - motion.t[k]) || 1;
    const part = Math.min(1, Math.max(0, (t - motion.t[k]) / length));
    const position = frame.map((x, i) => x + (next[i] - x) * part);

    motion.traces.forEach(([, i], at) => {
      pencil.lineWidth = 1.2;
      pencil.strokeStyle = colour(`line-${(motion.bodies.length + at) % 6}`);
      for (const [from, to, strength] of [[0, motion.t.length - 1, 0.25], [0, k, 0.9]]) {
        pencil.globalAlpha = strength;
        pencil.beginPath();
        for (let j = from; j <= to; j++) pencil.lineTo(...place(point(motion.frames[j], i)));
        if (to === k) pencil.lineTo(...place(point(position, i)));
        pencil.stroke();
      }
      pencil.globalAlpha = 1;
    });
    motion.rails.forEach(([p, d]) => {
      const s = (2 * ball) / (Math.hypot(...d) || 1), end = (sign) => place(p.slice(0, n).map((x, k) => x + sign * s * d[k]));
      pencil.strokeStyle = colour("rule"); pencil.lineWidth = 5;
      pencil.beginPath(); pencil.moveTo(...end(-1)); pencil.lineTo(...end(1)); pencil.stroke();
    });
    motion.ground.forEach((p) => support(place(p.slice(0, n)), colour("soft")));
    motion.bodies.forEach(([, chains], at) => {
      pencil.strokeStyle = pencil.fillStyle = colour(`line-${at % 6}`);
      pencil.lineJoin = pencil.lineCap = "round";
      for (const chain of chains) {
        // short links have small dots, so that a long chain stays a chain
        const places = chain.map((i) => place(point(position, i)));
        const longest = Math.max(...places.slice(1).map((p, k) => Math.hypot(p[0] - places[k][0], p[1] - places[k][1])));
        const dot = chain.length > 1 ? Math.min(4, Math.max(1.6, 0.3 * longest)) : 6;
        pencil.lineWidth = Math.min(4, 1.25 * dot);
        pencil.setLineDash(DASHES[at % 6].split(" ").filter(Boolean).map((d) => d * 1.6));
        pencil.beginPath();
        for (const p of places) pencil.lineTo(...p);
        pencil.stroke();
        pencil.setLineDash([]);
        for (const p of places) {
          pencil.beginPath();
          pencil.arc(...p, dot, 0, 7);
          pencil.fill();
        }
      }
    });
    ruler(width, height, scale, colour("soft"));
    if (spatial) triad(height, colour("soft"));
  }

  // a fixed point: a triangle on a hatched line
  function support([a, b], colour) {
    pencil.strokeStyle = colour; pencil.lineWidth = 1.4;
    pencil.beginPath();
    pencil.moveTo(a, b); pencil.lineTo(a - 8, b + 12); pencil.lineTo(a + 8, b + 12); pencil.closePath();
    for (let i = -2; i <= 2; i++) { pencil.moveTo(a + 4 * i + 2, b + 12); pencil.lineTo(a + 4 * i - 2, b + 17); }
    pencil.stroke();
  }
  function ruler(width, height, scale, colour) {
    const length = 10 ** Math.floor(Math.log10((width * 0.3) / scale));
    const pixels = length * scale;
    pencil.strokeStyle = pencil.fillStyle = colour; pencil.lineWidth = 1;
    pencil.beginPath();
    pencil.moveTo(width - 12 - pixels, height - 14); pencil.lineTo(width - 12 - pixels, height - 10);
    pencil.lineTo(width - 12, height - 10); pencil.lineTo(width - 12, height - 14);
    pencil.stroke();
    pencil.font = "12px system-ui, sans-serif"; pencil.textAlign = "right";
    pencil.fillText(`${show(length)} m`, width - 12, height - 18);
  }
  function triad(height, colour) {
    pencil.strokeStyle = pencil.fillStyle = colour; pencil.lineWidth = 1; pencil.textAlign = "center";
    [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((axis, i) => {
      const [a, b] = project(axis);
      pencil.beginPath(); pencil.moveTo(40, height - 40); pencil.lineTo(40 + 24 * a, height - 40 - 24 * b); pencil.stroke();
      pencil.fillText("xyz"[i], 40 + 32 * a, height - 36 - 32 * b);
    });
  }

  const cast = document.getElementById("cast");
  motion.bodies.forEach(([name], i) => legendEntry(cast, i, name, false));
  motion.traces.forEach(([name], i) => legendEntry(cast, 0, "", false).parentNode.replaceChildren(...path(motion.bodies.length + i, name)));
  function path(i, name) {
    const swatch = element("svg", { viewBox: "0 0 34 12", "aria-hidden": "true" });
    element("path", { d: "M1,9Q12,-3 17,6T33,4", style: `stroke: var(--line-${i % 6}); stroke-width: 1.2` }, swatch);
    return [swatch, `path of ${name}`];
  }
  document.getElementById("motion-caption").textContent =
    "The mechanism as lines between its points" +
    (motion.ground.length ? "; triangles are fixed to the ground" : "") +
    (motion.rails.length ? "; grey bars are fixed guides." : ".") +
    (motion.traces.length ? " Faint lines are paths over the whole run, strong ones up to now." : "") +
    (spatial ? " Drag to turn; the picture has no perspective." : "");
  if (spatial) turning();
  function turning() {
    stage.classList.add("turns");
    let held = null;
    stage.addEventListener("pointerdown", (event) => { held = [event.clientX, event.clientY]; stage.setPointerCapture(event.pointerId); });
    stage.addEventListener("pointerup", () => { held = null; });
    stage.addEventListener("pointercancel", () => { held = null; });
    stage.addEventListener("pointermove", (event) => {
      if (!held) return;
      view.yaw -= (event.clientX - held[0]) * 0.01;
      view.pitch = Math.min(1.57, Math.max(-1.57, view.pitch + (event.clientY - held[1]) * 0.01));
      held = [event.clientX, event.clientY];
      draw(clock.now());
    });
    const reset = document.getElementById("reset");
    reset.hidden = false;
    reset.addEventListener("click", () => { view = { ...home }; draw(clock.now()); });
  }
  clock.listen(draw);
  return () => draw(clock.now());
}
