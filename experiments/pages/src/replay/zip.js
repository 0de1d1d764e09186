// Archives of files that are compressed already, such as PNG.

const table = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c;
});

export function crc32(bytes) {
  let c = 0xffffffff;
  for (const byte of bytes) c = table[(c ^ byte) & 255] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}

// Writes numbers, [bytes, value], little endian.
function numbers(...fields) {
  const view = new DataView(new ArrayBuffer(fields.reduce((sum, [size]) => sum + size, 0)));
  let at = 0;
  for (const [size, value] of fields) {
    if (size === 2) view.setUint16(at, value, true);
    else view.setUint32(at, value, true);
    at += size;
  }
  return new Uint8Array(view.buffer);
}

const date = 0x21;  // 1980-01-01, the first that archives know

// Returns an archive of files, [name in ASCII, bytes], stored without compression.
export function zip(files) {
  const parts = [];
  const directory = [];
  let at = 0;
  const put = (bytes) => {
    parts.push(bytes);
    at += bytes.length;
  };
  for (const [name, bytes] of files) {
    const letters = new TextEncoder().encode(name);
    const sizes = [[4, bytes.length], [4, bytes.length], [2, letters.length], [2, 0]];
    const common = [[2, 20], [2, 0], [2, 0], [2, 0], [2, date], [4, crc32(bytes)], ...sizes];
    directory.push(numbers([4, 0x02014b50], [2, 20], ...common, [2, 0], [2, 0], [2, 0], [4, 0], [4, at]), letters);
    put(numbers([4, 0x04034b50], ...common));
    put(letters);
    put(bytes);
  }
  const start = at;
  directory.forEach(put);
  put(numbers([4, 0x06054b50], [2, 0], [2, 0], [2, files.length], [2, files.length], [4, at - start], [4, start], [2, 0]));
  return new Blob(parts, { type: "application/zip" });
}
