#pragma once
// The chord of the basis that was looked at last: who asks about the same again finds it here.

#include "structures/moving_sphere/sphere_chord.h"

namespace kds {

template <int Dimension>
class ChordCache {
 public:
  /// `chord` is that of `basis` in a period that ends with the step.
  void keep(const Basis& basis, const Period& period, const SphereChord<Dimension>& chord) {
    basis_ = basis;
    from_ = period.from;
    sure_ = period.sure;
    chord_ = chord;
  }
  void forget() { from_ = none; }

  /// `relax(basis, chord)` does to a new one what was done to those that were given to `keep`.
  template <class Relax>
  [[nodiscard]] const SphereChord<Dimension>& of(const BeadPaths<Dimension>& paths, const Basis& basis,
                                                 const Period& period, Relax relax) {
    if (!(from_ == period.from && sure_ == period.sure && basis_ == basis)) {
      keep(basis, period, sphere_chord(paths, basis, period));
      relax(basis, chord_);
    }
    return chord_;
  }

 private:
  static constexpr double none = -1;  // no time

  Basis basis_;
  double from_ = none, sure_ = 0;
  SphereChord<Dimension> chord_;
};

}  // namespace kds
