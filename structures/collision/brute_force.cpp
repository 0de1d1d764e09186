#include "structures/collision/brute_force.h"

#include <algorithm>
#include <array>
#include <bit>

#include "motions/base/floating_point_scope.h"
#include "motions/base/interruption.h"
#include "structures/collision/balls_meet.h"
#include "structures/enclosing_sphere/sphere_scan.h"
#include "structures/necklace/pairs_in_question.h"

namespace kds {

namespace {

constexpr BeadId beads_at_a_time = 1024;
using Found = std::array<BeadId, beads_at_a_time>;

// Finds the beads of first..end-1 that are not surely_apart from this bead. The range holds at most
// beads_at_a_time beads.
template <int Dimension>
[[KDS_SCAN_TARGETS]] std::size_t find_near(const Balls<Dimension>& balls, BeadId bead, double distance,
                                           BeadId first, BeadId end, Found& found) {
  const auto centers = detail::coordinates_of(balls);
  const Point<Dimension> center = detail::center_of(balls, bead);
  const double radius = balls.radius(bead);
  std::size_t count = 0;
  for (BeadId b = first; b < end; b += 8) {
    const detail::Eight square = detail::square_distance<Dimension>(centers, b, center);
    const detail::Eight reach = radius + detail::load(balls.radii() + b) + distance;
    const detail::Eight least = detail::all(0x1p-900), limit = reach * reach * (1 + 0x1p-46);
    const detail::EightFlags none{};
    unsigned near = detail::bits_of(square > (limit > least ? limit : least) ? none : ~none);
    if (end - b < 8) near &= (1U << (end - b)) - 1;
    for (; near != 0; near &= near - 1) found[count++] = b + static_cast<BeadId>(std::countr_zero(near));
  }
  return count;
}

// Returns the later beads that form pairs asked about with this bead, as runs first..end-1.
struct Run {
  BeadId first, end;
};
std::array<Run, 2> asked_of(BeadId bead, std::size_t necklace, const PairsAsked& asked) {
  const BeadId end = asked.necklaces[necklace].last + 1, beads = asked.necklaces.back().last + 1;
  const BeadId first = end - bead > asked.apart ? bead + asked.apart : end;
  return {Run{first, asked.within ? end : first}, Run{end, asked.between ? beads : end}};
}

// Calls visit(i, j) for pairs asked for, ascending; without groups and necklaces at rest it leaves out pairs
// that are surely_apart. Reads `distance()` anew for each run of beads.
template <int Dimension, class Distance, class Visit>
void visit_near(const Balls<Dimension>& balls, const PairsAsked& asked, const Distance& distance,
                const Visit& visit) {
  const FloatingPointScope to_nearest;
  if (!asked.groups.empty() || !asked.at_rest.empty()) {
    std::uint64_t visited = 0;
    return PairsInQuestion(asked).for_each([&](BeadId i, BeadId j) {
      if (++visited % beads_at_a_time == 0) InterruptionCheck::ask();
      visit(i, j);
    });
  }
  Found found;
  for (std::size_t n = 0; n < asked.necklaces.size(); ++n) {
    for (BeadId i = asked.necklaces[n].first; i <= asked.necklaces[n].last; ++i) {
      for (const Run& run : asked_of(i, n, asked)) {
        for (BeadId first = run.first; first < run.end;) {
          InterruptionCheck::ask();
          const BeadId end = first + std::min(beads_at_a_time, run.end - first);
          const std::size_t count = find_near(balls, i, distance(), first, end, found);
          for (std::size_t k = 0; k < count; ++k) visit(i, found[k]);
          first = end;
        }
      }
    }
  }
}

}  // namespace

template <int Dimension>
std::vector<BeadPair> pairs_by_force(const Balls<Dimension>& balls, const PairsAsked& asked,
                                     double distance) {
  std::vector<BeadPair> pairs;
  visit_near(
      balls, asked, [distance] { return distance; },
      [&](BeadId i, BeadId j) {
        if (balls_within(balls, i, j, distance)) pairs.push_back({i, j});
      });
  return pairs;
}

template <int Dimension>
std::optional<ClosestPair> closest_pair_by_force(const Balls<Dimension>& balls, const PairsAsked& asked) {
  ClosestSoFar<Dimension> closest(balls);
  visit_near(
      balls, asked, [&] { return std::max(0.0, closest.at_most()); },
      [&](BeadId i, BeadId j) { closest.offer(i, j); });
  return closest.result();
}

template std::vector<BeadPair> pairs_by_force(const Balls<2>&, const PairsAsked&, double);
template std::vector<BeadPair> pairs_by_force(const Balls<3>&, const PairsAsked&, double);
template std::optional<ClosestPair> closest_pair_by_force(const Balls<2>&, const PairsAsked&);
template std::optional<ClosestPair> closest_pair_by_force(const Balls<3>&, const PairsAsked&);

}  // namespace kds
