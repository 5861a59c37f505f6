// The motion in three dimensions: camera, sides, a body that is followed, names, pictures.
function makeView(T, motion, clock, section) {
  const canvas = section.querySelector("canvas"), labels = section.querySelector(".labels"), stage = section.querySelector(".stage");
  const renderer = new T.WebGLRenderer({ canvas, antialias: true });
  const planar = motion.dimension === 2, scene = new T.Scene(), shapes = makeShapes(T, motion);
  const camera = planar ? new T.OrthographicCamera(-1, 1, 1, -1, 0.01, 100) : new T.PerspectiveCamera(32, 1, 0.01, 100);
  const up = planar ? [0, 1, 0] : Math.hypot(...motion.up) > 0 ? vec.unit(motion.up) : [0, 0, 1];
  camera.up.set(...up);
  const sun = new T.DirectionalLight(0xffffff, 1.7);
  scene.add(shapes.root, new T.HemisphereLight(0xffffff, 0x8a8f96, 1.7), sun);
  const controls = new T.OrbitControls(camera, canvas);
  controls.enableRotate = !planar;
  controls.screenSpacePanning = true;
  if (planar) { controls.mouseButtons.LEFT = 2; controls.touches.ONE = 1; }

  // Boxes of all places over the whole run, and about a body that is followed; sizes of shapes are added.
  const size = motion.shapes.filter((s) => s.form !== "mesh").map((s) => [s.body, shapeReach(s)]);
  const boxes = motion.shapes.filter((s) => s.form === "mesh").map((s) => [s.body, meshBox(s)]);
  function range(about) {
    const low = [1 / 0, 1 / 0, 1 / 0], high = low.map((x) => -x), take = (p, r) => p.forEach((x, i) => { low[i] = Math.min(low[i], x - r); high[i] = Math.max(high[i], x + r); });
    for (let k = 0; k < motion.times.length; k += Math.max(1, Math.floor(motion.times.length / 60))) {
      const pose = motion.at(motion.times[k]), origin = about === null ? [0, 0, 0] : [...pose.slice(7 * about, 7 * about + 3)];
      for (const [body, r] of size) {
        if (body === null) continue;
        take(vec.add([...pose.slice(7 * body, 7 * body + 3)], origin, -1), r);
      }
      for (const [body, corners] of boxes) if (body !== null || about === null) for (const p of corners) take(vec.add(motion.point(pose, body, p), origin, -1), 0);
      for (const line of about === null ? motion.lines : []) for (const p of line.places) take(motion.point(pose, p.body, p.at), 0);
    }
    if (about === null) motion.shapes.forEach((s) => { if (s.body === null && s.at && s.form !== "plane" && s.form !== "mesh") take(s.at, 0.08 * motion.length); });
    return low[0] <= high[0] ? [low, high] : [[-1, -1, -1], [1, 1, 1]];
  }
  const travels = (b) => {
    const path = motion.path(b, [0, 0, 0], 200), [low, high] = [Math.min, Math.max].map((f) => [0, 1, 2].map((i) => f(...path.map((p) => p[i]))));
    return Math.hypot(...vec.add(high, low, -1)) > 2 * motion.length;
  };
  const heaviest = motion.bodies.reduce((best, body, i) => (body.mass > motion.bodies[best].mass ? i : best), 0);
  let followed = travels(heaviest) ? heaviest : null, side = planar ? "front" : "space", anchor = [0, 0, 0];

  // Directions from the target to the camera: across the direction of travel, x, for vehicles.
  const forward = vec.unit(vec.add([1, 0, 0], up, -vec.dot([1, 0, 0], up))), ahead = Math.abs(up[0]) > 0.9 ? [0, 1, 0] : forward, left = vec.cross(up, ahead);
  const sides = {
    side: left.map((x) => -x), front: ahead, rear: ahead.map((x) => -x), top: vec.add(up, ahead, -1e-3),
    space: vec.add(vec.add(left.map((x) => -0.8 * x), ahead, 0.6), up, 0.42),
  };
  function fit() {
    const [low, high] = range(followed), middle = low.map((x, i) => (x + high[i]) / 2);
    const pose = motion.at(clock.now());
    anchor = followed === null ? [0, 0, 0] : [...pose.slice(7 * followed, 7 * followed + 3)];
    const target = vec.add(middle, anchor);
    controls.target.set(...target);
    const extent = high.map((x, i) => x - low[i]), aspect = stage.clientWidth / stage.clientHeight || 1;
    const direction = planar ? [0, 0, 1] : vec.unit(sides[side] || sides.space);
    // what the box takes up across the direction of sight
    const right = vec.unit(vec.cross(up, direction)), over = vec.cross(direction, right);
    const seen = (d) => extent.reduce((sum, x, i) => sum + Math.abs(d[i]) * x, 0);
    const [w, h, depth] = [right, over, direction].map(seen), reach = Math.hypot(...extent) || 1;
    let distance;
    if (planar) {
      const half = 0.56 * Math.max(h, w / aspect, 1e-3 * reach);
      Object.assign(camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half, zoom: 1 });
      distance = 4 * reach;
    } else {
      const half = 0.5 * Math.max(h, w / aspect), tan = Math.tan((camera.fov * Math.PI) / 360);
      distance = (1.06 * half) / tan + 0.5 * depth;
      distance = Math.max(distance, 0.3 * reach);
    }
    camera.position.set(...vec.add(target, direction, distance));
    camera.near = distance / 500; camera.far = distance * 60 + 100 * reach;
    camera.updateProjectionMatrix();
    controls.update();
    draw();
  }
  function follow(t) {
    if (followed === null) return;
    const pose = motion.at(t), to = [...pose.slice(7 * followed, 7 * followed + 3)];
    const move = vec.add(to, anchor, -1);
    anchor = to;
    controls.target.add(new T.Vector3(...move));
    camera.position.add(new T.Vector3(...move));
    camera.updateMatrixWorld();
  }

  let names = null;
  function showNames(on) {
    labels.replaceChildren();
    names = on ? [...motion.bodies.map((b, i) => ({ name: b.name, body: i, at: [0, 0, 0] })), ...motion.joints] .map((label) => {
      const node = labels.appendChild(document.createElement("span"));
      node.textContent = label.name;
      if (label.mass === undefined && motion.joints.includes(label)) node.className = "joint";
      return { ...label, node };
    }) : null;
    draw();
  }
  function placeNames(pose) {
    const p = new T.Vector3();
    for (const { node, body, at } of names) {
      p.set(...motion.point(pose, body, at)).project(camera);
      node.hidden = Math.abs(p.x) > 1 || Math.abs(p.y) > 1 || p.z > 1;
      node.style.transform = `translate(${((p.x + 1) / 2) * stage.clientWidth}px, ${((1 - p.y) / 2) * stage.clientHeight}px)`;
    }
  }

  function draw() {
    const width = stage.clientWidth, height = stage.clientHeight;
    if (!width || !height) return;
    const t = clock.now(), pose = motion.at(t);
    shapes.update(pose, t);
    sun.position.copy(camera.position).sub(controls.target).add(new T.Vector3(...up.map((x) => x * camera.position.distanceTo(controls.target))));
    renderer.render(scene, camera);
    if (names) placeNames(pose);
    canvas.dataset.calls = renderer.info.render.calls;
    canvas.dataset.triangles = renderer.info.render.triangles;
  }
  function resize() {
    const width = stage.clientWidth, height = stage.clientHeight;
    if (!width || !height) return;
    renderer.setPixelRatio(Math.min(2, devicePixelRatio || 1));
    renderer.setSize(width, height, false);
    if (planar) { const half = camera.top; Object.assign(camera, { left: (-half * width) / height, right: (half * width) / height }); } else camera.aspect = width / height;
    camera.updateProjectionMatrix();
    draw();
  }
  function theme() {
    const style = getComputedStyle(document.documentElement), colour = (name) => style.getPropertyValue("--" + name).trim();
    scene.background = new T.Color(colour("stage"));
    shapes.theme(colour);
    draw();
  }

  // a click names a body and marks its plots
  const ray = new T.Raycaster(), note = section.querySelector(".note");
  let pressed = null;
  canvas.addEventListener("pointerdown", (event) => { pressed = [event.clientX, event.clientY]; });
  canvas.addEventListener("pointerup", (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
    const box = canvas.getBoundingClientRect();
    ray.setFromCamera(new T.Vector2((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height), camera);
    let hit = ray.intersectObject(shapes.root, true).map((h) => h.object).find((object) => object.isMesh);
    while (hit && hit.userData.body === undefined) hit = hit.parent;
    const body = hit ? motion.bodies[hit.userData.body] : null;
    note.textContent = body ? `${body.name}: ${show(body.mass)} kg` : "";
  });
  controls.addEventListener("change", draw);
  canvas.addEventListener("webglcontextrestored", draw);
  new ResizeObserver(resize).observe(stage);
  clock.listen((t) => { follow(t); draw(); });
  resize();
  theme();
  return {
    kind: "three", canvas, draw, theme, fit,
    setSide(name) { if (sides[name]) side = name; fit(); },
    followed: () => followed,
    setFollowed(body) { followed = body; fit(); },
    setNames: showNames,
    setForces(scale) { shapes.setForces(scale); draw(); },
    // drawn in the same task, so that the canvas still has it
    picture(take) { draw(); canvas.toBlob(take); },
  };
}

// How far a shape reaches from the centre of its body.
function shapeReach(s) {
  if (s.form === "box") return 0.7 * Math.hypot(...s.half);
  const far = Math.max(0, ...[s.at, s.from, s.to, ...(s.points || [])].filter(Boolean).map((p) => Math.hypot(...p)));
  return far + (s.form === "rail" || s.form === "pin" ? 0 : s.radius || 0);
}
