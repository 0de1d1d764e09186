// The named blocks of a replay. A block is unpacked whenever it is read, and not kept.
import { fromBase64, inflate } from "../shared/codec.js";

export class Blocks {
  // `textOf(name)` returns the base64 text of a block, or null if there is none. `sizes` are the lengths in bytes
  // before compression.
  constructor(textOf, sizes) {
    this.textOf = textOf;
    this.sizes = sizes;
  }

  has(name) {
    return (this.sizes[name] ?? 0) > 0;
  }

  async bytes(name) {
    if (!this.has(name)) return new Uint8Array(0);
    const text = this.textOf(name);
    if (text === null) throw new Error(`the replay lacks its block '${name}': the file is cut off or was edited`);
    let bytes;
    try {
      bytes = await inflate(fromBase64(text));
    } catch (error) {
      throw new Error(`cannot unpack block '${name}' of the replay: ${error.message}`);
    }
    if (bytes.length !== this.sizes[name])
      throw new Error(`block '${name}' of the replay has ${bytes.length} bytes, expected ${this.sizes[name]}`);
    return bytes;
  }
}

export const blocksOfPage = (document, meta) =>
  new Blocks((name) => document.getElementById(`kds-block-${name}`)?.textContent ?? null, meta.blocks);

// Reads META, and refuses a replay that this page cannot show.
export function metaOfPage(document) {
  const element = document.getElementById("kds-replay");
  if (!element && document.querySelector(".kds-block")) throw new Error("the file is cut off before its end");
  if (!element) throw new Error("this page has no replay in it: write one with 'kds view INPUT -o replay.html'");
  let meta;
  try {
    meta = JSON.parse(element.textContent);
  } catch {
    throw new Error("the file is cut off before its end");
  }
  if (meta.format !== "kds-replay" || meta.version !== 2)
    throw new Error(`the replay is of format '${meta.format}' ${meta.version}, this page shows 'kds-replay' 2`);
  return meta;
}
