#include "experiments/events/event_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "experiments/output/text.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

constexpr std::string_view structure_name = "contacts";

}  // namespace

bool has_contacts(const KineticRun& run) {
  return std::any_of(run.structures().begin(), run.structures().end(),
                     [](const KineticStructure* structure) { return structure->name() == structure_name; });
}

std::optional<std::uint64_t> contacts_at(const KineticRun& run, std::size_t frame) {
  for (std::size_t s = 0; s < run.structures().size(); ++s)
    if (run.structures()[s]->name() == structure_name)
      if (const auto pairs = run.elements(s, frame)) return pairs->all.size();
  return std::nullopt;
}

void ContactsCsv::add_built(const KineticRun& run) {
  for (std::size_t s = 0; s < run.structures().size(); ++s) {
    if (run.structures()[s]->name() != structure_name) continue;
    for (const Event& event : run.built(s)) on_event(event);
  }
}

void ContactsCsv::on_event(const Event& event) {
  if (is_of_contact(event)) add(event, event.kind.name);
}

bool ContactsCsv::is_of_contact(const Event& event) {
  return event.structure == structure_name && !event.kind.counted_apart;
}

ContactsDump::ContactsDump(std::ostream& stream) : stream_(stream) {
  stream_ << "step,lower,upper,i,j,event\n";
}

void ContactsDump::add(const Event& event, std::string_view kind) {
  stream_ << fmt::format("{},{},{},{},{},{}\n", event.step, event.lower, event.upper, event.change.ids[0],
                         event.change.ids[1], kind);
}

ContactsTable::ContactsTable(std::ostream& stream, const Scene& scene, const Column& column)
    : stream_(stream), scene_(scene), column_(column), timed_(scene.stamp(0).picoseconds.has_value()) {
  stream_ << "event,i,j,first,second,frame" << (timed_ ? ",picoseconds" : "")
          << (column.name.empty() ? "" : ",") << column.name << '\n';
}

void ContactsTable::add(const Event& event, bool flag) {
  add_cells(event, event.kind.name);
  stream_ << ',' << (flag ? column_.yes : column_.no) << '\n';
}

void ContactsTable::add(const Event& event, std::string_view kind) {
  add_cells(event, kind);
  stream_ << '\n';
}

void ContactsTable::add_cells(const Event& event, std::string_view kind) {
  const auto [i, j] = std::pair(event.change.ids[0], event.change.ids[1]);
  stream_ << fmt::format("{},{},{},{},{},{:.12g}", kind, i, j, csv_field(scene_.bead_name(i)),
                         csv_field(scene_.bead_name(j)), event.frame());
  const auto picoseconds = event.picoseconds();
  if (timed_) stream_ << (picoseconds ? fmt::format(",{:.12g}", *picoseconds) : ",");
}

EventsCsv::EventsCsv(std::ostream& stream, bool timed) : stream_(stream), timed_(timed) {
  stream_ << "frame,structure,events,cumulative" << (timed_ ? ",picoseconds\n" : "\n");
}

void EventsCsv::add(const FrameStamp& frame, std::string_view structure, std::uint64_t events) {
  auto so_far = cumulative_.find(structure);
  if (so_far == cumulative_.end()) so_far = cumulative_.emplace(structure, 0).first;
  so_far->second += events;
  stream_ << fmt::format("{},{},{},{}", frame.number, structure, events, so_far->second);
  if (timed_) stream_ << fmt::format(",{:.10g}", frame.picoseconds.value_or(0));
  stream_ << '\n';
}

DumpedFrames::DumpedFrames(const std::filesystem::path& directory, bool replace)
    : files_(directory, "--dump", replace) {}

std::ostream& DumpedFrames::open_contacts() { return files_.open(std::string(contacts_file)); }

void DumpedFrames::write(std::size_t frame, const std::vector<DumpFile>& files) {
  for (const DumpFile& file : files) files_.write(fmt::format("frame-{}.{}", frame, file.ending), file.text);
  files_.check();
}

}  // namespace kds
