#pragma once
// contacts.csv: which beads began to meet, parted or touched, and when; written while the run goes on.

#include <cstdint>
#include <optional>
#include <ostream>
#include <span>
#include <string_view>

#include "kds/event_log.h"
#include "motions/scene/scene.h"
#include "structures/session/session.h"

namespace kds {

/// The name of the file, in --dump and in --out.
inline constexpr std::string_view contacts_file = "contacts.csv";
/// In --out: the contacts that there may be beside a certified run.
inline constexpr std::string_view possible_contacts_file = "possible_contacts.csv";

/// Whether the session has the structure that the file is about.
[[nodiscard]] bool has_contacts(const Session& session);

/// Returns the pairs in contact at the frame just reached, or nothing if the session has no contacts.
[[nodiscard]] std::optional<std::uint64_t> contacts_at(const Session& session, std::size_t frame);

/// Hears of all events, and writes a line for each contact.
class ContactsCsv : public EventListener {
 public:
  /// Those that begin with the first frame: to be called once, when the structures have been built.
  void add_built(const Session& session);
  void on_event(const Event& event) override;

 protected:
  [[nodiscard]] static bool is_of_contact(const Event& event);

 private:
  virtual void add(const Event& event, std::string_view kind) = 0;
};

/// As in --dump: header `step,lower,upper,i,j,event`, then the bracket of the time in the step, the beads and
/// begin, end or touch. Those in contact at the start: step 0, 0, 0, begin.
class ContactsDump final : public ContactsCsv {
 public:
  /// Writes the header.
  explicit ContactsDump(std::ostream& stream);

 private:
  void add(const Event& event, std::string_view kind) override;

  std::ostream& stream_;
};

/// As in --out: header `event,i,j,first,second,frame`, the beads with their names where the input names them.
/// `frame` is the time by the numbers of frames in the file, between two frames with its fraction; where the
/// file has times `picoseconds` follows.
class ContactsTable final : public ContactsCsv {
 public:
  /// A column about each contact: one word where its flag is set, else another.
  struct Column {
    std::string_view name, yes, no;
  };
  /// Writes the header. The scene must outlive it.
  ContactsTable(std::ostream& stream, const Scene& scene) : ContactsTable(stream, scene, {"", "", ""}) {}
  /// Writes a header that ends with such a column.
  ContactsTable(std::ostream& stream, const Scene& scene, const Column& column);
  void add(const Event& event, bool flag);
  [[nodiscard]] bool prints_time_of(const Event& event) const override { return is_of_contact(event); }

 private:
  void add(const Event& event, std::string_view kind) override;
  void add_cells(const Event& event, std::string_view kind);

  std::ostream& stream_;
  const Scene& scene_;
  Column column_;
  bool timed_;
};

}  // namespace kds
