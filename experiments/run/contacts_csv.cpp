#include "experiments/run/contacts_csv.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/text.h"

namespace kds {

namespace {

constexpr std::string_view structure_name = "contacts";

}  // namespace

bool has_contacts(const Session& session) {
  return std::any_of(session.structures().begin(), session.structures().end(),
                     [](const KineticStructure* structure) { return structure->name() == structure_name; });
}

void ContactsCsv::add_built(const Session& session) {
  for (std::size_t s = 0; s < session.structures().size(); ++s) {
    const KineticStructure& structure = *session.structures()[s];
    if (structure.name() != structure_name) continue;
    for (const Change& change : session.built(s)) on_event(structure, {0, 0, 0, s, change});
  }
}

void ContactsCsv::on_event(const KineticStructure& structure, const LoggedEvent& event) {
  if (structure.name() == structure_name) add(event, structure.kinds()[event.change.kind].name);
}

ContactsDump::ContactsDump(std::ostream& stream) : stream_(stream) {
  stream_ << "step,lower,upper,i,j,event\n";
}

void ContactsDump::add(const LoggedEvent& event, std::string_view kind) {
  stream_ << fmt::format("{},{},{},{},{},{}\n", event.step, event.lower, event.upper, event.change.ids[0],
                         event.change.ids[1], kind);
}

ContactsTable::ContactsTable(std::ostream& stream, const Scene& scene)
    : stream_(stream), scene_(scene), timed_(scene.stamp(0).picoseconds.has_value()) {
  stream_ << "event,i,j,first,second,frame" << (timed_ ? ",picoseconds\n" : "\n");
}

void ContactsTable::add(const LoggedEvent& event, std::string_view kind) {
  const auto [i, j] = std::pair(event.change.ids[0], event.change.ids[1]);
  const double u = 0.5 * (event.lower + event.upper);
  const FrameStamp from = scene_.stamp(event.step), to = scene_.stamp(event.step + 1);
  const auto between = [u](double a, double b) { return a + u * (b - a); };
  stream_ << fmt::format("{},{},{},{},{},{:.12g}", kind, i, j, csv_field(scene_.bead_name(i)),
                         csv_field(scene_.bead_name(j)),
                         between(static_cast<double>(from.number), static_cast<double>(to.number)));
  if (timed_)
    stream_ << fmt::format(",{:.12g}", between(from.picoseconds.value_or(0), to.picoseconds.value_or(0)));
  stream_ << '\n';
}

}  // namespace kds
