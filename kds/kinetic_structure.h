#pragma once
// What the simulator asks of a kinetic structure. The structure keeps its certificates in CertificateTables,
// which put failures into the common queue; when one fails it is told, repairs itself, and reports the change
// it made.

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
  /// The kinds of its events; Change::kind counts them.
  [[nodiscard]] virtual std::span<const EventKind> kinds() const = 0;

  /// Builds the structure for positions at the start of the motion's first step, and no certificate yet.
  virtual void build() = 0;
  /// The motion is that of the next step and the time its start: certificates anew, right just after u = 0.
  virtual void start_step() = 0;
  /// The certificate in `slot` of the table numbered `table` fails now; it is out of the queue already.
  virtual void fail(unsigned table, std::uint32_t slot) = 0;
  /// A failure at this place of a table (CertificateTable::watch) comes near: memory to fetch, first that of
  /// the place itself, then, `next`, what it is about.
  virtual void fetch(unsigned table, std::uint32_t place, bool next) const {
    static_cast<void>(table);
    static_cast<void>(place);
    static_cast<void>(next);
  }
  /// All failures at this very time are handled. Asked only if `needs_after_batch` was set.
  virtual void after_batch() {}
  /// The step's end is reached: positions are those at u = 1. No certificate is left.
  virtual void finish_step() {}
  /// No step follows.
  virtual void finish() {}

  /// Makes a logged change again, without certificates (replay). Throws std::invalid_argument if it cannot be
  /// made.
  virtual void apply(const Change& change) = 0;

  /// Compares the structure with one built statically from exact positions, or proves without certificates
  /// that the two are the same. `time` is an end of the step, or a time at which nothing fails. Returns
  /// what differs, or nothing.
  [[nodiscard]] virtual std::optional<std::string> audit(const Dyadic& time) = 0;

  StructureStatistics statistics;
  bool needs_after_batch = false;
};

}  // namespace kds
