#pragma once
// The basis of a minimum enclosing sphere of beads of equal radii: at most four beads whose own minimum
// enclosing sphere it is, none to spare. What a basis is, and how to find one among a few beads, given who
// decides the signs of certificates: at a time, just after one, in double or exactly.

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>

#include "certificates/bead_in_sphere.h"
#include "certificates/orientation.h"
#include "certificates/power_test.h"

namespace kds {

struct Basis {
  static constexpr std::size_t max_size = 4;

  std::array<BeadId, max_size> beads{};  ///< ascending, the first `size` of them
  std::uint8_t size = 0;

  Basis() = default;
  explicit Basis(std::span<const BeadId> members) : size(static_cast<std::uint8_t>(members.size())) {
    std::copy(members.begin(), members.end(), beads.begin());
    sort();
  }

  [[nodiscard]] const BeadId* begin() const { return beads.data(); }
  [[nodiscard]] const BeadId* end() const { return beads.data() + size; }
  [[nodiscard]] bool contains(BeadId bead) const { return std::find(begin(), end(), bead) != end(); }
  void sort() {
    for (std::size_t i = 1; i < size; ++i) {
      for (std::size_t j = i; j > 0 && beads[j] < beads[j - 1]; --j) std::swap(beads[j], beads[j - 1]);
    }
  }
  friend bool operator==(const Basis& a, const Basis& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }
};

/// Decides the sign of any certificate at whatever time it stands for: 1, 0, -1.
template <class D>
concept SignDecider = requires(D& decide, const BeadInSphere<3>& a, const PowerTest<3>& b,
                               const Orientation<3>& c) {
  { decide(a) } -> std::convertible_to<int>;
  { decide(b) } -> std::convertible_to<int>;
  { decide(c) } -> std::convertible_to<int>;
};

/// Calls `visit` with the certificate that `bead` lies inside (or, not `inside`, outside) the sphere of
/// `basis`. `orientation` is the basis' own where it has four beads.
template <class Visit>
auto visit_membership(const Basis& basis, BeadId bead, bool inside, int orientation, Visit&& visit) {
  const auto& b = basis.beads;
  switch (basis.size) {
    case 1:
      return visit(BeadInSphere<1>{{b[0], bead}, inside});
    case 2:
      return visit(BeadInSphere<2>{{b[0], b[1], bead}, inside});
    case 3:
      return visit(BeadInSphere<3>{{b[0], b[1], b[2], bead}, inside});
    default:
      return visit(PowerTest<3>({b[0], b[1], b[2], b[3], bead}, inside ? -orientation : orientation));
  }
}

template <SignDecider Decide>
[[nodiscard]] int orientation_of(const Basis& basis, Decide& decide) {
  return basis.size == 4 ? decide(Orientation<3>(basis.beads, 1)) : 0;
}

[[nodiscard]] inline Basis without(const Basis& basis, BeadId bead) {
  Basis rest;
  for (const BeadId b : basis) {
    if (b != bead) rest.beads[rest.size++] = b;
  }
  return rest;
}

/// Inside or on the sphere.
template <SignDecider Decide>
[[nodiscard]] bool is_inside(const Basis& basis, BeadId bead, int orientation, Decide& decide) {
  return visit_membership(basis, bead, true, orientation, [&](const auto& c) { return decide(c) >= 0; });
}

/// None of its beads is to spare: each lies strictly outside the sphere of the others.
template <SignDecider Decide>
[[nodiscard]] bool is_proper(const Basis& basis, Decide& decide) {
  if (basis.size <= 1) return basis.size == 1;
  return std::all_of(basis.begin(), basis.end(), [&](BeadId b) {
    return visit_membership(without(basis, b), b, false, 0, [&](const auto& c) { return decide(c) > 0; });
  });
}

/// What is known of the basis that is sought: where to look first, and who is in it for sure.
struct BasisHint {
  std::size_t size = 1;
  BeadId member = no_bead;
};

/// The basis of at most five beads: the proper subset whose sphere holds the others. None only if `decide`
/// contradicts itself, as plain double may. Where several will do, the hint decides which is found.
template <SignDecider Decide>
[[nodiscard]] std::optional<Basis> basis_among(std::span<const BeadId> beads, Decide& decide,
                                               BasisHint hint = {}) {
  const auto subsets = 1U << beads.size();
  for (std::size_t i = 0; i < Basis::max_size; ++i) {
    const auto size = static_cast<int>((hint.size - 1 + i) % Basis::max_size + 1);
    for (unsigned subset = 1; subset < subsets; ++subset) {
      if (std::popcount(subset) != size) continue;
      Basis basis;
      for (std::size_t b = 0; b < beads.size(); ++b) {
        if ((subset >> b & 1U) != 0) basis.beads[basis.size++] = beads[b];
      }
      if (hint.member != no_bead && !basis.contains(hint.member)) continue;
      basis.sort();
      const int orientation = orientation_of(basis, decide);
      if (basis.size == 4 && orientation == 0) continue;
      const bool encloses = std::all_of(beads.begin(), beads.end(), [&](BeadId b) {
        return basis.contains(b) || is_inside(basis, b, orientation, decide);
      });
      if (encloses && is_proper(basis, decide)) return basis;
    }
  }
  return std::nullopt;
}

}  // namespace kds
