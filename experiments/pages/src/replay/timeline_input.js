// Pointer and wheel on the timeline. A drag goes through the time, a click goes to an event, wheel and two fingers zoom.
import { byId } from "../shared/dom.js";
import { trim } from "./explain.js";
import { binWidth, eventNear, layoutEvents, layoutSpans, moved } from "./timeline_layout.js";

const near = 5;  // pixels

export function listenToTimeline(view) {
  for (const element of [byId("axis"), ...view.rows.map((row) => row.canvas), byId("pairs")]) listen(view, element);
  listenToOverview(view);
}

function listen(view, element) {
  const x = (event) => event.clientX - byId("axis").getBoundingClientRect().left;
  const timeAt = (event) => Math.min(view.end, Math.max(0, view.window.time(x(event))));
  const touches = new Map();
  let drag = null;
  let pinch = null;
  element.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "mouse" && event.button !== 0) return;
    touches.set(event.pointerId, x(event));
    drag = touches.size === 1 ? { start: x(event), y: event.clientY, moving: false } : null;
    pinch = touches.size === 2 ? pinchOf(touches) : null;
  });
  element.addEventListener("pointermove", (event) => {
    if (!touches.has(event.pointerId)) {
      element.title = describe(view, element, x(event), timeAt(event));
      return;
    }
    touches.set(event.pointerId, x(event));
    if (pinch && touches.size === 2) {
      const now = pinchOf(touches);
      view.zoom(pinch.apart / now.apart, view.window.time(now.middle));
      pinch = now;
    } else if (drag) {
      drag.moving ||= Math.abs(x(event) - drag.start) > 4;
      if (drag.moving) view.actions.seek(timeAt(event));
    }
  });
  const end = (event) => {
    if (!touches.delete(event.pointerId)) return;
    pinch = null;
    if (drag && !drag.moving && event.type === "pointerup" && Math.abs(event.clientY - drag.y) < 8)
      click(view, element, x(event), event, timeAt(event));
    drag = null;
  };
  window.addEventListener("pointerup", end);
  window.addEventListener("pointercancel", end);
  window.addEventListener("pointermove", (event) => {
    if (drag?.moving && event.target !== element && touches.has(event.pointerId)) view.actions.seek(timeAt(event));
  });
  element.addEventListener(
    "wheel",
    (event) => {
      if (element.id === "pairs" && !event.ctrlKey && Math.abs(event.deltaY) > Math.abs(event.deltaX)) return;
      event.preventDefault();
      if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) view.pan(event.deltaX || event.deltaY);
      else view.zoom(1.0015 ** event.deltaY, timeAt(event));
    },
    { passive: false },
  );
}

function pinchOf(touches) {
  const [a, b] = touches.values();
  return { apart: Math.max(20, Math.abs(a - b)), middle: (a + b) / 2 };
}

// Returns the text for the pointer: the time, and the events there.
function describe(view, element, x, time) {
  const { first, spacing, word, unit } = view.frameOf;
  const at = (t) => `${unit ? "" : `${word} `}${trim(first + spacing * t, 4)}${unit ? ` ${unit}` : ""}`;
  const row = view.rows.find(({ canvas }) => canvas === element);
  if (!row) return at(time);
  const { events } = view.state.structures[row.s];
  const layout = layoutEvents(events, view.filter.lists[row.s], view.window);
  const bin = layout.bins?.find((one) => x >= one.x && x < one.x + binWidth);
  if (bin) {
    const kinds = [...bin.counts].flatMap((number, k) => (number ? [`${number} ${events.kinds[k].name}`] : []));
    return `${at(time)}: ${kinds.join(", ")}`;
  }
  const e = layout.single ? eventNear(events, view.filter.lists[row.s], view.window, x, near) : -1;
  return e < 0 ? at(time) : `${at(events.time[e])}: ${events.kindOf(e).name}`;
}

// A click near an event goes to its exact time, any other click to the time under the pointer.
function click(view, element, x, event, time) {
  const row = view.rows.find(({ canvas }) => canvas === element);
  if (row) {
    const e = eventNear(view.state.structures[row.s].events, view.filter.lists[row.s], view.window, x, near);
    if (e >= 0) return view.actions.choose([row.s, e]);
  }
  if (element.id === "pairs") {
    const y = event.clientY - element.getBoundingClientRect().top + element.scrollTop;
    const pair = view.pairsOfBead[Math.floor(y / view.pairHeight)];
    for (const { span } of pair ? layoutSpans(pair, view.window) : []) {
      for (const [at, e] of [[span.from, span.begins], [span.to, span.ends]])
        if (e >= 0 && Math.abs(view.window.x(at) - x) <= near) return view.actions.choose([pair.s, e]);
    }
  }
  return view.actions.seek(time);
}

function listenToOverview(view) {
  const overview = byId("overview");
  let held = null;
  overview.addEventListener("pointerdown", (event) => {
    overview.setPointerCapture(event.pointerId);
    held = { x: event.clientX, from: view.range[0] };
  });
  overview.addEventListener("pointermove", (event) => {
    if (!held) return;
    const by = ((event.clientX - held.x) / overview.clientWidth) * view.end;
    view.show(moved([held.from + by], view.range[1] - view.range[0], view.end));
  });
  overview.addEventListener("pointerup", () => (held = null));
  overview.addEventListener("pointercancel", () => (held = null));
}
