#pragma once
// Counts that a structure keeps in a run.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "certificates/base/stage_counts.h"
#include "motions/base/bead.h"

namespace kds {

struct CertificateCounts {
  std::uint64_t created = 0;
  std::uint64_t never_failing = 0;  ///< proved at birth to hold for the rest of their step
  std::uint64_t cancelled = 0;      ///< would have failed, but the structure changed first
  std::uint64_t failed = 0;
  std::uint64_t touched = 0;  ///< touched zero without failing, if the structure asked for touches
  std::uint64_t alive = 0;
  std::uint64_t peak = 0;          ///< most alive at once (compactness)
  std::uint64_t per_bead_max = 0;  ///< most that name one bead, at the starts of steps (locality)
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

}  // namespace kds
