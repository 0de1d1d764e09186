#include "structures/enclosing_sphere/exact_enclosing_sphere.h"

#include <cmath>
#include <optional>
#include <vector>

#include "structures/enclosing_sphere/exact_sphere.h"

namespace kds {

namespace {

template <int Dimension>
class ExactSearch {
 public:
  using Whole = IntegerBall<Dimension>;

  ExactSearch(const Balls<Dimension>& balls, BeadId first, BeadId last, bool of_points, ExactUse use)
      : balls_(balls),
        first_(first),
        last_(last),
        of_points_(of_points),
        use_(use),
        unit_(whole_unit(balls, first, last)) {}

  Cage<Dimension> settle(Basis& basis) {
    while (true) {
      const ExactSphere<Dimension> sphere = sphere_of_basis(basis);
      look_from(sphere);
      const BeadId escaped = escaped_from(sphere, basis);
      if (escaped == no_bead) return cage_;
      std::vector<BeadId> among(basis.begin(), basis.end());
      among.push_back(escaped);
      basis = basis_among(among);
    }
  }

 private:
  Whole whole(BeadId bead) const {
    Whole ball = whole_ball(balls_, bead, unit_);
    if (of_points_) ball.radius = 0;
    return ball;
  }
  std::vector<Whole> wholes(std::span<const BeadId> beads) const {
    std::vector<Whole> some;
    for (const BeadId b : beads) some.push_back(whole(b));
    return some;
  }
  Basis basis_among(std::span<const BeadId> beads) const {
    Basis basis;
    for (const std::size_t place : exact_basis_among<Dimension>(wholes(beads)))
      basis.beads[basis.size++] = beads[place];
    basis.sort();
    return basis;
  }
  // Reduces a basis with superfluous beads to a proper one.
  ExactSphere<Dimension> sphere_of_basis(Basis& basis) const {
    const std::span<const BeadId> beads(basis.begin(), basis.size);
    auto sphere = ExactSphere<Dimension>::touching(wholes(beads));
    if (sphere && sphere->is_proper()) return *sphere;
    basis = basis_among(beads);
    return *ExactSphere<Dimension>::touching(wholes({basis.begin(), basis.size}));
  }
  // Sets the sphere in double, and the distances up to which beads are certainly inside and beyond which they
  // are certainly outside.
  void look_from(const ExactSphere<Dimension>& sphere) {
    const Sphere rounded = sphere.rounded(unit_);
    double size = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      cage_.center[axis] = rounded.center[static_cast<Eigen::Index>(axis)];
      size = std::max(size, std::abs(cage_.center[axis]));
    }
    cage_.radius = rounded.radius;
    const double error = 8 * detail::unit_roundoff * (size + rounded.radius);
    inner_ = rounded.radius - error;
    outer_ = rounded.radius + error;
    filtered_ = use_ == ExactUse::where_needed && rounded.radius >= 0x1p-150 && outer_ <= 0x1p150;
  }
  // Returns |p - center| + r, with each term rounded to within 8u.
  double reach(BeadId bead) const {
    double square = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const double d = balls_.coordinate(bead, axis) - cage_.center[axis];
      square += d * d;
    }
    return std::sqrt(square) + (of_points_ ? 0 : balls_.radius(bead));
  }
  // Returns the bead that sticks out most, if doubles can tell that it does. Otherwise returns the first bead
  // that sticks out at all.
  BeadId escaped_from(const ExactSphere<Dimension>& sphere, const Basis& basis) const {
    constexpr double inflation = 1 + 16 * detail::unit_roundoff;
    BeadId farthest = no_bead;
    double most = outer_ * inflation;
    if (filtered_) {
      for (BeadId b = first_; b <= last_; ++b) {
        const double r = reach(b);
        if (r > most) {
          most = r;
          farthest = b;
        }
      }
      if (farthest != no_bead) return farthest;
    }
    for (BeadId b = first_; b <= last_; ++b) {
      if (basis.contains(b) || (filtered_ && reach(b) * inflation < inner_)) continue;
      if (!sphere.holds(whole(b))) return b;
    }
    return no_bead;
  }

  const Balls<Dimension>& balls_;
  BeadId first_, last_;
  bool of_points_;
  ExactUse use_;
  int unit_;
  Cage<Dimension> cage_;
  double inner_ = 0, outer_ = 0;
  bool filtered_ = false;
};

}  // namespace

template <int Dimension>
Cage<Dimension> enclosing_sphere_exactly(const Balls<Dimension>& balls, BeadId first, BeadId last,
                                         Basis& basis, bool of_points, ExactUse use) {
  return ExactSearch<Dimension>(balls, first, last, of_points, use).settle(basis);
}

template Cage<2> enclosing_sphere_exactly(const Balls<2>&, BeadId, BeadId, Basis&, bool, ExactUse);
template Cage<3> enclosing_sphere_exactly(const Balls<3>&, BeadId, BeadId, Basis&, bool, ExactUse);

}  // namespace kds
