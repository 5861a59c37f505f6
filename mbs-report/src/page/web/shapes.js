// The shapes of bodies, joints, effects and the road as meshes of three.js (T).
function bodyHue(i) { return (0.58 + 0.618 * i) % 1; }

function makeShapes(T, motion) {
  const L = motion.length || 1, root = new T.Group(), planar = motion.dimension === 2;
  const groups = motion.bodies.map((body, i) => { const g = new T.Group(); g.name = body.name; g.userData.body = i; root.add(g); return g; });
  const ground = new T.Group();
  root.add(ground);
  const dark = new T.MeshLambertMaterial({ color: 0x4a525c }), steel = new T.MeshLambertMaterial({ color: 0x9aa4af });
  const rubber = new T.MeshLambertMaterial({ color: 0x2b2f34, transparent: true, opacity: 0.8 });
  const themed = { mark: new T.MeshLambertMaterial(), road: new T.MeshLambertMaterial({ side: T.DoubleSide }), thin: new T.LineBasicMaterial() };
  const paints = motion.bodies.map((_, i) => [1, 0.35].map((opacity) => {
    const color = new T.Color().setHSL(bodyHue(i), 0.5, 0.55);
    return new T.MeshLambertMaterial({ color, opacity, transparent: opacity < 1, depthWrite: opacity === 1, side: T.DoubleSide });
  }));
  const up = new T.Vector3(0, 1, 0), V = (p) => new T.Vector3(...p);

  function put(group, geometry, material, at) {
    const mesh = new T.Mesh(geometry, material);
    if (at) mesh.position.copy(V(at));
    group.add(mesh);
    return mesh;
  }
  // A mesh whose own y axis goes from one place to the other.
  function between(group, geometry, material, from, to) {
    const mesh = put(group, geometry, material, from.map((x, i) => (x + to[i]) / 2));
    mesh.quaternion.setFromUnitVectors(up, V(vec.unit(vec.add(to, from, -1))));
    return mesh;
  }
  const distance = (a, b) => Math.hypot(...vec.add(a, b, -1));
  function bar(group, from, to, radius, material) {
    return between(group, new T.CylinderGeometry(radius, radius, distance(from, to) || radius, 14), material, from, to);
  }
  // A piece of an axis about a place.
  const about = (at, axis, half) => [vec.add(at, axis, -half), vec.add(at, axis, half)];

  const draw = {
    rod: (g, s, paint) => bar(g, s.from, s.to, s.radius, paint[0]),
    stroke: (g, s, paint) => bar(g, s.from, s.to, 0.008 * L, paint[0]),
    ball(g, s, paint) {
      put(g, new T.SphereGeometry(s.radius, 24, 16), paint[0], s.at);
      if (s.turns) for (const a of [[1, 0, 0], [0, 1, 0], [0, 0, 1]]) spots(g, s.at, a, s.radius);
    },
    box(g, s, paint) {
      const geometry = new T.BoxGeometry(...s.half.map((a) => 2 * a));
      const [x, y, z] = s.axes, right = vec.dot(vec.cross(x, y), z) > 0 ? z : z.map((c) => -c);
      for (const mesh of [new T.Mesh(geometry, paint[s.is_clear ? 1 : 0]), new T.LineSegments(new T.EdgesGeometry(geometry), edge(g))]) {
        mesh.quaternion.setFromRotationMatrix(frame(x, y, right));
        mesh.position.set(...s.at);
        g.add(mesh);
      }
    },
    capsule: (g, s, paint) => between(g, new T.CapsuleGeometry(s.radius, distance(s.from, s.to), 8, 20), paint[s.is_clear ? 1 : 0], s.from, s.to),
    polygon(g, s, paint, i) {
      const flat = [];
      for (let k = 1; k + 1 < s.points.length; k++) flat.push(...s.points[0], ...s.points[k], ...s.points[k + 1]);
      const geometry = new T.BufferGeometry();
      geometry.setAttribute("position", new T.BufferAttribute(new Float32Array(flat), 3));
      geometry.computeVertexNormals();
      put(g, geometry, paint[1], [0, 0, -(0.02 + 0.001 * i) * L]);
      s.points.forEach((p, k) => bar(g, p, s.points[(k + 1) % s.points.length], 0.008 * L, paint[0]));
    },
    wheel(g, s, paint) {
      // thin discs are of their body's colour, tires dark
      const tire = s.width > 0.2 * s.radius, sides = about(s.at, s.axis, s.width / 2);
      const wheel = bar(g, ...sides, s.radius, tire ? rubber : paint[1]);
      wheel.geometry.dispose();
      wheel.geometry = new T.CylinderGeometry(s.radius, s.radius, s.width, 40);
      for (const side of sides) ring(g, side, s.axis, s.radius, tire ? dark : paint[0]);
      if (!s.turns) return;
      const [a, b] = vec.across(s.axis);
      for (let k = 0; k < 3; k++) {
        const angle = (2 * Math.PI * k) / 3, out = vec.add(a.map((x) => x * Math.cos(angle)), b, Math.sin(angle));
        bar(g, vec.add(s.at, out, 0.15 * s.radius), vec.add(s.at, out, 0.95 * s.radius), 0.03 * s.radius, tire ? steel : paint[0]);
      }
    },
    mesh(g, s, paint) {
      const geometry = new T.BufferGeometry(), { places, normals } = meshArrays(s);
      geometry.setAttribute("position", new T.BufferAttribute(places, 3));
      geometry.setAttribute("normal", new T.BufferAttribute(normals, 3));
      put(g, geometry, paint[0]);
    },
    pin: (g, s) => bar(g, ...about(s.at, s.axis, (planar ? 0.02 : 0.03) * L), 0.016 * L, steel),
    socket: (g, s) => put(g, new T.SphereGeometry(0.018 * L, 20, 14), steel, s.at),
    rail(g, s) {
      const [low, high] = railReach(motion, s);
      bar(g, vec.add(s.at, s.axis, low), vec.add(s.at, s.axis, high), 0.007 * L, themed.mark);
    },
    block: (g, s, paint) => between(g, new T.BoxGeometry(0.05 * L, 0.08 * L, 0.05 * L), paint[0], ...about(s.at, s.axis, 0.04 * L)),
    ring: (g, s) => put(g, new T.TorusGeometry(0.022 * L, 0.009 * L, 10, 20), rubber, s.at),
    support(g, s) {
      const down = planar ? [0, -1, 0] : vec.unit(motion.up).map((x) => -x), to = vec.add(s.at, Math.hypot(...motion.up) > 0 || planar ? down : [0, 0, -1], 0.07 * L);
      const cone = between(g, new T.ConeGeometry(0.04 * L, 0.07 * L, planar ? 4 : 20), themed.mark, to, s.at);
      if (planar) cone.position.z -= 0.03 * L;
    },
    plane(g, s) {
      const [a, b] = vec.across(s.axis), points = motion.path(s.slider.body, s.slider.at, 200).map((p) => vec.add(p, s.at, -1));
      const span = (d) => { const c = points.map((p) => vec.dot(p, d)); const m = 0.6 * L; return [Math.min(...c) - m, Math.max(...c) + m]; };
      const [[a0, a1], [b0, b1]] = [span(a), span(b)], step = 10 ** Math.round(Math.log10(Math.max(a1 - a0, b1 - b0) / 12)), at = (x, y) => vec.add(vec.add(s.at, a, x), b, y);
      const out = [];
      for (let x = Math.ceil(a0 / step) * step; x <= a1; x += step) out.push(at(x, b0), at(x, b1));
      for (let y = Math.ceil(b0 / step) * step; y <= b1; y += step) out.push(at(a0, y), at(a1, y));
      g.add(lines(out, themed.thin));
    },
  };
  function frame(x, y, z) { return new T.Matrix4().makeBasis(V(x), V(y), V(z)); }
  function ring(group, at, axis, radius, material) {
    const torus = put(group, new T.TorusGeometry(radius, 0.025 * radius, 8, 40), material, at);
    torus.quaternion.setFromUnitVectors(new T.Vector3(0, 0, 1), V(axis));
  }
  function spots(group, at, axis, radius) {
    for (const sign of [-1, 1]) put(group, new T.SphereGeometry(0.12 * radius, 10, 8), dark, vec.add(at, axis, 0.93 * sign * radius));
  }
  function lines(points, material) {
    const geometry = new T.BufferGeometry();
    geometry.setAttribute("position", new T.BufferAttribute(new Float32Array(points.flat()), 3));
    return new T.LineSegments(geometry, material);
  }
  const edges = new Map();
  function edge(group) {
    const key = group.userData.body ?? -1;
    if (!edges.has(key)) edges.set(key, new T.LineBasicMaterial({ color: new T.Color().setHSL(bodyHue(key), 0.5, 0.38) }));
    return edges.get(key);
  }

  for (const shape of motion.shapes) {
    const on = shape.body === null ? ground : groups[shape.body];
    draw[shape.form]?.(on, shape, paintOf(shape), shape.body ?? 0);
  }

  // Materials of a shape, opaque and clear: those of its body, or its own.
  function paintOf({ body, colour, opacity }) {
    const common = body === null ? [themed.mark, themed.mark] : paints[body];
    if (!colour && opacity === 1) return common;
    const own = new T.MeshLambertMaterial({ color: colour ? new T.Color(colour) : common[0].color, opacity, transparent: opacity < 1, depthWrite: opacity === 1, side: T.DoubleSide });
    return [own, own];
  }

  // Lines between bodies: meshes of length one along y, which every picture places anew.
  const moving = motion.lines.map((line) => {
    const parts = [];
    for (let i = 0; i + 1 < line.places.length; i++) parts.push(...partsOf(line.style).map((part) => ({ ...part, i })));
    parts.forEach((part) => root.add(part.mesh));
    return { line, parts };
  });
  function partsOf(style) {
    const cylinder = (radius, material, from = 0, to = 1) => ({ mesh: new T.Mesh(new T.CylinderGeometry(radius * L, radius * L, 1, 14), material), from, to });
    const coil = () => ({ mesh: new T.Mesh(coilGeometry(0.03 * L, 0.006 * L), steel), from: 0, to: 1 });
    const damper = () => [cylinder(0.018, dark, 0, 0.55), cylinder(0.008, steel, 0.5, 1)];
    return {
      coil: () => [coil()],
      damper,
      "coil-damper": () => [coil(), ...damper()],
      bumper: () => [{ mesh: new T.Mesh(new T.ConeGeometry(0.02 * L, 1, 16), rubber), from: 0, to: 0.25 }],
      actuator: () => [cylinder(0.016, steel, 0, 0.5), cylinder(0.009, dark, 0.5, 1)],
      link: () => [cylinder(0.009, steel)],
      rope: () => [cylinder(0.004, themed.mark)],
    }[style]();
  }
  function coilGeometry(radius, wire) {
    const turns = 8, around = 14, sides = 6, n = turns * around, points = [], index = [];
    for (let i = 0; i <= n; i++) {
      const angle = (2 * Math.PI * i) / around, c = Math.cos(angle), s = Math.sin(angle);
      for (let k = 0; k < sides; k++) {
        const phase = (2 * Math.PI * k) / sides, r = radius + wire * Math.cos(phase);
        // the wire's height is taken as that of a coil of ten radii
        points.push(r * c, i / n - 0.5 + (wire * Math.sin(phase)) / (10 * radius), r * s);
        if (i < n) { const a = i * sides + k, b = i * sides + ((k + 1) % sides); index.push(a, a + sides, b, b, a + sides, b + sides); }
      }
    }
    const geometry = new T.BufferGeometry();
    geometry.setAttribute("position", new T.BufferAttribute(new Float32Array(points), 3));
    geometry.setIndex(index);
    geometry.computeVertexNormals();
    return geometry;
  }

  const road = motion.road && roadGroup();
  function roadGroup() {
    const group = new T.Group(), { start, spacing, sides, heights } = motion.road, marks = [];
    const place = (x, across, h) => (planar ? [x, h, across] : [x, across, h]);
    sides.forEach(([from, to], s) => {
      const points = [], index = [];
      heights[s].forEach((h, i) => {
        const x = start + i * spacing;
        points.push(...place(x, from, h), ...place(x, to, h));
        if (i) { const a = 2 * i; index.push(a - 2, a, a - 1, a - 1, a, a + 1); }
        if (Math.floor(x) !== Math.floor(x - spacing)) marks.push(place(x, from, h + 0.002 * L), place(x, to, h + 0.002 * L));
      });
      const geometry = new T.BufferGeometry();
      geometry.setAttribute("position", new T.BufferAttribute(new Float32Array(points), 3));
      geometry.setIndex(index);
      geometry.computeVertexNormals();
      group.add(new T.Mesh(geometry, themed.road));
    });
    if (!planar) group.add(lines(marks, themed.thin));
    else group.add(...sides.map((_, s) => { const top = []; heights[s].forEach((h, i) => { if (i) top.push([start + (i - 1) * spacing, heights[s][i - 1], 0], [start + i * spacing, h, 0]); }); return lines(top, themed.thin); }));
    root.add(group);
    return group;
  }

  // The paths of outputs.
  motion.traces.forEach((trace, i) => {
    const points = motion.path(trace.body, trace.at, 600), geometry = new T.BufferGeometry();
    geometry.setAttribute("position", new T.BufferAttribute(new Float32Array(points.flat()), 3));
    root.add(new T.Line(geometry, new T.LineBasicMaterial({ color: new T.Color().setHSL(trace.body === null ? 0 : bodyHue(trace.body), 0.6, 0.5), transparent: true, opacity: 0.6 })));
  });

  // Arrows of forces, and with two heads of moments, over everything else; those of the plane point at the reader and are left out.
  const arrows = motion.forces.flatMap((force) => (planar ? [0] : [0, 1]).map((i) => {
    const color = i ? 0x8e5bd0 : 0xd6453d, paint = new T.MeshLambertMaterial({ color, emissive: color, emissiveIntensity: 0.5, depthTest: false, transparent: true }), group = new T.Group();
    const shaft = put(group, new T.CylinderGeometry(0.006 * L, 0.006 * L, 1, 10), paint), heads = i ? [0, 0.03 * L] : [0];
    const cones = heads.map(() => put(group, new T.ConeGeometry(0.016 * L, 0.045 * L, 14), paint));
    group.traverse((part) => { part.renderOrder = 2; });
    root.add(group);
    return { force, i, group, shaft, cones, heads };
  }));
  let forceScale = 1;
  function drawArrows(pose, t) {
    for (const { force, i, group, shaft, cones, heads } of arrows) {
      const value = motion.load(force, t)[i], size = Math.hypot(...value), length = (forceScale * 0.25 * L * size) / motion.largest[i];
      group.visible = length > 0.01 * L;
      if (!group.visible) continue;
      group.position.set(...motion.point(pose, force.place.body, force.place.at));
      group.quaternion.setFromUnitVectors(up, V(value.map((x) => x / size)));
      shaft.scale.set(1, length, 1);
      shaft.position.set(0, length / 2, 0);
      cones.forEach((cone, k) => cone.position.set(0, length - heads[k], 0));
    }
  }

  const from = new T.Vector3(), to = new T.Vector3(), way = new T.Vector3();
  function update(pose, t) {
    groups.forEach((group, b) => {
      const o = 7 * b;
      group.position.set(pose[o], pose[o + 1], pose[o + 2]);
      group.quaternion.set(pose[o + 4], pose[o + 5], pose[o + 6], pose[o + 3]);
    });
    for (const { line, parts } of moving) {
      for (const { mesh, i, from: a, to: b } of parts) {
        from.set(...motion.point(pose, line.places[i].body, line.places[i].at));
        to.set(...motion.point(pose, line.places[i + 1].body, line.places[i + 1].at));
        way.subVectors(to, from);
        const length = way.length();
        mesh.position.copy(from).addScaledVector(way, (a + b) / 2);
        mesh.scale.set(1, Math.max(length * (b - a), 1e-9 * L), 1);
        if (length > 0) mesh.quaternion.setFromUnitVectors(up, way.divideScalar(length));
      }
    }
    drawArrows(pose, t);
    if (road && motion.road.speed) road.position.x = -motion.road.speed * t;
  }
  function theme(colour) {
    themed.mark.color.set(colour("soft")); themed.road.color.set(colour("road")); themed.thin.color.set(colour("rule"));
  }
  return { root, groups, update, theme, setForces(scale) { forceScale = scale; } };
}
