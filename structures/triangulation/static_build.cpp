#include "structures/triangulation/static_build.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Min_sphere_of_spheres_d_traits_2.h>
#include <CGAL/Min_sphere_of_spheres_d_traits_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

#include "motions/base/floating_point_scope.h"

namespace kds {

namespace {

using Doubles = CGAL::Simple_cartesian<double>;
template <int Dimension>
using TraitsIn = std::conditional_t<Dimension == 2, CGAL::Min_sphere_of_spheres_d_traits_2<Doubles, double>,
                                    CGAL::Min_sphere_of_spheres_d_traits_3<Doubles, double>>;

template <int Dimension>
auto cgal_spheres(const Eigen::Matrix3Xd& centers, std::span<const double> radii) {
  std::vector<typename TraitsIn<Dimension>::Sphere> spheres;
  spheres.reserve(radii.size());
  for (std::size_t b = 0; b < radii.size(); ++b) {
    const auto c = centers.col(static_cast<Eigen::Index>(b));
    if constexpr (Dimension == 2) {
      spheres.emplace_back(Doubles::Point_2(c.x(), c.y()), radii[b]);
    } else {
      spheres.emplace_back(Doubles::Point_3(c.x(), c.y(), c.z()), radii[b]);
    }
  }
  return spheres;
}

template <int Dimension>
void wrap(std::span<const BeadRange> nodes,
          const std::vector<typename TraitsIn<Dimension>::Sphere>& spheres) {
  double sum = 0;
  for (const BeadRange& range : nodes) {
    CGAL::Min_sphere_of_spheres_d<TraitsIn<Dimension>> sphere(spheres.begin() + range.first,
                                                              spheres.begin() + range.last + 1);
    sum += sphere.radius();
  }
  volatile double used = sum;  // keeps the compiler from omitting a build
  static_cast<void>(used);
}

}  // namespace

template <int Dimension>
StaticBuild spheres_by_cgal(std::span<const BeadRange> nodes, const Eigen::Matrix3Xd& centers,
                            std::span<const double> radii) {
  return [nodes, spheres = cgal_spheres<Dimension>(centers, radii)] {
    const FloatingPointScope to_nearest;
    wrap<Dimension>(nodes, spheres);
  };
}

template StaticBuild spheres_by_cgal<2>(std::span<const BeadRange>, const Eigen::Matrix3Xd&,
                                        std::span<const double>);
template StaticBuild spheres_by_cgal<3>(std::span<const BeadRange>, const Eigen::Matrix3Xd&,
                                        std::span<const double>);

StaticBuild hull_by_cgal(const Eigen::Matrix3Xd& centers) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
  std::vector<Point> points;
  for (Eigen::Index b = 0; b < centers.cols(); ++b) points.emplace_back(centers(0, b), centers(1, b));
  return [points = std::move(points)] {
    const FloatingPointScope to_nearest;
    std::vector<Point> corners;
    CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(corners));
  };
}

StaticBuild order_by_sorting(const Eigen::Matrix3Xd& centers) {
  std::vector<double> unsorted(static_cast<std::size_t>(centers.cols()));
  for (std::size_t b = 0; b < unsorted.size(); ++b) unsorted[b] = centers(0, static_cast<Eigen::Index>(b));
  return [unsorted = std::move(unsorted)] {
    std::vector<double> sorted = unsorted;
    std::sort(sorted.begin(), sorted.end());
    volatile double used = sorted.front();  // keeps the compiler from omitting a build
    static_cast<void>(used);
  };
}

StaticBuild box_by_scanning(const Eigen::Matrix3Xd& centers) {
  return [centers] {
    volatile double used = (centers.rowwise().maxCoeff() - centers.rowwise().minCoeff()).sum();
    static_cast<void>(used);
  };
}

}  // namespace kds
