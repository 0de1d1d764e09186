#pragma once
// Two triangles that lie in one plane at the time asked for: positive if they turn the same way there, zero
// if one is flat. The dot product of their normals; degree 4k for centres of degree k. Exact. Not a
// certificate: a question about one moment.

#include "certificates/certificate.h"
#include "certificates/determinant.h"

namespace kds {

struct SameTurn {
  std::array<BeadId, 6> beads{};  ///< three of the one triangle in their order, three of the other

  template <MotionView View>
  [[nodiscard]] auto function(const View& view) const {
    return dot(normal(view, 0), normal(view, 3));
  }

 private:
  template <MotionView View>
  [[nodiscard]] auto normal(const View& view, std::size_t first) const {
    return cross(view.difference(beads[first + 1], beads[first]),
                 view.difference(beads[first + 2], beads[first]));
  }
};

}  // namespace kds
