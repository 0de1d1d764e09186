#include "structures/triangulation/exact_triangulation.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>

#include "motions/base/floating_point_guard.h"
#include "structures/triangulation/cgal_triangulations.h"

namespace kds {

namespace {

using Geometry = CGAL::Exact_predicates_exact_constructions_kernel;

// Twos in the denominator.
mp_bitcnt_t binary_places(const Rational& x) { return mpz_scan1(mpq_denref(x.data()), 0); }

// Lengths are taken times two to this power: dyadic numbers are whole then, which CGAL's rationals need no
// common divisors for. The triangulation stays as it is.
mp_bitcnt_t places_of(std::span<const ExactBead> beads) {
  mp_bitcnt_t places = 0;
  for (const ExactBead& b : beads) {
    for (const Rational& x : b.center) places = std::max(places, binary_places(x));
    places = std::max(places, (binary_places(b.weight) + 1) / 2);
  }
  return places;
}

Geometry::FT to_cgal(const Rational& x, mp_bitcnt_t places) {
  using Exact = Geometry::FT::ET;
  Rational shifted;
  mpq_mul_2exp(shifted.data(), x.data(), places);
  return Geometry::FT(Exact(shifted.data()));
}

}  // namespace

template <int Dimension>
StaticTriangulation<Dimension> static_triangulation(std::span<const ExactBead> beads, bool oriented) {
  const FloatingPointGuard to_nearest;
  using Cgal = CgalTriangulation<Geometry, Dimension>;
  using Triangulation = typename Cgal::Type;
  std::vector<std::pair<typename Triangulation::Weighted_point, BeadId>> points;
  const mp_bitcnt_t places = places_of(beads);
  const auto length = [places](const Rational& x) { return to_cgal(x, places); };
  for (const ExactBead& b : beads) {
    points.emplace_back(typename Triangulation::Weighted_point(
                            Cgal::point(length(b.center[0]), length(b.center[1]), length(b.center[2])),
                            to_cgal(b.weight, 2 * places)),
                        static_cast<BeadId>(points.size()));
  }
  Triangulation triangulation;
  triangulation.insert(points.begin(), points.end());
  triangulation.infinite_vertex()->info() = infinite_bead;

  StaticTriangulation<Dimension> result{
      {}, hidden_beads(triangulation, beads.size()), triangulation.dimension()};
  if (result.dimension < Dimension) return result;
  for (const auto c : Cgal::all_cells(triangulation)) {
    if (oriented || !triangulation.is_infinite(c)) result.cells.push_back(beads_of<Dimension>(c));
  }
  if (!oriented) sort_cells(result.cells);
  return result;
}

template StaticTriangulation<2> static_triangulation(std::span<const ExactBead>, bool);
template StaticTriangulation<3> static_triangulation(std::span<const ExactBead>, bool);

}  // namespace kds
