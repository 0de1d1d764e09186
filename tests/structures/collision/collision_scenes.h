#pragma once
// Scenes for tests of collision detectors, and a brute-force loop over all pairs.

#include <Eigen/Core>
#include <Eigen/QR>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "structures/blocks/float_conversion.h"
#include "structures/necklace/ball_distance.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"
#include "tests/support/inputs/random.h"

namespace kds::test {

struct CollisionScene {
  std::string name;
  Eigen::Matrix3Xd centers;
  std::vector<double> radii;
  PairsAsked asked;
};

inline std::vector<BeadPair> all_pairs(const Eigen::Matrix3Xd& centers, const std::vector<double>& radii,
                                       const PairsAsked& asked, int dimension) {
  Eigen::Matrix3Xd c = centers;
  if (dimension == 2) c.row(2).setZero();
  std::vector<BeadPair> found;
  for (BeadId a = 0; a < radii.size(); ++a) {
    for (BeadId b = a + 1; b < radii.size(); ++b) {
      if (asked.asks({a, b}) && compare_distance(c.col(a), c.col(b), radii[a], radii[b]) <= 0)
        found.push_back({a, b});
    }
  }
  return found;
}

/// Returns a question about one, two or many necklaces, some of which have a single bead or are at rest.
inline PairsAsked some_pairs(Random& random, std::size_t beads) {
  PairsAsked asked;
  const std::uint64_t form = random() % 4;
  for (std::size_t first = 0; first < beads;) {
    std::size_t count = beads - first;
    if (form == 1) count = std::min(count, (beads + 1) / 2);
    if (form == 2) count = std::min<std::size_t>(count, 1 + random() % 20);
    asked.necklaces.push_back({static_cast<BeadId>(first), static_cast<BeadId>(first + count - 1)});
    first += count;
  }
  asked.apart = static_cast<BeadId>(random() % 2 == 0 ? 2 : 1 + random() % 20);
  asked.within = random() % 4 != 0;
  asked.between = random() % 4 != 0;
  if (random() % 3 == 0)
    for (std::size_t n = 0; n < asked.necklaces.size(); ++n) asked.at_rest.push_back(random() % 2 != 0);
  return asked;
}

/// Returns random orthonormal axes.
template <int Dimension>
Axes<Dimension> random_axes(Random& random) {
  const Eigen::Matrix<double, Dimension, Dimension> m =
      Eigen::Matrix<double, Dimension, Dimension>::NullaryExpr([&random] { return uniform(random, -1, 1); });
  const Eigen::Matrix<double, Dimension, Dimension> q = m.householderQr().householderQ();
  Axes<Dimension> axes;
  for (Eigen::Index i = 0; i < Dimension; ++i)
    for (Eigen::Index j = 0; j < Dimension; ++j)
      axes[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = q(i, j);
  return axes;
}

/// Makes a random scene: a random walk or scattered points, of any size and place, with equal, mixed or
/// partly zero radii. Some scenes have whole numbers, so that beads touch exactly.
inline CollisionScene random_scene(Random& random, std::size_t most_beads) {
  CollisionScene scene;
  const std::size_t beads = 1 + random() % most_beads;
  scene.asked = some_pairs(random, beads);
  scene.centers.resize(3, static_cast<Eigen::Index>(beads));
  scene.radii.resize(beads);
  const std::uint64_t places = random() % 4, sizes = random() % 4;
  const double box = std::cbrt(static_cast<double>(beads)) * uniform(random, 0.5, 4);
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for (std::size_t b = 0; b < beads; ++b) {
    Eigen::Vector3d step(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    if (places == 0) {
      at = box * step;
    } else if (places == 1) {
      at += 1.5 * step;
    } else if (places == 2) {
      at = (box * step).array().round();  // a grid of beads that touch exactly, or coincide
    } else {
      at += Eigen::Vector3d(1, 0.01 * step[1], 0.01 * step[2]);  // a nearly straight chain
    }
    scene.centers.col(static_cast<Eigen::Index>(b)) = at;
    double& radius = scene.radii[b];
    radius = 0.5;
    if (sizes == 1) radius = uniform(random, 0, 1);
    if (sizes == 2) radius = 0.5 * static_cast<double>(random() % 3);
    if (sizes == 3 && random() % 10 == 0) radius = std::exp(uniform(random, -20, 3));
  }
  scene.name = "places " + std::to_string(places) + ", sizes " + std::to_string(sizes);
  // Scales at which floats or doubles overflow, underflow or lose precision.
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  const std::vector<double> scales{1,       1,        1,     0x1p100, 0x1p-100,
                                   0x1p140, 0x1p-160, 1e300, 1e-300,  1e4 * smallest};
  const double scale = scales[random() % scales.size()];
  scene.centers *= scale;
  for (double& r : scene.radii) r *= scale;
  scene.name += ", scale " + std::to_string(std::log2(scale));
  if (random() % 3 == 0) {
    const std::vector<double> offsets{1e3, 1e7, 1e12, 1e16};
    const double offset = offsets[random() % offsets.size()] * scale;
    if (std::isfinite(offset * 1e4))
      scene.centers.row(static_cast<Eigen::Index>(random() % 2)).array() += offset;
    scene.name += ", offset " + std::to_string(std::log2(offset));
  }
  if (beads > 2 && random() % 8 == 0) {
    scene.centers.col(1) *= -1e7;  // one bead far away makes the float conversion coarse for all other beads
    if (!scene.centers.allFinite()) scene.centers.col(1).setConstant(-1.7e308);
    scene.name += ", one far";
  }
  return scene;
}

}  // namespace kds::test
