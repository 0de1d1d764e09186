#pragma once
// Caches the chord of the last basis, so that a repeated query finds it.

#include "structures/moving_sphere/sphere_chord.h"

namespace kds {

template <int Dimension>
class ChordCache {
 public:
  /// Stores `chord` as the chord of `basis` in a period that ends with the step.
  void keep(const Basis& basis, const Period& period, const SphereChord<Dimension>& chord) {
    basis_ = basis;
    from_ = period.from;
    sure_ = period.sure;
    chord_ = chord;
  }
  void forget() { from_ = none; }

  /// Returns the chord of `basis`. `relax(basis, chord)` is applied to a new chord; chords given to `keep`
  /// must have undergone it already.
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
