#pragma once
// Certificates of one type that are proved until some time (certificates/conservative/proved_certificate.h),
// in the common queue: when that time comes the structure is told, and proves on or refines. The time is a
// double and exact, as all times of a run are; at it nothing has failed.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "certificates/conservative/proved_certificate.h"
#include "kds/certificate_table.h"

namespace kds {

/// The polynomial with this one root in [0,1].
[[nodiscard]] ExactFunction function_with_root(double time);

template <class Certificate, int Dimension>
requires ProvedCertificate<Certificate, Dimension>
class ProvedTable final : public FailureSource {
 public:
  /// As of CertificateTable.
  ProvedTable(Simulator& simulator, KineticStructure& owner, std::size_t structure, unsigned number,
              const MotionRef<Dimension>& motion)
      : simulator_(simulator),
        owner_(owner),
        structure_(structure),
        number_(number),
        among_tables_(structure, number),
        motion_(motion) {
    simulator.add_table(*this, Certificate::type);
  }

  /// Proves `certificate` from now on: `never` if to the end of the step, `violated` if for no time at all,
  /// or else told, by KineticStructure::fail, when its proof ends. The present time may lie anywhere in its
  /// bracket: the proof begins before it and must reach beyond.
  [[nodiscard]] CertificateHandle watch(const Certificate& certificate, std::uint32_t place) {
    CertificateCounts& counts = owner_.statistics.certificates;
    ++counts.created;
    const Instant& now = simulator_.now();
    const double until = certificate.proved_until(motion_.curves(), now.lower());
    if (!(until > now.upper())) {
      ++counts.failed;
      return CertificateHandle::violated;
    }
    counts.peak = std::max(counts.peak, ++counts.alive);
    if (until >= 1) {
      ++counts.never_failing;
      return CertificateHandle::never;
    }
    std::uint32_t slot = 0;
    if (free_.empty()) {
      slot = static_cast<std::uint32_t>(entries_.size());
      entries_.emplace_back();
    } else {
      slot = free_.back();
      free_.pop_back();
    }
    entries_[slot] = {certificate, place, until,
                      simulator_.schedule(FailureTime{until, until, 0, false}, *this, slot)};
    return static_cast<CertificateHandle>(slot);
  }

  /// Gives up one whose proof has not ended.
  void drop(CertificateHandle handle) {
    if (handle == CertificateHandle::violated) return;
    --owner_.statistics.certificates.alive;
    if (!has_slot(handle)) return;
    ++owner_.statistics.certificates.cancelled;
    simulator_.cancel(entries_[slot_of(handle)].handle);
    free_.push_back(slot_of(handle));
  }

  [[nodiscard]] const Certificate& certificate(std::uint32_t slot) const {
    return entries_[slot].certificate;
  }
  [[nodiscard]] std::uint32_t place_in_structure(std::uint32_t slot) const { return entries_[slot].place; }

  [[nodiscard]] ExactFunction exact_function(std::uint32_t slot) const override {
    return function_with_root(entries_[slot].until);
  }
  [[nodiscard]] Identity identity(std::uint32_t slot) const override {
    return entries_[slot].certificate.identity();
  }
  [[nodiscard]] std::uint64_t place(std::uint32_t slot) const override {
    return among_tables_.of(entries_[slot].place);
  }
  [[nodiscard]] std::size_t structure() const override { return structure_; }

 private:
  // What the engine alone asks.

  void fail(std::uint32_t slot) override {
    ++owner_.statistics.certificates.failed;
    --owner_.statistics.certificates.alive;
    owner_.fail(number_, slot);
  }
  void retire(std::uint32_t slot) override { free_.push_back(slot); }
  void clear() override {
    entries_.clear();
    free_.clear();
    owner_.statistics.certificates.alive = 0;
  }

  struct Entry {
    Certificate certificate;
    std::uint32_t place = 0;
    double until = 0;
    QueueHandle handle = 0;
  };

  Simulator& simulator_;
  KineticStructure& owner_;
  std::size_t structure_;
  unsigned number_;
  PlaceAmongTables among_tables_;
  MotionRef<Dimension> motion_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> free_;
};

}  // namespace kds
