// The poses of all bodies at any time: places are interpolated linearly, turns along the shortest arc.
function makeMotion(motion, panels, column) {
  placeMeshes(motion, column);
  const times = column(motion.times), places = motion.places.map((c) => column(c)), turns = motion.turns.map((c) => column(c));
  const n = motion.bodies.length, pose = new Float64Array(7 * n);

  // Places and turns (w, x, y, z) of all bodies at a time; the array is used again.
  function at(t) {
    const k = before(times, t), next = Math.min(k + 1, times.length - 1);
    const part = next > k ? Math.min(1, Math.max(0, (t - times[k]) / (times[next] - times[k]))) : 0;
    for (let b = 0; b < n; b++) {
      for (let i = 0; i < 3; i++) { const c = places[3 * b + i]; pose[7 * b + i] = c[k] + (c[next] - c[k]) * part; }
      slerp(b, k, next, part);
    }
    return pose;
  }
  function slerp(b, k, next, part) {
    let dot = 0;
    for (let i = 0; i < 4; i++) dot += turns[4 * b + i][k] * turns[4 * b + i][next];
    const sign = dot < 0 ? -1 : 1, angle = Math.acos(Math.min(1, Math.abs(dot))), sin = Math.sin(angle);
    const [a, c] = sin > 1e-4 ? [Math.sin((1 - part) * angle) / sin, Math.sin(part * angle) / sin] : [1 - part, part];
    let size = 0;
    for (let i = 0; i < 4; i++) {
      const x = a * turns[4 * b + i][k] + sign * c * turns[4 * b + i][next];
      pose[7 * b + 3 + i] = x;
      size += x * x;
    }
    size = Math.sqrt(size) || 1;
    for (let i = 3; i < 7; i++) pose[7 * b + i] /= size;
  }
  // Where a point of a body (or of the ground) is in a pose.
  function point(pose, body, p) {
    if (body === null || body === undefined) return p;
    const o = 7 * body, w = pose[o + 3], x = pose[o + 4], y = pose[o + 5], z = pose[o + 6];
    const a = y * p[2] - z * p[1] + w * p[0], b = z * p[0] - x * p[2] + w * p[1], c = x * p[1] - y * p[0] + w * p[2];
    return [pose[o] + p[0] + 2 * (y * c - z * b), pose[o + 1] + p[1] + 2 * (z * a - x * c), pose[o + 2] + p[2] + 2 * (x * b - y * a)];
  }
  // Force and moment of an output at a time, in global axes.
  const forces = (motion.forces ?? []).map((force) => ({ ...force, parts: force.parts.map(partOf) }));
  function partOf(part) {
    if (!Array.isArray(part)) return () => part ?? 0;
    const line = panels[part[0]].lines[part[1]], t = column(line.t), y = column(line.y, true);
    return (now) => {
      const k = before(t, now), next = Math.min(k + 1, t.length - 1);
      return y[k] + (next > k ? (y[next] - y[k]) * Math.min(1, Math.max(0, (now - t[k]) / (t[next] - t[k]))) : 0) || 0;
    };
  }
  function load({ parts, axes }, t) {
    const v = parts.map((part) => part(t));
    const both = motion.dimension === 2 ? [[v[0], v[1], 0], [0, 0, v[2]]] : [v.slice(0, 3), [v[3] || 0, v[4] || 0, v[5] || 0]];
    if (axes === null) return both;
    const pose = at(t), origin = point(pose, axes, [0, 0, 0]);
    return both.map((x) => vec.add(point(pose, axes, x), origin, -1));
  }
  // The largest force and the largest moment of the run: they have the longest arrows.
  const largest = [0, 1].map((i) => Math.max(1e-300, ...forces.flatMap((force) => [...times].map((t) => Math.hypot(...load(force, t)[i])))));
  // The path of a point of a body, at most `most` places of it.
  function path(body, p, most) {
    const skip = Math.max(1, Math.ceil(times.length / most)), out = [];
    for (let k = 0; k < times.length; k += skip) out.push([...point(at(times[k]), body, p)]);
    return out;
  }
  return { ...motion, forces, largest, load, times, n, at, point, path, start: times[0], end: times[times.length - 1] };
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

// Index of the time that is nearest to t.
function nearest(times, t) {
  const k = before(times, t), next = Math.min(k + 1, times.length - 1);
  return times[next] - t < t - times[k] ? next : k;
}

const vec = {
  add: (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]],
  dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
  cross: (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]],
  unit(a) { const s = Math.hypot(...a); return s > 0 ? a.map((x) => x / s) : [0, 0, 1]; },
  // Two unit vectors across a third.
  across(a) {
    const first = vec.unit(vec.cross(Math.abs(a[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0], a));
    return [first, vec.cross(a, first)];
  },
};

// How far a rail reaches: the least and the largest coordinate of its slider along it, with a margin.
function railReach(motion, shape) {
  let low = 0, high = 0;
  for (let k = 0; k < motion.times.length; k += Math.max(1, Math.floor(motion.times.length / 100))) {
    const pose = motion.at(motion.times[k]);
    const base = motion.point(pose, shape.body, shape.at), tip = motion.point(pose, shape.body, vec.add(shape.at, shape.axis));
    const s = vec.dot(vec.add(motion.point(pose, shape.slider.body, shape.slider.at), base, -1), vec.add(tip, base, -1));
    low = Math.min(low, s); high = Math.max(high, s);
  }
  const margin = 0.06 * motion.length;
  return [low - margin, high + margin];
}
