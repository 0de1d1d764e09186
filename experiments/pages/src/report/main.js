// Starts the report page: reads the result that the page contains, and shows it.
import { errors, fail } from "../shared/problems.js";
import { describe } from "./describe.js";
import { showReport } from "./page.js";
import { resultOfPage } from "./result.js";

window.addEventListener("error", ({ error, message }) => fail(error ?? message));
window.addEventListener("unhandledrejection", ({ reason }) => fail(reason));

// The result stands behind this script.
const parsed = new Promise((resolve) => document.addEventListener("DOMContentLoaded", resolve, { once: true }));
const ready = parsed.then(() => resultOfPage(document)).then(({ meta, result }) => showReport(meta, result, describe(result)));
ready.catch(fail);
window.kds = { ready, errors };
