// Writes a report: `node tests/make_report.mjs TEMPLATE RESULT.json OUT [REPLAY]` puts a result into the built page.
import { readFile, writeFile } from "node:fs/promises";
import { deflateSync } from "node:zlib";

const [template, result, out, replay = null] = process.argv.slice(2);
const json = Buffer.from(JSON.stringify(JSON.parse(await readFile(result, "utf8"))));
const meta = { format: "kds-report", version: 1, replay, data: [], size: json.length };
const page = await readFile(template, "utf8");
const data = `<script type="application/json" id="kds-report">${JSON.stringify(meta).replaceAll("<", "\\u003c")}</script>
<script type="text/plain" id="kds-result">${deflateSync(json, { level: 9 }).toString("base64")}</script>
`;
await writeFile(out, page.replace("<!--KDS-DATA-->", () => data));
