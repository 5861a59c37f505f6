// The same motion as lines on a plain canvas, where the browser has no WebGL.
function makeLines(motion, clock, section) {
  const canvas = section.querySelector("canvas"), stage = section.querySelector(".stage"), pencil = canvas.getContext("2d");
  const spatial = motion.dimension === 3, up = !spatial ? [0, 1, 0] : Math.hypot(...motion.up) > 0 ? vec.unit(motion.up) : [0, 0, 1];
  const ahead = Math.abs(up[0]) > 0.9 ? [0, 1, 0] : vec.unit(vec.add([1, 0, 0], up, -up[0])), left = vec.cross(up, ahead);
  const angles = { space: [-0.9, 0.4], side: [0, 0], front: [-Math.PI / 2, 0], rear: [Math.PI / 2, 0], top: [0, 1.57] };
  let forceScale = 1;
  let [yaw, pitch] = spatial ? angles.space : [0, 0], zoom = 1, followed = null;
  section.querySelector(".note").textContent = "This browser has no WebGL: the mechanism is drawn as lines.";

  // A shape as lines of places on its body.
  function circle(at, axis, radius) {
    const [a, b] = vec.across(axis);
    return Array.from({ length: 25 }, (_, i) => { const c = (2 * Math.PI * i) / 24; return vec.add(vec.add(at, a, radius * Math.cos(c)), b, radius * Math.sin(c)); });
  }
  function outline(s) {
    const mark = 0.02 * motion.length;
    if (s.form === "mesh") return meshEdges(s, 200);
    if (s.from) return [[s.from, s.to]];
    if (s.form === "polygon") return [[...s.points, s.points[0]]];
    if (s.form === "wheel") return [circle(s.at, s.axis, s.radius), [s.at, vec.add(s.at, vec.across(s.axis)[0], s.radius)]];
    if (s.form === "ball") return [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => circle(s.at, axis, s.radius));
    if (s.form === "rail") { const [low, high] = railReach(motion, s); return [[vec.add(s.at, s.axis, low), vec.add(s.at, s.axis, high)]]; }
    if (s.form === "box") {
      const corner = (i, j, k) => [i, j, k].reduce((p, sign, d) => vec.add(p, s.axes[d], sign * s.half[d]), s.at), out = [];
      for (const a of [-1, 1]) for (const b of [-1, 1]) out.push([corner(a, b, -1), corner(a, b, 1)], [corner(a, -1, b), corner(a, 1, b)], [corner(-1, a, b), corner(1, a, b)]);
      return out;
    }
    if (s.form === "support") return [[s.at, vec.add(s.at, up, -3 * mark)], circle(vec.add(s.at, up, -3 * mark), up, mark)];
    return s.at && s.form !== "plane" ? [circle(s.at, s.axis || up, mark / 2)] : [];
  }
  const shapes = motion.shapes.map((s) => ({ body: s.body, lines: outline(s), thick: s.form === "mesh" ? 1 : s.body === null ? 1.5 : 2.5 }));
  const heaviest = motion.bodies.reduce((best, body, i) => (body.mass > motion.bodies[best].mass ? i : best), 0);
  let low, high;
  function extents() {
    low = [1 / 0, 1 / 0, 1 / 0]; high = low.map((x) => -x);
    for (let k = 0; k < motion.times.length; k += Math.max(1, Math.floor(motion.times.length / 40))) {
      const pose = motion.at(motion.times[k]), origin = followed === null ? [0, 0, 0] : [...pose.slice(7 * followed, 7 * followed + 3)];
      for (const { body, lines } of shapes) if (body !== null || followed === null) for (const p of lines.flat()) vec.add(motion.point(pose, body, p), origin, -1).forEach((x, i) => { low[i] = Math.min(low[i], x); high[i] = Math.max(high[i], x); });
    }
  }
  const path = motion.path(heaviest, [0, 0, 0], 100);
  if (Math.max(...path.map((p) => Math.hypot(...vec.add(p, path[0], -1)))) > 2 * motion.length) followed = heaviest;
  extents();

  function draw() {
    const width = stage.clientWidth, height = stage.clientHeight, ratio = devicePixelRatio || 1;
    if (!width || !height) return;
    canvas.width = width * ratio; canvas.height = height * ratio;
    pencil.setTransform(ratio, 0, 0, ratio, 0, 0);
    const style = getComputedStyle(document.documentElement), pose = motion.at(clock.now());
    const origin = followed === null ? [0, 0, 0] : [...pose.slice(7 * followed, 7 * followed + 3)];
    const middle = vec.add(low.map((x, i) => (x + high[i]) / 2), origin), d = vec.add(high, low, -1), sin = Math.sin(yaw), cos = Math.cos(yaw);
    const scale = zoom * (spatial ? Math.min(width, height) / (Math.hypot(...d) || 1) : 0.9 * Math.min(width / (d[0] || 1e-9), height / (d[1] || 1e-9)));
    const place = (p) => {
      const q = vec.add(p, middle, -1);
      if (!spatial) return [width / 2 + q[0] * scale, height / 2 - q[1] * scale];
      const a = vec.dot(q, ahead), b = vec.dot(q, left), depth = -sin * a + cos * b;
      return [width / 2 + (cos * a + sin * b) * scale, height / 2 - (vec.dot(q, up) * Math.cos(pitch) + depth * Math.sin(pitch)) * scale];
    };
    const stroke = (points, colour, thick) => {
      pencil.strokeStyle = colour; pencil.lineWidth = thick; pencil.lineJoin = pencil.lineCap = "round";
      pencil.beginPath();
      for (const p of points) pencil.lineTo(...place(p));
      pencil.stroke();
    };
    const soft = style.getPropertyValue("--soft").trim(), rule = style.getPropertyValue("--rule").trim();
    if (motion.road) motion.road.sides.forEach((sides, s) => sides.forEach((y) => {
      const shift = motion.road.start - motion.road.speed * clock.now();
      stroke([...motion.road.heights[s]].map((h, i) => (spatial ? [shift + i * motion.road.spacing, y, h] : [shift + i * motion.road.spacing, h, 0])), rule, 2);
    }));
    for (const { body, lines, thick } of shapes) {
      const colour = body === null ? soft : `hsl(${360 * bodyHue(body)} 55% 50%)`;
      for (const line of lines) stroke(line.map((p) => motion.point(pose, body, p)), colour, thick);
    }
    for (const force of motion.forces) motion.load(force, clock.now()).forEach((value, i) => {
      const from = motion.point(pose, force.place.body, force.place.at);
      if (forceScale && Math.hypot(...value) > 0 && (spatial || i === 0)) stroke([from, vec.add(from, value, (forceScale * 0.25 * motion.length) / motion.largest[i])], i ? "#8e5bd0" : "#d6453d", 2.5);
    });
    for (const line of motion.lines) stroke(line.places.map((p) => motion.point(pose, p.body, p.at)), soft, 1.5);
  }
  let held = null;
  canvas.addEventListener("pointerdown", (event) => { held = [event.clientX, event.clientY]; canvas.setPointerCapture(event.pointerId); });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { held = null; });
  canvas.addEventListener("pointermove", (event) => {
    if (!held || !spatial) return;
    yaw -= (event.clientX - held[0]) * 0.01;
    pitch = Math.min(1.57, Math.max(-1.57, pitch + (event.clientY - held[1]) * 0.01));
    held = [event.clientX, event.clientY];
    draw();
  });
  canvas.addEventListener("wheel", (event) => { zoom *= Math.exp(-0.001 * event.deltaY); event.preventDefault(); draw(); }, { passive: false });
  new ResizeObserver(draw).observe(stage);
  clock.listen(draw);
  return {
    kind: "lines", canvas, draw, theme: draw,
    fit() { zoom = 1; draw(); },
    setSide(name) { if (spatial && angles[name]) [yaw, pitch] = angles[name]; zoom = 1; draw(); },
    followed: () => followed,
    setFollowed(body) { followed = body; extents(); draw(); },
    setNames() {},
    setForces(scale) { forceScale = scale; draw(); },
    picture(take) { draw(); canvas.toBlob(take); },
  };
}
