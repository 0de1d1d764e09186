// Bundles each page into one file: dist/replay_page.html and dist/report_page.html. `node build.mjs FOLDER` writes to
// another folder.
import { build } from "esbuild";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const folder = process.argv[2] ?? join(here, "dist");

// Each page with the libraries whose licences it must show.
const pages = { replay: ["three"], report: ["@observablehq/plot", "d3", "isoformat"] };

// Bundles one file, minified. JavaScript runs in browsers that have DecompressionStream.
async function bundle(entry) {
  const result = await build({
    absWorkingDir: here,
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: ["chrome111", "firefox113", "safari16.4"],
    charset: "ascii",
    legalComments: "none",
    logLevel: "warning",
  });
  return result.outputFiles[0].text.trim();
}

async function write(page, libraries) {
  const licences = await Promise.all(libraries.map(async (library) =>
    `/* ${library}\n${(await readFile(join(here, "node_modules", library, "LICENSE"), "utf8")).trim()}\n*/\n`));
  const script = licences.join("") + await bundle(`src/${page}/main.js`);
  if (/<\/script|<!--/i.test(script)) throw new Error(`the script of ${page} would end its element in the page`);
  const style = await bundle(`src/${page}/style.css`);
  const text = (await readFile(join(here, "src", page, "page.html"), "utf8"))
    .replace("/*STYLE*/", () => style)
    .replace("/*SCRIPT*/", () => script);
  await writeFile(join(folder, `${page}_page.html`), text);
}

await mkdir(folder, { recursive: true });
for (const [page, libraries] of Object.entries(pages)) await write(page, libraries);
