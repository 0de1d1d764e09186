#include "tests/support/judges/cgal_sphere.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Min_sphere_of_spheres_d_traits_3.h>
#include <CGAL/Simple_cartesian.h>

#include <stdexcept>
#include <vector>

namespace kds::test {

ExactSphere cgal_smallest_sphere(std::span<const ExactPoint> points, BeadId first, BeadId last) {
  using Number = CGAL::Gmpq;
  using Geometry = CGAL::Simple_cartesian<Number>;
  using Traits =
      CGAL::Min_sphere_of_spheres_d_traits_3<Geometry, Number, CGAL::Tag_false, CGAL::LP_algorithm>;
  const auto number = [](const Rational& x) { return Number(x.get_mpq_t()); };
  const auto back = [](const Number& x) { return Rational(x.mpq()); };
  std::vector<Traits::Sphere> spheres;
  for (BeadId b = first; b <= last; ++b) {
    const ExactPoint& p = points[b];
    spheres.emplace_back(Geometry::Point_3(number(p[0]), number(p[1]), number(p[2])), Number(0));
  }
  CGAL::Min_sphere_of_spheres_d<Traits> smallest(spheres.begin(), spheres.end());
  // CGAL's numbers here have the form a + b sqrt(d). The centre of points is rational, and their radius is
  // either a or b sqrt(d).
  const Number d = smallest.discriminant();
  ExactSphere sphere;
  auto coordinate = smallest.center_cartesian_begin();
  for (std::size_t axis = 0; axis < 3; ++axis, ++coordinate) {
    if (coordinate->second * d != Number(0)) throw std::logic_error("a centre that is not rational");
    sphere.center[axis] = back(coordinate->first);
  }
  const auto radius = smallest.radius();
  if (radius.first * radius.second * d != Number(0))
    throw std::logic_error("a radius whose square is not rational");
  sphere.square = back(radius.first * radius.first + radius.second * radius.second * d);
  return sphere;
}

}  // namespace kds::test
