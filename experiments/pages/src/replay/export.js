// Pictures to show others: the scene with time, sentence, legend and scale bar on a canvas of any size.
import { byId } from "../shared/dom.js";
import { css } from "../shared/palette.js";
import { pngOf, save } from "../shared/save.js";
import { lengthUnit, trim } from "./explain.js";

const font = (size, weight = "") => `${weight} ${size}px system-ui, "Segoe UI", "DejaVu Sans", sans-serif`.trim();

// Breaks a text into lines that fit.
export function linesOf(text, width, widthOf) {
  const lines = [""];
  for (const word of text.split(" ")) {
    const longer = `${lines.at(-1)} ${word}`.trim();
    if (lines.at(-1) === "" || widthOf(longer) <= width) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

// Returns the largest of 1, 2, 5, 10, ... that is at most `length`.
export function roundLength(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return [5, 2, 1].find((step) => step * power <= length) * power;
}

const sentenceNow = (app) => (app.state.chosen ? byId("event-now").textContent : "");

// Draws what is seen to a canvas, `scale` times as large. `texts` adds time, sentence, legend and scale bar.
// Encoders of films want `even` sides.
export function compose(app, canvas, { scale, transparent = false, even = false, texts = true, sentence = sentenceNow(app) }) {
  const { scene } = app;
  const [width, height] = scene.uniforms.screen.value.toArray();
  const side = (length) => (even ? 2 * Math.round((length * scale) / 2) : Math.round(length * scale));
  const size = { width: side(width), height: side(height) };
  if (canvas.width !== size.width || canvas.height !== size.height) Object.assign(canvas, size);
  const context = canvas.getContext("2d");
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, canvas.width, canvas.height);
  scene.drawLarge(scale, transparent, (picture) => context.drawImage(picture, 0, 0, canvas.width, canvas.height));
  context.setTransform(canvas.width / width, 0, 0, canvas.height / height, 0, 0);
  const ink = getComputedStyle(document.body).color;
  const write = (text, x, y, weight = "", fontSize = 13) => {
    context.font = font(fontSize, weight);
    const length = context.measureText(text).width;
    context.fillStyle = `${scene.colours.page}b0`;
    if (!transparent) context.fillRect(context.textAlign === "right" ? x - length - 3 : x - 3, y - 13, length + 6, 18);
    context.fillStyle = ink;
    context.fillText(text, x, y);
  };
  const { measure } = app.look;
  if (measure.pair) write(measure.text, ...measure.place().map((value, k) => value + [6, -6][k]), "600");
  const { closest } = app.structures;
  if (closest) write(closest.text, closest.at[0], closest.at[1] + 13, "600");
  if (!texts) return;
  write(byId("time").textContent, 14, 24, "600", 14);
  context.font = font(13);
  linesOf(sentence, width - 28, (text) => context.measureText(text).width).forEach((line, k) => write(line, 14, 44 + 18 * k));
  drawLegend(app, context, write, width, height);
}

function drawLegend(app, context, write, width, stage) {
  const { scene, layers, look } = app;
  const { legend } = look;
  const rows = [];
  if (layers.shows("beads") || layers.shows("trace")) {
    if (legend.ramp) rows.push({ ramp: legend.ramp, text: `${legend.title}: ${legend.low} to ${legend.high}` });
    else rows.push(...legend.entries.map(([colour, text]) => ({ colour: css(colour), text })));
  }
  for (const name of layers.shown()) {
    const swatch = document.querySelector(`.swatch.${name}`);
    const style = swatch && getComputedStyle(swatch);
    const colour = style && parseFloat(style.borderTopWidth) > 0 ? style.borderTopColor : style?.backgroundColor;
    if (!["beads", "trace", "hidden", "flashes", "order"].includes(name) && colour) rows.push({ colour, line: true, text: name });
  }
  if (app.state.chosen && scene.marks.count)
    for (const text of ["goes", "comes"]) rows.push({ colour: scene.colours[text], line: true, text });
  const ranks = byId("ranks");
  if (!ranks.hidden) context.drawImage(ranks, 14, stage - 36, width - 28, 26);
  const height = stage - (ranks.hidden ? 0 : 40);
  rows.forEach(({ ramp, colour, line, text }, k) => {
    const y = height - 14 - 18 * (rows.length - 1 - k);
    context.fillStyle = colour;
    if (ramp) {
      context.fillStyle = context.createLinearGradient(14, 0, 44, 0);
      ramp.forEach((own, at) => context.fillStyle.addColorStop(at / (ramp.length - 1), css(own)));
    }
    context.fillRect(14, line ? y - 6 : y - 9, ramp ? 30 : 18, line ? 3 : 9);
    write(text, ramp ? 50 : 38, y);
  });
  const length = roundLength(90 / scene.scale);
  const right = width - 14;
  context.fillStyle = scene.colours.axis;
  context.fillRect(right - length * scene.scale, height - 16, length * scene.scale, 3);
  context.textAlign = "right";
  write(`${trim(length, 9)} ${lengthUnit(app.meta)}`, right, height - 22);
  context.textAlign = "left";
}

export const fileName = ({ meta, frameNumbers, state }, ending) =>
  `${meta.title.replace(/[^\w.-]+/g, "_")}-${frameNumbers[state.step]}.${ending}`;

export async function savePicture(app) {
  const canvas = document.createElement("canvas");
  app.draw();
  compose(app, canvas, {
    scale: Number(byId("png-scale").value),
    transparent: byId("png-transparent").checked,
    texts: byId("png-texts").checked,
  });
  save(fileName(app, "png"), await pngOf(canvas));
}
