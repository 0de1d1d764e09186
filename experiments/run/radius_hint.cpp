#include "experiments/run/radius_hint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "motions/base/input_error.h"
#include "structures/collision/balls_meet.h"
#include "structures/collision/distance_queries.h"

namespace kds {

namespace {

// Returns half the distance from each bead that moves to its nearest partner in `pairs`, in ascending order.
// The entry is infinite for a bead without a partner.
std::vector<double> half_distances(const Scene& scene, std::span<const BeadPair> pairs) {
  const Eigen::Matrix3Xd centers = scene.centers(0);
  std::vector<double> half(static_cast<std::size_t>(centers.cols()), HUGE_VAL);
  for (const auto& [a, b] : pairs) {
    const double distance = (centers.col(b) - centers.col(a)).norm() / 2;
    half[a] = std::min(half[a], distance);
    half[b] = std::min(half[b], distance);
  }
  for (std::size_t n = scene.at_rest().size(); n-- > 0;)
    if (const BeadRange& range = scene.necklaces()[n]; scene.at_rest()[n])
      half.erase(half.begin() + range.first, half.begin() + range.last + 1);
  std::ranges::sort(half);
  return half;
}

// Rounds up to three digits, so that the balls still meet.
double to_three_digits(double x) {
  const double unit = std::pow(10, std::floor(std::log10(x)) - 2);
  return std::ceil(x / unit) * unit;
}

// Returns the half distances of the beads that move in ascending order. At least half of them are finite; if
// that cannot be achieved, returns an empty list.
template <int Dimension>
std::vector<double> half_distances_known(const Scene& scene, const Balls<Dimension>& balls, BeadId apart) {
  DistanceQueries<Dimension> queries({scene.necklaces(), true, apart, true, {}, scene.at_rest()});
  const auto closest = queries.closest_pair(balls);
  if (!closest || closest->sign <= 0) return {};
  for (double reach = 2 * closest->distance; std::isfinite(reach); reach *= 2) {
    const auto& pairs = queries.pairs_within(balls, reach);
    std::vector<double> half = half_distances(scene, pairs);
    if (half[(half.size() - 1) / 2] < HUGE_VAL) return half;
    if (pairs.size() > 64 * half.size()) break;  // some beads have no partner
  }
  return {};
}

/// The radius to try, with the option that excludes beads which are near along the chain.
struct Advice {
  double radius = 0;
  std::string apart;
};

template <int Dimension>
std::optional<Advice> advice_in(const Scene& scene, BeadId apart) {
  constexpr BeadId few = 5;  // beads closer than this along the chain are near because of its bonds
  const Balls<Dimension> balls(scene.centers(0), scene.radii());
  const BeadId farther = std::max(apart, few);
  std::vector<double> half = half_distances_known(scene, balls, farther);
  std::string option = farther > apart ? fmt::format(" {} {}", "--apart"_arg, farther) : "";
  if (half.empty() && farther > apart) {
    half = half_distances_known(scene, balls, apart);
    option.clear();
  }
  if (half.empty()) return std::nullopt;
  return Advice{half[(half.size() - 1) / 2], option};
}

std::optional<Advice> advice_for(const Scene& scene, BeadId apart) {
  if (scene.is_live()) return std::nullopt;  // the first frame is gone
  if (scene.frame_count() == 0 || !scene.has_radii() || !scene.equal_radii()) return std::nullopt;
  if (scene.dimension() == 2) return advice_in<2>(scene, apart);
  if (scene.dimension() == 3) return advice_in<3>(scene, apart);
  return std::nullopt;
}

constexpr std::string_view half_touch = "at which half of the beads touch another in the first frame";

}  // namespace

std::optional<std::string> radius_hint(const Scene& scene, BeadId apart) {
  const std::optional<Advice> advice = advice_for(scene, apart);
  if (!advice) return std::nullopt;
  return fmt::format(
      "contacts: there are none, because beads of a chain just touch with {} auto, {:.3g}; try {} {:.3g}{}, "
      "{}",
      "--radius"_arg, scene.radii().front(), "--radius"_arg, to_three_digits(advice->radius), advice->apart,
      half_touch);
}

std::optional<std::string> factor_hint(const Scene& scene, double factor, BeadId apart) {
  const std::optional<Advice> advice = advice_for(scene, apart);
  if (!advice) return std::nullopt;
  const double radius = scene.radii().front() / factor;
  return fmt::format("contacts: there are none with radii of {:g} times {} auto, {:.3g}; try {} {:.3g}{}, {}",
                     factor, "--radius"_arg, radius, "--factors"_arg,
                     to_three_digits(advice->radius / radius), advice->apart, half_touch);
}

std::optional<std::string> cutoff_hint(const Scene& scene, bool between_surfaces, BeadId apart) {
  constexpr BeadId few = 5;  // the least distance along the chain, as in radius_hint
  const BeadId farther = std::max(apart, few);
  const std::optional<Advice> advice = advice_for(scene, farther);
  if (!advice) return std::nullopt;
  const double cutoff = 2 * (advice->radius - (between_surfaces ? scene.radii().front() : 0));
  return fmt::format(
      "worth trying is {} {:.3g}, within which half of the beads have another in the first frame that is at "
      "least {} beads along the chain",
      "--cutoff"_arg, to_three_digits(cutoff), farther);
}

}  // namespace kds
