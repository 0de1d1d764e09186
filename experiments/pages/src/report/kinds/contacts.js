// The page of kds contacts: which contacts persist, and how long contacts last.
import { briefInterval, interval, known, num, percent, plural } from "../format.js";
import { coursePlot, pairMap, seriesPlot, ticksAt } from "../plots.js";
import { leftOutSection, leftOutSentence } from "../left_out.js";
import { dataOf, endOf, filesOf, lengthText } from "../result.js";
import { column, withInterval } from "../table_text.js";

const kPersistent = 0.9;

// Returns "with a cutoff of 6 Å", or "for contacts that begin within 8 Å and end beyond 10 Å".
function cutoffText({ settings: { cutoff, surface }, input }) {
  const [begin, end] = String(cutoff).split(":").map((length) => lengthText(length, input));
  const between = surface ? " between surfaces" : "";
  return end ? `for contacts that begin within ${begin} and end beyond ${end}${between}` : `with a cutoff of ${begin}${between}`;
}

const nouns = { residue: "residues", bead: "beads", chain: "chains" };

// Sorts pairs by their share of the time in contact, then by their longest contact.
const persistence = (a, b) => b.occupancy - a.occupancy || b.longest - a.longest || b.total - a.total || a.i - b.i || a.j - b.j;

function sentences(result) {
  const { all, rows, unit, by } = result;
  const data = dataOf(result);
  if (rows.length === 0)
    return [`No two ${nouns[by]} of ${data} come into contact ${cutoffText(result)}. Try a larger --cutoff or a ` +
      `smaller --apart.`, []];
  const often = rows.filter(({ occupancy }) => occupancy > kPersistent);
  const sure = often.filter(({ occupancy_lower: lower }) => known(lower) && lower > kPersistent);
  const always = often.filter(({ occupancy }) => occupancy === 1).length, others = often.length - always;
  const howSure = [always > 0 && `${num(always)} all the time`,
    others > 0 && `${num(sure.length)} of ${always > 0 ? "the other " : ""}${num(others)} even at the lower end of the 95% interval`]
    .filter(Boolean);
  const life = all.residence === null ? `no contact ends within the run of ${num(result.run_length)} ${unit}`
    : `a contact lasts ${interval(all.residence, all.residence_lower, all.residence_upper, unit)} on average`;
  const answer = `${num(often.length)} of ${plural(all.pairs_asked, "pair")} of ${nouns[by]} ` +
    `${often.length === 1 || all.pairs_asked === 1 ? "is" : "are"} in contact for more than 90% of the time` +
    (often.length > 0 ? ` (${howSure.join(", ")})` : "") +
    `; ${life}.`;
  const more = [`${plural(all.pairs, "pair")} ${all.pairs === 1 ? "is" : "are"} ever in contact, in ` +
    `${plural(all.contacts, "contact")}. ` +
    `A pair is in contact for ${interval(all.occupancy, all.occupancy_lower, all.occupancy_upper, "", percent)} of the ` +
      `time, averaged over all pairs.` +
    (!known(all.median) ? "" : ` Half of the contacts end within ` +
      `${interval(all.median, all.median_lower, all.median_upper, unit)}` +
      `${all.residence > 1.2 * all.median ? "; the mean is longer, because a few long contacts raise it" : ""}.`)];
  if (result.stride) more.push(leftOutSentence(result));
  if (all.residence_upper > result.run_length || all.residence > result.run_length)
    more.push(`The run lasts ${num(result.run_length)} ${unit}, which is short compared with the life of its contacts. A ` +
      `longer run narrows the interval.`);
  return [answer, more];
}

function map(result, rows) {
  const { names } = result;
  return {
    title: `Contact map: share of the time in contact`,
    note: `by ${result.by}; ${plural(rows.length, "pair")}`,
    draw: (size) => pairMap(rows.map((row) => ({
      ...row, value: row.occupancy,
      text: `in contact ${briefInterval(row.occupancy, row.occupancy_lower, row.occupancy_upper, percent)} of the time\n` +
        `mean life ${briefInterval(row.residence, row.residence_lower, row.residence_upper)} ` +
          `${result.unit}\n${plural(row.contacts, "contact")}`,
    })), names, size, { label: "share of the time in contact (occupancy)", axis: result.by, tickFormat: "%" }),
    columns: [column("first"), column("second"), column("i"), column("j"), withInterval("occupancy", "occupancy")], rows,
  };
}

function survival({ survival, unit, all }) {
  if (!survival?.length) return null;
  const points = [{ x: 0, y: 1, lower: 1, upper: 1 }, ...survival.map(({ length, survival: y, lower, upper }) =>
    ({ x: length, y, lower, upper, text: briefInterval(y, lower, upper, percent) }))];
  const positive = points.filter(({ x }) => x > 0);
  return {
    title: "Survival: share of contacts that last longer than a time",
    note: `The band is the 95% interval. ${plural(all.open_at_start, "contact")} that began before the first frame ` +
      `${all.open_at_start === 1 ? "is" : "are"} left out.`,
    draw: (size) => coursePlot(positive, size, { step: true,
      x: { type: "log", label: `time since the contact began (${unit})`,
        tickFormat: (v) => (/^1e/.test(v.toExponential()) ? String(v) : "") },
      y: { label: "share of contacts that last", domain: [0, 1], tickFormat: "%" } }),
    columns: [column("x", "", { key: `length_${unit}` }), column("y", "", { key: "survival" }), column("lower"),
      column("upper")], rows: points,
  };
}

function course(result) {
  const { course } = result;
  if (!course?.length) return null;
  const timed = course[0].picoseconds !== null;
  const points = course.map(({ frame, picoseconds, contacts }) =>
    ({ x: timed ? picoseconds : frame, y: contacts, text: num(contacts) }));
  return {
    title: "Pairs in contact over time", note: "mean of each span",
    draw: (size) => coursePlot([...points, { ...points.at(-1), x: endOf(result, timed) }], size,
      { step: true, x: { label: timed ? "time (ps)" : "frame" },
        y: { label: "pairs in contact", zero: true } }),
    columns: [column("x", "", { key: timed ? "picoseconds" : "frame" }), column("y", "", { key: "pairs_in_contact" })],
    rows: points,
  };
}

const spacingText = (spacing) => (spacing === null ? "exact" : spacing < 1 ? `${Math.round(1 / spacing)} times a frame`
  : spacing === 1 ? "every frame" : `one frame in ${spacing}`);

// Returns the section that compares contacts counted at samples with the exact ones, or null.
function samples(result) {
  const rows = result.frames.map((row) => ({ ...row, name: spacingText(row.spacing) }));
  const exact = rows.find(({ spacing }) => spacing === null),
    sampled = rows.filter(({ spacing }) => spacing !== null && spacing >= 1);
  if (!exact || exact.plain_contacts === 0 || sampled.length === 0) return null;
  const kinds = [["plain", "counted at frames alone"],
    ["bridged", `absences of up to ${plural(Number(result.settings.intermittency ?? 1), "sample")} bridged`],
    ["dual", "two cutoffs at frames"]]
    .filter(([kind]) => sampled.some((row) => known(row[`${kind}_length`])));
  const series = [
    { name: "exact, for straight paths", points: sampled
      .map(({ spacing }) => ({ x: spacing, y: exact.plain_length, text: num(exact.plain_length) })) },
    ...kinds.map(([kind, name]) => ({ name, points: sampled.filter((row) => row[`${kind}_length`])
        .map((row) => ({ x: row.spacing, y: row[`${kind}_length`], text: num(row[`${kind}_length`]) })) })),
  ];
  const worst = sampled.find(({ spacing }) => spacing === 8) ?? sampled.at(-1);
  const columns = [column("name", "looked at"), column("samples"), column("found", "exact contacts seen"),
    ...[["plain", "frames alone"], ["bridged", "bridged"], ["dual", "two cutoffs"]]
      .filter(([kind]) => kind === "plain" || kinds.some(([other]) => other === kind))
      .flatMap(([kind, name]) => [column(`${kind}_contacts`, `${name}: contacts`),
          column(`${kind}_length`, `${name}: mean length (${result.unit})`),
        column(`${kind}_occupancy`, `${name}: occupancy`, { write: percent })])];
  return {
    heading: "What the spacing of frames shows",
    note: `Looking only at ${worst.name} sees ${num(worst.found)} of the ${plural(exact.plain_contacts, "contact")}, and ` +
      `makes the mean contact ${num(worst.plain_length)} ` +
      `instead of ${num(exact.plain_length)} ${result.unit} long. Exact values hold for straight paths between the frames ` +
        `that were read.`,
    parts: [{
      title: "Mean length of contacts by spacing of frames",
      draw: (size) => seriesPlot(series, size,
        { x: { ...ticksAt(sampled.map(({ spacing }) => spacing)),
          label: "spacing of the frames that are looked at (frames)" },
          y: { label: `mean length of a contact (${result.unit})`, zero: true }, height: 300 }),
      columns, rows,
    }, { title: "Spacings of frames", columns, rows }],
  };
}

export function contacts(result) {
  const [answer, more] = sentences(result);
  const rows = [...result.rows].sort(persistence), { unit } = result,
    times = result.input.picoseconds || rows[0]?.first_begin_picoseconds !== null;
  const columns = [column("first", "first", { order: ({ i }) => i }), column("second", "second", { order: ({ j }) => j }),
    withInterval("occupancy", "occupancy (95%)", { write: percent, hint: "share of the time in contact" }),
    withInterval("residence", `mean life, ${unit} (95%)`, { hint: "time in contact divided by the number of ends" }),
    column("longest", `longest, ${unit}`), column("contacts", "contacts"),
    withInterval("begin_rate", `begins per ${unit === "ps" ? "ps" : "frame"} apart (95%)`),
    ...(times && unit === "ps" ? [column("first_begin_picoseconds", "first at, ps"),
        column("last_end_picoseconds", "last at, ps")]
      : [column("first_begin_frame", "first at frame"), column("last_end_frame", "last at frame")]),
    ...(rows[0]?.sure === undefined ? [] : [column("sure", "sure contacts"),
        column("least_occupancy", "least occupancy", { write: percent }),
        column("most_occupancy", "most occupancy", { write: percent })])];
  const always = rows.filter(({ occupancy }) => occupancy === 1), others = rows.filter(({ occupancy }) => occupancy < 1);
  const top = others.slice(0, 10), pairText = ({ first, second }) => `${first} – ${second}`;
  return {
    title: `Contacts of ${filesOf(result).join(", ")}`, answer, more,
    holds: rows.length > 0 ? `Holds for ${dataOf(result)}, ${cutoffText(result)}.` : null,
    first: rows.length > 0 ? map(result, rows) : null,
    side: rows.length > 0 ? {
      title: "Contacts that persist most", columns: ["pair", "occupancy (95%)", `mean life, ${unit} (95%)`],
      before: always.length === 0 ? null : `${plural(always.length, "pair")} ${always.length === 1 ? "is" : "are"} in ` +
        `contact all the time: ` +
        `${always.slice(0, 8).map(pairText).join(", ")}${always.length > 8 ? " and others" : ""}.` +
        (top.length > 0 ? " Next come:" : ""),
      rows: top.map((row) => [pairText(row), briefInterval(row.occupancy, row.occupancy_lower, row.occupancy_upper, percent),
        briefInterval(row.residence, row.residence_lower, row.residence_upper)]),
      note: `The table below has all ${plural(rows.length, "pair")}.`,
    } : null,
    sections: [
      rows.length > 0 && { heading: "Pairs", parts: [{ title: "Pairs in contact", columns, rows,
        note: "Sorted by occupancy, then by the longest contact. Click a heading to sort. Intervals assume that the " +
          "contacts of a pair begin and end at constant rates." }] },
      survival(result) && { heading: "How long contacts last", parts: [survival(result), course(result)] },
      samples(result),
      leftOutSection(result),
    ].filter(Boolean),
  };
}
