// Chooses the description of a result by its kind.
import { kindOf } from "./result.js";
import { collide } from "./kinds/collide.js";
import { compare } from "./kinds/compare.js";
import { contacts } from "./kinds/contacts.js";
import { generic } from "./kinds/generic.js";
import { missed } from "./kinds/missed.js";
import { run } from "./kinds/run.js";
import { sweep } from "./kinds/sweep.js";
import { trade } from "./kinds/trade.js";

const kinds = { collide, compare, contacts, missed, replay: run, run, sweep, trade };

export const describe = (result) => (kinds[kindOf(result)] ?? generic)(result);
