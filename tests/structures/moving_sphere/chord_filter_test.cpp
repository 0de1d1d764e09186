// Compares the filter that looks at four nodes at a time with the chord and the scan of each node alone.

#include "structures/moving_sphere/beads_beyond.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "motions/curves/positions.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::chord_filter_test {
namespace {

using namespace test;

struct Tally {
  int steady = 0, unproved = 0, beyond = 0;
};

/// Judges the filter's answer for a node: examines the beads one by one with the same bound and the same
/// rounding in double.
template <class M>
void judge(const BeadPaths<M::dimension>& paths, const BeadRange& range, const Basis& basis, bool steady,
           const SphereChord<M::dimension>& chord, std::span<const BeadId> beyond, Tally& tally) {
  const auto own = sphere_chord(paths, basis, {0, 1});
  std::vector<BeadId> own_beyond;
  if (own.proved) find_beyond(paths, range, basis, own, 0, own_beyond);
  const bool all_stay = own.stays == (1U << basis.size) - 1U;
  EXPECT_EQ(steady, own.proved && all_stay && own_beyond.empty());
  EXPECT_TRUE(std::equal(beyond.begin(), beyond.end(), own_beyond.begin(), own_beyond.end()));
  tally.steady += steady ? 1 : 0;
  tally.unproved += own.proved ? 0 : 1;
  tally.beyond += static_cast<int>(own_beyond.size());
  if (steady) return;
  EXPECT_EQ(chord.proved, own.proved);
  if (!own.proved) return;
  EXPECT_EQ(chord.stays, own.stays);
  EXPECT_EQ(chord.center, own.center);
  EXPECT_EQ(chord.limit, own.limit);
  EXPECT_EQ(chord.dip, own.dip);
  // Each bead's own chord stays within the limit's chord, unless the filter reports the bead.
  for (BeadId b = range.first; b <= range.last; ++b) {
    bool inside = true;
    for (int k = 0; k <= paths.degree(); ++k) {
      const double t = static_cast<double>(k) / paths.degree();
      double square = 0;
      for (int axis = 0; axis < M::dimension; ++axis) {
        const auto place = static_cast<std::size_t>(axis);
        const double* const column = paths.column(k, axis);
        const double x =
            column[b] - column[basis.beads[0]] - ((1 - t) * own.center[0][place] + t * own.center[1][place]);
        square += x * x;
      }
      const double* const r = paths.column(k, M::dimension);
      const double room =
          ((1 - t) * own.limit[0] + t * own.limit[1]) * (1 - 0x1p-40) - (r[b] - r[basis.beads[0]]);
      inside &= room >= 0 && square <= room * room;
    }
    const bool told = std::find(beyond.begin(), beyond.end(), b) != beyond.end();
    EXPECT_EQ(told, !inside && !basis.contains(b)) << "bead " << b;
  }
}

template <class M>
void look_at_random_nodes(unsigned seed, Tally& tally) {
  Random random(seed);
  const BeadId count = seed % 7 == 0 ? 301 : 40;  // longer than one word of the scan
  const MotionKind kind = all_motion_kinds[seed % std::size(all_motion_kinds)];
  auto motion = random_motion<M>(random, count, kind);
  if (seed % 2 == 0) {
    for (BeadId b = 0; b < count; ++b) {
      const double r = uniform(random, 0, 0.1);
      for (int k = 0; k <= M::degree; ++k) motion.set_radius(b, k, r);
    }
  }
  if (seed % 3 == 0) {  // nearly at rest
    for (BeadId b = 0; b < count; ++b) {
      for (int k = 1; k <= M::degree; ++k) {
        for (int axis = 0; axis < M::dimension; ++axis) {
          const double start = motion.coordinate(b, 0, axis);
          motion.set_coordinate(b, k, axis, start + 0x1p-10 * (motion.coordinate(b, k, axis) - start));
        }
      }
    }
  }
  BeadPaths<M::dimension> paths;
  paths.set(Curves<M::dimension>(motion));
  std::vector<double> radii = approximate_radii(motion, 0);
  for (double& r : radii) r = std::max(r, 0.0);
  const Balls<M::dimension> balls(approximate_positions(motion, 0), radii);
  std::array<std::vector<BeadRange>, Basis::max_size + 1> ranges;
  std::array<std::vector<Basis>, Basis::max_size + 1> bases;
  for (BeadId first = 0; first + 1 < count; first += 1 + first / 2) {
    for (const BeadId length : {2U, 3U, 6U, 17U, 64U, 65U, 131U, 300U}) {
      if (first + length > count) continue;
      const BeadRange range{first, first + length - 1};
      const Basis basis = smallest_sphere(balls, range.first, range.last).basis;
      ranges[basis.size].push_back(range);
      bases[basis.size].push_back(basis);
    }
  }
  for (std::size_t size = 1; size <= Basis::max_size; ++size) {
    for (std::size_t from = 0; from < ranges[size].size(); from += 4) {
      const std::size_t some = std::min<std::size_t>(4, ranges[size].size() - from);
      const auto nodes = std::span<const BeadRange>(ranges[size]).subspan(from, some);
      const auto their_bases = std::span<const Basis>(bases[size]).subspan(from, some);
      std::vector<BeadId> beyond{7};  // the filter appends
      ChordFilterResult<M::dimension> look;
      filter_nodes<M::dimension>(paths, nodes, their_bases, look, beyond);
      std::size_t begin = 1;
      for (std::size_t i = 0; i < some; ++i) {
        judge<M>(paths, nodes[i], their_bases[i], look.steady[i], look.chords[i],
                 std::span<const BeadId>(beyond).subspan(begin, look.ends[i] - begin), tally);
        begin = look.ends[i];
      }
      EXPECT_EQ(begin, beyond.size());
    }
  }
}

template <class M>
class SteadyNodes : public ::testing::Test {};
using Motions = ::testing::Types<BezierMotion<3, 1>, BezierMotion<2, 1>, BezierMotion<3, 3>>;
TYPED_TEST_SUITE(SteadyNodes, Motions);

TYPED_TEST(SteadyNodes, AreThoseOfChordAndScan) {
  Tally tally;
  for (unsigned seed = 0; seed < 60U; ++seed) look_at_random_nodes<TypeParam>(seed, tally);
  EXPECT_GT(tally.steady, 100);
  EXPECT_GT(tally.unproved, 20);
  EXPECT_GT(tally.beyond, 1000);
}

// Equal radii may be left out without changing the result.
TEST(SteadyNodes, RadiiCanBeLeftOut) {
  Random random(3);
  auto motion = random_motion<BezierMotion<3, 1>>(random, 41, MotionKind::generic);
  for (BeadId b = 0; b < 41; ++b)
    for (int k = 0; k <= 1; ++k) motion.set_radius(b, k, 0.375);
  BeadPaths<3> with, without;
  with.set(Curves<3>(motion));
  without.set(Curves<3>(motion), true);
  EXPECT_EQ(with.extent(), without.extent());
  EXPECT_TRUE(with.equal_radii() && without.equal_radii());
  for (int k = 0; k <= 1; ++k) {
    for (BeadId b = 0; b < 41; ++b) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(with.column(k, axis)[b], motion.coordinate(b, k, axis));
        EXPECT_EQ(without.column(k, axis)[b], motion.coordinate(b, k, axis));
      }
      EXPECT_EQ(with.column(k, 3)[b], 0.375);
      EXPECT_EQ(without.column(k, 3)[b], 0);
    }
  }
}

}  // namespace
}  // namespace kds::chord_filter_test
