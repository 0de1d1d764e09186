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
class CertifiedPlaces : public Base {
 public:
  /// Creates the certificates of all places. A place whose certificate does not hold just after u = 0 is
  /// repaired at once.
  void start_step() override {
    handles_.assign(place_count(), CertificateHandle::violated);
    for (std::size_t place = handles_.size(); place-- > 0;) uncertified_.push_back(place);
    certify_all();
  }
  void fail(unsigned, std::uint32_t slot) final {
    change_at(table_.place_in_structure(slot), KnownAtStart::at_own_root);
    certify_all();
  }

 protected:
  template <int Dimension>
  CertifiedPlaces(Simulator& simulator, const MotionRef<Dimension>& motion, std::string_view name,
                  std::span<const EventKind> kinds)
      : Base(simulator, motion.bead_count(), name, kinds),
        table_(simulator, *this, this->index(), 0, motion) {}

  [[nodiscard]] virtual std::size_t place_count() const = 0;
  /// Returns the certificate that guards a place now.
  [[nodiscard]] virtual Certificate certificate(std::size_t place) const = 0;
  /// Changes the structure where the certificate of a place fails now, and records the change. Afterwards the
  /// place has the negated certificate, which the base creates. Other places whose certificates change need
  /// certify_anew.
  virtual void repair(std::size_t place) = 0;

  [[nodiscard]] CertificateTable<Certificate>& table() { return table_; }
  /// Returns the sign of the certificate's function just after the present time: positive if it holds.
  [[nodiscard]] int sign_just_after(const Certificate& certificate) {
    return table_.search().sign_just_after(this->simulator().kernel(), certificate, this->simulator().now(),
                                           this->statistics.stages);
  }

  /// Drops the certificate of a place, if it has one. The next certify_all creates another.
  void certify_anew(std::size_t place) {
    table_.drop(handles_[place]);
    handles_[place] = CertificateHandle::violated;
    uncertified_.push_back(place);
  }
  /// Creates a certificate for each place that has none. The base calls it at the start of a step and after a
  /// failure.
  void certify_all() {
    while (!uncertified_.empty()) {
      const std::size_t place = uncertified_.back();
      uncertified_.pop_back();
      if (handles_[place] == CertificateHandle::violated)
        handles_[place] = watch(place, KnownAtStart::unknown);
      if (handles_[place] == CertificateHandle::violated) change_at(place, KnownAtStart::unknown);
    }
  }
  /// Inserts a place, which has no certificate yet. Later places are renumbered. No other place may be
  /// waiting for a certificate.
  void insert_place(std::size_t place) {
    assert(uncertified_.empty());
    handles_.insert(handles_.begin() + static_cast<std::ptrdiff_t>(place), CertificateHandle::violated);
    renumber_from(place + 1);
    uncertified_.push_back(place);
  }
  /// Erases a place with its certificate. Later places are renumbered. No place may be waiting for a
  /// certificate.
  void erase_place(std::size_t place) {
    assert(uncertified_.empty());
    table_.drop(handles_[place]);
    handles_.erase(handles_.begin() + static_cast<std::ptrdiff_t>(place));
    renumber_from(place);
  }

 private:
  void change_at(std::size_t place, KnownAtStart known) {
    repair(place);
    handles_[place] = watch(place, known);
  }
  [[nodiscard]] CertificateHandle watch(std::size_t place, KnownAtStart known) {
    return table_.watch(certificate(place), static_cast<std::uint32_t>(place), known);
  }
  void renumber_from(std::size_t place) {
    for (; place < handles_.size(); ++place)
      table_.set_place(handles_[place], static_cast<std::uint32_t>(place));
  }

  CertificateTable<Certificate> table_;
  std::vector<CertificateHandle> handles_;  // violated: no certificate
  std::vector<std::size_t> uncertified_;
};

}  // namespace kds
