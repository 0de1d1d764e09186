// Buttons that save, plots as PNG, and names of files.
import { make } from "../shared/dom.js";
import { pngOf } from "../shared/save.js";

export const saveButton = (label, title, onclick) =>
  make("button", { type: "button", class: "save", title, "aria-label": title, onclick }, label);

// Draws an SVG as a PNG, `scale` pixels for each unit.
export async function pngOfSvg(svgText, width, height, scale = 3) {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgText)}`;
  await image.decode();
  const canvas = make("canvas", { width: width * scale, height: height * scale });
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  return pngOf(canvas);
}

export const fileName = (text) => text.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "");
