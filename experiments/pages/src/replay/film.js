// Films of a span of the run: WebM where the browser can record the canvas, or its frames as PNG files in a zip.
import { pause } from "../shared/codec.js";
import { byId } from "../shared/dom.js";
import { pngOf, save } from "../shared/save.js";
import { countWhile } from "./events.js";
import { compose, fileName } from "./export.js";
import { zip } from "./zip.js";

const perSecond = 25;
const sentenceSeconds = 1.2;  // that a sentence stays if no other event follows
const sliceEvery = 100;       // ms after which a recorder hands over what it has
const mostSlices = 50;        // to wait for the first frame
const leastBytes = 1000;      // that a film with a frame has
const largest = 1280;         // pixels of a film's longer side

const filmTypes = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];

const recordableType = () =>
  typeof MediaRecorder !== "undefined" && HTMLCanvasElement.prototype.captureStream
    ? filmTypes.find((type) => MediaRecorder.isTypeSupported(type)) ?? null
    : null;

// The span that the box names, in steps.
function spanOf(app) {
  const { lastStep, time } = app.state;
  const spans = {
    loop: app.player.loop,
    timeline: app.timeline.range,
    next: [time, Math.min(lastStep, time + 10 * app.player.rate * app.player.speed)],
  };
  return spans[byId("film-span").value] ?? [0, lastStep];
}

// Returns the sentence of the last event before the present that is switched on, if it is not long ago.
function sentenceAt(app, time, span) {
  const last = lastEvent(app.state.structures, app.filter.stops, time, span);
  return last ? app.panels.sentenceText(...last) : "";
}

// Returns the last event, [structure, event], of the lists `stops` that lies in the `span` before a time, or null.
export function lastEvent(structures, stops, time, span) {
  let last = null;
  structures.forEach(({ events }, s) => {
    const list = stops[s];
    const e = list[countWhile(list.length, (k) => events.time[list[k]] < time + 1e-12) - 1];
    if (e === undefined || events.time[e] < time - span) return;
    if (!last || events.order[e] > structures[last[0]].events.order[last[1]]) last = [s, e];
  });
  return last;
}

export class Film {
  constructor(app) {
    this.app = app;
    this.running = false;
    if (!recordableType()) byId("film-type").value = "zip";
    byId("film-type").querySelector("[value=webm]").disabled = !recordableType();
    byId("film").onclick = () => (this.running ? (this.running = false) : this.make());
  }

  // Makes the film and saves it, then goes back to the present.
  async make() {
    const { app } = this;
    const { step, u, chosen } = app.state;
    app.pauseClock();
    this.running = true;
    byId("film").textContent = "Stop";
    const [from, to] = spanOf(app);
    const frames = Math.max(2, Math.round(perSecond * Math.min(60, Math.max(0.2, Number(byId("film-seconds").value) || 10))));
    const canvas = document.createElement("canvas");
    const { x, y } = app.scene.uniforms.screen.value;
    const scale = Math.min(2, largest / Math.max(x, y));
    const draw = async (k) => {
      const time = from + ((to - from) * k) / (frames - 1);
      await app.frames.prepare(Math.min(app.state.lastStep, Math.floor(time)));
      app.state.seek(Math.floor(time), time - Math.floor(time));
      const sentence = sentenceAt(app, time, ((to - from) / frames) * perSecond * sentenceSeconds);
      app.draw();
      byId("time").textContent = app.panels.timeText(app.state.step, app.state.u);
      compose(app, canvas, { scale, even: true, sentence, texts: byId("png-texts").checked });
      byId("film-progress").textContent = `${k + 1} of ${frames} frames`;
    };
    try {
      const webm = byId("film-type").value === "webm";
      const film = await (webm ? this.record(canvas, frames, draw) : this.collect(canvas, frames, draw));
      if (this.running) save(fileName(app, webm ? film.type.match(/webm|mp4/)[0] : "zip"), film);
      byId("film-progress").textContent = this.running ? `Saved ${(film.size / 1e6).toFixed(1)} MB.` : "Stopped.";
    } finally {
      this.running = false;
      byId("film").textContent = "Save film";
      await app.goTo(step, u, chosen);
    }
  }

  // Records in real time, because a recorder stamps frames with the clock.
  async record(canvas, frames, draw) {
    await draw(0);
    const stream = canvas.captureStream(0);
    const recorder = new MediaRecorder(stream, { mimeType: recordableType(), videoBitsPerSecond: 8e6 });
    const parts = [];
    recorder.ondataavailable = ({ data }) => parts.push(data);
    const ended = new Promise((resolve) => (recorder.onstop = resolve));
    recorder.start(sliceEvery);
    const start = performance.now();
    for (let k = 0; k < frames && this.running; ++k) {
      await draw(k);
      stream.getTracks()[0].requestFrame();
      await new Promise((resolve) => setTimeout(resolve, Math.max(0, start + ((k + 1) * 1000) / perSecond - performance.now())));
    }
    // A busy machine encodes the first frame late. A recorder that is stopped before has no film, so the last frame is held.
    const isEmpty = () => parts.reduce((sum, { size }) => sum + size, 0) < leastBytes;
    for (let k = 0; k < mostSlices && this.running && isEmpty(); ++k) {
      await draw(frames - 1);
      stream.getTracks()[0].requestFrame();
      await new Promise((resolve) => setTimeout(resolve, sliceEvery));
    }
    recorder.stop();
    await ended;
    return new Blob(parts, { type: recorder.mimeType });
  }

  async collect(canvas, frames, draw) {
    const files = [];
    for (let k = 0; k < frames && this.running; ++k) {
      await draw(k);
      const bytes = new Uint8Array(await (await pngOf(canvas)).arrayBuffer());
      files.push([`frame-${String(k).padStart(5, "0")}.png`, bytes]);
      await pause();
    }
    return zip(files);
  }
}
