// The times during which each pair is in contact, from a layer of pairs.

// Returns [{pair: [i, j], spans: [{from, to, begins, ends}], total, changes}], the most changes first. `begins` and `ends` are
// events, or -1 at the ends of the run.
export function contactIntervals(layer, events, lastStep) {
  const pairs = new Map();
  const keyOf = (words, at) => words[at] * 4294967296 + words[at + 1];
  const begin = (words, at, from, begins) => {
    const key = keyOf(words, at);
    if (!pairs.has(key)) pairs.set(key, { pair: [words[at], words[at + 1]], spans: [], total: 0 });
    pairs.get(key).spans.push({ from, to: lastStep, begins, ends: -1 });
  };
  const initial = layer.snapshots[0].words;
  for (let at = 0; at < initial.length; at += layer.arity) begin(initial, at, 0, -1);
  for (let record = 0; record < layer.count; ++record) {
    const event = layer.eventOf(record);
    const [removed, added] = layer.elementsOf(record);
    for (let at = 0; at < removed.length; at += layer.arity) {
      const span = pairs.get(keyOf(removed, at))?.spans.at(-1);
      if (!span) throw new Error("the replay ends a contact that has not begun");
      span.to = events.time[event];
      span.ends = event;
    }
    for (let at = 0; at < added.length; at += layer.arity) begin(added, at, events.time[event], event);
  }
  for (const row of pairs.values()) {
    row.total = row.spans.reduce((sum, { from, to }) => sum + to - from, 0);
    row.changes = row.spans.reduce((sum, { begins, ends }) => sum + (begins >= 0) + (ends >= 0), 0);
  }
  const byBeads = ([a, b], [c, d]) => a - c || b - d;
  return [...pairs.values()].sort((a, b) => b.changes - a.changes || b.total - a.total || byBeads(a.pair, b.pair));
}
