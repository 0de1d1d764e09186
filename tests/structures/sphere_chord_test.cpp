// What the chord of a sphere proves, against certificates on integers.

#include "structures/sphere_chord.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "certificates/failure_search.h"
#include "motions/positions.h"
#include "structures/enclosing_sphere.h"
#include "tests/support/moving_beads.h"
#include "tests/support/random_motion.h"

namespace kds {
namespace {

using namespace test;

/// Whether the bead's certificate against the basis holds from `now` to the end of the step.
bool holds(const Space& motion, const Basis& basis, BeadId bead, bool inside, const Instant& now) {
  StageCounts stages;
  const int orientation =
      basis.size == 4 ? sign_just_after<Exact>(Orientation<3>(basis.beads, 1), motion, now, stages) : 0;
  return visit_membership(basis, bead, inside, orientation, [&](const auto& certificate) {
    const Failure::Kind kind = first_failure<Exact>(certificate, motion, now, Birth::unknown, stages).kind;
    return kind != Failure::Kind::later && kind != Failure::Kind::at_birth;
  });
}

struct Tally {
  int proved = 0, inside = 0, beyond = 0, kept = 0;
};

/// Judges all that is claimed of the likely basis at `from` of all beads.
void judge(const Space& motion, double from, Tally& tally) {
  const auto count = static_cast<BeadId>(motion.bead_count());
  const Basis basis =
      likely_basis(0, count - 1, Basis(std::array<BeadId, 2>{0, 1}), approximate_positions(motion, from));
  StepEnds ends;
  ends.set(motion);
  const SphereChord chord = sphere_chord(ends, basis, from);
  if (!chord.proved) return;
  ++tally.proved;
  std::vector<BeadId> beyond;
  find_beyond(ends, {0, count - 1}, basis.beads[0], chord, from, beyond);
  ASSERT_TRUE(std::is_sorted(beyond.begin(), beyond.end()));
  const Instant now(from);
  for (BeadId b = 0; b < count; ++b) {
    if (std::binary_search(beyond.begin(), beyond.end(), b)) {
      ++tally.beyond;
      continue;
    }
    ++tally.inside;
    ASSERT_FALSE(basis.contains(b)) << "basis beads lie on the sphere";
    EXPECT_TRUE(holds(motion, basis, b, true, now)) << "bead " << b << " from " << from;
  }
  if (!chord.keeps_basis || basis.size < 3) return;
  ++tally.kept;
  for (const BeadId b : basis)
    EXPECT_TRUE(holds(motion, without(basis, b), b, false, now)) << "basis bead " << b;
}

TEST(SphereChord, ProvesOnlyWhatHolds) {
  Tally tally;
  for (unsigned seed = 0; seed < 150; ++seed) {
    for (const MotionKind kind : all_motion_kinds) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", kind " << static_cast<int>(kind));
      Random random(1000 * seed + static_cast<unsigned>(kind));
      auto motion = random_motion<Space>(random, 4 + random() % 9, kind);
      // From rest to far: at first hardly anything is beyond, then all.
      const double pace = std::ldexp(1.0, -static_cast<int>(seed % 12));
      for (BeadId b = 0; b < motion.bead_count(); ++b) {
        for (int axis = 0; axis < 3; ++axis) {
          const double x = motion.coordinate(b, 0, axis);
          motion.set_coordinate(b, 1, axis, x + pace * (motion.coordinate(b, 1, axis) - x));
        }
        for (int k = 0; k <= 1; ++k) motion.set_weight(b, k, 0);
      }
      for (const double from : {0.0, 0.25, 0.9}) judge(motion, from, tally);
      if (HasFatalFailure() || HasNonfatalFailure()) return;
    }
  }
  EXPECT_GT(tally.proved, 1000);
  EXPECT_GT(tally.inside, 2000);
  EXPECT_GT(tally.beyond, 2000);
  EXPECT_GT(tally.kept, 200);
}

TEST(SphereChord, ScalesWithTheInput) {
  for (const int exponent : {-300, -140, 100, 140, 300, 900}) {
    Tally tally;
    for (unsigned seed = 0; seed < 20; ++seed) {
      Random random(seed);
      auto motion = random_motion<Space>(random, 9, MotionKind::generic);
      for (BeadId b = 0; b < motion.bead_count(); ++b) {
        for (int axis = 0; axis < 3; ++axis) {
          const double x = motion.coordinate(b, 0, axis);
          motion.set_coordinate(b, 1, axis, x + 0.01 * (motion.coordinate(b, 1, axis) - x));
        }
        for (int k = 0; k <= 1; ++k) motion.set_weight(b, k, 0);
      }
      scale(motion, exponent);
      judge(motion, 0, tally);
    }
    EXPECT_EQ(tally.proved > 0, std::abs(exponent) <= 140) << exponent;
  }
}

// A rigid turn: the triangle's centre rests, its radius dips in between by what the formula says.
TEST(SphereChord, SeesTheDipOfATurningBasis) {
  const double r = 1, turn = 0.2;
  Points from, to;
  for (int k = 0; k < 3; ++k) {
    const double a = 2.0943951023931953 * k;
    from.push_back({r * std::cos(a), r * std::sin(a), 0});
    to.push_back({r * std::cos(a + turn), r * std::sin(a + turn), 0});
  }
  const double dip = r * (1 - std::cos(turn / 2));
  for (const double share : {0.5, 3.0}) {  // of the dip: inside the whole sphere, but is it in the dip?
    Points start = from, end = to;
    start.push_back({0, 0, r - share * dip});
    end.push_back(start.back());
    const Space motion = moving(start, end);
    StepEnds ends;
    ends.set(motion);
    const Basis basis(std::array<BeadId, 3>{0, 1, 2});
    const SphereChord chord = sphere_chord(ends, basis, 0);
    ASSERT_TRUE(chord.proved && chord.keeps_basis);
    std::vector<BeadId> beyond;
    find_beyond(ends, {3, 3}, 0, chord, 0, beyond);
    EXPECT_EQ(beyond.empty(), share > 1);
    EXPECT_EQ(holds(motion, basis, 3, true, Instant(0)), share > 1);
  }
}

// Where motion is slow the kinetic hierarchy makes hardly any certificate.
TEST(SphereChord, PrunesCertificatesInSlowMotion) {
  Random random(12);
  Points from(200), to(200);
  for (std::size_t b = 0; b < from.size(); ++b) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from[b][axis] = (b == 0 ? 0 : from[b - 1][axis]) + uniform(random);
      to[b][axis] = from[b][axis] + 1e-4 * uniform(random);
    }
  }
  StepEnds ends;
  const Space motion = moving(from, to);
  ends.set(motion);
  std::size_t watched = 0, all = 0;
  for (BeadId first = 0; first < 200; first += 25) {
    const BeadRange range{first, first + 24};
    const Basis basis = likely_basis(range.first, range.last, Basis(std::array{range.first, range.last}),
                                     approximate_positions(motion, 0));
    const SphereChord chord = sphere_chord(ends, basis, 0);
    ASSERT_TRUE(chord.proved);
    std::vector<BeadId> beyond;
    find_beyond(ends, range, basis.beads[0], chord, 0, beyond);
    watched += beyond.size() - basis.size;
    all += 25U - basis.size;
  }
  EXPECT_LE(watched, all / 50);
}

}  // namespace
}  // namespace kds
