#pragma once
// The interface between the simulator and a kinetic structure. The structure keeps its certificates in
// CertificateTables, which put failures into the common queue. When a certificate fails, the simulator calls
// the structure's `fail`; the structure repairs itself and reports the change it made.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "kds/change.h"
#include "kds/statistics.h"

namespace kds {

class Dyadic;

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

}  // namespace kds
