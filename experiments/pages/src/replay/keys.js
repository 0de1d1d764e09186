// Keys of the whole page.
import { byId } from "../shared/dom.js";

export function listenToKeys(app) {
  const actions = {
    " ": () => app.togglePlay(),
    ArrowRight: () => app.stepFrame(1),
    ArrowLeft: () => app.stepFrame(-1),
    n: () => app.goToNearest(1),
    p: () => app.goToNearest(-1),
    "[": () => app.setLoop(0),
    "]": () => app.setLoop(1),
    "\\": () => app.clearLoop(),
    f: () => app.setFollow(!app.bead.follow),
    "+": () => app.scene?.zoom(1.25),
    "=": () => app.scene?.zoom(1.25),
    "-": () => app.scene?.zoom(0.8),
    Home: () => app.scrub(0),
    End: () => app.scrub(app.state.lastStep),
    "/": () => byId("find").focus(),
    Escape: () => app.release(),
    "?": () => (byId("guide").open = !byId("guide").open),
  };
  const turns = { ArrowRight: [-0.1, 0], ArrowLeft: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
  window.addEventListener("keydown", (event) => {
    // AltGr, by which some keyboards write brackets, counts as Ctrl and Alt.
    const command = (event.ctrlKey || event.metaKey || event.altKey) && !event.getModifierState("AltGraph");
    if (command || takesKey(event.target, event.key)) return;
    const turn = event.shiftKey ? turns[event.key] : null;
    const action = turn ? () => app.scene?.turn(...turn) : actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

// Buttons, boxes and menus use some keys themselves.
function takesKey(element, key) {
  const tag = element.tagName;
  if (["search", "number", "text"].includes(element.type)) return true;
  if (tag === "SELECT" || (tag === "INPUT" && element.type === "range")) return key !== "n" && key !== "p";
  if (tag === "BUTTON" || tag === "SUMMARY" || tag === "INPUT") return key === " " || key === "Enter";
  return false;
}
