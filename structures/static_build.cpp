#include "structures/static_build.h"

#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Min_sphere_of_spheres_d_traits_3.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <vector>

namespace kds {

namespace {

template <class Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

using Geometry = CGAL::Simple_cartesian<double>;
using Traits = CGAL::Min_sphere_of_spheres_d_traits_3<Geometry, double>;

std::vector<Traits::Sphere> cgal_spheres(const Eigen::Matrix3Xd& centers, std::span<const double> radii) {
  std::vector<Traits::Sphere> spheres;
  spheres.reserve(radii.size());
  for (std::size_t b = 0; b < radii.size(); ++b) {
    const auto c = centers.col(static_cast<Eigen::Index>(b));
    spheres.emplace_back(Geometry::Point_3(c.x(), c.y(), c.z()), radii[b]);
  }
  return spheres;
}

void wrap(const NecklaceTree& tree, const std::vector<Traits::Sphere>& spheres) {
  double sum = 0;
  for (NodeId node = 0; node < tree.node_count(); ++node) {
    const BeadRange range = tree.range(node);
    CGAL::Min_sphere_of_spheres_d<Traits> sphere(spheres.begin() + range.first,
                                                 spheres.begin() + range.last + 1);
    sum += sphere.radius();
  }
  volatile double used = sum;  // so that no build can be left out
  static_cast<void>(used);
}

}  // namespace

double seconds_to_wrap(const NecklaceTree& tree, const Eigen::Matrix3Xd& centers,
                       std::span<const double> radii) {
  const auto spheres = cgal_spheres(centers, radii);
  return seconds_of([&] { wrap(tree, spheres); });
}

double processor_seconds_to_wrap(const NecklaceTree& tree, const Eigen::Matrix3Xd& centers,
                                 std::span<const double> radii) {
  const auto spheres = cgal_spheres(centers, radii);
  const auto now = [] {
    std::timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  wrap(tree, spheres);
  return now() - start;
}

double seconds_to_sort(const Eigen::Matrix3Xd& centers) {
  std::vector<double> x(static_cast<std::size_t>(centers.cols()));
  for (std::size_t b = 0; b < x.size(); ++b) x[b] = centers(0, static_cast<Eigen::Index>(b));
  return seconds_of([&] { std::sort(x.begin(), x.end()); });
}

}  // namespace kds
