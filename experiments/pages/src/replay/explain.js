// Explains structures and kinds of events in a sentence each. A structure that is not listed is shown without one.

import { count } from "../shared/dom.js";

const structures = {
  wrapped: "Wrapped hierarchy: a balanced tree of cages. A cage is the smallest sphere around the beads of its node.",
  boxes:
    "Hierarchy of boxes: each node of a balanced tree has the smallest box around its beads. " +
    "The page draws the sides along the axes.",
  layered: "Layered hierarchy: each node of a balanced tree has a sphere around the spheres of its two children.",
  power: "Power diagram: an edge joins two beads whose cells share a face.",
  dual: "Dual complex: sets of up to four beads whose balls meet within their power cells.",
  voids: "Voids: components, tunnels and voids of the union of balls. A void is a space that the union encloses.",
  contacts: "Contacts: pairs of beads that are at most the cutoff apart, by default those that touch or overlap.",
  crossings: "Crossings: moments at which two bonds that share no bead pass through each other or touch.",
  sorted: "Sorted list: the beads in order along an axis.",
  box: "Enclosing box: the smallest box around all beads.",
  hull: "Convex hull of the beads in the plane.",
  closest: "Closest pair: the two beads with the least distance.",
  spanner: "Spanner: a graph of the beads with short paths, on a hierarchy of discrete centres.",
};

const kinds = {
  wrapped: {
    enter: "A bead reaches the sphere of this cage and joins the basis, the beads that hold the sphere.",
    leave: "A bead of the basis is no longer needed to hold the sphere of this cage.",
    pivot: "A bead reaches the sphere of this cage and takes the place of another bead in the basis.",
  },
  power: {
    "2-3": "Two tetrahedra with a common triangle become three around a new edge.",
    "3-2": "Three tetrahedra around an edge become two. The edge goes.",
    "2-2": "Two triangles exchange their common edge for the other diagonal.",
    "4-1": "A bead loses its power cell and is hidden: four tetrahedra become one.",
    "1-4": "A hidden bead gets a power cell: one tetrahedron becomes four.",
    "3-1": "A bead loses its power cell and is hidden: three triangles become one.",
    "1-3": "A hidden bead gets a power cell: one triangle becomes three.",
    wander: "A hidden bead moves into another cell of the triangulation.",
    rebuild: "Flips block each other here, so the diagram is built anew.",
    "rebuild-at-frame": "The diagram is built anew at this frame.",
    clear: "Cells go, where flips block each other.",
    fill: "Cells come, where flips block each other.",
    repair: "The diagram is repaired, where flips block each other.",
  },
  contacts: {
    begin: "Two beads come into contact.",
    end: "The contact of two beads ends.",
    touch: "Two beads are in contact at this one instant.",
  },
  crossings: {
    cross_plus: "Two bonds pass through each other. The linking number of closed strands along them rises by one.",
    cross_minus: "Two bonds pass through each other. The linking number of closed strands along them falls by one.",
    end_plus: "An end of a bond passes through another bond. The strand passes if both bonds at the bead have an end_plus event.",
    end_minus: "An end of a bond passes through another bond. The strand passes if both bonds at the bead have an end_minus event.",
    touch: "Two bonds touch without passing through each other.",
  },
  dual: Object.fromEntries(["vertex", "edge", "triangle", "tetrahedron"].flatMap((shape) => [
    [`${shape}_begin`, `A ${shape} begins: its balls meet within their power cells.`],
    [`${shape}_end`, `A ${shape} ends: its balls no longer meet within their power cells.`],
  ])),
  voids: {
    component_begin: "A ball begins a component.", component_end: "The last ball of a component leaves the union.",
    component_merge: "Two components meet and become one, which keeps the first number.",
    component_split: "A component falls into two. The second number is new.",
    void_begin: "A void begins between balls that no longer share a point.",
    void_end: "A void ends: the balls around it share a point.",
    void_merge: "A gate opens between two voids. The void that remains has the first number.",
    void_split: "A gate closes and divides a void into two. The second number is new.",
    void_open: "A gate opens between a void and the outside. The void ends.",
    void_close: "A gate closes and cuts off a part of the outside, which becomes a void.",
    cell_begin: "A cell becomes part of a void.", cell_end: "A cell is no longer part of a void.",
    tunnel_begin: "A tunnel through the union begins: an edge closes a ring, or a triangle within a ring opens.",
    tunnel_end: "A tunnel through the union ends: a triangle fills a ring, or an edge of the ring breaks.",
  },
  sorted: { interchange: "Two neighbours in the list exchange places." },
  hull: {
    enter: "A bead becomes a corner of the hull.",
    leave: "A corner of the hull moves inside.",
    interchange: "Two corners exchange their order along an axis.",
  },
  closest: { replace: "Another pair becomes the closest.", overtake: "A pair overtakes another within the tournament." },
  spanner: {
    join: "An edge of the spanner begins: two centres of a level come within its reach.",
    part: "An edge of the spanner ends.",
    rise: "A bead becomes a centre of a higher level, because no other centre covers it.",
    fall: "A bead is no longer a centre of its highest level, because another centre is too near.",
    adopt: "A bead leaves the reach of its parent and takes another one.",
    rescale: "The edge is now that of another level.",
  },
  boxes: { support: "Another bead holds a side of this box." },
  box: { overtake: "A bead overtakes another within the tournament for an end of the box." },
};

export const explainStructure = (name) => structures[name] ?? "";
export const explainKind = (structure, kind) =>
  kinds[structure]?.[kind] ?? (structure === "box" && /^(min|max)-/.test(kind) ? "Another bead holds this end of the box." : "");

// Splits a bead's name, such as "A/LEU42/CA", into chain, residue and atom.
export function residueOf(name) {
  const parts = name.split("/");
  return parts.length === 3 ? { chain: parts[0], residue: parts[1], atom: parts[2] } : null;
}

// Splits a bead's name further, such as "A/LEU42/CA" into A, LEU, 42 and CA.
export function namedParts(name) {
  const parts = residueOf(name);
  if (!parts) return null;
  const [, residue, number] = /^(.*?)(-?\d+[A-Za-z]?)$/.exec(parts.residue) ?? [null, parts.residue, ""];
  return { chain: parts.chain, residue, number, atom: parts.atom };
}

// Returns the unit of the times, which are in picoseconds: femtoseconds if frames follow each other within 0.1 ps.
export function timeUnit(times) {
  const short = times.length > 1 && Math.abs(times.at(-1) - times[0]) < 0.1 * (times.length - 1);
  return short ? { name: "fs", perPicosecond: 1000 } : { name: "ps", perPicosecond: 1 };
}

// Writes a time of the run: fs or ps if known, and the frame.
export function timeText(step, u, frames, times) {
  const last = step + 1 >= frames.length;
  const from = frames[step];
  const to = last ? from : frames[step + 1];
  const frame = u === 0 ? `frame ${from}` : `frame ${trim(from + (to - from) * u, 6)}`;
  if (!times) return frame;
  const { name, perPicosecond } = timeUnit(times);
  const at = last ? times[step] : times[step] + (times[step + 1] - times[step]) * u;
  return `${trim(at * perPicosecond, 6)} ${name}, ${frame}`;
}

// Returns the number of decimals that positions rounded to multiples of `quantum` need.
export const decimals = (quantum) => Math.min(100, Math.max(0, Math.ceil(-Math.log10(quantum))));

// Times of events are multiples of 2^-32, so 32 decimals are exact.
const allDecimals = 32;
const bracketDecimals = 10;

export const exactText = (u) => u.toFixed(allDecimals).replace(/\.?0+$/, "");
// Returns the largest number of few decimals that is at most u.
export const lowerText = (u) => u.toFixed(allDecimals).slice(0, 2 + bracketDecimals);
// Returns the smallest number of few decimals that is at least u.
export function upperText(u) {
  const below = lowerText(u);
  if (/^0*$/.test(u.toFixed(allDecimals).slice(below.length))) return below;
  const next = String(BigInt(below.replace(".", "")) + 1n).padStart(1 + bracketDecimals, "0");
  return `${next.slice(0, 1)}.${next.slice(1)}`;
}

// Returns numerator / 2^exponent. `ids` are the exponent, then the 32-bit words of the numerator, lowest first.
export const dyadic = ([exponent, ...words]) =>
  words.reduceRight((sum, word) => sum * 2 ** 32 + word, 0) / 2 ** exponent;

export const trim = (value, digits) => String(Number(value.toFixed(digits)));

// Returns the unit of lengths, or an empty text.
export const lengthUnit = ({ length_unit: unit }) => (unit === "angstrom" ? "Å" : unit);

// Returns the line below the title. Internal events are not among `events`.
export function subtitle(meta, events) {
  const stride = meta.stride > 1 ? ` (one in ${meta.stride} of the input)` : "";
  return `${count(meta.beads, "bead")}, ${count(meta.frames, "frame")}${stride}, ${count(events, "event")}`;
}

// Returns the text at the foot of the panel: input, motion, rounding and command of the replay.
export function aboutText(meta) {
  const unit = meta.length_unit ? ` ${meta.length_unit}` : "";
  const note = meta.quantum_note ? ` (${meta.quantum_note})` : "";
  const parts = [
    `Input: ${meta.inputs.join(", ")}.`,
    `Motion between frames: ${meta.motion}.`,
    `Positions are rounded to multiples of ${meta.quantum}${unit}${note}.`,
    "Events come from the exact motion; their times are shown to 2^-32 of a step, in brackets that hold the true times.",
    ...(meta.stride > 1 ? [`The run takes one frame in ${meta.stride} of the input, which keeps the page small.`] : []),
    `Made by ${meta.program}: ${meta.command}`,
  ];
  return parts.join(" ");
}
