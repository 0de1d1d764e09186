// Connects the buttons, the menus, the keys and the pointer in the scene to the app.
import { byId } from "../shared/dom.js";
import { trim } from "./explain.js";
import { listenToKeys } from "./keys.js";
import { speeds } from "./player.js";
import { openView, saveViewSoon } from "./saved_view.js";

export function connectControls(app) {
  const on = (id, action) => (byId(id).onclick = action);
  on("play", () => app.togglePlay());
  on("next-event", () => app.goToNearest(1));
  on("previous-event", () => app.goToNearest(-1));
  byId("next-event").disabled = byId("previous-event").disabled = app.filter.countedInAll === 0 && !app.filter.hasInternal;
  on("next-frame", () => app.stepFrame(1));
  on("previous-frame", () => app.stepFrame(-1));
  on("loop-from", () => app.setLoop(0));
  on("loop-to", () => app.setLoop(1));
  on("loop-clear", () => app.clearLoop());
  on("theme", () => app.setTheme(app.dark ? "light" : "dark"));
  on("reset-camera", () => {
    app.setFollow(false);
    app.scene?.resetCamera();
    app.changed();
  });
  const speed = byId("speed");
  for (const value of speeds) speed.add(new Option(`${value}×`, value, value === 1, value === 1));
  speed.title = `1× shows ${trim(app.player.rate, 2)} frames in a second`;
  speed.onchange = () => {
    app.player.speed = Number(speed.value);
    saveViewSoon(app);
  };
  byId("bead-size").oninput = () => app.changed();
  listenToKeys(app);
  listenToScene(app);
  window.addEventListener("hashchange", () => {
    if (location.hash !== app.written) openView(app);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    if (!app.theme) app.setTheme(null);
  });
  const resized = () => {
    app.scene?.resize();
    app.timeline.draw();
    app.look.resize();
    app.request();
  };
  new ResizeObserver(resized).observe(byId("stage"));
  new ResizeObserver(resized).observe(byId("rows"));
  byId("contact-rows").addEventListener("toggle", resized);
}

// A click chooses the bead under the pointer. A drag turns the scene (OrbitControls).
function listenToScene(app) {
  const canvas = byId("scene");
  let start = null;
  canvas.addEventListener("pointerdown", (event) => (start = event));
  canvas.addEventListener("pointerup", (event) => {
    const still = start && Math.hypot(event.clientX - start.clientX, event.clientY - start.clientY) < 5;
    if (!still || !event.isPrimary || event.button !== 0) return;
    app.chooseBead(app.scene.pick(event.clientX, event.clientY), event.shiftKey);
    start = null;
  });
  canvas.addEventListener("webglcontextlost", () => app.report("The browser took the graphics away. Load the page again."));
}
