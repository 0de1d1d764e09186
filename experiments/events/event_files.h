#pragma once
// The files that a run writes about its events: contacts.csv, events.csv and the files of --dump. These files
// are written during the run.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/output_files.h"
#include "kds/event.h"
#include "motions/frames/frame_reader.h"
#include "motions/scene/scene.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/structure_spec.h"

namespace kds {

/// The name of the file in --dump and in --out.
inline constexpr std::string_view contacts_file = "contacts.csv";
/// The name of the file in --out that lists the possible contacts of a certified run.
inline constexpr std::string_view possible_contacts_file = "possible_contacts.csv";

/// Returns whether the run has the structure `contacts`.
[[nodiscard]] bool has_contacts(const KineticRun& run);

/// Returns the number of pairs in contact at the frame just reached, or nothing if the run has no
/// contacts.
[[nodiscard]] std::optional<std::uint64_t> contacts_at(const KineticRun& run, std::size_t frame);

/// Listens to all events and passes each event of a contact on.
class ContactsCsv : public EventListener {
 public:
  /// Adds the contacts that begin with the first frame. Call it once, when the structures have been built.
  void add_built(const KineticRun& run);
  void on_event(const Event& event) override;

 protected:
  [[nodiscard]] static bool is_of_contact(const Event& event);

 private:
  virtual void add(const Event& event, std::string_view kind) = 0;
};

/// The file in --dump. The header is `step,lower,upper,i,j,event`. Each line has the canonical bracket of
/// the time in the step, the beads, and begin, end or touch. A contact at the start has step 0, bracket 0, 0
/// and begin.
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

/// Writes the header `frame,structure,events,cumulative`, then one line per frame and structure. Only
/// external events count. A line with frame k (its number in the file) covers the time from frame k to the
/// next frame of the run. If the file has times, the column `picoseconds` follows with the time of frame k.
class EventsCsv {
 public:
  /// Writes the header.
  EventsCsv(std::ostream& stream, bool timed);
  void add(const FrameStamp& frame, std::string_view structure, std::uint64_t events);

 private:
  std::ostream& stream_;
  bool timed_;
  std::map<std::string, std::uint64_t, std::less<>> cumulative_;  ///< per structure
};

/// The files of --dump. Either the files of all frames of a run appear, or none.
class DumpedFrames {
 public:
  /// Throws an InputError or OutputError that names the option and the path.
  DumpedFrames(const std::filesystem::path& directory, bool replace);
  DumpedFrames(const DumpedFrames&) = delete;
  DumpedFrames& operator=(const DumpedFrames&) = delete;

  /// Opens the file of contacts, which covers the whole run.
  [[nodiscard]] std::ostream& open_contacts();
  /// Writes the files of a frame. Call it in the order of the frames, from 0.
  void write(std::size_t frame, const std::vector<DumpFile>& files);
  [[nodiscard]] AtomicFiles& files() { return files_; }

 private:
  AtomicFiles files_;
};

}  // namespace kds
