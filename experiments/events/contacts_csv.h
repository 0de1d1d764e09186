#pragma once
// Writes contacts.csv during the run: which beads began to meet, parted or touched, and when.

#include <cstdint>
#include <optional>
#include <ostream>
#include <span>
#include <string_view>

#include "kds/event_log.h"
#include "motions/scene/scene.h"
#include "structures/session/session.h"

namespace kds {

/// The name of the file in --dump and in --out.
inline constexpr std::string_view contacts_file = "contacts.csv";
/// The name of the file in --out that lists the possible contacts of a certified run.
inline constexpr std::string_view possible_contacts_file = "possible_contacts.csv";

/// Returns whether the session has the structure `contacts`.
[[nodiscard]] bool has_contacts(const Session& session);

/// Returns the number of pairs in contact at the frame just reached, or nothing if the session has no
/// contacts.
[[nodiscard]] std::optional<std::uint64_t> contacts_at(const Session& session, std::size_t frame);

/// Listens to all events and writes a line for each event of a contact.
class ContactsCsv : public EventListener {
 public:
  /// Adds the contacts that begin with the first frame. Call it once, when the structures have been built.
  void add_built(const Session& session);
  void on_event(const Event& event) override;

 protected:
  [[nodiscard]] static bool is_of_contact(const Event& event);

 private:
  virtual void add(const Event& event, std::string_view kind) = 0;
};

/// The file in --dump. The header is `step,lower,upper,i,j,event`. Each line has the bracket of the time in
/// the step, the beads, and begin, end or touch. A contact at the start has step 0, bracket 0, 0 and begin.
class ContactsDump final : public ContactsCsv {
 public:
  /// Writes the header.
  explicit ContactsDump(std::ostream& stream);

 private:
  void add(const Event& event, std::string_view kind) override;

  std::ostream& stream_;
};

/// The file in --out. The header is `event,i,j,first,second,frame`. `first` and `second` are the bead names,
/// if the input has names. `frame` is the time in frame numbers of the file; between two frames it has a
/// fraction. If the file has times, the column `picoseconds` follows.
class ContactsTable final : public ContactsCsv {
 public:
  /// A column that says one word for a contact whose flag is set, and another word otherwise.
  struct Column {
    std::string_view name, yes, no;
  };
  /// Writes the header. The scene must outlive it.
  ContactsTable(std::ostream& stream, const Scene& scene) : ContactsTable(stream, scene, {"", "", ""}) {}
  /// Writes a header that ends with this column.
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
