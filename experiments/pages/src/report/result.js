// The result that the page contains, and what all results have.
import { fromBase64, inflate } from "../shared/codec.js";
import { baseName, num, plural } from "./format.js";

export async function resultOfPage(document) {
  const element = document.getElementById("kds-report"), packed = document.getElementById("kds-result");
  if (!element || !packed) throw new Error("it has no result in it: a command with --out DIR writes DIR/report.html");
  const meta = JSON.parse(element.textContent);
  if (meta.format !== "kds-report" || meta.version !== 1)
    throw new Error(`the report is of format '${meta.format}' ${meta.version}, this page shows 'kds-report' 1`);
  const bytes = await inflate(fromBase64(packed.textContent));
  if (bytes.length !== meta.size) throw new Error(`the result has ${bytes.length} bytes, expected ${meta.size}: the file ` +
    `is cut off`);
  return { meta, result: JSON.parse(new TextDecoder().decode(bytes)) };
}

// The kind of a result: its field `kind`, else the command's name.
export function kindOf(result) {
  return result.kind ?? result.command?.split(/\s+/)[1] ?? "result";
}

export const distinct = (values) => [...new Set(values)];

export const filesOf = (result) => (result.input?.files ?? result.inputs?.map(({ file }) => file) ?? []).map(baseName);

// Writes a length with its unit, or a number if the input names no unit.
export const lengthText = (length, { length_unit: unit }, figures = 3) =>
  `${typeof length === "number" ? num(length, figures) : length}${unit === "angstrom" ? " Å" : ""}`;

// Returns the heading of a column of lengths.
export const lengthName = (name, { length_unit: unit }) => (unit === "angstrom" ? `${name}, Å` : name);

// Writes the radius of the beads, or the least and the largest.
export function radiiText(input) {
  const { radius_min: least, radius_max: most } = input;
  return lengthText(most > least ? `${num(least)} to ${num(most)}` : least, input);
}

// Returns where the last frame lies on the axis of frames or of times.
export const endOf = ({ input }, timed) => (timed ? input.picoseconds?.[1] : input.last_frame);

// Names the data that a result holds for: "villin.dcd (108 beads, 1,000 frames, 0 to 1,998 ps)".
export function dataOf(result) {
  const input = result.input ?? {}, files = filesOf(result);
  const names = files.length > 3 ? plural(files.length, "file") : files.join(", ");
  const times = input.picoseconds ? `${num(input.picoseconds[0])} to ${num(input.picoseconds[1])} ps` : null;
  const stride = Number(String(result.settings?.frames ?? "").split(":")[2] || 1);
  const facts = [input.beads && plural(input.beads, "bead"),
    input.frames && plural(input.frames, "frame") + (stride > 1 ? ` (one in ${stride} of the file)` : ""), times];
  return `${names} (${facts.filter(Boolean).join(", ")})`;
}
