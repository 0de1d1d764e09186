// Keeps the view in the URL's fragment.
import { byId } from "../shared/dom.js";
import { readLink, writeLink } from "./link.js";

const linkEvery = 500;  // ms

// Opens the view that the URL, or another text, names.
export async function openView(app, text = location.hash) {
  const view = readLink(text);
  app.layers.open(view);
  app.filter.internal = view.internal ?? false;
  app.filter.words = view.off ?? [];
  app.timeline.showFilter();
  app.look.open(view);
  app.setTheme(view.theme ?? app.theme ?? null);
  if (view.speed) {
    app.player.speed = view.speed;
    byId("speed").value = String(view.speed);
  }
  const end = app.state.lastStep;
  const within = (range) => range && range[0] >= 0 && range[0] < range[1] && range[1] <= end;
  app.player.loop = within(view.loop) ? view.loop : null;
  byId("loop-clear").hidden = !app.player.loop;
  app.chooseBead(view.bead < app.meta.beads ? view.bead : -1);
  if (view.camera && app.scene) app.scene.view = view.camera;
  app.timeline.show(within(view.window) ? view.window : [0, app.timeline.end]);
  const [s, e] = view.event ?? [];
  const known = e < app.state.structures[s]?.events.count;
  await app.goTo(Math.min(end, view.step ?? 0), view.u ?? 0, known ? [s, e] : null);
  if (view.follow) app.bead.follow = app.bead.number >= 0;
  app.showTexts();
}

// Writes the view to the URL a little later, because browsers limit how often a page may change its URL.
export function saveViewSoon(app) {
  if (app.linking) return;
  app.linking = setTimeout(() => {
    app.linking = null;
    if (!app.player.playing && !app.film?.running) saveView(app);
  }, linkEvery);
}

// Writes the view to the URL now, and to `app.written`.
export function saveView(app) {
  const { state, timeline } = app;
  const all = timeline.range[0] === 0 && timeline.range[1] === timeline.end;
  app.written = writeLink({
    ...app.look.view,
    step: state.step,
    u: state.u,
    event: state.chosen,
    bead: app.bead.number,
    follow: app.bead.follow,
    layers: app.layers.shown(),
    level: app.layers.level,
    camera: app.scene?.view,
    speed: app.player.speed,
    window: all ? null : timeline.range,
    loop: app.player.loop,
    off: app.filter.words,
    internal: app.filter.internal,
    theme: app.theme,
  });
  try {
    history.replaceState(null, "", app.written);
  } catch {
    // A page inside a notebook may have no address of its own.
  }
}
