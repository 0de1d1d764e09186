// Loads an encoded run with the page's modules, without a browser.
import { Blocks } from "../src/replay/blocks.js";
import { RunState, loadStructures } from "../src/replay/run_state.js";
import { encodeReplay, packed } from "./encode_replay.mjs";

export function blocksOf({ meta, blocks }) {
  const texts = packed(blocks);
  return new Blocks((name) => texts.get(name) ?? null, meta.blocks);
}

export async function loadRun(run) {
  const encoded = encodeReplay(run);
  const structures = await loadStructures(encoded.meta, blocksOf(encoded));
  return { meta: encoded.meta, state: new RunState(encoded.meta, structures) };
}
