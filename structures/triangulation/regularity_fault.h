#pragma once
// Whether a triangulation is regular, by the definition and by exact signs alone: sound in degenerate
// positions, where several are right and comparing with a static build would not do.
//
// All beads are vertices or hidden, all finite cells positive, all facets regular, the hull's faces have no
// bead outside, and each hidden bead is in a cell and not inside its power sphere. Then its triangles cover
// the hull's boundary equally often everywhere, and the cells its inside as often; once, if the centroid of
// one triangle lies in no other. (The cells close up: flips keep that.)

#include <optional>
#include <span>
#include <string>
#include <type_traits>

#include "certificates/types/coplanar.h"
#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "structures/triangulation/hidden_beads.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// The signs of functions of beads at one moment.
template <int Dimension>
class SignsOfFunctions {
 public:
  virtual ~SignsOfFunctions() = default;
  [[nodiscard]] virtual int of(const PowerTest<Dimension>& function) const = 0;
  [[nodiscard]] virtual int of(const Orientation<Dimension>& function) const = 0;
  [[nodiscard]] virtual int of(const SameTurn<Dimension>& function) const = 0;
  [[nodiscard]] virtual int of(const CentroidInside<Dimension>& function) const = 0;
};

/// Those that `sign` gives of any of them.
template <int Dimension, class Sign>
class SignsBy final : public SignsOfFunctions<Dimension> {
 public:
  explicit SignsBy(Sign sign) : sign_(sign) {}
  [[nodiscard]] int of(const PowerTest<Dimension>& function) const override { return sign_(function); }
  [[nodiscard]] int of(const Orientation<Dimension>& function) const override { return sign_(function); }
  [[nodiscard]] int of(const SameTurn<Dimension>& function) const override { return sign_(function); }
  [[nodiscard]] int of(const CentroidInside<Dimension>& function) const override { return sign_(function); }

 private:
  Sign sign_;
};

/// What is wrong with the triangulation of beads 0 ... beads-1 at one moment, or nothing. Cells may be flat
/// where `flat_cells` says so. A hidden bead whose host is not known may be in any cell. Beads marked in
/// `absent` do not take part.
template <int Dimension>
[[nodiscard]] std::optional<std::string> regularity_fault(
    const RegularTriangulation<Dimension>& triangulation, BeadId beads, std::span<const HiddenBead> hidden,
    bool flat_cells, const SignsOfFunctions<Dimension>& signs, std::span<const char> absent = {});

/// The same with the sign that `sign` gives of a function of beads.
template <int Dimension, class Sign>
requires(!std::is_base_of_v<SignsOfFunctions<Dimension>, Sign>)
    [[nodiscard]] std::optional<std::string> regularity_fault(
        const RegularTriangulation<Dimension>& triangulation, BeadId beads,
        std::span<const HiddenBead> hidden, bool flat_cells, Sign sign, std::span<const char> absent = {}) {
  const SignsOfFunctions<Dimension>& signs = SignsBy<Dimension, Sign>(sign);
  return regularity_fault(triangulation, beads, hidden, flat_cells, signs, absent);
}

}  // namespace kds
