// Residues of the beads, from their names. Without names each bead counts as a residue.
import { namedParts, residueOf } from "./explain.js";

// Returns {of, list}: the residue of each bead, and all residues, {chain, type, number, beads, title}.
export function residuesOf(meta, names) {
  const of = new Uint32Array(meta.beads);
  const list = [];
  const chains = new Set();
  let known = null;
  meta.necklaces.flatMap((count, n) => Array(count).fill(n)).forEach((necklace, bead) => {
    const parts = names ? namedParts(names[bead]) : null;
    const key = parts ? `${necklace}/${parts.chain}/${parts.residue}/${parts.number}` : bead;
    if (key !== known) {
      known = key;
      const [type, number] = parts ? [parts.residue, parts.number] : ["", `${bead}`];
      chains.add(parts?.chain);
      const title = parts ? `${type} ${number}`.trim() : names?.[bead] ?? `bead ${bead}`;
      list.push({ chain: parts?.chain ?? "", type, number, necklace, beads: [], title });
    }
    list.at(-1).beads.push(bead);
    of[bead] = list.length - 1;
  });
  if (chains.size > 1) for (const residue of list) if (residue.chain) residue.title = `${residue.chain} ${residue.title}`;
  return { of, list };
}

// Returns the beads that the trace of each chain goes through: the CA atoms, or all beads of a chain without such atoms.
export function traceOf(meta, names) {
  let first = 0;
  return meta.necklaces.map((count) => {
    const beads = Array.from({ length: count }, (_, k) => first + k);
    first += count;
    const alphas = beads.filter((bead) => names && residueOf(names[bead])?.atom === "CA");
    return alphas.length > 1 ? alphas : beads;
  });
}

// Returns the residues that a text names, such as "LEU 42", "42", "A/LEU42/CA", "leu" or "bead 17", the best first.
export function findResidues({ of, list }, text) {
  const bead = text.trim().match(/^(?:bead\s*|#)(\d+)$/i);
  if (bead) return Number(bead[1]) < of.length ? [of[Number(bead[1])]] : [];
  const words = text.toUpperCase().replace(/([A-Z])(-?\d)/g, "$1 $2").split(/[\s/:,]+/).filter(Boolean);
  if (words.length === 0) return [];
  // The words name chain, type and number in this order; after the number may follow an atom.
  const fits = ({ chain, type, number, title }) => {
    const parts = [chain, type, number].map((part) => part.toUpperCase());
    let from = 0;
    for (const word of words) {
      if (from === parts.length) break;
      const at = parts.indexOf(word, from);
      if (at < 0) return title.toUpperCase() === text.trim().toUpperCase();
      from = at + 1;
    }
    return true;
  };
  return list.flatMap((residue, r) => (fits(residue) ? [r] : []));
}
