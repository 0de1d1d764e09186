#include "structures/triangulation/exact_triangulation.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Filtered_kernel.h>
#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/Simple_cartesian.h>
#include <algorithm>

#include "motions/base/floating_point_scope.h"
#include "structures/triangulation/cgal_triangulations.h"

namespace kds {

template <int Dimension>
void WholePowerTest<Dimension>::set_minor(Integer& minor, const Integer& a, const Integer& b,
                                          const Integer& c, const Integer& d) {
  mpz_mul(minor.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  mpz_submul(minor.get_mpz_t(), c.get_mpz_t(), d.get_mpz_t());
}

template <int Dimension>
int WholePowerTest<Dimension>::sign(const std::array<WholePoint<Dimension>, rows + 1>& points) {
  constexpr std::size_t lift = rows - 1;
  const WholePoint<Dimension>& t = points[rows];
  for (std::size_t i = 0; i < rows; ++i) {
    mpz_ptr square = row_[i][lift].get_mpz_t();
    mpz_sub(square, t[lift], points[i][lift]);
    for (std::size_t axis = 0; axis < lift; ++axis) {
      mpz_ptr difference = row_[i][axis].get_mpz_t();
      mpz_sub(difference, points[i][axis], t[axis]);
      mpz_addmul(square, difference, difference);
    }
  }
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = i + 1; j < rows; ++j)
      set_minor(of_pair_[i][j], row_[i][0], row_[j][1], row_[j][0], row_[i][1]);
  }
  // Laplace expansion along the last column and, in space, also along the column before it.
  mpz_set_ui(determinant_.get_mpz_t(), 0);
  for (std::size_t out = 0; out < rows; ++out) {
    std::array<std::size_t, rows - 1> left{};
    for (std::size_t i = 0, next = 0; i < rows; ++i) {
      if (i != out) left[next++] = i;
    }
    mpz_srcptr minor = of_pair_[left[0]][left[1]].get_mpz_t();
    if constexpr (Dimension == 3) {
      mpz_mul(minor_.get_mpz_t(), row_[left[0]][2].get_mpz_t(), of_pair_[left[1]][left[2]].get_mpz_t());
      mpz_submul(minor_.get_mpz_t(), row_[left[1]][2].get_mpz_t(), of_pair_[left[0]][left[2]].get_mpz_t());
      mpz_addmul(minor_.get_mpz_t(), row_[left[2]][2].get_mpz_t(), of_pair_[left[0]][left[1]].get_mpz_t());
      minor = minor_.get_mpz_t();
    }
    const bool even = (out + lift) % 2 == 0;
    (even ? mpz_addmul : mpz_submul)(determinant_.get_mpz_t(), row_[out][lift].get_mpz_t(), minor);
  }
  return sgn(determinant_);
}

template class WholePowerTest<2>;
template class WholePowerTest<3>;

namespace {

/// A power test of points with integer coordinates, used if CGAL's own filter fails. CGAL's power test with
/// rationals takes several times as long.
struct ExactPowerTest {
  using result_type = CGAL::Oriented_side;

  template <class Point>
  CGAL::Oriented_side operator()(const Point& p, const Point& q, const Point& r, const Point& s,
                                 const Point& t) const {
    return CGAL::enum_cast<CGAL::Oriented_side>(-room<3>().sign(
        {whole(p, p.z()), whole(q, q.z()), whole(r, r.z()), whole(s, s.z()), whole(t, t.z())}));
  }
  template <class Point>
  CGAL::Oriented_side operator()(const Point& p, const Point& q, const Point& r, const Point& t) const {
    return CGAL::enum_cast<CGAL::Oriented_side>(room<2>().sign({whole(p), whole(q), whole(r), whole(t)}));
  }

 private:
  template <int Dimension>
  static WholePowerTest<Dimension>& room() {
    thread_local WholePowerTest<Dimension> test;
    return test;
  }
  template <class Point, class... Third>
  static auto whole(const Point& p, const Third&... z) -> WholePoint<2 + sizeof...(Third)> {
    return {whole_number(p.x()), whole_number(p.y()), whole_number(z)..., whole_number(p.weight())};
  }
  template <class Number>
  static mpz_srcptr whole_number(const Number& x) {
    return mpq_numref(x.exact().get_mpq_t());
  }
};

/// A kernel of lazy rationals, each with an enclosing interval. (CGAL's own exact kernel has lazy points
/// instead, which would be constructed anew for each predicate.)
using Rationals = CGAL::Filtered_kernel<CGAL::Simple_cartesian<CGAL::Lazy_exact_nt<CGAL::Epeck_ft>>, false>;

struct AsItIs {
  template <class Point>
  const Point& operator()(const Point& point) const {
    return point;
  }
};

template <class Approximate>
using FilteredPowerTest = CGAL::Filtered_predicate<ExactPowerTest, Approximate, AsItIs, Rationals::C2F>;

/// CGAL's exact numbers for points with integer coordinates.
struct Geometry : Rationals {
  struct Power_side_of_oriented_power_sphere_3 : Rationals::Power_side_of_oriented_power_sphere_3 {
    using Rationals::Power_side_of_oriented_power_sphere_3::operator();
    CGAL::Oriented_side operator()(const Weighted_point_3& p, const Weighted_point_3& q,
                                   const Weighted_point_3& r, const Weighted_point_3& s,
                                   const Weighted_point_3& t) const {
      return FilteredPowerTest<Approximate_kernel::Power_side_of_oriented_power_sphere_3>()(p, q, r, s, t);
    }
  };
  struct Power_side_of_oriented_power_circle_2 : Rationals::Power_side_of_oriented_power_circle_2 {
    using Rationals::Power_side_of_oriented_power_circle_2::operator();
    CGAL::Oriented_side operator()(const Weighted_point_2& p, const Weighted_point_2& q,
                                   const Weighted_point_2& r, const Weighted_point_2& t) const {
      return FilteredPowerTest<Approximate_kernel::Power_side_of_oriented_power_circle_2>()(p, q, r, t);
    }
  };
  [[nodiscard]] static Power_side_of_oriented_power_sphere_3 power_side_of_oriented_power_sphere_3_object() {
    return {};
  }
  [[nodiscard]] static Power_side_of_oriented_power_circle_2 power_side_of_oriented_power_circle_2_object() {
    return {};
  }
};

// Returns the exponent of two in the denominator.
mp_bitcnt_t bits_of_fraction(const Rational& x) { return mpz_scan1(mpq_denref(x.get_mpq_t()), 0); }

// Returns the exponent of the power of two by which lengths are multiplied. Dyadic numbers then become
// integers, for which CGAL's rationals need no common divisors. The scaling does not change the
// triangulation.
mp_bitcnt_t bits_of(std::span<const ExactBead> beads) {
  mp_bitcnt_t bits = 0;
  for (const ExactBead& b : beads) {
    for (const Rational& x : b.center) bits = std::max(bits, bits_of_fraction(x));
    bits = std::max(bits, (bits_of_fraction(b.weight) + 1) / 2);
  }
  return bits;
}

Geometry::FT to_cgal(const Rational& x, mp_bitcnt_t bits) {
  using Exact = Geometry::FT::ET;
  Rational shifted;
  mpq_mul_2exp(shifted.get_mpq_t(), x.get_mpq_t(), bits);
  return Geometry::FT(Exact(shifted.get_mpq_t()));
}

}  // namespace

}  // namespace kds

/// Locates points with the same filter as for CGAL's own exact numbers.
template <>
struct CGAL::Triangulation_structural_filtering_traits<kds::Geometry>
    : CGAL::Triangulation_structural_filtering_traits<CGAL::Epeck> {};

namespace kds {

template <int Dimension>
StaticTriangulation<Dimension> static_triangulation(std::span<const ExactBead> beads, bool oriented) {
  const FloatingPointScope to_nearest;
  using Cgal = CgalTriangulation<Geometry, Dimension>;
  using Triangulation = typename Cgal::Type;
  std::vector<std::pair<typename Triangulation::Weighted_point, BeadId>> points;
  const mp_bitcnt_t bits = bits_of(beads);
  const auto length = [bits](const Rational& x) { return to_cgal(x, bits); };
  for (const ExactBead& b : beads) {
    points.emplace_back(typename Triangulation::Weighted_point(
                            Cgal::point(length(b.center[0]), length(b.center[1]), length(b.center[2])),
                            to_cgal(b.weight, 2 * bits)),
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
