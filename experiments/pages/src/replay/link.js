// The view in the URL's fragment: all that is seen.
import { speeds } from "./player.js";

// Words, and lists of whole numbers, by their names in the link and in the view.
const words = { colour: "colour", lines: "lines", map: "map" };
const lists = { pair: "pair", dist: "distance" };

const numbers = (text) => (text ?? "").split(",").map(Number);
const list = (values, digits) => values.map((value) => Number(value.toPrecision(digits))).join(",");

export function writeLink(view) {
  const parts = new URLSearchParams();
  parts.set("s", view.step);
  parts.set("u", view.u);
  if (view.event) parts.set("e", view.event.join("."));
  if (view.bead >= 0) parts.set("b", view.bead);
  if (view.follow) parts.set("follow", 1);
  parts.set("layers", view.layers.join("."));
  parts.set("level", view.level);
  if (view.camera) parts.set("cam", list(view.camera, 8));
  parts.set("speed", view.speed);
  if (view.window) parts.set("win", list(view.window, 15));
  if (view.loop) parts.set("loop", list(view.loop, 15));
  if (view.off?.length) parts.set("off", view.off.join("_"));
  if (view.internal) parts.set("internal", 1);
  if (view.theme) parts.set("theme", view.theme);
  if (view.size) parts.set("size", view.size);
  if (Number.isInteger(view.residue)) parts.set("res", view.residue);
  for (const [name, member] of Object.entries(words)) if (view[member]) parts.set(name, view[member]);
  for (const [name, member] of Object.entries(lists)) if (view[member]?.length) parts.set(name, view[member].join("."));
  return `#${parts}`;
}

// Returns what the fragment says. Parts that are absent or that make no sense are left out.
export function readLink(hash) {
  const parts = new URLSearchParams(hash.replace(/^#/, ""));
  const view = {};
  const number = (name, target, accept) => {
    const value = Number(parts.get(name));
    if (parts.has(name) && Number.isFinite(value) && accept(value)) view[target] = value;
  };
  number("s", "step", (value) => value >= 0 && Number.isInteger(value));
  number("u", "u", (value) => value >= 0 && value <= 1);
  number("b", "bead", (value) => value >= 0 && Number.isInteger(value));
  number("speed", "speed", (value) => speeds.includes(value));
  if (parts.has("e")) {
    const [s, e] = parts.get("e").split(".").map(Number);
    if ([s, e].every((value) => Number.isInteger(value) && value >= 0)) view.event = [s, e];
  }
  if (parts.has("layers")) view.layers = parts.get("layers").split(".").filter(Boolean);
  if (/^(all|\d+)$/.test(parts.get("level") ?? "")) view.level = parts.get("level");
  const vector = (name, target, count) => {
    const values = numbers(parts.get(name));
    if (parts.has(name) && values.length === count && values.every(Number.isFinite)) view[target] = values;
  };
  vector("cam", "camera", 7);
  if (view.camera && !seesScene(view.camera)) delete view.camera;
  vector("win", "window", 2);
  vector("loop", "loop", 2);
  number("size", "size", (value) => value > 0 && value <= 1);
  number("res", "residue", (value) => value >= 0 && Number.isInteger(value));
  for (const [name, member] of Object.entries(words)) if (/^\w+$/.test(parts.get(name) ?? "")) view[member] = parts.get(name);
  for (const [name, member] of Object.entries(lists)) {
    const values = /^\d+(\.\d+)*$/.test(parts.get(name) ?? "") ? parts.get(name).split(".").map(Number) : [];
    if (values.length === 2) view[member] = values;
  }
  if (["light", "dark"].includes(parts.get("theme"))) view.theme = parts.get("theme");
  if (parts.has("follow")) view.follow = true;
  const off = (parts.get("off") ?? "").split("_").filter((word) => /^\d+(\.\d+)?$/.test(word));
  if (off.length) view.off = off;
  if (parts.has("internal")) view.internal = true;
  return view;
}

// Returns false for a camera at its target or without a positive zoom.
const seesScene = ([x, y, z, ...rest]) => rest[3] > 0 && (x !== rest[0] || y !== rest[1] || z !== rest[2]);
