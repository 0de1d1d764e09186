#pragma once
// The interface between the simulator and a kinetic structure: the structure itself, the changes it reports,
// the counts it keeps, edits of its beads, and audits.

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/base/kernel.h"
#include "motions/base/bead.h"

namespace kds {

class Dyadic;

/// A combinatorial change of a structure. The event log holds changes, the fingerprint hashes them, and
/// replay repeats a change from this record alone, without certificates.
struct Change {
  std::uint8_t kind = 0;         ///< index into the structure's kinds
  std::uint8_t size = 0;         ///< number of `ids` in use
  std::array<BeadId, 10> ids{};  ///< beads or nodes, as the structure documents for each kind

  friend bool operator==(const Change&, const Change&) = default;
};

/// The role of some of an event's ids. The ids of the first role come first.
struct IdRole {
  enum class Of : std::uint8_t {
    beads,   ///< beads, or no_bead for the infinite vertex or for none
    node,    ///< two ids: the first and the last bead below a node of a hierarchy
    number,  ///< no beads
  };
  std::string_view name;
  std::uint8_t count = 1;  ///< number of ids with this role; 0: all that are left
  Of of = Of::beads;
};

/// Roles used by the kinds that do not declare roles.
inline constexpr std::array<IdRole, 1> unnamed_ids{{{"beads", 0}}};

/// A kind of event. Internal events change only bookkeeping and are left out of totals.
struct EventKind {
  std::string_view name;
  bool external = true;
  bool counted_apart = false;  ///< not listed among the events (used for rebuilds)
  std::span<const IdRole> roles = unnamed_ids;
};

struct CertificateCounts {
  std::uint64_t created = 0;
  std::uint64_t never_failing = 0;  ///< proved at birth to hold for the rest of their step
  std::uint64_t cancelled = 0;      ///< would have failed, but the structure changed first
  std::uint64_t failed = 0;
  std::uint64_t touched = 0;  ///< touched zero without failing, if the structure asked for touches
  std::uint64_t alive = 0;
  std::uint64_t peak = 0;  ///< most alive at once (compactness)
  std::uint64_t per_bead_max =
      0;  ///< most that name one bead (locality); 0 if the structure does not count them
};

/// Counts the certificates that name each bead, and keeps the greatest of all counts in per_bead_max.
class CertificatesPerBead {
 public:
  CertificatesPerBead(CertificateCounts& counts, std::size_t bead_count)
      : counts_(counts), named_(bead_count) {}

  /// Counts one certificate of the bead.
  void add(BeadId bead) {
    counts_.per_bead_max = std::max<std::uint64_t>(counts_.per_bead_max, ++named_[bead]);
  }
  void reset(BeadId bead) { named_[bead] = 0; }

 private:
  CertificateCounts& counts_;
  std::vector<std::uint32_t> named_;
};

/// Counts that a structure keeps in a run.
struct StructureStatistics {
  CertificateCounts certificates;
  StageCounts stages;
  std::vector<std::uint64_t> events_by_kind;   ///< in the structure's order of kinds
  std::vector<std::uint64_t> events_per_step;  ///< external events only
  std::uint64_t rebuilds = 0;
  std::uint64_t audits_run = 0;
  std::uint64_t audits_failed = 0;
  double build_seconds = 0;  ///< time of the first build
};

/// A kinetic structure. The structure keeps its certificates in CertificateTables, which put failures into
/// the common queue. When a certificate fails, the simulator calls the structure's `fail`; the structure
/// repairs itself and reports the change it made.
class KineticStructure {
 public:
  virtual ~KineticStructure() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Returns the kinds of the structure's events. Change::kind is an index into them.
  [[nodiscard]] virtual std::span<const EventKind> kinds() const = 0;

  /// Builds the structure from the positions at the start of the motion's first step. Creates no
  /// certificates.
  virtual void build() = 0;
  /// Called when the motion is that of the next step and the time is its start. Creates all certificates
  /// anew, valid just after u = 0.
  virtual void start_step() = 0;
  /// Handles the failure, at the present time, of the certificate in `slot` of the table with number `table`.
  /// The certificate is no longer in the queue.
  virtual void fail(unsigned table, std::uint32_t slot) = 0;
  /// Returns a number that orders simultaneous failures of one function of the table with number `table`, in
  /// ascending order. The number must follow from the structure's state and the certificate's place in it,
  /// not from how the structure came to this state. Override it if places number cells or other memory.
  [[nodiscard]] virtual std::uint64_t tie_of(unsigned table, std::uint32_t place) const {
    static_cast<void>(table);
    return place;
  }
  /// Prefetches the data that a failure at this place of a table (CertificateTable::watch) will need soon:
  /// first the data at the place itself, then, if `next`, the data to which it refers.
  virtual void fetch(unsigned table, std::uint32_t place, bool next) const {
    static_cast<void>(table);
    static_cast<void>(place);
    static_cast<void>(next);
  }
  /// Called when all failures at the present time are handled, if `needs_after_batch` is set.
  virtual void after_batch() {}
  /// Called at the end of the step, with the positions at u = 1. No certificate is left.
  virtual void finish_step() {}
  /// Called after the last step.
  virtual void finish() {}

  /// Repeats a logged change without certificates (replay). Throws std::invalid_argument if the change cannot
  /// be made.
  virtual void apply(const Change& change) = 0;

  /// Compares the structure with one built statically from exact positions, or proves without certificates
  /// that the two are the same. `time` is an end of the step, or a time at which nothing fails. Returns
  /// what differs, or nothing.
  [[nodiscard]] virtual std::optional<std::string> audit(const Dyadic& time) = 0;

  StructureStatistics statistics;
  bool needs_after_batch = false;
};

/// When structures are audited, that is compared with static ones.
enum class AuditMode : std::uint8_t {
  none,
  frames,  ///< at the start and end of every step
  events,  ///< also strictly between all events
};
/// Names of the modes, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> audit_mode_names{"none", "frames", "events"};
[[nodiscard]] constexpr std::string_view name_of(AuditMode mode) {
  return audit_mode_names[static_cast<std::size_t>(mode)];
}

/// Thrown if a kinetic structure disagrees with its static rebuild. Such a disagreement is an internal
/// failure; its message says how to reproduce it.
class AuditError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Edits: beads are inserted, erased or given other curves during a run. Every edit is exact and may be made
// at any time at which the simulator stands still, including the irrational time of an event. After an edit,
// the structure is the one of the beads now present, on their present curves, just after the present time.

/// A structure whose beads can change course. Only Simulator::change_motion calls these functions, and it
/// names each bead once. `change_motion` calls require_release on all structures before it calls release on
/// any.
class CourseFollower {
 public:
  virtual ~CourseFollower() = default;

 protected:
  /// Throws std::invalid_argument if a bead does not exist, or if the structure cannot follow these beads
  /// whatever their new curves are.
  virtual void require_release(std::span<const BeadId> beads) const = 0;

 private:
  friend class Simulator;
  /// Called before the motion gets other curves for these beads: discards everything derived from the old
  /// curves.
  virtual void release(std::span<const BeadId> beads) = 0;
  /// Called after the motion got the new curves of these beads.
  virtual void take_up(std::span<const BeadId> beads) = 0;
};

/// A structure whose beads can also be inserted and erased; beads that change course may be absent. The calls
/// below throw std::invalid_argument and change nothing if the bead does not exist, if it is already present
/// or already absent, or if the simulator does not stand still within a step
/// (Simulator::require_standing_still).
class BeadEdits : public CourseFollower {
 public:
  /// Called before the structure is built: the bead does not take part until it is inserted.
  virtual void leave_out(BeadId bead) = 0;
  /// Adds the bead from now on, on its present curve in the motion.
  virtual void insert(BeadId bead) = 0;
  /// Removes the bead from now on.
  virtual void erase(BeadId bead) = 0;
  /// Throws std::invalid_argument if the bead does not exist.
  [[nodiscard]] virtual bool is_absent(BeadId bead) const = 0;

 protected:
  void require_release(std::span<const BeadId> beads) const override {
    for (const BeadId bead : beads) static_cast<void>(is_absent(bead));  // throws if the bead does not exist
  }
};

/// A structure whose beads can be inserted, erased and given other curves.
template <class S>
concept EditableStructure = std::derived_from<S, KineticStructure> && std::derived_from<S, BeadEdits>;

/// Returns null if the beads of this structure cannot be inserted or erased.
[[nodiscard]] inline BeadEdits* edits_of(KineticStructure& structure) {
  return dynamic_cast<BeadEdits*>(&structure);
}

}  // namespace kds
