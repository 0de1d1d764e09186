// Reads the changes of a layer from their columns. Most ids of an element are ids of the event, and are stored as their
// places there.
import { ColumnReader } from "../shared/codec.js";
import { noBead } from "./events.js";

const [noId, otherId] = [255, 254];

// Returns the records of a layer as words: for each change its event, how many elements go, how many come, and these.
export function changesOfColumns({ name, arity, changes: count }, bytes, events) {
  const reader = new ColumnReader(bytes);
  const eventOf = reader.words(count);
  const removed = Uint32Array.from({ length: count }, () => reader.next());
  const added = Uint32Array.from({ length: count }, () => reader.next());
  let total = 0;
  for (let c = 0; c < count; ++c) total += arity * (removed[c] + added[c]);
  const places = reader.byteColumn(total);
  const words = new Uint32Array(3 * count + total);
  for (let c = 0, at = 0, next = 0; c < count; ++c) {
    const event = eventOf[c];
    const ids = events.firstId[event];
    words[at++] = event;
    words[at++] = removed[c];
    words[at++] = added[c];
    let other = 0;  // the last id of the change that the event does not have
    for (const end = at + arity * (removed[c] + added[c]); at < end; ++at) {
      const place = places[next++];
      if (place === noId) words[at] = noBead;
      else if (place === otherId) words[at] = other = (other + reader.next()) >>> 0;
      else words[at] = events.ids[ids + place];
    }
  }
  if (!reader.ended) throw new Error(`changes of layer '${name}' are followed by other bytes`);
  return words;
}
