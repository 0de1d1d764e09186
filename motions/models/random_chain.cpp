#include "motions/models/random_chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <unordered_map>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/models/elementary.h"

namespace kds::models {

namespace {

// A hash map of beads by grid cells, whose side is the distance that nonadjacent beads keep. It is used only
// for look-up, so its order does not matter.
class Occupied {
 public:
  void add(const Eigen::Vector3d& place) { cells_[key(place, 0, 0, 0)].push_back(place); }
  void remove(const Eigen::Vector3d& place) {
    auto& cell = cells_[key(place, 0, 0, 0)];
    cell.erase(std::find(cell.begin(), cell.end(), place));
  }
  [[nodiscard]] bool near(const Eigen::Vector3d& place) const {
    for (int n = 0; n < 27; ++n) {
      const auto cell = cells_.find(key(place, n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
      if (cell == cells_.end()) continue;
      for (const Eigen::Vector3d& other : cell->second)
        if (squared_distance(place, other) < clear_distance * clear_distance) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] static std::int64_t key(const Eigen::Vector3d& place, int x, int y, int z) {
    const auto number = [](double at, int shift) {  // numbers from 0 on
      return static_cast<std::int64_t>(at / clear_distance) + shift + 1;
    };
    return (number(place[0], x) << 42U) + (number(place[1], y) << 21U) + number(place[2], z);
  }
  std::unordered_map<std::int64_t, std::vector<Eigen::Vector3d>> cells_;
};

}  // namespace

Shape random_chain(std::size_t beads, double fill, Random& random, double bond) {
  constexpr int tries_a_bead = 200;
  constexpr std::size_t steps_back = 30;
  const double volume = 4 * std::numbers::pi / 3 * static_cast<double>(beads) / fill;
  const double side = cube_root(volume);
  std::vector<Eigen::Vector3d> chain{Eigen::Vector3d::Constant(side / 2)};
  Occupied occupied;  // all beads except the last
  std::size_t dead_ends = 0;
  while (chain.size() < beads) {
    int tries = tries_a_bead;
    for (; tries > 0; --tries) {
      const Eigen::Vector3d next = chain.back() + 2 * radius * bond * random.direction();
      const bool inside = next.minCoeff() >= 0 && next.maxCoeff() <= side;
      if (!inside || occupied.near(next)) continue;
      occupied.add(chain.back());
      chain.push_back(next);
      break;
    }
    if (tries > 0) continue;
    if (++dead_ends > 100 + beads)
      throw InputError(fmt::format("--fill: found no chain of {} beads that fill {} of their cube; give less",
                                   beads, fill));
    for (std::size_t back = 0; back < steps_back && chain.size() > 1; ++back) {
      chain.pop_back();
      occupied.remove(chain.back());
    }
  }
  Shape shape(3, static_cast<Eigen::Index>(beads));
  for (std::size_t b = 0; b < beads; ++b) shape.col(static_cast<Eigen::Index>(b)) = chain[b];
  return shape;
}

Shape jittered(Shape shape, double distance, Random& random, int dimension) {
  for (Eigen::Index bead = 0; bead < shape.cols(); ++bead) {
    const double length = distance * radius * random.uniform();
    shape.col(bead) += length * random.direction(dimension);
  }
  return shape;
}

}  // namespace kds::models
