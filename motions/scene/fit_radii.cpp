#include "motions/scene/fit_radii.h"

#include <fmt/format.h>

#include <algorithm>

#include "motions/base/input_error.h"

namespace kds {

namespace {

struct Ball {
  Eigen::Vector3d centre;
  double radius;
  std::size_t necklace;
  std::size_t bead;  // index within its necklace
};

// Returns the balls of the first frames, from left to right.
std::vector<Ball> sorted_balls(const std::vector<double>& radii, std::span<const Trajectory> necklaces) {
  std::vector<Ball> balls;
  for (std::size_t n = 0; n < necklaces.size(); ++n)
    for (std::size_t i = 0; i < necklaces[n].bead_count(); ++i)
      balls.push_back(
          {necklaces[n].frames.front().col(static_cast<Eigen::Index>(i)), radii[balls.size()], n, i});
  std::stable_sort(balls.begin(), balls.end(),
                   [](const Ball& a, const Ball& b) { return a.centre.x() < b.centre.x(); });
  return balls;
}

bool adjacent(const Ball& a, const Ball& b) {
  return a.necklace == b.necklace && (a.bead + 1 == b.bead || b.bead + 1 == a.bead);
}

[[noreturn]] void refuse_coincident(const Ball& a, const Ball& b, std::span<const Trajectory> necklaces) {
  const auto name = [&](const Ball& ball) {
    return fmt::format("bead {} of {}", ball.bead, necklaces[ball.necklace].file);
  };
  const bool in_order = std::pair(a.necklace, a.bead) < std::pair(b.necklace, b.bead);
  throw InputError(
      fmt::format("--radius: element:fit cannot part {} and {}, which lie in one place in the first frame",
                  name(in_order ? a : b), name(in_order ? b : a)));
}

}  // namespace

std::vector<double> fit_radii(std::vector<double> radii, std::span<const Trajectory> necklaces) {
  const std::vector<Ball> balls = sorted_balls(radii, necklaces);
  const double largest = radii.empty() ? 0 : *std::max_element(radii.begin(), radii.end());
  double factor = 2;  // least ratio of distance to sum of radii, over all pairs that touch
  for (std::size_t i = 0; i < balls.size(); ++i)
    for (std::size_t j = i + 1; j < balls.size(); ++j) {
      if (balls[j].centre.x() - balls[i].centre.x() > 2 * largest) break;
      if (adjacent(balls[i], balls[j])) continue;
      const double distance = (balls[j].centre - balls[i].centre).stableNorm();
      const double reach = balls[i].radius + balls[j].radius;
      if (distance > reach) continue;
      if (distance == 0) refuse_coincident(balls[i], balls[j], necklaces);
      factor = std::min(factor, distance / reach);
    }
  if (factor > 1) return radii;
  // Touching counts as contact, so shrink slightly more, well above the rounding of the distances.
  factor *= 1 - 1e-12;
  for (double& radius : radii) radius *= factor;
  return radii;
}

}  // namespace kds
