import assert from "node:assert/strict";
import test from "node:test";
import { beadColours, colourModes, contactLives } from "../src/replay/bead_colours.js";
import { contactFilter, residueContacts } from "../src/replay/contact_map.js";
import { contactIntervals } from "../src/replay/contact_intervals.js";
import { EventFilter } from "../src/replay/event_filter.js";
import { linesOf, roundLength } from "../src/replay/export.js";
import { lastEvent } from "../src/replay/film.js";
import { distanceOf } from "../src/replay/measure.js";
import { findResidues, residuesOf, traceOf } from "../src/replay/residues.js";
import { segmentsOf } from "../src/replay/trace.js";
import { crc32, zip } from "../src/replay/zip.js";
import { loadRun } from "./load_run.mjs";
import { random, sampleRun } from "./sample_run.mjs";

const run = sampleRun({ beads: 24, frames: 8 });
const { meta, state } = await loadRun(run);
const residues = residuesOf(meta, run.names);
const s = state.structures.findIndex(({ name }) => name === "contacts");
const layer = state.structures[s].layers.find(({ name }) => name === "contacts");
const pairs = contactIntervals(layer, state.structures[s].events, state.lastStep).map((row) => ({ ...row, s }));

test("beads of one residue stand together, and without names each bead is one", () => {
  assert.equal(residues.list.length, 8);
  assert.deepEqual(residues.list[5], { chain: "B", type: "ALA", number: "2", necklace: 1, beads: [15, 16, 17],
      title: "B ALA 2" });
  assert.deepEqual([...residues.of.slice(0, 4)], [0, 0, 0, 1]);
  const unnamed = residuesOf(meta, null);
  assert.equal(unnamed.list.length, 24);
  assert.equal(unnamed.list[7].title, "bead 7");
  const one = residuesOf({ beads: 3, necklaces: [3] }, ["A/DA5/P", "A/2MG10/P", "A/LEU42A/CA"]);
  assert.deepEqual(one.list.map(({ title }) => title), ["DA 5", "2MG 10", "LEU 42A"]);
});

test("residues are found by type, number, chain, atom and bead", () => {
  const find = (text) => findResidues(residues, text);
  for (const text of ["B ALA 2", "b/ala2", "B/ALA2/CA", "b 2", "bead 16", "#16"]) assert.deepEqual(find(text), [5], text);
  assert.deepEqual(find("ala 2"), [1, 5]);
  assert.deepEqual(find("3 CA"), [2, 6]);
  assert.equal(find("ALA").length, 8);
  for (const text of ["", " ", "LEU 2", "ALA 99", "bead 24", "2 ALA"]) assert.deepEqual(find(text),
    text === "2 ALA" ? [1, 5] : [], text);
  assert.deepEqual(findResidues(residuesOf(meta, null), "17"), [17]);
});

test("a trace goes through the CA atoms, or through all beads", () => {
  assert.deepEqual(traceOf(meta, run.names), [[1, 4, 7, 10], [13, 16, 19, 22]]);
  assert.deepEqual(traceOf(meta, null)[1], Array.from({ length: 12 }, (_, k) => 12 + k));
  assert.deepEqual(segmentsOf([[1, 4, 7]]), [[1, 1, 4, 7], [1, 4, 7, 7]]);
});

test("the contacts of residues agree with those found by sampling", () => {
  const contacts = residueContacts(residues, pairs, state.lastStep);
  const samples = 20000;
  const counts = new Map();
  let before = null;
  const changes = new Map();
  for (let k = 0; k < samples; ++k) {
    const time = ((k + 0.5) / samples) * state.lastStep;
    const inContact = new Set();
    for (const { pair, spans } of pairs) {
      const own = pair.map((bead) => residues.of[bead]).sort((a, b) => a - b);
      if (own[0] !== own[1] && spans.some(({ from, to }) => time >= from && time < to)) inContact.add(own[0] * 8 + own[1]);
    }
    for (const key of inContact) counts.set(key, (counts.get(key) ?? 0) + 1);
    for (const key of before ? [...inContact, ...before] : []) if (inContact.has(key) !== before.has(key)) changes.set(key,
      (changes.get(key) ?? 0) + 1);
    before = inContact;
  }
  assert.ok(contacts.size > 3);
  for (const [key, { share, changes: own }] of contacts) {
    assert.ok(Math.abs(share - (counts.get(key) ?? 0) / samples) < 1e-3, `share of ${key}`);
    assert.equal(own, changes.get(key) ?? 0, `changes of ${key}`);
  }
});

test("only the pairs that change most are drawn", () => {
  const words = Uint32Array.from(pairs.flatMap(({ pair }) => pair));
  assert.equal(contactFilter(pairs, "all")(words), words);
  const kept = contactFilter(pairs, "2")(words);
  assert.deepEqual([...kept], [...pairs[0].pair, ...pairs[1].pair]);
  assert.ok(pairs.every((row, k) => k === 0 || row.changes <= pairs[k - 1].changes));
  const still = [{ pair: [0, 1], changes: 1 }, { pair: [2, 3], changes: 0 }];
  assert.deepEqual([...contactFilter(still, "changing")(Uint32Array.of(0, 1, 2, 3))], [0, 1]);
});

test("colours tell chains, types and lives apart", () => {
  assert.deepEqual(colourModes(meta, run.names, pairs).map(([name]) => name), ["chain", "along", "type", "life"]);
  assert.deepEqual(colourModes({ necklaces: [3] }, null, []).map(([name]) => name), ["along", "chain"]);
  const colours = (mode) => beadColours(mode, { meta, residues, pairs, dark: false, durationText: String });
  const { of, legend } = colours("chain");
  assert.deepEqual(legend.entries.map(([, text]) => text), ["chain A", "chain B"]);
  assert.notDeepEqual(of(0), of(12));
  assert.deepEqual(colours("type").legend.entries.map(([, text]) => text), ["hydrophobic"]);
  assert.deepEqual(colours("along").of(0), colours("along").of(12));
  const lives = contactLives(residues, [{ pair: [0, 3], total: 3, changes: 3, spans: [{}, {}] },
      { pair: [0, 6], total: 7, changes: 0, spans: [{}] }]);
  assert.deepEqual(lives.slice(0, 3), [1.5, 1.5, NaN]);
  const low = Number(colours("life").legend.low);
  assert.ok(Math.abs(low - Math.min(...contactLives(residues, pairs).filter((life) => life > 0))) < 1e-9 * low);
});

test("distances, lines of text and scale bars", () => {
  assert.equal(distanceOf([0, 0, 0, 1, 2, 2], 0, 1), 3);
  assert.deepEqual(linesOf("one two three", 7, (text) => text.length), ["one two", "three"]);
  assert.deepEqual([0.31, 1, 7, 49, 50].map(roundLength), [0.2, 1, 5, 20, 50]);
});

test("a film tells of the last event that is switched on", () => {
  const { structures } = state;
  const filter = new EventFilter(structures);
  // The slow twin looks at all events.
  const slow = (time, span) => {
    const all = structures.flatMap(({ events }, s) => Array.from({ length: events.count }, (_, e) => [s, e]));
    const near = all.filter(([s, e]) => filter.takes(s, e) && structures[s].events.time[e] < time + 1e-12);
    const order = ([s, e]) => structures[s].events.order[e];
    const lasts = structures.flatMap((_, s) => near.filter(([other]) => other === s).slice(-1));
    const late = lasts.filter(([s, e]) => structures[s].events.time[e] >= time - span);
    return late.sort((a, b) => order(a) - order(b)).at(-1) ?? null;
  };
  const next = random(5);
  const seen = new Set();
  for (const words of [[], ["0"], [`${s}.0`, "0", "1"], [`${s}`], ["0", "1", "2"]]) {
    filter.words = words;
    for (let k = 0; k < 40; ++k) {
      const [time, span] = [7 * next(), 0.3 * next()];
      const last = lastEvent(structures, filter.stops, time, span);
      assert.deepEqual(last, slow(time, span), `${words} at ${time}`);
      seen.add(String(last?.[0]));
    }
  }
  assert.deepEqual([...seen].sort(), ["0", "1", "2", "undefined"]);
});

test("an archive has the checksums and places that readers want", async () => {
  const next = random(3);
  const bytes = Uint8Array.from({ length: 1000 }, () => 256 * next());

  assert.equal(crc32(new TextEncoder().encode("123456789")), 0xcbf43926);
  const archive = Buffer.from(await zip([["a.png", bytes], ["b.png", bytes.subarray(5)]]).arrayBuffer());
  const end = archive.length - 22;
  assert.deepEqual([archive.readUInt32LE(end), archive.readUInt16LE(end + 10)], [0x06054b50, 2]);
  let at = archive.readUInt32LE(end + 16);
  for (const [name, content] of [["a.png", bytes], ["b.png", bytes.subarray(5)]]) {
    assert.equal(archive.readUInt32LE(at + 16), crc32(content));
    const start = archive.readUInt32LE(at + 42) + 30 + name.length;
    assert.deepEqual([...archive.subarray(start, start + content.length)], [...content]);
    assert.equal(archive.toString("ascii", at + 46, at + 46 + name.length), name);
    at += 46 + name.length;
  }
});
