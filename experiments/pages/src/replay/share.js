// The box by which pictures, films and links are made.
import { byId } from "../shared/dom.js";
import { savePicture } from "./export.js";
import { Film } from "./film.js";
import { saveView } from "./saved_view.js";

export function connectShare(app) {
  const box = byId("share-box");
  byId("share").onclick = () => (box.open ? box.close() : box.show());
  byId("share-close").onclick = () => box.close();
  byId("png").onclick = () => savePicture(app);
  byId("copy-link").onclick = () => copyLink(app);
  byId("picture-part").hidden = byId("film-part").hidden = !app.scene;
  if (app.scene) app.film = new Film(app);
}

// Copies the address of the view. A page in a notebook has no address, so there the state alone is copied; the box that finds
// residues opens it.
async function copyLink(app) {
  saveView(app);
  const field = byId("link-text");
  const reachable = /^(file|https?):$/.test(location.protocol) && window === window.top;
  field.value = reachable ? location.href.replace(/#.*$/, "") + app.written : app.written;
  field.hidden = false;
  field.select();
  let copied = false;
  try {
    await navigator.clipboard.writeText(field.value);
    copied = true;
  } catch {
    copied = document.execCommand("copy");  // pages without the right to use the clipboard
  }
  const what = reachable ? "The link" : "The state of the view";
  byId("link-said").textContent = copied
    ? `${what} is copied.${reachable ? "" : " Paste it into the box Find of this page to open it again."}`
    : `${what} is selected: copy it.`;
}
