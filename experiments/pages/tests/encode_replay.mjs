// Encodes a replay as docs/formats.md says, without any code of the page, so that tests compare two readings of the format.
import { deflateSync } from "node:zlib";

// Collects little-endian numbers.
class Bytes {
  parts = [];
  length = 0;

  push(buffer) {
    this.parts.push(buffer);
    this.length += buffer.length;
  }

  uint8(values) {
    this.push(Buffer.from(values));
  }

  uint32(values) {
    const buffer = Buffer.alloc(4 * values.length);
    values.forEach((value, k) => buffer.writeUInt32LE(value >>> 0, 4 * k));
    this.push(buffer);
  }

  float64(values) {
    const buffer = Buffer.alloc(8 * values.length);
    values.forEach((value, k) => buffer.writeDoubleLE(value, 8 * k));
    this.push(buffer);
  }

  varint(value) {
    let rest = BigInt(value) >= 0n ? 2n * BigInt(value) : -2n * BigInt(value) - 1n;
    const bytes = [];
    do {
      bytes.push(Number(rest & 127n) | (rest > 127n ? 128 : 0));
      rest >>= 7n;
    } while (rest > 0n);
    this.push(Buffer.from(bytes));
  }

  // Differences of 32-bit words, as signed numbers of 32 bits.
  differences(words) {
    words.forEach((word, k) => this.varint((word - (k ? words[k - 1] : 0)) | 0));
  }

  get buffer() {
    return Buffer.concat(this.parts);
  }
}

// Returns [middle, reach] of a bracket: its middle in units of 2^-32, and 0 or 1 more than the logarithm of how far the bracket
// reaches from there.
export function shownTime(lower, upper) {
  const [from, to] = [lower * 2 ** 32, upper * 2 ** 32];
  if (from === to && Number.isInteger(from)) return [from, 0];
  const middle = Math.max(1, Math.round((from + to) / 2));
  const away = Math.max(middle - from, to - middle, 1);
  return [middle, 1 + Math.ceil(Math.log2(away))];
}

export const quantised = (value, origin, quantum) => Math.round((value - origin) / quantum);

// `run`: frames [[x, y, z] of each bead] of each frame, controls (degree > 1) of each step: inner points [[[x, y, z] of each
// bead]], structures [{name, kinds, stages, layers, events, nodes}], and the other members of META. An event is {order, step,
// lower, upper, kind, stage, ids, changes: [{layer, removed, added}]} with elements as arrays. Returns {meta, blocks}.
export function encodeReplay(run) {
  const axes = run.dimension;
  const beads = run.frames[0].length;
  const blocks = new Map();
  const put = (name, fill) => {
    const bytes = new Bytes();
    fill(bytes);
    blocks.set(name, bytes.buffer);
  };
  const flat = run.frames.flat();
  const low = [0, 1, 2].map((axis) => Math.min(...flat.map((p) => p[axis] ?? 0)));
  const high = [0, 1, 2].map((axis) => Math.max(...flat.map((p) => p[axis] ?? 0)));
  const { quantum = 0.02, block_frames = 4, degree = 1 } = run;
  const integer = (point, axis) => quantised(point[axis], low[axis], quantum);

  put("frames", (bytes) => bytes.uint32(run.frame_numbers ?? run.frames.map((_, k) => k)));
  if (run.times) put("times", (bytes) => bytes.float64(run.times));
  if (run.radii) put("radii", (bytes) => bytes.float64(run.radii));
  if (run.names) blocks.set("names", Buffer.from(JSON.stringify(run.names)));
  for (let first = 0; first < run.frames.length; first += block_frames) {
    put(`positions-${first / block_frames}`, (bytes) => {
      for (let f = first; f < Math.min(first + block_frames, run.frames.length); ++f) {
        for (let axis = 0; axis < axes; ++axis) {
          for (let b = 0; b < beads; ++b) {
            const now = integer(run.frames[f][b], axis);
            if (f > first) bytes.varint(now - integer(run.frames[f - 1][b], axis));
            else bytes.varint(now - (b > 0 ? integer(run.frames[f][b - 1], axis) : 0));
          }
        }
      }
    });
    if (degree === 1) continue;
    put(`controls-${first / block_frames}`, (bytes) => {
      for (let s = first; s < Math.min(first + block_frames, run.frames.length - 1); ++s) {
        for (let j = 1; j < degree; ++j) {
          for (let axis = 0; axis < axes; ++axis) {
            for (let b = 0; b < beads; ++b) {
              const [from, to] = [integer(run.frames[s][b], axis), integer(run.frames[s + 1][b], axis)];
              const chord = Math.floor(((degree - j) * from + j * to) / degree + 0.5);
              bytes.varint(integer(run.controls[s][j - 1][b], axis) - chord);
            }
          }
        }
      }
    });
  }
  run.structures.forEach((structure, s) => {
    const { events } = structure;
    put(`events-${s}`, (bytes) => {
      bytes.differences(events.map((e) => e.order));
      bytes.differences(events.map((e) => e.step));
      const times = events.map((e) => shownTime(e.lower, e.upper));
      times.forEach(([middle], e) =>
        bytes.varint(middle - (e && events[e].step === events[e - 1].step ? times[e - 1][0] : 0)),
      );
      bytes.uint8(times.map(([, reach]) => reach));
      bytes.uint8(events.map((e) => e.kind));
      bytes.uint8(events.map((e) => e.stage));
      bytes.uint8(events.map((e) => e.ids.length));
      for (let k = 0; k < Math.max(0, ...events.map((e) => e.ids.length)); ++k)
        for (const { ids } of events.filter((e) => e.ids.length > k)) bytes.varint((ids[k] - (k ? ids[k - 1] : 0)) | 0);
    });
    structure.layers.forEach((layer, l) => {
      const padded = (elements) =>
        elements.flatMap((element) => [...element, ...Array(layer.arity - element.length).fill(0xffffffff)]);
      put(`initial-${s}-${l}`, (bytes) => bytes.uint32(padded(layer.initial)));
      put(`changes-${s}-${l}`, (bytes) => {
        const changes = events.flatMap((event, e) =>
          (event.changes ?? []).filter((c) => c.layer === layer.name).map((change) => ({ e, event, ...change })),
        );
        bytes.differences(changes.map(({ e }) => e));
        changes.forEach(({ removed }) => bytes.varint(removed.length));
        changes.forEach(({ added }) => bytes.varint(added.length));
        const wordsOf = ({ removed, added }) => padded([...removed, ...added]);
        const isOther = (word, { event }) => word !== 0xffffffff && !event.ids.includes(word);
        for (const change of changes)
          bytes.uint8(wordsOf(change).map((word) =>
            word === 0xffffffff ? 255 : isOther(word, change) ? 254 : change.event.ids.indexOf(word)));
        for (const change of changes) bytes.differences(wordsOf(change).filter((word) => isOther(word, change)));
      });
    });
    if (structure.spheres) {
      // `spheres`: {nodes, frames: [[x, y, z, radius] of each node] of each frame}; of degree 1.
      put(`sphere-nodes-${s}`, (bytes) => bytes.uint32(structure.spheres.nodes));
      for (let first = 0; first < run.frames.length; first += block_frames) {
        put(`spheres-${s}-positions-${first / block_frames}`, (bytes) => {
          const whole = structure.spheres.frames.map((balls) =>
            [0, 1, 2, 3].flatMap((axis) => balls.map((ball) => quantised(ball[axis], axis < 3 ? low[axis] : 0, quantum))));
          for (let f = first; f < Math.min(first + block_frames, whole.length); ++f)
            whole[f].forEach((value, k) =>
              bytes.varint(value - (f > first ? whole[f - 1][k] : k % structure.spheres.nodes.length ? whole[f][k - 1] : 0)));
        });
      }
    }
    if (structure.nodes) put(`nodes-${s}`, (bytes) => bytes.uint32(structure.nodes.flat()));
  });
  const meta = {
    format: "kds-replay",
    version: 2,
    program: run.program ?? "kds test",
    title: run.title ?? "test",
    inputs: run.inputs ?? ["test.pdb"],
    command: run.command ?? "kds view test.pdb -o replay.html",
    dimension: axes,
    degree,
    motion: degree === 1 ? "linear" : "hermite",
    frames: run.frames.length,
    stride: run.stride ?? 1,
    has_times: Boolean(run.times),
    length_unit: "angstrom",
    quantum,
    origin: low,
    block_frames,
    necklaces: run.necklaces ?? [beads],
    beads,
    radius: run.radii ? null : run.radius,
    box: { low, high },
    names: Boolean(run.names),
    structures: run.structures.map((structure) => ({
      name: structure.name,
      kinds: structure.kinds,
      stages: structure.stages,
      events: structure.events.length,
      layers: structure.layers.map((layer) => ({
        name: layer.name,
        arity: layer.arity,
        initial: layer.initial.length,
        changes: structure.events.flatMap((e) => (e.changes ?? []).filter((c) => c.layer === layer.name)).length,
      })),
      nodes: structure.nodes?.length ?? 0,
      spheres: structure.spheres?.nodes.length ?? 0,
      note: structure.note ?? "",
    })),
    blocks: Object.fromEntries([...blocks].map(([name, buffer]) => [name, buffer.length])),
  };
  return { meta, blocks };
}

// Returns the base64 text of each block.
export const packed = (blocks) =>
  new Map([...blocks].map(([name, buffer]) => [name, deflateSync(buffer).toString("base64")]));

// Puts a replay into the page.
export function intoPage(page, { meta, blocks }) {
  const parts = [`<script type="application/json" id="kds-replay">${JSON.stringify(meta).replaceAll("<", "\\u003c")}</script>`];
  for (const [name, text] of packed(blocks))
    parts.push(`<script type="text/plain" class="kds-block" id="kds-block-${name}">${text}</script>`);
  return page.replace("<!--KDS-DATA-->", () => parts.join("\n"));
}
