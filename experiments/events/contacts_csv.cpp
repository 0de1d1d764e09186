#include "experiments/events/contacts_csv.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/text.h"
#include "motions/base/csv_field.h"

namespace kds {

namespace {

constexpr std::string_view structure_name = "contacts";

}  // namespace

bool has_contacts(const Session& session) {
  return std::any_of(session.structures().begin(), session.structures().end(),
                     [](const KineticStructure* structure) { return structure->name() == structure_name; });
}

std::optional<std::uint64_t> contacts_at(const Session& session, std::size_t frame) {
  for (std::size_t s = 0; s < session.structures().size(); ++s)
    if (session.structures()[s]->name() == structure_name)
      if (const auto pairs = session.elements(s, frame)) return pairs->all.size();
  return std::nullopt;
}

void ContactsCsv::add_built(const Session& session) {
  for (std::size_t s = 0; s < session.structures().size(); ++s) {
    if (session.structures()[s]->name() != structure_name) continue;
    for (const Event& event : session.built(s)) on_event(event);
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

}  // namespace kds
