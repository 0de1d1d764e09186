// Says what an event is, with the names of its beads and of its node, and which beads enter and leave.
import { noBead } from "./events.js";
import { explainKind, namedParts } from "./explain.js";

const axisNames = ["x", "y", "z"];
const shapes = ["vertex", "edge", "triangle", "tetrahedron"];

// Returns {parts, enters, leaves}. `parts` are texts and beads, {bead, mark}; a mark is "enters", "leaves" or "". `names`
// may be null. `changes` are those of RunState.changesOf.
export function eventSentence({ structure, kind, roles, changes, nodes, names, dimension, several }) {
  const ids = Object.fromEntries(roles.map((role) => [role.name, role.ids]));
  const plain = (bead) => ({ bead, mark: "" });
  const enters = (bead) => ({ bead, mark: "enters" });
  const leaves = (bead) => ({ bead, mark: "leaves" });
  const comma = (k, beads) => (k === 0 ? [] : [k + 1 < beads.length ? ", " : " and "]);
  const list = (beads, mark = plain) => beads.flatMap((bead, k) => [...comma(k, beads), mark(bead)]);
  const around = () => `around ${rangeText(...ids.node, names, several)}`;
  const sentences = {
    wrapped: () => {
      const { goes, comes } = exchanged(changes.find(({ name }) => name === "cages"));
      const says = (verb) => (comes.length > 1 ? ` ${verb}` : ` ${verb}s`);
      if (comes.length && goes.length)
        return [...list(comes, enters), says("take"), " the place of ", ...list(goes, leaves), ` on the sphere ${around()}`];
      if (comes.length) return [...list(comes, enters), says("enter"), ` the sphere ${around()}`];
      if (goes.length) return [...list(goes, leaves), goes.length > 1 ? " leave" : " leaves", ` the sphere ${around()}`];
      return null;
    },
    boxes: () => {
      const side = sideText(ids.side[0], dimension);
      return [enters(ids.is[0]), " takes the place of ", leaves(ids.was[0]), ` at the ${side} side of the box ${around()}`];
    },
    power: {
      "2-3": () => [...list(ids.edge, enters), " become neighbours in the power diagram"],
      "3-2": () => [...list(ids.edge, leaves), " are neighbours in the power diagram no more"],
      "2-2": () => [...list(ids.new, enters), " become neighbours in the power diagram in place of ", ...list(ids.gone, leaves)],
      hides: () => [leaves(ids.bead[0]), " loses its power cell between ", ...list(ids.cell)],
      shows: () => [enters(ids.bead[0]), " gets a power cell between ", ...list(ids.cell)],
      wander: () => [plain(ids.bead[0]), ", which is hidden, moves to another place of the power diagram"],
    },
    dual: () => {
      const [shape, way] = kind.split("_");
      const begins = way === "begin";
      const verb = ids.simplex.length > 1 ? "form" : begins ? "becomes" : "is";
      const says = ` ${verb} ${shape === "edge" ? "an" : "a"} ${shape} of the dual complex${begins ? "" : " no more"}`;
      return [...list(ids.simplex, begins ? enters : leaves), says];
    },
    voids: () => {
      const [first, second] = roles[0].ids;
      const shape = shapes[(ids.simplex?.length ?? 0) - 1];
      const at = (before, mark, ...after) => (ids.simplex ? [before, ...list(ids.simplex, mark), ...after] : []);
      const [begins, ends] = shape === "edge"
        ? [[enters, " closes a ring"], [leaves, " breaks a ring"]] : [[leaves, " opens"], [enters, " fills it"]];
      return {
        component_begin: [`component ${first} begins`, ...at(" with ", enters)],
        component_end: [`component ${first} ends`, ...at(" with ", leaves)],
        component_merge: [`component ${second} joins component ${first}`, ...at(" by the edge of ", enters)],
        component_split: [`component ${second} splits off from component ${first}`, ...at(" as the edge of ", leaves, " ends")],
        void_begin: [`void ${first} begins`, ...at(` within the ${shape} of `)],
        void_end: [`void ${first} ends`, ...at(` within the ${shape} of `)],
        void_merge: [`void ${second} joins void ${first}`, ...at(" through the gate of ")],
        void_split: [`void ${second} splits off from void ${first}`, ...at(" at the gate of ")],
        void_open: [`void ${first} opens to the outside`, ...at(" through the gate of ")],
        void_close: [`void ${first} is cut off from the outside`, ...at(" at the gate of ")],
        tunnel_begin: ["a tunnel begins", ...at(` as the ${shape} of `, ...begins)],
        tunnel_end: ["a tunnel ends", ...at(` as the ${shape} of `, ...ends)],
      }[kind];
    },
    contacts: {
      begin: () => [enters(ids.first[0]), " and ", enters(ids.second[0]), " come into contact"],
      end: () => [leaves(ids.first[0]), " and ", leaves(ids.second[0]), " lose contact"],
      touch: () => [enters(ids.first[0]), " and ", enters(ids.second[0]), " touch at this instant only"],
    },
    crossings: () => {
      const verb = kind === "touch" ? "touches" : kind.startsWith("end") ? "passes at a bead through" : "passes through";
      return ["the bond of ", ...list(ids.first), ` ${verb} that of `, ...list(ids.second)];
    },
    sorted: {
      interchange: () => [enters(ids.second[0]), " passes ", leaves(ids.first[0]), " along x", ranksText(changes)],
    },
    hull: {
      enter: () => [enters(ids.corner[0]), " becomes a corner of the hull", ...between(ids)],
      leave: () => [leaves(ids.corner[0]), " is a corner of the hull no more", ...between(ids)],
      interchange: () => [plain(ids.first[0]), " and ", plain(ids.second[0]), " exchange their order along the hull"],
    },
    closest: {
      replace: () => [...list(ids.is, enters), " become the closest pair in place of ", ...list(ids.was, leaves)],
      overtake: () => [...list(ids.is), " come closer than ", ...list(ids.was)],
    },
    spanner: {
      join: () => [enters(ids.first[0]), " and ", enters(ids.second[0]), " become an edge of the spanner"],
      part: () => [leaves(ids.first[0]), " and ", leaves(ids.second[0]), " are no longer an edge of the spanner"],
      rise: () => ids.parent[0] === noBead
        ? [enters(ids.bead[0]), " becomes the root of the spanner"]
        : [enters(ids.bead[0]), ` becomes a centre of level ${ids.level[0]}, under `, plain(ids.parent[0])],
      fall: () => [leaves(ids.bead[0]), ` falls to level ${ids.level[0]}, under `, plain(ids.parent[0])],
      adopt: () => [plain(ids.bead[0]), " gets another parent, ", enters(ids.parent[0])],
    },
    box: () => {
      if (kind === "overtake") return [plain(ids.is[0]), " overtakes ", plain(ids.was[0]), " on the way to an end of the box"];
      const [end, axis] = kind.split("-");
      const side = end === "min" ? "low" : "high";
      return [enters(ids.is[0]), " takes the place of ", leaves(ids.was[0]), ` at the ${side} ${axis} end of the box`];
    },
  };
  const between = ({ corner, before, after }) =>
    before[0] === corner[0] ? [] : [" between ", plain(before[0]), " and ", plain(after[0])];
  const alias = { "4-1": "hides", "3-1": "hides", "1-4": "shows", "1-3": "shows" }[kind] ?? kind;
  const say = typeof sentences[structure] === "function" ? sentences[structure] : sentences[structure]?.[alias];
  let parts = null;
  try {
    parts = say?.() ?? null;
  } catch {
    // An event without these ids, for example of an edit, has the text of its kind.
  }
  parts = parts ? [...parts, "."] : [explainKind(structure, kind) || `${structure}: ${kind}.`];
  const marked = (mark) => {
    const beads = parts.filter((part) => part.mark === mark).map(({ bead }) => bead);
    return [...new Set(beads)].filter((bead) => bead !== noBead);
  };
  return { parts, enters: marked("enters"), leaves: marked("leaves") };
}

// The beads that a change of a cage takes from the basis and adds to it.
function exchanged(change) {
  const [old, now] = [change.removed, change.added].map((words) => [...words].slice(1).filter((bead) => bead !== noBead));
  return { goes: old.filter((bead) => !now.includes(bead)), comes: now.filter((bead) => !old.includes(bead)) };
}

function ranksText(changes) {
  const ranks = changes.filter(({ name }) => name === "order").flatMap(({ added }) => [...added].filter((_, k) => k % 2 === 0));
  return ranks.length === 2 ? `: ranks ${Math.min(...ranks) + 1} and ${Math.max(...ranks) + 1}` : "";
}

export function sideText(side, dimension) {
  const direction = side >> 1;
  return `${side % 2 ? "high" : "low"} ${direction < dimension ? axisNames[direction] : `oblique (direction ${direction + 1})`}`;
}

// Names the beads under a node: "residues 40 to 46", or "beads 3 to 9" without names.
export function rangeText(first, last, names, several) {
  const [from, to] = [first, last].map((bead) => (names ? namedParts(names[bead]) : null));
  if (!from?.number || !to?.number || from.chain !== to.chain)
    return first === last ? `bead ${first}` : `beads ${first} to ${last}`;
  const chain = several && from.chain ? ` of chain ${from.chain}` : "";
  return from.number === to.number ? `residue ${from.number}${chain}` : `residues ${from.number} to ${to.number}${chain}`;
}

// Names a bead: "LEU 42 CA", with its chain if there are several, or "bead 7".
export function beadText(bead, names, several) {
  if (bead === noBead) return "the outside";
  const parts = names ? namedParts(names[bead]) : null;
  if (!parts) return names?.[bead] || `bead ${bead}`;
  const chain = several && parts.chain ? ` of ${parts.chain}` : "";
  return [parts.residue, parts.number, parts.atom].filter(Boolean).join(" ") + chain;
}

export const textOf = (parts, names, several) =>
  parts.map((part, k) => {
    const text = typeof part === "string" ? part : beadText(part.bead, names, several);
    return k === 0 ? text.slice(0, 1).toUpperCase() + text.slice(1) : text;
  }).join("");
