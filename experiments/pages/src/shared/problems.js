// Errors of the page: shown to the reader, and kept for tests.
import { byId } from "./dom.js";

export const errors = [];

export function fail(error) {
  const text = error?.message ?? String(error);
  errors.push(text);
  const place = byId("problem");
  place.hidden = false;
  place.textContent = `This page cannot be shown: ${text}.`;
}
