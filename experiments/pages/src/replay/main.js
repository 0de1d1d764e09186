// Starts the page.
import { App } from "./app.js";
import { interfaceOf } from "./interface.js";
import { fail } from "../shared/problems.js";

window.addEventListener("error", ({ error, message }) => fail(error ?? message));
window.addEventListener("unhandledrejection", ({ reason }) => fail(reason));
const app = new App();
// The blocks stand behind this script.
const parsed = new Promise((resolve) => document.addEventListener("DOMContentLoaded", resolve, { once: true }));
const ready = parsed.then(() => app.load());
ready.catch(fail);
window.kds = interfaceOf(app, ready);
