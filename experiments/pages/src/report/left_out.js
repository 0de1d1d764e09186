// Frames left out by a stride, as results of --certify describe them: the member `stride` of a result.
import { num, plural } from "./format.js";
import { lengthText } from "./result.js";
import { column } from "./table_text.js";

// Returns a sentence, or null without such frames.
export function leftOutSentence({ stride, input, unit }) {
  if (!stride) return null;
  const { contacts, time } = stride;
  const { largest } = stride.deviation;
  return `In the ${plural(stride.skipped, "frame")} left out, beads are at most ${lengthText(largest, input)} from their ` +
    `positions in the run` + (contacts ? `: ${num(contacts.sure)} of the ${num(contacts.found)} contacts found are sure` : "") +
    (time ? `, and the true time in contact is between ${num(time.least)} and ${num(time.most)} ${unit}` : "") + ".";
}

// Returns the section of the page, or null.
export function leftOutSection(result) {
  const { stride, unit } = result;
  if (!stride) return null;
  const rows = ["pairs", "contacts", "time"].filter((name) => stride[name])
    .map((name) => ({ name: name === "time" ? `time in contact (${unit})` : name, ...stride[name] }));
  return { heading: "Frames left out", note: `${leftOutSentence(result)} A contact is sure if it exists wherever the beads ` +
    "were in these frames. Each true contact lies within a possible one; one possible contact may hold several.",
    parts: rows.length > 0 ? [{ title: "What is sure", columns: [column("name", "figure"), column("found"), column("sure"),
      column("possible"), column("least"), column("most")], rows }] : [] };
}
