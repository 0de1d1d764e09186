#pragma once

namespace kds {

/// Returns a length in angstrom. Rounds to single precision before and after the multiplication, as
/// MDAnalysis does, so that all formats and programs give the same coordinates.
[[nodiscard]] inline double angstrom_of_nanometres(double nanometres) {
  return static_cast<double>(10.0F * static_cast<float>(nanometres));
}

}  // namespace kds
