// Chooses the description of a result by its kind.
import { kindOf } from "./result.js";
import { contacts } from "./kinds/contacts.js";
import { generic } from "./kinds/generic.js";
import { run } from "./kinds/run.js";

const kinds = { contacts, run, replay: run };

export const describe = (result) => (kinds[kindOf(result)] ?? generic)(result);
