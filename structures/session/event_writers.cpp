#include "structures/session/event_writers.h"

#include <fmt/format.h>

#include <span>
#include <string_view>
#include <utility>

#include "motions/base/text_input.h"
#include "motions/readers/bead_name.h"

namespace kds {

namespace {

// Returns the text as a JSON string. Bytes that are not ASCII are written as the characters with these
// numbers, whatever the encoding is, so the result is always valid JSON.
std::string json_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (byte < 0x20 || byte >= 0x7f) {
      quoted += fmt::format("\\u{:04x}", byte);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

}  // namespace

std::string residue_of(const Scene& scene, BeadId bead) {
  if (bead == no_bead) return "-";
  const auto name = bead_name_of(scene.bead_name(bead));
  return name ? fmt::format("{}:{}:{}:{}", name->chain, name->residue, name->number, name->atom) : "-";
}

EventCsv::EventCsv(std::ostream& stream, const Scene& scene) : stream_(stream), scene_(scene) {
  if (scene.frame_count() > 0) finish();
}

void EventCsv::finish() {
  if (std::exchange(begun_, true)) return;
  timed_ = is_timed();
  stream_ << "frame,lower,upper" << (timed_ ? ",picoseconds" : "")
          << ",structure,kind,external,node,beads,residues\n";
}

void EventCsv::on_event(const Event& event) {
  if (event.kind.counted_apart) return;
  finish();
  stream_ << fmt::format("{},{},{}", event.from.number, event.lower, event.upper);
  const auto picoseconds = event.picoseconds();
  if (timed_) stream_ << (picoseconds ? fmt::format(",{:.12g}", *picoseconds) : ",");
  std::string node, beads, residues;
  event.for_roles([&](const IdRole& role, std::span<const BeadId> ids) {
    if (role.of == IdRole::Of::node) node = fmt::format("{}-{}", ids.front(), ids.back());
    if (role.of != IdRole::Of::beads) return;
    for (const BeadId bead : ids) {
      const char* const space = beads.empty() ? "" : " ";
      beads += bead == no_bead ? fmt::format("{}infinity", space) : fmt::format("{}{}", space, bead);
      residues += fmt::format("{}{}", space, residue_of(scene_, bead));
    }
  });
  stream_ << fmt::format(",{},{},{},{},{},{}\n", event.structure, event.kind.name,
                         event.kind.external ? 1 : 0, node, beads, csv_field(residues));
}

void EventJsonLines::on_event(const Event& event) {
  if (event.kind.counted_apart) return;
  stream_ << fmt::format("{{\"step\":{},\"frame\":{},\"time\":{:.12g}", event.step, event.from.number,
                         event.frame());
  if (const auto picoseconds = event.picoseconds())
    stream_ << fmt::format(",\"picoseconds\":{:.12g}", *picoseconds);
  stream_ << fmt::format(",\"lower\":{},\"upper\":{},\"structure\":{},\"kind\":{},\"external\":{}",
                         event.lower, event.upper, json_text(event.structure), json_text(event.kind.name),
                         event.kind.external);
  std::string roles, residues;
  event.for_roles([&](const IdRole& role, std::span<const BeadId> ids) {
    std::string numbers;
    for (const BeadId id : ids) {
      const bool nothing = id == no_bead && role.of == IdRole::Of::beads;
      numbers += fmt::format("{}{}", numbers.empty() ? "" : ",", nothing ? "null" : fmt::to_string(id));
      if (role.of == IdRole::Of::number || !scene_.names_beads()) continue;
      residues += fmt::format("{}{}", residues.empty() ? "" : ",", json_text(residue_of(scene_, id)));
    }
    roles += fmt::format("{}{}:[{}]", roles.empty() ? "" : ",", json_text(role.name), numbers);
  });
  stream_ << ",\"ids\":{" << roles << '}';
  if (!residues.empty()) stream_ << ",\"residues\":[" << residues << ']';
  stream_ << "}\n";
}

std::unique_ptr<EventListener> make_event_writer(const std::filesystem::path& file, std::ostream& stream,
                                                 const Scene& scene) {
  if (file_ending(file) == ".jsonl") return std::make_unique<EventJsonLines>(stream, scene);
  return std::make_unique<EventCsv>(stream, scene);
}

}  // namespace kds
