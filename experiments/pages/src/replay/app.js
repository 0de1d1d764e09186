// Joins the parts of the page: time, structures, scene, timeline, panels and the link.
import { blocksOfPage, metaOfPage } from "./blocks.js";
import { float64, pause, uint32 } from "../shared/codec.js";
import { contactIntervals } from "./contact_intervals.js";
import { FramesWithChords, loadChords } from "./chords.js";
import { connectControls } from "./controls.js";
import { byId } from "../shared/dom.js";
import { aboutText, subtitle } from "./explain.js";
import { EventFilter } from "./event_filter.js";
import { Frames } from "./frames.js";
import { LayerList } from "./layer_list.js";
import { Look } from "./look.js";
import { Panels } from "./panel.js";
import { Picture } from "./picture.js";
import { Player } from "./player.js";
import { fail } from "../shared/problems.js";
import { residuesOf, traceOf } from "./residues.js";
import { RunState, loadStructures } from "./run_state.js";
import { openView, saveViewSoon } from "./saved_view.js";
import { Scene, hasWebGL2 } from "./scene.js";
import { connectShare } from "./share.js";
import { StructureLayers } from "./structure_layers.js";
import { TimelineView } from "./timeline_view.js";

const textsEvery = 100;  // ms, while playing

export class App {
  async load() {
    this.meta = metaOfPage(document);
    const { meta } = this;
    if (typeof DecompressionStream === "undefined")
      throw new Error("this browser cannot unpack it; take Chrome 111, Firefox 113, Safari 16.4 or a newer one");
    document.title = `${meta.title} · kds replay`;
    byId("title").textContent = meta.title;
    byId("about").textContent = aboutText(meta);
    const blocks = blocksOfPage(document, meta);
    const radii = meta.radius === null ? float64(await blocks.bytes("radii")) : null;
    this.radii = radii ? (bead) => radii[bead] : () => meta.radius;
    this.frameNumbers = [...uint32(await blocks.bytes("frames"))];
    this.times = meta.has_times ? [...float64(await blocks.bytes("times"))] : null;
    this.names = meta.names ? JSON.parse(new TextDecoder().decode(await blocks.bytes("names"))) : null;
    this.state = new RunState(meta, await loadStructures(meta, blocks));
    this.filter = new EventFilter(this.state.structures);
    byId("subtitle").textContent = subtitle(meta, this.filter.countedInAll);
    byId("how").hidden = this.filter.countedInAll === 0;
    this.frames = new FramesWithChords(new Frames(meta, blocks), await loadChords(meta, blocks));
    await this.frames.prepare(0);
    this.bead = { number: -1, events: [], follow: false };
    this.player = new Player(this.state.lastStep);
    this.positions = new Float32Array(3 * meta.beads);
    this.cost = { drawCalls: 0, script: 0 };
    this.makeScene();
    this.picture = new Picture(this);
    this.layers = new LayerList(this.state, meta, () => this.changed());
    this.structures = new StructureLayers(this);
    this.panels = new Panels(
      {
        meta,
        frames: this.frameNumbers,
        times: this.times,
        names: this.names,
        state: this.state,
        filter: this.filter,
        radii: this.radii,
        positions: () => this.positions,
      },
      {
        bead: (bead) => this.chooseBead(bead),
        follow: (on) => this.setFollow(on),
        beadEvent: (way) => this.goToNearest(way, this.bead.events),
      },
    );
    const pairs = this.findPairs();
    this.look = new Look(this, residuesOf(meta, this.names), pairs);
    this.timeline = new TimelineView(this.state, this.filter, this.frameNumbers, this.times, pairs, {
      seek: (time) => this.scrub(time),
      choose: (event) => this.chooseEvent(event),
      filtered: () => this.changed(),
      changed: () => saveViewSoon(this),
      loop: () => this.player.loop,
      pairName: ([i, j]) => (this.names ? `${this.names[i]} – ${this.names[j]}` : `${i} – ${j}`),
    });
    byId("axis").setAttribute("aria-valuemax", this.state.lastStep);
    connectControls(this);
    connectShare(this);
    await openView(this);
    this.cost.ready = performance.now();
    document.body.dataset.ready = "";
    this.makeSnapshots();
  }

  makeScene() {
    if (!hasWebGL2()) {
      byId("scene").hidden = true;
      byId("no-webgl").hidden = false;
      byId("reset-camera").hidden = true;
      this.scene = null;
      return;
    }
    this.scene = new Scene(byId("scene"), this.meta, this.radii, traceOf(this.meta, this.names), () => {
      this.request();
      saveViewSoon(this);
    });
    this.positions = this.scene.positions;
    this.scene.trace.fit(this.frames.positions(0, 0, this.positions));
  }

  findPairs() {
    return this.state.layersNamed("contacts").flatMap(({ layer, s }) =>
      contactIntervals(layer, this.state.structures[s].events, this.state.lastStep).map((row) => ({ ...row, s })),
    );
  }

  // Going to a time.

  // Goes to a time and draws the scene there. A later call overtakes one that still unpacks its frames.
  async goTo(step, u, event = null) {
    const request = (this.latest = (this.latest ?? 0) + 1);
    const [whole] = event ? [this.state.structures[event[0]].events.step[event[1]]] : this.state.normal(step, u);
    await this.frames.prepare(whole);
    if (request !== this.latest) return;
    if (event) this.state.seekEvent(...event);
    else this.state.seek(step, u);
    this.draw();
    this.showTexts();
    this.timeline.keepInView();
    saveViewSoon(this);
  }

  scrub(time) {
    this.pauseClock();
    return this.goTo(Math.floor(time), time - Math.floor(time));
  }

  chooseEvent(event) {
    this.pauseClock();
    return this.goTo(0, 0, event);
  }

  // Goes to the next (`way` 1) or previous event that is switched on, or to one of the events `within`, if given.
  goToNearest(way, within = null) {
    const stops = within ? within.map((list, s) => list.filter((e) => this.filter.takes(s, e))) : this.filter.stops;
    const event = way > 0 ? this.state.next(stops) : this.state.previous(stops);
    if (event) return this.chooseEvent(event);
    this.sayNoEvent(way > 0 ? "later" : "earlier", within !== null);
    return Promise.resolve();
  }

  // Says so in the place of the event's sentence, until the texts are shown again.
  sayNoEvent(later, ofBead) {
    const among = this.filter.words.length ? " of the kinds that are switched on" : "";
    const text = ofBead ? `The bead has no ${later} event.` : `There is no ${later} event${among}.`;
    this.say(text);
    byId("event-now").textContent = text;
    this.shownEvent = null;
  }

  stepFrame(way) {
    this.pauseClock();
    const { step, u } = this.state;
    return this.goTo(way > 0 || u > 0 ? step + (way > 0 ? 1 : 0) : step - 1, 0);
  }

  togglePlay() {
    if (this.player.playing) return this.pauseClock();
    this.player.playing = true;
    this.lastTick = null;
    const start = this.player.startTime(this.state.time);
    if (start !== this.state.time) this.state.seek(Math.floor(start), start - Math.floor(start));
    else this.state.chosen = null;
    this.showPlaying();
    this.request();
    return undefined;
  }

  pauseClock() {
    if (!this.player.playing) return;
    this.player.playing = false;
    this.showPlaying();
    this.changed();
  }

  showPlaying() {
    const { playing } = this.player;
    byId("play").setAttribute("aria-pressed", playing);
    byId("play").querySelector("use").setAttribute("href", playing ? "#icon-pause" : "#icon-play");
    byId("play").setAttribute("aria-label", playing ? "Pause" : "Play");
  }

  setLoop(end) {
    this.player.setLoop(end, this.state.time);
    byId("loop-clear").hidden = !this.player.loop;
    this.timeline.placeHead();
    this.say(this.player.loop ? "Loop set." : "No loop.");
    saveViewSoon(this);
  }

  clearLoop() {
    this.player.loop = null;
    byId("loop-clear").hidden = true;
    this.timeline.placeHead();
    saveViewSoon(this);
  }

  // Moves the clock by the real time that has passed. Stands still while frames are unpacked.
  tick(now) {
    const seconds = this.lastTick === null ? 0 : Math.min(0.1, (now - this.lastTick) / 1000);
    this.lastTick = now;
    const time = this.player.advance(this.state.time, seconds);
    const step = Math.floor(time);
    if (!this.frames.isReady(step)) {
      this.frames.prepare(step).then(() => {
        this.lastTick = null;
        this.request();
      }, fail);
      return false;
    }
    const ahead = Math.min(this.state.lastStep, step + Math.ceil(this.frames.perBlock / 2));
    if (!this.frames.isReady(ahead)) this.frames.prepare(ahead).catch(fail);
    this.state.seek(step, time - step);
    if (!this.player.playing) this.showPlaying();
    return true;
  }

  // Drawing.

  request() {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame((now) => {
      this.requested = false;
      const start = performance.now();
      try {
        if (this.player.playing && !this.tick(now)) return;
        this.draw();
      } catch (error) {
        fail(error);
        return;
      }
      if (this.player.playing) this.timeline.keepInView();
      else this.timeline.placeHead();
      if (!this.player.playing || now - (this.textsAt ?? 0) > textsEvery) {
        this.textsAt = now;
        this.showTexts();
      }
      if (this.player.playing) this.request();
      this.cost.script = performance.now() - start;
    });
  }

  // Draws again, after a change of layers or colours or another choice of event or bead.
  changed() {
    this.request();
    saveViewSoon(this);
  }

  draw() {
    const { state, scene } = this;
    if (!this.frames.isReady(state.step)) {
      this.goTo(state.step, state.u, state.chosen).catch(fail);
      return;
    }
    const before = this.bead.number < 0 ? null : this.placeOf(this.bead.number);
    this.frames.positions(state.step, state.u, this.positions);
    if (!scene) return;
    scene.movedBeads();
    if (this.bead.follow && before)
      scene.follow(this.placeOf(this.bead.number).map((value, axis) => value - before[axis]));
    scene.setShrink(Number(byId("bead-size").value));
    this.look.colours();
    this.picture.drawLayers();
    this.picture.drawMarks();
    this.structures.draw();
    this.cost.drawCalls = scene.render();
    this.structures.placeDistance();
  }

  placeOf(bead) {
    return Array.from(this.positions.subarray(3 * bead, 3 * bead + 3));
  }

  showTexts() {
    const { state } = this;
    const text = this.panels.timeText(state.step, state.u);
    byId("time").textContent = text;
    const axis = byId("axis");
    axis.setAttribute("aria-valuenow", state.time.toFixed(4));
    axis.setAttribute("aria-valuetext", text);
    this.panels.showBead(this.bead);
    this.look.showTexts();
    const chosen = state.chosen?.join(".") ?? "";
    if (chosen === this.shownEvent) return;
    this.shownEvent = chosen;
    this.panels.showEvent();
    if (!state.chosen) return;
    this.say(`${byId("event-now").textContent} ${text}`);
    this.reveal("event");
  }

  // Scrolls the side panel, and never the page, to a section that would be out of sight.
  reveal(id) {
    const section = byId(id).parentNode;
    const side = section.parentNode;
    const top = section.offsetTop - side.offsetTop;
    if (top < side.scrollTop || top + 200 > side.scrollTop + side.clientHeight) side.scrollTop = top - 8;
  }

  // Gives a text to screen readers.
  say(text) {
    byId("said").textContent = text;
  }

  report(text) {
    byId("problem").hidden = false;
    byId("problem").textContent = text;
  }

  // Choosing a bead.

  // `second` asks for its distance from the chosen bead instead.
  chooseBead(bead, second = false) {
    if (this.look.measure.takes(bead, second)) return;
    const events = bead < 0 ? [] : this.state.structures.map((structure) => structure.events.withBead(bead));
    this.bead = { number: bead, events, follow: bead >= 0 && this.bead.follow };
    this.timeline.showBead(bead, events);
    this.panels.showBead(this.bead);
    if (bead >= 0) {
      this.say(`Chosen: ${this.panels.nameOf(bead)}.`);
      this.reveal("bead");
    }
    this.changed();
  }

  setFollow(on) {
    this.bead.follow = on && this.bead.number >= 0;
    if (this.bead.follow && this.scene) {
      const target = this.scene.controls.target.toArray();
      this.scene.follow(this.placeOf(this.bead.number).map((value, axis) => value - target[axis]));
    }
    this.panels.showBead(this.bead);
    this.changed();
  }

  release() {
    this.state.chosen = null;
    this.look.release();
    this.chooseBead(-1);
    this.showTexts();
  }

  // `name` is light, dark, or null for that of the system.
  setTheme(name) {
    this.theme = name;
    this.dark = (name ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light")) === "dark";
    document.documentElement.dataset.theme = this.dark ? "dark" : "light";
    this.layers.forget();
    this.scene?.setTheme(this.dark);
    this.timeline.setDark(this.dark);
    this.changed();
  }

  // Makes the snapshots for seeking in the background.
  async makeSnapshots() {
    try {
      for (const { layers } of this.state.structures) {
        for (const layer of layers) while (layer.makeSomeSnapshots()) await pause();
      }
    } catch (error) {
      fail(error);
    }
  }
}
