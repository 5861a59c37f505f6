// Reads what a page carries: text in base64 that is deflated; columns of whole numbers as page/pack.rs writes them.
async function inflated(id) {
  const text = atob(document.getElementById(id).textContent.trim());
  const bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The header, and a function that gives the numbers of a column: NaN in gaps where asked for.
async function readPack(id) {
  const bytes = await inflated(id);
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  let at = 4 + length;
  const groups = header.groups.map(([rows, columns, planes]) => {
    const start = at, size = rows * columns;
    at += size * planes;
    return { start, size, rows, planes };
  });
  function column({ group, column, low, step }, hasGaps) {
    const { start, size, rows, planes } = groups[group], out = new Float64Array(rows);
    let sum = 0;
    for (let r = 0; r < rows; r++) {
      let x = 0;
      for (let plane = planes - 1; plane >= 0; plane--) x = x * 256 + bytes[start + plane * size + column * rows + r];
      sum += x % 2 ? -(x + 1) / 2 : x / 2;
      out[r] = hasGaps && sum === 65535 ? NaN : low + step * sum;
    }
    return out;
  }
  return { header, column };
}
