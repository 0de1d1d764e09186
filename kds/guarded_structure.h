#pragma once
// A structure whose places have one certificate each, such as the pairs of neighbours of a sorted list. The
// base creates the certificates, and calls the structure when one fails.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "kds/certificate_table.h"
#include "kds/structure_base.h"

namespace kds {

/// `Base` is StructureBase or EditableBase.
template <class Certificate, class Base = StructureBase>
class GuardedStructure : public Base {
 public:
  /// Guards all places anew. A place whose certificate does not hold just after u = 0 is repaired at once.
  void start_step() override {
    guards_.assign(place_count(), CertificateHandle::violated);
    for (std::size_t place = guards_.size(); place-- > 0;) unguarded_.push_back(place);
    guard_all();
  }
  void fail(unsigned, std::uint32_t slot) final {
    change_at(table_.place_in_structure(slot), KnownAtStart::at_own_root);
    guard_all();
  }

 protected:
  template <int Dimension>
  GuardedStructure(Simulator& simulator, const MotionRef<Dimension>& motion, std::string_view name,
                   std::span<const EventKind> kinds)
      : Base(simulator, motion.bead_count(), name, kinds),
        table_(simulator, *this, this->index(), 0, motion) {}

  [[nodiscard]] virtual std::size_t place_count() const = 0;
  /// Returns the certificate that guards a place now.
  [[nodiscard]] virtual Certificate certificate(std::size_t place) const = 0;
  /// Changes the structure where the certificate of a place fails now, and records the change. Afterwards the
  /// place has the negated certificate, which the base creates. Other places whose certificates change need
  /// guard_anew.
  virtual void repair(std::size_t place) = 0;

  [[nodiscard]] CertificateTable<Certificate>& table() { return table_; }
  /// Returns the sign of the certificate's function just after the present time: positive if it holds.
  [[nodiscard]] int sign_just_after(const Certificate& certificate) {
    return table_.search().sign_just_after(this->simulator().kernel(), certificate, this->simulator().now(),
                                           this->statistics.stages);
  }

  /// Drops the certificate of a place, if it has one. The next guard_all creates another.
  void guard_anew(std::size_t place) {
    table_.drop(guards_[place]);
    guards_[place] = CertificateHandle::violated;
    unguarded_.push_back(place);
  }
  /// Guards all places that have no certificate. The base calls it at the start of a step and after a
  /// failure.
  void guard_all() {
    while (!unguarded_.empty()) {
      const std::size_t place = unguarded_.back();
      unguarded_.pop_back();
      if (guards_[place] == CertificateHandle::violated) guards_[place] = watch(place, KnownAtStart::unknown);
      if (guards_[place] == CertificateHandle::violated) change_at(place, KnownAtStart::unknown);
    }
  }
  /// Inserts a place, which has no certificate yet. Later places are renumbered. No other place may be
  /// waiting for a certificate.
  void insert_place(std::size_t place) {
    assert(unguarded_.empty());
    guards_.insert(guards_.begin() + static_cast<std::ptrdiff_t>(place), CertificateHandle::violated);
    renumber_from(place + 1);
    unguarded_.push_back(place);
  }
  /// Erases a place with its certificate. Later places are renumbered. No place may be waiting for a
  /// certificate.
  void erase_place(std::size_t place) {
    assert(unguarded_.empty());
    table_.drop(guards_[place]);
    guards_.erase(guards_.begin() + static_cast<std::ptrdiff_t>(place));
    renumber_from(place);
  }

 private:
  void change_at(std::size_t place, KnownAtStart known) {
    repair(place);
    guards_[place] = watch(place, known);
  }
  [[nodiscard]] CertificateHandle watch(std::size_t place, KnownAtStart known) {
    return table_.watch(certificate(place), static_cast<std::uint32_t>(place), known);
  }
  void renumber_from(std::size_t place) {
    for (; place < guards_.size(); ++place)
      table_.set_place(guards_[place], static_cast<std::uint32_t>(place));
  }

  CertificateTable<Certificate> table_;
  std::vector<CertificateHandle> guards_;  // violated: no certificate
  std::vector<std::size_t> unguarded_;
};

}  // namespace kds
