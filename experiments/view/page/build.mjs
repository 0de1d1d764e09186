// Bundles the page into one file, dist/replay_page.html. `node build.mjs FILE` writes to another file.
import { build } from "esbuild";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const target = process.argv[2] ?? join(here, "dist", "replay_page.html");

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

const licence = (await readFile(join(here, "node_modules/three/LICENSE"), "utf8")).trim();
const script = `/* three.js\n${licence}\n*/\n${await bundle("src/main.js")}`;
if (/<\/script|<!--/i.test(script)) throw new Error("the script would end its element in the page");
const style = await bundle("src/style.css");
const page = (await readFile(join(here, "src/page.html"), "utf8"))
  .replace("/*STYLE*/", () => style)
  .replace("/*SCRIPT*/", () => script);
await mkdir(dirname(target), { recursive: true });
await writeFile(target, page);
