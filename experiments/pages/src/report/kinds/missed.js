// The page of kds missed: the share of contacts that are missed if only some frames are examined.
import { capital, everyFrame, interval, known, num, percent, plural } from "../format.js";
import { seriesPlot, ticksAt } from "../plots.js";
import { dataOf, filesOf, lengthText } from "../result.js";
import { column, withInterval } from "../table_text.js";

// Rows of one cutoff or factor, in the order of the result.
export function groupsOf({ rows, input }) {
  const groups = new Map();
  for (const row of rows) {
    const by = known(row.cutoff) ? "cutoff" : "factor", key = `${by} ${row[by]}`;
    if (!groups.has(key)) groups.set(key, { name: by === "cutoff" ? `within ${lengthText(row.cutoff, input)}`
        : `radii times ${num(row.factor)}`, rows: [] });
    groups.get(key).rows.push(row);
  }
  return [...groups.values()];
}

// Returns the row of the first sentence: every 8th frame, else the largest stride that still finds a contact.
export function leadOf(rows) {
  const missing = rows.filter(({ stride, missed }) => stride > 1 && missed > 0);
  return missing.find(({ stride }) => stride === 8) ?? missing.filter(({ found }) => found > 0).at(-1) ?? missing.at(-1)
    ?? rows.at(-1);
}

const share = (row) => interval(row.missed_fraction, row.missed_fraction_lower, row.missed_fraction_upper, "", percent);

function sentenceOf({ name, rows }) {
  const lead = leadOf(rows), other = rows.find(({ stride, missed }) => stride > 1 && stride !== lead.stride && missed > 0);
  return `looking only at ${everyFrame(lead.stride)} misses ${share(lead)} of the ${plural(lead.contacts, "contact")} (${name})` +
    (other ? `; ${everyFrame(other.stride)} misses ${share(other)}` : "");
}

export function missed(result) {
  const groups = groupsOf(result), full = groups.filter(({ rows }) => rows[0].contacts > 0),
    title = `Contacts that frames miss in ${filesOf(result).join(", ")}`;
  const columns = [column("group", "contacts"), column("stride"), column("frames"), column("contacts", "all contacts"),
    column("found"), column("missed"),
    withInterval("missed_fraction", "missed share (95%)", { write: percent })];
  const rows = groups.flatMap((group) => group.rows.map((row) => ({ group: group.name, ...row })));
  const sections = [{ heading: "Table", parts: [{ title: "Contacts missed by stride", columns, rows }] }];
  if (full.length === 0)
    return { title, sections, answer: "No two beads come into contact, so no contact can be missed. Set a cutoff: " +
      "--cutoff 8 --apart 3 is usual between C-alpha atoms, --cutoff 4.5 between heavy atoms.",
      holds: `Holds for ${dataOf(result)}.` };
  const series = full.map(({ name, rows }) => ({ name, points: rows.map((row) => ({
    x: row.stride, y: row.missed_fraction, lower: row.missed_fraction_lower, upper: row.missed_fraction_upper,
    text: share(row) })) }));
  const bare = full.flatMap(({ rows }) => rows).some((row) => row.missed > 0 && row.found > 0
    && row.missed_fraction_lower === null);
  return {
    title, answer: `${capital(sentenceOf(full[0]))}.`,
    holds: `Holds for ${dataOf(result)}. Contacts are found exactly for ` +
      `${result.settings.motion === "hermite" ? "smooth (Hermite)" : "straight"} paths between all frames that were read.`,
    more: [...full.slice(1, 5).map((group) => `${capital(sentenceOf(group))}.`),
      ...(bare ? ["Shares without an interval come from fewer than 50 steps."] : [])],
    first: {
      title: "Share of contacts that are missed", note: "Bars are 95% intervals.",
      draw: (size) => seriesPlot(series, size, { x: { ...ticksAt(rows.map(({ stride }) => stride)), label: "stride (frames)" },
        y: { label: "share of contacts missed", domain: [0, 1], tickFormat: "%" } }),
      columns, rows,
    }, sections,
  };
}
