// The page's data: a header of JSON and columns of numbers, packed by pack.py.

/** Base64 of deflate-raw of: length of the header (4 bytes), header, columns one after the other. */
async function unpack(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const inflated = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return contentsOf(new Uint8Array(await new Response(inflated).arrayBuffer()));
}

/** Header and columns in one object. */
function contentsOf(bytes) {
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  let at = 4 + length;
  const columns = {};
  for (const column of header.columns) {
    const end = at + column.count * column.width;
    columns[column.name] = columnOf(column, bytes.slice(at, end));
    at = end;
  }
  delete header.columns;
  return { ...header, ...columns };
}

/** Floats are as they are. Whole numbers stand as planes of bytes, the lowest first: what each adds
 * to the one `stride` before it. With `low` and `high` they tell parts of that range. */
function columnOf({ count, width, stride, low, high }, bytes) {
  if (stride === 0) return new { 4: Float32Array, 8: Float64Array }[width](bytes.buffer);
  const whole = new { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array }[width](count);
  for (let i = 0; i < count; ++i) {
    let change = 0;
    for (let plane = width - 1; plane >= 0; --plane) change = (change << 8) | bytes[plane * count + i];
    whole[i] = (i < stride ? 0 : whole[i - stride]) + change; // wraps as the packer's did
  }
  if (low === undefined) return whole;
  const most = 2 ** (8 * width) - 1;
  return Float64Array.from(whole, (part) => low + ((high - low) * part) / most);
}
