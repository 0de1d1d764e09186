// Numbers as people read them: few figures, thousands separated, a unit and an interval.
export { count as plural } from "../shared/dom.js";

export const known = (value) => value !== null && value !== undefined && !Number.isNaN(value);

// Writes whole numbers in full, and others with `figures` significant figures.
export function num(value, figures = 3) {
  if (!known(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "infinite" : "minus infinite";
  if (Number.isInteger(value)) return value.toLocaleString("en");
  const size = Math.abs(value);
  if (size < 1e-4) return value.toExponential(figures - 1);
  return value.toLocaleString("en", size >= 1000 ? { maximumFractionDigits: 0 }
    : { minimumSignificantDigits: figures, maximumSignificantDigits: figures });
}

export const percent = (share) => (known(share) ? `${num(Math.abs(share) < 1e-9 ? 0 : round(100 * share))}%` : "–");

// Rounds away digits that are errors of rounding, so that 100 * 0.07 is 7.
const round = (value) => Number(value.toPrecision(12));

const united = (text, unit) => (unit ? `${text} ${unit}` : text);

// Writes a value with its 95% interval, if it has one.
export function interval(value, lower, upper, unit = "", write = num) {
  const text = united(write(value), unit);
  if (!known(lower)) return text;
  return `${text} (95%: ${known(upper) ? `${write(lower)} to ${write(upper)}` : `at least ${write(lower)}`})`;
}

// Writes a value with its interval for cells of tables whose heading names the level.
export const briefInterval = (value, lower, upper, write = num) =>
  known(value) && known(lower) && known(upper) ? `${write(value)} (${write(lower)} to ${write(upper)})`
    : known(value) ? write(value) : known(lower) ? `at least ${write(lower)}` : "–";

export function seconds(value) {
  if (!known(value)) return "–";
  const [scale, unit] = value >= 1 || value === 0 ? [1, "s"] : value >= 1e-3 ? [1e3, "ms"] : [1e6, "µs"];
  return `${num(value * scale)} ${unit}`;
}

export const ordinal = (n) =>
  n + (n % 100 >= 11 && n % 100 <= 13 ? "th" : { 1: "st", 2: "nd", 3: "rd" }[n % 10] ?? "th");

// "every frame", "every 2nd frame".
export const everyFrame = (stride) => (stride === 1 ? "every frame" : `every ${ordinal(stride)} frame`);

// Joins names: "a", "a and b", "a, b and c".
export const list = (names) =>
  names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`;

export const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

export const baseName = (path) => String(path).replace(/^(?:[^ ]*\/)?([^/ ]+)/, "$1");
