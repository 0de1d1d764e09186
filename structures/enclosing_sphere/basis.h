#pragma once
// The basis of a minimum enclosing sphere: at most dimension + 1 beads that have the same minimum enclosing
// sphere, without a superfluous bead. Defines bases and finds one among a few beads. A `SphereSigns` object
// decides which beads lie in which sphere: at a time, just after a time, in double or exactly.

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>

#include "motions/base/bead.h"

namespace kds {

struct Basis {
  static constexpr std::size_t max_size = 4;

  std::array<BeadId, max_size> beads{};  ///< the first `size` of them, ascending
  std::uint8_t size = 0;

  Basis() = default;
  explicit Basis(std::span<const BeadId> members) : size(static_cast<std::uint8_t>(members.size())) {
    std::copy(members.begin(), members.end(), beads.begin());
    sort();
  }

  [[nodiscard]] const BeadId* begin() const { return beads.data(); }
  [[nodiscard]] const BeadId* end() const { return beads.data() + size; }
  [[nodiscard]] bool contains(BeadId bead) const {
    bool found = false;
    for (std::size_t i = 0; i < max_size; ++i) found |= (i < size) & (beads[i] == bead);
    return found;
  }
  void sort() {
    for (std::size_t i = 1; i < size; ++i) {
      for (std::size_t j = i; j > 0 && beads[j] < beads[j - 1]; --j) std::swap(beads[j], beads[j - 1]);
    }
  }
  friend bool operator==(const Basis& a, const Basis& b) {
    if (a.size != b.size) return false;
    for (std::size_t i = 0; i < a.size; ++i)
      if (a.beads[i] != b.beads[i]) return false;
    return true;
  }
};

/// Decides which bead lies in which sphere, at a time of its own.
template <class S>
concept SphereSigns = requires(S& signs, const Basis& basis, BeadId bead, bool inside, int orientation) {
  { S::dimension } -> std::convertible_to<int>;
  // 1, 0 or -1: `bead` is inside, on, or outside the sphere of `basis`; negated unless `inside`
  { signs.membership(basis, bead, inside, orientation) } -> std::convertible_to<int>;
  // for a full basis, in `membership`; 0 if its centres are affinely dependent
  { signs.orientation(basis) } -> std::convertible_to<int>;
};

template <SphereSigns Signs>
inline constexpr std::size_t full_size = Signs::dimension + 1;

template <SphereSigns Signs>
[[nodiscard]] int orientation_of(const Basis& basis, Signs& signs) {
  return basis.size == full_size<Signs> ? signs.orientation(basis) : 0;
}

[[nodiscard]] inline Basis without(const Basis& basis, BeadId bead) {
  Basis rest;
  for (const BeadId b : basis) {
    if (b != bead) rest.beads[rest.size++] = b;
  }
  return rest;
}

/// Returns whether the bead is inside or on the sphere.
template <SphereSigns Signs>
[[nodiscard]] bool is_inside(const Basis& basis, BeadId bead, int orientation, Signs& signs) {
  return signs.membership(basis, bead, true, orientation) >= 0;
}

/// Returns whether no bead of the basis is superfluous: each lies strictly outside the sphere of the others.
template <SphereSigns Signs>
[[nodiscard]] bool is_proper(const Basis& basis, Signs& signs) {
  if (basis.size <= 1) return basis.size == 1;
  return std::all_of(basis.begin(), basis.end(),
                     [&](BeadId b) { return signs.membership(without(basis, b), b, false, 0) > 0; });
}

/// Partial knowledge of the wanted basis: the size to try first, and a bead that is certainly in it.
struct BasisHint {
  std::size_t size = 1;
  BeadId member = no_bead;
};

/// Returns the basis of at most dimension + 2 beads of equal radii: the proper subset whose sphere holds the
/// others. Returns none only if `signs` contradict themselves, which plain double may do. If several bases
/// are valid, the hint decides which one is found. `signs` are queried for any subset, since independent
/// points have a sphere.
template <SphereSigns Signs>
[[nodiscard]] std::optional<Basis> basis_of_points(std::span<const BeadId> beads, Signs& signs,
                                                   BasisHint hint = {}) {
  constexpr std::size_t full = full_size<Signs>;
  const auto subsets = 1U << beads.size();
  for (std::size_t i = 0; i < full; ++i) {
    const auto size = static_cast<int>((hint.size - 1 + i) % full + 1);
    for (unsigned subset = 1; subset < subsets; ++subset) {
      if (std::popcount(subset) != size) continue;
      Basis basis;
      for (std::size_t b = 0; b < beads.size(); ++b) {
        if ((subset >> b & 1U) != 0) basis.beads[basis.size++] = beads[b];
      }
      if (hint.member != no_bead && !basis.contains(hint.member)) continue;
      basis.sort();
      const int orientation = orientation_of(basis, signs);
      if (basis.size == full && orientation == 0) continue;
      const bool encloses = std::all_of(beads.begin(), beads.end(), [&](BeadId b) {
        return basis.contains(b) || is_inside(basis, b, orientation, signs);
      });
      if (encloses && is_proper(basis, signs)) return basis;
    }
  }
  return std::nullopt;
}

/// Finds the basis of at most dimension + 2 balls of any radii. Independent balls need not have a sphere that
/// touches all of them. `signs` are therefore queried only for bases that are proved proper, from single
/// balls up.
template <SphereSigns Signs>
class BasisOfBalls {
 public:
  /// `beads` are ascending, at most dimension + 2.
  BasisOfBalls(std::span<const BeadId> beads, Signs& signs) : beads_(beads), signs_(signs) {}

  [[nodiscard]] std::optional<Basis> find() { return of((1U << beads_.size()) - 1U); }

 private:
  enum class State : std::uint8_t { unknown, none, known };

  /// Returns the basis of a subset: the basis of all its beads but one, if that sphere holds the remaining
  /// bead, else the subset itself.
  std::optional<Basis> of(unsigned subset) {
    State& state = states_[subset];
    if (state == State::known) return bases_[subset];
    if (state == State::none) return std::nullopt;
    const auto found = look(subset);
    state = found ? State::known : State::none;
    if (found) bases_[subset] = *found;
    return found;
  }
  std::optional<Basis> look(unsigned subset) {
    if (std::has_single_bit(subset)) return beads_of(subset);
    for (std::size_t b = 0; b < beads_.size(); ++b) {
      const unsigned bit = 1U << b;
      if ((subset & bit) == 0) continue;
      const std::optional<Basis> others = of(subset & ~bit);
      if (others && is_inside(*others, beads_[b], orientation_of(*others, signs_), signs_)) return others;
    }
    if (static_cast<std::size_t>(std::popcount(subset)) > full_size<Signs>) return std::nullopt;
    return beads_of(subset);
  }
  [[nodiscard]] Basis beads_of(unsigned subset) const {
    Basis basis;
    for (std::size_t b = 0; b < beads_.size(); ++b) {
      if ((subset >> b & 1U) != 0) basis.beads[basis.size++] = beads_[b];
    }
    return basis;
  }

  static constexpr std::size_t subsets = 1U << (Basis::max_size + 1);
  std::span<const BeadId> beads_;
  Signs& signs_;
  std::array<Basis, subsets> bases_;
  std::array<State, subsets> states_{};
};

/// Erases a bead from a basis and keeps the order of the others. The code has no branches, because they would
/// be unpredictable.
[[gnu::always_inline]] inline void erase_bead_at(Basis& basis, std::size_t index) {
  for (std::size_t i = 0; i + 1 < Basis::max_size; ++i)
    basis.beads[i] = basis.beads[i + (i >= index ? 1U : 0U)];
  --basis.size;
}

/// Inserts a bead into a basis in order. The basis must have room for the bead.
[[gnu::always_inline]] inline void insert_bead(Basis& basis, BeadId bead) {
  auto& b = basis.beads;
  for (std::size_t i = 0; i < Basis::max_size; ++i) {  // insertion by compare and exchange
    const BeadId here = i < basis.size ? b[i] : no_bead;
    b[i] = std::min(here, bead);
    bead = std::max(here, bead);
  }
  ++basis.size;
}

}  // namespace kds
