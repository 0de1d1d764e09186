#include "experiments/bench_chains.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <unordered_map>

namespace kds {

namespace {

using Random = std::mt19937_64;
constexpr std::uint64_t seed = 20240611;

Eigen::Vector3d random_direction(Random& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return Eigen::Vector3d(x, y, z).normalized();
}

// Which beads are near a place, by cells of side 2.
class CellGrid {
 public:
  void add(const Eigen::Vector3d& p, std::size_t bead) { cells_[key(p, 0, 0, 0)].push_back(bead); }
  void remove_last_of(const Eigen::Vector3d& p) { cells_[key(p, 0, 0, 0)].pop_back(); }
  template <class Test>
  [[nodiscard]] bool any_near(const Eigen::Vector3d& p, const Test& test) const {
    for (int near = 0; near < 27; ++near) {
      const auto found = cells_.find(key(p, near % 3 - 1, near / 3 % 3 - 1, near / 9 - 1));
      if (found == cells_.end()) continue;
      for (const std::size_t bead : found->second)
        if (test(bead)) return true;
    }
    return false;
  }

 private:
  static std::int64_t key(const Eigen::Vector3d& p, int x, int y, int z) {
    const auto place = [](double at, int shift) { return static_cast<std::int64_t>(at / 2) + shift + 1; };
    return (place(p.x(), x) << 40) + (place(p.y(), y) << 20) + place(p.z(), z);
  }
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

}  // namespace

BenchChain helix_chain(std::size_t beads) {
  constexpr double turns = 10;
  BenchChain chain{"helix", 0, Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(beads))};
  for (std::size_t b = 0; b < beads; ++b) {
    const double t = static_cast<double>(b) / static_cast<double>(beads - 1);
    const double angle = 2 * std::numbers::pi * turns * t;
    chain.centers.col(static_cast<Eigen::Index>(b)) << 0.5 + 0.5 * std::cos(angle),
        0.5 + 0.5 * std::sin(angle), t;
  }
  chain.radius = (chain.centers.col(1) - chain.centers.col(0)).norm() / 2;
  return chain;
}

BenchChain packed_chain(std::size_t beads) {
  Random random(seed);
  std::uniform_real_distribution<double> jitter(-0.05, 0.05);
  BenchChain chain{"packed", 0.45, Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(beads))};
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(beads))));
  for (std::size_t b = 0; b < beads; ++b) {  // row by row, every other one backwards
    const std::size_t row = b / side, layer = row / side;
    const std::size_t x = row % 2 == 0 ? b % side : side - 1 - b % side;
    const std::size_t y = layer % 2 == 0 ? row % side : side - 1 - row % side;
    const double at[] = {static_cast<double>(x), static_cast<double>(y), static_cast<double>(layer)};
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      chain.centers(axis, static_cast<Eigen::Index>(b)) = at[axis] + jitter(random);
  }
  return chain;
}

BenchChain random_chain(std::size_t beads) {
  Random random(seed);
  const double side = std::cbrt(static_cast<double>(beads) * 4 / 3 * std::numbers::pi / 0.2);
  CellGrid grid;
  std::vector<Eigen::Vector3d> chain{Eigen::Vector3d::Constant(side / 2)};
  grid.add(chain[0], 0);
  const auto is_free = [&](const Eigen::Vector3d& p) {
    return (p.array() >= 0).all() && (p.array() <= side).all() && !grid.any_near(p, [&](std::size_t other) {
      return other + 1 < chain.size() && (p - chain[other]).squaredNorm() < 4;
    });
  };
  while (chain.size() < beads) {
    Eigen::Vector3d next;
    int tries = 200;
    do next = chain.back() + 2 * random_direction(random);
    while (!is_free(next) && --tries > 0);
    if (tries > 0) {
      grid.add(next, chain.size());
      chain.push_back(next);
      continue;
    }
    for (int back = 0; back < 30 && chain.size() > 1; ++back) {  // a dead end
      grid.remove_last_of(chain.back());
      chain.pop_back();
    }
  }
  BenchChain result{"random", 1, Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(beads))};
  for (std::size_t b = 0; b < beads; ++b) result.centers.col(static_cast<Eigen::Index>(b)) = chain[b];
  return result;
}

std::vector<Eigen::Matrix3Xd> jostled_frames(const Eigen::Matrix3Xd& start, double distance,
                                             std::size_t frames) {
  Random random(seed);
  std::vector<Eigen::Matrix3Xd> all{start};
  while (all.size() < frames) {
    all.push_back(all.back());
    for (Eigen::Index b = 0; b < start.cols(); ++b) all.back().col(b) += distance * random_direction(random);
  }
  return all;
}

}  // namespace kds
