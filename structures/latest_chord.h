#pragma once
// The chord of the basis that was looked at last: who asks about the same again finds it here.

#include "structures/sphere_path.h"

namespace kds {

template <int Dimension>
class LatestChord {
 public:
  /// `chord` is that of `basis` from a time to the end of the step.
  void keep(const Basis& basis, double from, const SphereChord<Dimension>& chord) {
    basis_ = basis;
    from_ = from;
    chord_ = chord;
  }
  void forget() { from_ = none; }

  /// From the beginning of `period`, which ends with the step.
  [[nodiscard]] const SphereChord<Dimension>& of(const BeadPaths<Dimension>& paths, const Basis& basis,
                                                 const Period& period) {
    if (!(from_ == period.from && basis_ == basis))
      keep(basis, period.from, sphere_chord(paths, basis, period));
    return chord_;
  }

 private:
  static constexpr double none = -1;  // no time

  Basis basis_;
  double from_ = none;
  SphereChord<Dimension> chord_;
};

}  // namespace kds
