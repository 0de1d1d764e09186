// Starts the report page: reads the result that the page contains, and shows it.
import { fromBase64, inflate } from "../shared/codec.js";

async function resultOfPage(document) {
  const element = document.getElementById("kds-report");
  if (!element) throw new Error("this page has no result in it: a command with --out DIR writes DIR/report.html");
  const meta = JSON.parse(element.textContent);
  const bytes = await inflate(fromBase64(document.getElementById("kds-result").textContent));
  return { meta, result: JSON.parse(new TextDecoder().decode(bytes)) };
}

resultOfPage(document).then(({ result }) => {
  document.title = result.command;
});
