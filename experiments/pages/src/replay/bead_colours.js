// Colours of beads and traces: along the chain, by chain, by type of residue, or by the life of their contacts.
import { categories, rgb } from "../shared/palette.js";
import { alongChain } from "./colours.js";

const classes = [
  ["hydrophobic", 1, "ALA VAL LEU ILE MET PHE TRP TYR NLE"],
  ["polar", 2, "SER THR ASN GLN CYS CYX HIS HSD HSE HSP HID HIE HIP"],
  ["positive", 0, "LYS ARG"],
  ["negative", 5, "ASP GLU"],
  ["glycine, proline", 3, "GLY PRO"],
  ["other", 6, ""],
];

const classOf = (type) => {
  const found = classes.findIndex(([, , types]) => types.split(" ").includes(type));
  return found < 0 ? classes.length - 1 : found;
};

// The modes that suit a run, [name, text], the first being the one without a choice.
export function colourModes(meta, names, pairs) {
  const modes = [["along", "along the chain"], ["chain", "by chain"]];
  if (meta.necklaces.length > 1) modes.reverse();
  if (names) modes.push(["type", "by type of residue"]);
  if (pairs.some(({ changes }) => changes > 0)) modes.push(["life", "by life of contacts"]);
  return modes;
}

// Returns the mean life of the contacts of each residue, in steps, or NaN. Contacts that never change are left out.
export function contactLives({ of, list }, pairs) {
  const sums = list.map(() => [0, 0]);
  for (const { pair, spans, total, changes } of pairs) {
    if (changes === 0) continue;
    for (const residue of new Set([of[pair[0]], of[pair[1]]])) {
      sums[residue][0] += total;
      sums[residue][1] += spans.length;
    }
  }
  return sums.map(([time, count]) => time / count);
}

// Returns {of(bead), legend}. A legend is {title, ramp, low, high} or {title, entries: [[colour, text]]}.
export function beadColours(mode, { meta, residues, pairs, dark, durationText }) {
  const palette = categories[dark ? "dark" : "light"].map(rgb);
  const ramp = Array.from({ length: 9 }, (_, k) => alongChain(k / 8, dark));
  const { of, list } = residues;
  if (mode === "type") {
    const own = list.map(({ type }) => classOf(type));
    const entries = classes.flatMap(([text, c], k) => (own.includes(k) ? [[palette[c], text]] : []));
    return { of: (bead) => palette[classes[own[of[bead]]][1]], legend: { title: "type of residue", entries } };
  }
  if (mode === "life") {
    const lives = contactLives(residues, pairs);
    const logs = lives.filter((life) => life > 0).map(Math.log);
    const [low, high] = [logs.reduce((a, b) => Math.min(a, b), Infinity), logs.reduce((a, b) => Math.max(a, b), -Infinity)];
    const at = (life) => (high > low ? (Math.log(life) - low) / (high - low) : 0.5);
    const colours = lives.map((life) => (life > 0 ? alongChain(at(life), dark) : palette[6]));
    const [least, most] = [low, high].map((log) => durationText(Math.exp(log)));
    const title = "mean life of contacts that change";
    return { of: (bead) => colours[of[bead]], legend: { title, ramp, low: least.split(" ")[0], high: most } };
  }
  const firsts = [];
  meta.necklaces.reduce((sum, count, n) => ((firsts[n] = sum), sum + count), 0);
  const necklace = (bead) => list[of[bead]].necklace;
  if (mode === "along") {
    const share = (bead, n) => (bead - firsts[n]) / Math.max(1, meta.necklaces[n] - 1);
    const legend = { title: "along the chain", ramp, low: "first", high: "last" };
    return { of: (bead) => alongChain(share(bead, necklace(bead)), dark), legend };
  }
  const text = (n) => (list[of[firsts[n]]].chain ? `chain ${list[of[firsts[n]]].chain}` : `chain ${n + 1}`);
  const entries = firsts.slice(0, 8).map((_, n) => [palette[n % 8], text(n)]);
  return { of: (bead) => palette[necklace(bead) % 8], legend: { title: "chains", entries } };
}
