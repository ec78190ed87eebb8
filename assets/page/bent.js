// What bends, as surfaces through its points at a sample: those of app/present/bent.cpp and strands.cpp.
async (gl, mesh, bodyBuffer, solids) => {
  const samples = DATA.count, { grain, low, weaves, bands, top } = DATA.bent;
  const rowsOf = async (text, width) => {
    const bytes = await unpacked(text), count = bytes.byteLength / (4 * width), halves = seriesOf(bytes, count);
    return Array.from({ length: count }, (_, n) => Array.from({ length: width }, (_, k) => halves[k * count + n] + 65536 * halves[(width + k) * count + n]));
  };
  const places = seriesOf(await unpacked(DATA.bent.places), samples);
  const strains = bands && seriesOf(await unpacked(DATA.bent.strains), samples);
  let first = 0;
  for (const weave of weaves) {
    weave.first = first;
    first += weave.count;
    if (weave.strand) {  // from its second point on each is told from the one before
      for (let p = 0; p < weave.count; ++p) if (p % weave.strand) {
        const at = 3 * (weave.first + p) * samples;
        for (let i = at; i < at + 3 * samples; ++i) places[i] += places[i - 3 * samples];
      }
      continue;
    }
    weave.triangles = await rowsOf(weave.triangles, 3);
    weave.rim = await rowsOf(weave.rim, 2);
    weave.sides = new Uint8Array(await unpacked(weave.sides));
  }

  // Its points [m] from the origin of the picture; the strain in shares of that of the last colour comes fourth.
  const pointsOf = (weave, k) => Array.from({ length: weave.count }, (_, p) => {
    const number = weave.first + p, at = axis => low[axis] - DATA.origin[axis] + grain * places[(3 * number + axis) * samples + k];
    return strains ? [at(0), at(1), at(2), strains[number * samples + k] / 127.5] : [at(0), at(1), at(2)];
  });
  // Cubics whose slope at a place is that of the chord of its neighbours.
  const curveThrough = (row, parts) => {
    const curve = [row[0]], last = row.length - 1;
    for (let j = 0; j < last; ++j) {
      const b = row[j], c = row[j + 1], a = j > 0 ? row[j - 1] : b.map((x, i) => 2 * x - c[i]), d = j + 1 < last ? row[j + 2] : c.map((x, i) => 2 * x - b[i]);
      for (let part = 1; part <= parts; ++part) {
        const s = part / parts;
        curve.push(b.map((x, i) => x + 0.5 * s * (c[i] - a[i] + s * (2 * a[i] - 5 * x + 4 * c[i] - d[i] + s * (3 * (x - c[i]) + d[i] - a[i])))));
      }
    }
    return curve;
  };
  const sheetThrough = (points, columns, parts) => {
    const rows = [], sheet = [];
    for (let at = 0; at < points.length; at += columns) rows.push(curveThrough(points.slice(at, at + columns), parts));
    const width = rows[0].length;
    for (let i = 0; i < width; ++i) curveThrough(rows.map(row => row[i]), parts).forEach((place, j) => sheet[j * width + i] = place);
    return sheet;
  };

  // Corners are rows [x, y, z, normal, colour, thickness, strain], triangles threes of them.
  const corner = (place, normal, offset, colour, thickness) => [...add(place, normal, offset), ...normal, ...colour, thickness, place[3]];
  function sheetOf(weave, k) {
    const { triangles, sides, half, skin, colours: [front, back] } = weave;
    const own = pointsOf(weave, k), points = weave.parts > 1 ? sheetThrough(own, weave.columns, weave.parts) : own, count = points.length;
    const normals = Array.from({ length: count * (1 + sides.reduce((a, b) => Math.max(a, b), 0)) }, () => [0, 0, 0]);
    const at = (n, p) => (sides.length ? sides[n] * count : 0) + p;
    triangles.forEach(([p, q, r], n) => {
      const area = cross(add(points[q], points[p], -1), add(points[r], points[p], -1));
      for (const i of [p, q, r]) for (let axis = 0; axis < 3; ++axis) normals[at(n, i)][axis] += area[axis];
    });
    normals.forEach((normal, i) => normals[i] = unit(normal));
    if (!half) {  // a solid: its skin is off its points along the normals of all sides that meet there
      const out = points.map(p => [...p]);
      normals.forEach((normal, i) => normal.forEach((x, axis) => out[i % count][axis] += skin * x));
      return [normals.map((normal, i) => corner(out[i % count], normal, 0, front, 1)), triangles.map((t, n) => t.map(p => at(n, p)))];
    }
    const corners = [...points.map((p, i) => corner(p, normals[i], half, front, half)), ...points.map((p, i) => corner(p, normals[i].map(x => -x), half, back, half))];
    const faces = [...triangles, ...triangles.map(([p, q, r]) => [count + r, count + q, count + p])];
    for (const [p, q] of weave.rim) {
      const out = unit(cross(add(points[q], points[p], -1), add(normals[p], normals[q]))), a = corners.length;
      for (const [i, side] of [[p, half], [p, -half], [q, -half], [q, half]]) corners.push([...add(points[i], normals[i], side), ...out, ...front, half, points[i][3]]);
      faces.push([a, a + 1, a + 2], [a, a + 2, a + 3]);
    }
    return [corners, faces];
  }
  // A tube of four sides along each strand, thinner towards its tip.
  function tubesOf(weave, k) {
    const points = pointsOf(weave, k), corners = [], faces = [];
    for (let strand = 0, n = 0; strand < points.length; strand += weave.strand, ++n) {
      const curve = curveThrough(points.slice(strand, strand + weave.strand), weave.parts), last = curve.length - 1;
      let u = [1, 0, 0];
      curve.forEach((place, i) => {
        const t = unit(add(curve[Math.min(i + 1, last)], curve[Math.max(i - 1, 0)], -1));
        let across = add(u, t, -dot(u, t));
        if (dot(across, across) < 1e-4) across = cross(t, Math.abs(t[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0]);
        u = unit(across);
        const v = cross(t, u), radius = weave.half * (1 - 0.75 * (i / last) ** 2), a = corners.length;
        for (const normal of [u, v, u.map(x => -x), v.map(x => -x)]) corners.push(corner(place, normal, radius, weave.colours[n % weave.colours.length], weave.half));
        if (i < last) for (let side = 0; side < 4; ++side) {
          const b = a + side, c = a + (side + 1) % 4;
          faces.push([b, c, c + 4], [b, c + 4, b + 4]);
        }
      });
    }
    return [corners, faces];
  }

  // The part of a polygon where side · (strain − level) ≥ 0.
  const kept = (polygon, level, side) => polygon.flatMap((a, i) => {
    const b = polygon[(i + 1) % polygon.length], inside = side * (a[10] - level) >= 0, part = inside ? [a] : [];
    if (inside === side * (b[10] - level) >= 0) return part;
    const [p, q] = a[10] < b[10] ? [a, b] : [b, a], u = (level - p[10]) / (q[10] - p[10]);
    return [...part, p.map((x, j) => j === 10 ? level : x + u * (q[j] - x))];
  });
  // Each triangle cut where the strain passes from one colour to the next.
  function inBands([corners, faces]) {
    const cut = [], threes = [], bandOf = value => Math.min(bands.length - 1, Math.max(0, Math.floor(value * bands.length)));  // curves may pass below 0
    const put = (polygon, band) => {
      const a = cut.length;
      for (const c of polygon) cut.push([...c.slice(0, 6), ...bands[band], ...c.slice(9)]);
      for (let j = 2; j < polygon.length; ++j) threes.push([a, a + j - 1, a + j]);
    };
    for (const face of faces) {
      let rest = face.map(i => corners[i]);
      const all = rest.map(c => bandOf(c[10])), last = Math.max(...all);
      for (let band = Math.min(...all); band < last; ++band) {
        put(kept(rest, (band + 1) / bands.length, -1), band);
        rest = kept(rest, (band + 1) / bands.length, 1);
      }
      put(rest, last);
    }
    return [cut, threes];
  }

  // One solid for each surface now, and for each that a strobe shows: drawn once, at the origin.
  gl.vertexAttrib3f(8, 1e9, 1e9, 1e9);  // no edge is near
  const known = new Map();
  function solidOf(number, k, slot) {
    const key = number + ' ' + slot, weave = weaves[number];
    let made = known.get(key);
    if (made && made.k === k) return made.solid;
    let surface = weave.strand ? tubesOf(weave, k) : sheetOf(weave, k);
    if (bands && !weave.strand) surface = inBands(surface);
    const vertices = new Float32Array(10 * surface[0].length), faces = new Uint32Array(3 * surface[1].length);
    surface[0].forEach((c, n) => { for (let j = 0; j < 10; ++j) vertices[10 * n + j] = c[j]; });
    surface[1].forEach((t, n) => faces.set(t, 3 * n));
    if (!made) {
      known.set(key, made = { solid: solids.length });
      solids.push(mesh([[], []], 10, [[0, 3, 0], [1, 3, 3], [5, 4, 6], [6, 4, 6]], [[2, 4, 0], [3, 4, 4], [4, 4, 8]], bodyBuffer, 20));
    }
    made.k = k;
    solids[made.solid].fill(vertices, faces);
    return made.solid;
  }
  if (bands) document.querySelector('header').insertAdjacentHTML('beforeend', `<p>strain: 0 <span style="display:inline-block;width:8em;height:.7em;background:linear-gradient(90deg,${bands.map(c => `rgb(${c.map(x => 255 * x)})`)})"></span> ${(100 * top).toPrecision(3)} %</p>`);
  return {
    /// Ranges as those of bodies; `floats` gets where they stand.
    ranges: (floats, k, slot, alpha, present) => weaves.map((_, number) => {
      const solid = solidOf(number, k, slot), range = [solid, floats.length / 20, 1];
      floats.push(0, 0, 0, alpha, 0, 0, 0, 1, 1, 1, 1, present, 0, 0, 0, 0, 0, 0, 0, 0);
      return range;
    }),
    points: k => weaves.flatMap(weave => pointsOf(weave, k).map(p => add(p, DATA.origin)))
  };
}
