// Writes a made-up replay: node tests/make_replay.mjs PAGE REPLAY [BEADS FRAMES DIMENSION TITLE [still]]
import { readFileSync, writeFileSync } from "node:fs";
import { encodeReplay, intoPage } from "./encode_replay.mjs";
import { sampleRun, stillRun } from "./sample_run.mjs";

const [page, replay, beads = "24", frames = "10", dimension = "3", title = "Winding chains", still] = process.argv.slice(2);
const run = (still ? stillRun : sampleRun)({ beads: Number(beads), frames: Number(frames), dimension: Number(dimension), title });
writeFileSync(replay, intoPage(readFileSync(page, "utf8"), encodeReplay(run)));
