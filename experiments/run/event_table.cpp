#include "experiments/run/event_table.h"

#include <fmt/format.h>

#include <span>
#include <string>

#include "experiments/output/text.h"
#include "motions/readers/bead_name.h"
#include "structures/session/structure_spec.h"

namespace kds {

namespace {

std::string residue_of(const Scene& scene, BeadId bead) {
  if (bead == no_bead) return "-";
  const auto name = bead_name_of(scene.bead_name(bead));
  return name ? fmt::format("{}:{}:{}:{}", name->chain, name->residue, name->number, name->atom) : "-";
}

bool is_of_nodes(std::string_view structure) {
  const StructureSpec* const spec = structure_registry().find(structure);
  return spec != nullptr && spec->of_nodes;
}

}  // namespace

EventTable::EventTable(std::ostream& stream, const Scene& scene)
    : stream_(stream), scene_(scene), timed_(scene.stamp(0).picoseconds.has_value()) {
  stream_ << "frame,lower,upper" << (timed_ ? ",picoseconds" : "")
          << ",structure,kind,external,node,beads,residues\n";
}

void EventTable::on_event(const KineticStructure& structure, const LoggedEvent& event) {
  const EventKind& kind = structure.kinds()[event.change.kind];
  if (kind.counted_apart) return;
  const FrameStamp from = scene_.stamp(event.step), to = scene_.stamp(event.step + 1);
  stream_ << fmt::format("{},{},{}", from.number, event.lower, event.upper);
  if (timed_) {
    const double begin = from.picoseconds.value_or(0), end = to.picoseconds.value_or(0);
    stream_ << fmt::format(",{:.12g}", begin + 0.5 * (event.lower + event.upper) * (end - begin));
  }
  std::span<const BeadId> ids(event.change.ids.data(), event.change.size);
  std::string node, beads, residues;
  if (is_of_nodes(structure.name())) {
    node = fmt::format("{}-{}", ids[0], ids[1]);
    ids = ids.subspan(2);
  }
  for (const BeadId bead : ids) {
    const char* const space = beads.empty() ? "" : " ";
    beads += bead == no_bead ? fmt::format("{}infinity", space) : fmt::format("{}{}", space, bead);
    residues += space + residue_of(scene_, bead);
  }
  stream_ << fmt::format(",{},{},{},{},{},{}\n", structure.name(), kind.name, kind.external ? 1 : 0, node,
                         beads, csv_field(residues));
}

}  // namespace kds
