import assert from "node:assert/strict";
import test from "node:test";
import { ColumnReader, fromBase64, inflate } from "../src/shared/codec.js";
import { Blocks, metaOfPage } from "../src/replay/blocks.js";
import { encodeReplay, intoPage, packed } from "./encode_replay.mjs";
import { sampleRun } from "./sample_run.mjs";

test("varints of all lengths are read", () => {
  const bytes = [0, 1, 2, 0x7f, 0x80, 0x01, 0xff, 0xff, 0xff, 0xff, 0x0f, 0xfe, 0xff, 0xff, 0xff, 0x0f];
  const reader = new ColumnReader(Uint8Array.from(bytes));
  const values = [];
  while (!reader.ended) values.push(reader.next());
  assert.deepEqual(values, [0, -1, 1, -64, 64, -2147483648, 2147483647]);
});

test("a varint that is cut off or too long is refused", () => {
  assert.throws(() => new ColumnReader(Uint8Array.of(0x80)).next(), /ends inside a number/);
  assert.throws(() => new ColumnReader(new Uint8Array(6).fill(0x80)).next(), /more than 32 bits/);
});

test("long varints are read, and those beyond 53 bits refused", () => {
  const bytes = [0x80, 0x80, 0x80, 0x80, 0x20, 0xff, 0xff, 0xff, 0xff, 0x1f];
  const reader = new ColumnReader(Uint8Array.from(bytes));
  assert.deepEqual([reader.nextLong(), reader.nextLong()], [2 ** 32, -(2 ** 32)]);
  assert.throws(() => new ColumnReader(new Uint8Array(9).fill(0x80)).nextLong(), /more than 53 bits/);
});

test("words are sums of their differences, also around 2^32", () => {
  const words = new ColumnReader(Uint8Array.of(0x0a, 0x0b, 0x06)).words(3);
  assert.deepEqual([...words], [5, 0xffffffff, 2]);
});

test("blocks are unpacked, and damage is named", async () => {
  const { meta, blocks } = encodeReplay(sampleRun({ beads: 8, frames: 4 }));
  const texts = packed(blocks);
  for (const [name, buffer] of blocks)
    if (buffer.length) assert.deepEqual(Buffer.from(await inflate(fromBase64(texts.get(name)))), buffer);
  const read = (textOf, sizes = meta.blocks) => new Blocks(textOf, sizes).bytes("frames");
  await assert.rejects(read(() => null), /lacks its block 'frames'/);
  await assert.rejects(read(() => "AAAA"), /cannot unpack block 'frames'/);
  await assert.rejects(read((name) => texts.get(name), { frames: 3 }), /has 16 bytes, expected 3/);
});

test("a name that ends a script element stays inside the data", () => {
  const run = sampleRun({ beads: 8, frames: 4, title: "</script><script>alert(1)</script>" });
  const page = intoPage("<body><!--KDS-DATA--></body>", encodeReplay(run));
  assert.equal(page.match(/alert/g).length, 1);
  assert.ok(!page.includes("<script>alert"));
});

test("a page without a replay, one that is cut off and one of another version are refused", () => {
  const page = (meta, block) => ({
    getElementById: () => (meta ? { textContent: JSON.stringify(meta) } : null),
    querySelector: () => block,
  });
  assert.throws(() => metaOfPage(page(null, null)), /has no replay in it: write one with 'kds view/);
  assert.throws(() => metaOfPage(page(null, {})), /cut off/);
  assert.throws(() => metaOfPage({ getElementById: () => ({ textContent: '{"format": "kds-' }) }), /cut off/);
  assert.throws(() => metaOfPage(page({ format: "kds-replay", version: 1 })), /is of format 'kds-replay' 1, .* 'kds-replay' 2/);
  assert.equal(metaOfPage(page({ format: "kds-replay", version: 2 })).version, 2);
});
