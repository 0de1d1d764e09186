// Bytes of the replay's blocks: base64, zlib, and zigzag LEB128 varints.

export function fromBase64(text) {
  const clean = text.trim();
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(clean);
  const binary = atob(clean);
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = binary.charCodeAt(k);
  return bytes;
}

export async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  try {
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch {
    throw new Error("the data are damaged: the file is cut off or was edited");  // browsers say "Failed to fetch"
  }
}

// Reads columns one after another. A varint is a zigzag LEB128 number.
export class ColumnReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  // Reads a varint of at most 32 bits.
  next() {
    const bytes = this.bytes;
    let value = 0;
    for (let shift = 0; shift < 35; shift += 7) {
      if (this.at >= bytes.length) throw new RangeError("the block ends inside a number");
      const byte = bytes[this.at++];
      value |= (byte & 127) << shift;
      if (byte < 128) return (value >>> 1) ^ -(value & 1);
    }
    throw new RangeError("a number of the block has more than 32 bits");
  }

  // Reads a varint of at most 53 bits.
  nextLong() {
    let value = 0;
    for (let unit = 1; unit < 2 ** 53; unit *= 128) {
      if (this.at >= this.bytes.length) throw new RangeError("the block ends inside a number");
      const byte = this.bytes[this.at++];
      value += (byte & 127) * unit;
      if (byte < 128) return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
    }
    throw new RangeError("a number of the block has more than 53 bits");
  }

  // Reads varints that are differences of 32-bit words from the word before.
  words(count) {
    const words = new Uint32Array(count);
    for (let k = 0, word = 0; k < count; ++k) words[k] = word = (word + this.next()) >>> 0;
    return words;
  }

  byteColumn(count) {
    if (this.at + count > this.bytes.length) throw new RangeError("the block is too short");
    return this.bytes.subarray(this.at, (this.at += count));
  }

  get ended() {
    return this.at === this.bytes.length;
  }
}

// Copies, because typed arrays must be aligned and columns are not.
function column(Type, bytes, at, count) {
  const size = count * Type.BYTES_PER_ELEMENT;
  if (at + size > bytes.length) throw new RangeError("the block is too short");
  return new Type(bytes.slice(at, at + size).buffer);
}

export const uint32 = (bytes, at = 0, count = (bytes.length - at) >> 2) => column(Uint32Array, bytes, at, count);
export const float64 = (bytes, at = 0, count = (bytes.length - at) >> 3) => column(Float64Array, bytes, at, count);

// Lets the page draw and answer while long work goes on.
export const pause = () => new Promise((resolve) => setTimeout(resolve, 0));
