// Meshes from files: their triangles on their bodies, and the edges that are seen.

// Gives every shape that is a mesh the corners of its triangles in the axes of its body, three numbers each.
function placeMeshes(motion, column) {
  const meshes = (motion.meshes ?? []).map(({ places, triangles }) => ({ places: places.map((c) => column(c)), triangles: triangles.map((c) => column(c)) }));
  for (const shape of motion.shapes) {
    if (shape.form !== "mesh") continue;
    const { places, triangles } = meshes[shape.mesh], n = places[0].length, corners = new Float32Array(3 * n);
    for (let v = 0; v < n; v++) for (let i = 0; i < 3; i++) corners[3 * v + i] = shape.at[i] + places[0][v] * shape.axes[0][i] + places[1][v] * shape.axes[1][i] + places[2][v] * shape.axes[2][i];
    shape.corners = corners;
    shape.triangles = triangles;
  }
}

const cornerOf = ({ corners }, v) => [corners[3 * v], corners[3 * v + 1], corners[3 * v + 2]];

// The unit normals of the triangles, and their areas.
function normalsOf(shape) {
  const [a, b, c] = shape.triangles;
  return Array.from(a, (_, k) => {
    const p = cornerOf(shape, a[k]), n = vec.cross(vec.add(cornerOf(shape, b[k]), p, -1), vec.add(cornerOf(shape, c[k]), p, -1)), size = Math.hypot(...n);
    return { size, unit: size > 0 ? n.map((x) => x / size) : n };
  });
}

// Surfaces are round where neighbours are turned by less than this angle, and have an edge elsewhere.
const CREASE = Math.cos((38 * Math.PI) / 180);

// Places and normals of all corners of all triangles, as numbers for three.js.
function meshArrays(shape) {
  const normals = normalsOf(shape), around = new Map(), n = shape.triangles[0].length, places = new Float32Array(9 * n), out = new Float32Array(9 * n);
  shape.triangles.forEach((column) => column.forEach((v, k) => { if (around.has(v)) around.get(v).push(k); else around.set(v, [k]); }));
  for (let k = 0; k < n; k++) for (let i = 0; i < 3; i++) {
    const v = shape.triangles[i][k], own = normals[k].unit;
    let sum = [0, 0, 0];
    for (const other of around.get(v)) if (vec.dot(own, normals[other].unit) > CREASE) sum = vec.add(sum, normals[other].unit, normals[other].size);
    places.set(cornerOf(shape, v), 9 * k + 3 * i);
    out.set(Math.hypot(...sum) > 0 ? vec.unit(sum) : own, 9 * k + 3 * i);
  }
  return { places, normals: out };
}

// The edges of a mesh where it is drawn as lines: open ones and sharp ones, the longest first, and no more than `most`.
function meshEdges(shape, most) {
  const normals = normalsOf(shape), edges = new Map(), n = shape.triangles[0].length;
  for (let k = 0; k < n; k++) for (let i = 0; i < 3; i++) {
    const pair = [shape.triangles[i][k], shape.triangles[(i + 1) % 3][k]].sort((a, b) => a - b), key = pair.join();
    if (edges.has(key)) edges.get(key).on.push(k); else edges.set(key, { pair, on: [k] });
  }
  const sharp = [...edges.values()].filter(({ on }) => on.length !== 2 || vec.dot(normals[on[0]].unit, normals[on[1]].unit) < CREASE);
  const lines = sharp.map(({ pair }) => pair.map((v) => cornerOf(shape, v)));
  const length = ([a, b]) => Math.hypot(...vec.add(a, b, -1));
  return lines.map((line) => [length(line), line]).sort((a, b) => b[0] - a[0]).slice(0, most).map(([, line]) => line);
}

// The corners of the box about it.
function meshBox({ corners }) {
  const low = [1 / 0, 1 / 0, 1 / 0], high = low.map((x) => -x);
  corners.forEach((x, i) => { low[i % 3] = Math.min(low[i % 3], x); high[i % 3] = Math.max(high[i % 3], x); });
  return Array.from({ length: 8 }, (_, k) => low.map((x, i) => (k >> i & 1 ? high[i] : x)));
}
