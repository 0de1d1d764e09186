// The proofs from the path of a sphere, compared with certificates in integers.

#include "structures/moving_sphere/sphere_chord.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <numeric>

#include "certificates/types/membership.h"
#include "certificates/types/orientation.h"
#include "motions/curves/positions.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "structures/moving_sphere/beads_beyond.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/integer_search.h"
#include "tests/support/rounds.h"

namespace kds::sphere_chord_test {
namespace {

using namespace test;

template <class M>
Basis basis_at(const M& motion, const BeadRange& range, double time) {
  std::vector<double> radii = approximate_radii(motion, time);
  for (double& r : radii) r = std::max(r, 0.0);
  const Balls<M::dimension> balls(approximate_positions(motion, time), radii);
  return smallest_sphere(balls, range.first, range.last).basis;
}

/// Returns the failure of the bead's certificate with the basis, from `now` on.
template <Radii radii, class M>
Failure failure_of(const M& motion, const Basis& basis, BeadId bead, bool inside, const Instant& now) {
  int orientation = 0;
  if (basis.size == M::dimension + 1) {
    Orientation<M::dimension> certificate;
    std::copy(basis.begin(), basis.end(), certificate.beads.begin());
    orientation = integer_sign_just_after(certificate, motion, now);
  }
  return visit_membership(
      radii, motion, std::span(basis.begin(), basis.end()), bead, inside, orientation,
      [&](const auto& certificate) { return integer_first_failure(certificate, motion, now); });
}

/// Returns whether the certificate holds from `now` to time `to`, by default the end of the step.
template <Radii radii, class M>
bool holds(const M& motion, const Basis& basis, BeadId bead, bool inside, const Instant& now, double to = 1) {
  const Failure failure = failure_of<radii>(motion, basis, bead, inside, now);
  return failure.kind != Failure::Kind::at_birth &&
         (failure.kind != Failure::Kind::later || (to < 1 && failure.time.upper > to));
}

struct Tally {
  int proved = 0, inside = 0, beyond = 0, kept = 0, dipping = 0, risen = 0;
  int steep = 0;  // proved bases of four balls whose centre moves by more than the radius changes
};

/// Returns q of a basis of four balls (sphere_chord.h).
template <class M>
Eigen::Vector3d slope_of(const M& motion, const Basis& basis, double time) {
  const auto at = approximate_positions(motion, time);
  const auto radii = approximate_radii(motion, time);
  Eigen::Matrix3d c;
  Eigen::Vector3d s;
  for (int i = 0; i < 3; ++i) {
    const BeadId bead = basis.beads[static_cast<std::size_t>(i) + 1], first = basis.beads[0];
    c.row(i) = (at.col(bead) - at.col(first)).transpose();
    s[i] = radii[bead] - radii[first];
  }
  return c.partialPivLu().solve(s);
}

/// Judges all claims about the basis at `from` and all beads.
template <Radii radii, class M>
void judge(const M& motion, double from, Tally& tally) {
  const auto count = static_cast<BeadId>(motion.bead_count());
  const Basis basis = basis_at(motion, {0, count - 1}, from);
  BeadPaths<M::dimension> paths;
  paths.set(Curves<M::dimension>(motion));
  const auto chord = sphere_chord(paths, basis, {from, 1});
  if (!chord.proved) return;
  ++tally.proved;
  if constexpr (M::dimension == 3)
    tally.steep += basis.size == 4 && slope_of(motion, basis, from).norm() > 1 ? 1 : 0;
  std::vector<BeadId> beyond;
  find_beyond(paths, {0, count - 1}, basis, chord, from, beyond);
  ASSERT_TRUE(std::is_sorted(beyond.begin(), beyond.end()));
  std::vector<BeadId> left = beyond;
  take_out_dipping(paths, basis, chord, {from, 1}, no_bead, left);
  tally.dipping += static_cast<int>(beyond.size() - left.size());
  const Instant now(from);
  for (BeadId b = 0; b < count; ++b) {
    if (std::binary_search(left.begin(), left.end(), b)) {
      ++tally.beyond;
      ASSERT_FALSE(basis.contains(b)) << "basis beads are not looked at";
      continue;
    }
    if (basis.contains(b)) continue;
    ++tally.inside;
    EXPECT_TRUE((holds<radii>(motion, basis, b, true, now))) << "bead " << b << " from " << from;
  }
  for (std::size_t i = 0; i < basis.size && basis.size > 1; ++i) {
    if ((chord.stays >> i & 1U) == 0) continue;
    ++tally.kept;
    EXPECT_TRUE((holds<radii>(motion, without(basis, basis.beads[i]), basis.beads[i], false, now)))
        << "basis bead " << basis.beads[i];
  }
}

/// Judges the claims that hold only from a later time `sure` on, when values that have just risen from zero
/// are certain. The basis is that of `sure`, and the chords begin at `from`, before that time.
template <Radii radii, class M>
void judge_risen(const M& motion, double from, double sure, Tally& tally) {
  const auto count = static_cast<BeadId>(motion.bead_count());
  const Basis basis = basis_at(motion, {0, count - 1}, sure);
  BeadPaths<M::dimension> paths;
  paths.set(Curves<M::dimension>(motion));
  const Period period{from, 1, sure};
  const auto chord = sphere_chord(paths, basis, period);
  if (!chord.proved) return;
  const Instant then(sure);
  for (std::size_t i = 0; i < basis.size && basis.size > 1; ++i) {
    if ((chord.rises >> i & 1U) == 0) continue;
    tally.risen += (chord.stays >> i & 1U) == 0 ? 1 : 0;
    EXPECT_TRUE((holds<radii>(motion, without(basis, basis.beads[i]), basis.beads[i], false, then)))
        << "basis bead " << basis.beads[i] << " from " << sure;
  }
  for (BeadId b = 0; b < count; ++b) {
    if (basis.contains(b)) continue;
    std::vector<BeadId> one{b}, other{b};
    take_out_dipping(paths, basis, chord, period, b, one);
    take_out_dipping(paths, basis, chord, period, no_bead, other);
    if (!one.empty()) continue;
    tally.risen += other.empty() ? 0 : 1;
    EXPECT_TRUE((holds<radii>(motion, basis, b, true, then))) << "bead " << b << " from " << sure;
  }
}

/// Speeds range from rest to far motion: at first almost no bead can leave the sphere, in the end all beads
/// can.
template <class M, Radii radii>
Tally judge_random(unsigned seeds) {
  Tally tally;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    for (const MotionKind kind : all_motion_kinds) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", kind " << static_cast<int>(kind));
      Random random(1000 * seed + static_cast<unsigned>(kind));
      auto motion = random_motion<M>(random, 4 + random() % 9, kind);
      const double pace = std::ldexp(1.0, -static_cast<int>(seed % 12));
      const auto slow = [&](double start, double x) { return start + pace * (x - start); };
      for (BeadId b = 0; b < motion.bead_count(); ++b) {
        for (int k = 0; k <= M::degree; ++k) {
          for (int axis = 0; axis < M::dimension; ++axis)
            motion.set_coordinate(b, k, axis,
                                  slow(motion.coordinate(b, 0, axis), motion.coordinate(b, k, axis)));
          motion.set_radius(b, k,
                            radii == Radii::equal ? 0.5 : slow(motion.radius(b, 0), motion.radius(b, k)));
          motion.set_weight(b, k, 0);
        }
      }
      for (const double from : {0.0, 0.25, 0.9}) judge<radii>(motion, from, tally);
      for (const double from : {0.0, 0.5}) {
        for (const double later : {0x1p-20, 0.01, 0.25})
          judge_risen<radii>(motion, from, from + later * (1 - from), tally);
      }
      if (testing::Test::HasFailure()) return tally;
    }
  }
  return tally;
}

TEST(SpherePath, ProvesOnlyWhatHolds) {
  const Tally tally = judge_random<Space, Radii::equal>(test::rounds(150U));
  EXPECT_GT(tally.proved, test::rounds(1000));
  EXPECT_GT(tally.inside, test::rounds(2000));
  EXPECT_GT(tally.beyond, test::rounds(2000));
  EXPECT_GT(tally.kept, test::rounds(200));
  EXPECT_GT(tally.dipping, test::rounds(100));
  EXPECT_GT(tally.risen, test::rounds(50));
}

TEST(SpherePath, OfBallsInThePlaneAndOfCurvedMotion) {
  for (const Tally& tally : {judge_random<Space, Radii::any>(test::rounds(24U)),
                             judge_random<BezierMotion<2, 1>, Radii::any>(test::rounds(24U)),
                             judge_random<BezierMotion<2, 3>, Radii::equal>(test::rounds(24U)),
                             judge_random<BezierMotion<3, 2>, Radii::equal>(test::rounds(24U)),
                             judge_random<BezierMotion<3, 3>, Radii::equal>(test::rounds(24U))}) {
    EXPECT_GT(tally.proved, test::rounds(50));
    EXPECT_GT(tally.inside, test::rounds(100));
    EXPECT_GT(tally.beyond, test::rounds(100));
    EXPECT_GT(tally.kept, test::rounds(50));
  }
}

// If the centre moves by more than the radius changes, two spheres touch the basis; a ball of constant radius
// distinguishes them.
template <class M>
void judge_nearly_flat(Tally& tally) {
  for (unsigned seed = 0; seed < test::rounds(150U); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const double height = std::ldexp(1.0, -static_cast<int>(1 + seed % 6));
    const double pace = height * std::ldexp(1.0, -static_cast<int>(1 + seed % 10));
    const auto motion = nearly_flat_basis<M>(random, 4 + random() % 5, height, pace);
    for (const double from : {0.0, 0.5}) judge<Radii::any>(motion, from, tally);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(SpherePath, OfNearlyFlatBases) {
  Tally linear, curved;
  judge_nearly_flat<Space>(linear);
  judge_nearly_flat<BezierMotion<3, 3>>(curved);
  for (const Tally& tally : {linear, curved}) {
    EXPECT_GT(tally.steep, test::rounds(50));
    EXPECT_GT(tally.kept, test::rounds(300));
    EXPECT_GT(tally.inside, test::rounds(100));
  }
}

template <class M, Radii radii>
void judge_scales() {
  for (const int exponent : {-300, -140, 100, 140, 300, 900}) {
    Tally tally;
    for (unsigned seed = 0; seed < (radii == Radii::equal && M::degree == 1 ? 20U : 6U); ++seed) {
      Random random(seed);
      auto motion = random_motion<M>(random, 9, MotionKind::generic);
      for (BeadId b = 0; b < motion.bead_count(); ++b) {
        for (int k = 0; k <= M::degree; ++k) {
          for (int axis = 0; axis < M::dimension; ++axis) {
            const double x = motion.coordinate(b, 0, axis);
            motion.set_coordinate(b, k, axis, x + 0.01 * (motion.coordinate(b, k, axis) - x));
          }
          motion.set_weight(b, k, 0);
          motion.set_radius(b, k, radii == Radii::equal ? 0 : 0.01 * (1 + b % 5));
        }
      }
      scale(motion, exponent);
      judge<radii>(motion, 0, tally);
    }
    EXPECT_EQ(tally.proved > 0, std::abs(exponent) <= 140) << exponent;
  }
}

TEST(SpherePath, ScalesWithTheInput) {
  judge_scales<Space, Radii::equal>();
  judge_scales<Space, Radii::any>();
  judge_scales<BezierMotion<2, 1>, Radii::any>();
  judge_scales<BezierMotion<2, 3>, Radii::equal>();
  judge_scales<BezierMotion<3, 3>, Radii::equal>();
}

/// Places bead 4 just inside or outside the chord's limit, at both ends in one direction. If the chord claims
/// that the bead stays inside, the bead must stay inside.
template <Radii radii>
void judge_next_to_limit(Space motion, const Basis& basis, const SphereChord<3>& chord,
                         const Eigen::Vector3d& way, double off, Tally& tally) {
  for (std::size_t k = 0; k <= 1; ++k) {
    const auto place = static_cast<int>(k);
    const double own = motion.radius(4, place) - motion.radius(basis.beads[0], place);
    for (int axis = 0; axis < 3; ++axis) {
      motion.set_coordinate(4, place, axis,
                            motion.coordinate(basis.beads[0], place, axis) +
                                chord.center[k][static_cast<std::size_t>(axis)] +
                                way[axis] * (chord.limit[k] - own) * (1 + off));
    }
  }
  BeadPaths<3> paths;
  paths.set(Curves<3>(motion));
  std::vector<BeadId> found;
  find_beyond(paths, {4, 4}, basis, chord, 0, found);
  ++(found.empty() ? tally.inside : tally.beyond);
  if (found.empty()) {
    EXPECT_TRUE((holds<radii>(motion, basis, 4, true, Instant(0))));
  }
}

TEST(SpherePath, BeadsNextToTheLimit) {
  Tally tally;
  for (unsigned seed = 0; seed < test::rounds(60U); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    auto motion = random_motion<Space>(random, 5, MotionKind::generic);
    for (BeadId b = 0; b < 5; ++b) {
      for (int k = 0; k <= 1; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
          const double x = motion.coordinate(b, 0, axis);
          motion.set_coordinate(b, k, axis, x + 0x1p-20 * (motion.coordinate(b, k, axis) - x));
        }
        motion.set_radius(b, k, 0.5);
        motion.set_weight(b, k, 0);
      }
    }
    const Basis basis = basis_at(motion, {0, 3}, 0);
    BeadPaths<3> paths;
    paths.set(Curves<3>(motion));
    const auto chord = sphere_chord(paths, basis, {});
    if (!chord.proved || (chord.stays + 1U) != 1U << basis.size) continue;
    const Eigen::Vector3d way(uniform(random), uniform(random), uniform(random));
    for (const double off : {-1e-12, -1e-13, 0.0, 1e-13, 1e-12})
      judge_next_to_limit<Radii::equal>(motion, basis, chord, way.normalized(), off, tally);
  }
  EXPECT_GT(tally.inside, test::rounds(50));
  EXPECT_GT(tally.beyond, test::rounds(50));
}

// Places beads in the directions in which the centre deviates most.
TEST(SpherePath, BeadsNextToTheLimitOfNearlyFlatBases) {
  Tally tally;
  const Basis basis(std::array<BeadId, 4>{0, 1, 2, 3});
  for (unsigned seed = 0; seed < test::rounds(400U); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const double height = std::ldexp(1.0, -static_cast<int>(1 + seed % 6));
    const double pace = height * std::ldexp(1.0, -static_cast<int>(seed % 9));
    const auto motion = nearly_flat_basis<Space>(random, 5, height, pace);
    BeadPaths<3> paths;
    paths.set(Curves<3>(motion));
    const auto chord = sphere_chord(paths, basis, {});
    if (!chord.proved || (chord.stays + 1U) != 1U << basis.size) continue;
    const Eigen::Vector3d across = slope_of(motion, basis, 0).normalized();
    for (const Eigen::Vector3d& way : {across, Eigen::Vector3d(-across)})
      judge_next_to_limit<Radii::any>(motion, basis, chord, way, -1e-10, tally);
  }
  EXPECT_GT(tally.inside, test::rounds(100));
}

template <class M, Radii radii>
void judge_parts(unsigned seed, Tally& tally) {
  Random random(seed);
  auto motion = random_motion<M>(random, 12, MotionKind::generic);
  const double pace = std::ldexp(1.0, -static_cast<int>(1 + seed % 8));
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int k = 0; k <= M::degree; ++k) {
      for (int axis = 0; axis < M::dimension; ++axis) {
        const double start = motion.coordinate(b, 0, axis);
        motion.set_coordinate(b, k, axis, start + pace * (motion.coordinate(b, k, axis) - start));
      }
      motion.set_radius(b, k, radii == Radii::equal ? 0.5 : 0.01 * (b % 7));
      motion.set_weight(b, k, 0);
    }
  }
  BeadPaths<M::dimension> paths;
  paths.set(Curves<M::dimension>(motion));
  const auto count = static_cast<BeadId>(motion.bead_count());
  const double from = seed % 4 == 0 ? 0 : std::uniform_real_distribution<double>(0, 0.9)(random);
  const Basis basis = basis_at(motion, {0, count - 1}, from);
  std::array<Basis, 4> bases;
  std::array<Period, 4> periods;
  std::array<SphereChord<M::dimension>, 4> chords;
  bases.fill(basis);
  // The ends of the periods are rounded. In half of the cases the last end is the end of the step.
  const double end = seed % 2 == 0 ? 1 : from + 0.5 * (1 - from);
  for (std::size_t i = 0; i < 4; ++i) {
    periods[i].from = i == 0 ? from : periods[i - 1].to;
    periods[i].to = i == 3 ? end : from + 0.25 * static_cast<double>(i + 1) * (end - from);
  }
  sphere_chords<M::dimension>(paths, bases, periods, chords);
  if (!std::all_of(chords.begin(), chords.end(), [](const auto& chord) { return chord.proved; })) return;
  ++tally.proved;
  std::vector<BeadId> beyond(count);
  std::iota(beyond.begin(), beyond.end(), 0U);
  keep_beyond<M::dimension>(paths, basis, chords, periods, beyond);
  const bool stay = std::all_of(chords.begin(), chords.end(),
                                [&](const auto& chord) { return chord.stays == (1U << basis.size) - 1U; });
  for (BeadId b = 0; b < count; ++b) {
    if (std::binary_search(beyond.begin(), beyond.end(), b)) {
      ++tally.beyond;
    } else {
      ++tally.inside;
      ASSERT_FALSE(basis.contains(b)) << "basis beads lie on the sphere";
      if (stay) {
        EXPECT_TRUE((holds<radii>(motion, basis, b, true, Instant(from), periods.back().to)))
            << "bead " << b << ", seed " << seed;
      }
    }
  }
}

TEST(SpherePath, ProvesPartsOfAStep) {
  Tally equal, any;
  for (unsigned seed = 0; seed < test::rounds(400U); ++seed) judge_parts<Space, Radii::equal>(seed, equal);
  for (unsigned seed = 0; seed < test::rounds(100U); ++seed) {
    judge_parts<Space, Radii::any>(seed, any);
    judge_parts<BezierMotion<2, 3>, Radii::any>(seed, any);
  }
  for (const Tally& tally : {equal, any}) {
    EXPECT_GT(tally.proved, test::rounds(50));
    EXPECT_GT(tally.inside, test::rounds(200));
    EXPECT_GT(tally.beyond, test::rounds(200));
  }
}

// Two balls are claimed to be apart only if neither ever contains the other, and in most such cases the claim
// is made.
template <class M>
void judge_pairs(unsigned seed, int& said, int& missed) {
  Random random(seed);
  auto motion = random_motion<M>(random, 8, all_motion_kinds[seed % std::size(all_motion_kinds)]);
  if (seed % 2 == 0) {
    for (BeadId b = 0; b < 8; ++b)
      for (int k = 0; k <= M::degree; ++k) motion.set_radius(b, k, uniform(random, 0, 1));
  }
  BeadPaths<M::dimension> paths;
  paths.set(Curves<M::dimension>(motion));
  std::vector<std::uint8_t> apart_from_next;
  paths.find_apart_from_next(apart_from_next);
  for (BeadId b = 0; b < 7; ++b) {
    bool apart = true;
    for (const auto& [holder, held] : {std::pair(b, b + 1), std::pair(b + 1, b)}) {
      const Basis basis(std::array<BeadId, 1>{holder});
      apart &= holds<Radii::any>(motion, basis, held, false, Instant(0));
    }
    const bool claimed = apart_from_next[b] != 0;
    EXPECT_TRUE(apart || !claimed) << "beads " << b << " and " << b + 1 << ", seed " << seed;
    said += claimed ? 1 : 0;
    missed += apart && !claimed ? 1 : 0;
  }
}

TEST(SpherePath, KnowsBallsThatStayApart) {
  int said = 0, missed = 0;
  for (unsigned seed = 0; seed < test::rounds(200U); ++seed) {
    judge_pairs<Space>(seed, said, missed);
    judge_pairs<BezierMotion<2, 3>>(seed, said, missed);
  }
  EXPECT_GT(said, test::rounds(300));
  EXPECT_GT(missed, test::rounds(10));
}

// Bounding four bases at once gives the same bits as bounding each alone.
template <class M>
void judge_four(Random& random, std::size_t size) {
  const auto motion = random_motion<M>(random, 24, MotionKind::generic);
  BeadPaths<M::dimension> paths;
  paths.set(Curves<M::dimension>(motion));
  std::array<Basis, 4> bases;
  constexpr std::array<Period, 4> periods{{{0, 1}, {0.25, 1, 0.26}, {0, 0.25}, {0.3, 0.9, 0.5}}};
  for (std::size_t i = 0; i < bases.size(); ++i) {
    for (std::size_t k = 0; k < size; ++k) bases[i].beads[k] = static_cast<BeadId>(6 * i + k);
    bases[i].size = static_cast<std::uint8_t>(size);
  }
  for (std::size_t count = 1; count <= 4; ++count) {
    std::array<SphereChord<M::dimension>, 4> chords;
    sphere_chords<M::dimension>(paths, std::span(bases).first(count), periods,
                                std::span(chords).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      const auto alone = sphere_chord(paths, bases[i], periods[i]);
      ASSERT_EQ(chords[i].proved, alone.proved);
      if (!alone.proved) continue;
      EXPECT_EQ(chords[i].stays, alone.stays);
      EXPECT_EQ(chords[i].rises, alone.rises);
      EXPECT_EQ(chords[i].dip, alone.dip);
      EXPECT_EQ(chords[i].center, alone.center);
      EXPECT_EQ(chords[i].limit, alone.limit);
    }
  }
}

TEST(SpherePath, OfFourBasesAtOnce) {
  Random random(3);
  for (int round = 0; round < test::rounds(50); ++round) {
    for (std::size_t size = 1; size <= 4; ++size) {
      judge_four<Space>(random, size);
      if (size < 4) judge_four<BezierMotion<2, 3>>(random, size);
    }
  }
}

// A rigid rotation: the centre of the triangle rests, and in between the radius decreases (dips) by the
// amount that the formula gives.
TEST(SpherePath, SeesTheDipOfATurningBasis) {
  const double r = 1, turn = 0.2;
  Points from, to;
  for (int k = 0; k < 3; ++k) {
    const double a = 2.0943951023931953 * k;
    from.push_back({r * std::cos(a), r * std::sin(a), 0});
    to.push_back({r * std::cos(a + turn), r * std::sin(a + turn), 0});
  }
  const double dip = r * (1 - std::cos(turn / 2));
  // `share` of the dip: the bead is inside the full sphere, and for 0.5 it is outside during the dip.
  for (const double share : {0.5, 3.0}) {
    Points start = from, end = to;
    start.push_back({0, 0, r - share * dip});
    end.push_back(start.back());
    const Space motion = moving(start, end);
    BeadPaths<3> paths;
    paths.set(Curves<3>(motion));
    const Basis basis(std::array<BeadId, 3>{0, 1, 2});
    const auto chord = sphere_chord(paths, basis, {});
    ASSERT_TRUE(chord.proved && chord.stays == 7);
    std::vector<BeadId> beyond;
    find_beyond(paths, {3, 3}, basis, chord, 0, beyond);
    EXPECT_EQ(beyond.empty(), share > 1);
    EXPECT_EQ((holds<Radii::equal>(motion, basis, 3, true, Instant(0))), share > 1);
  }
}

// In slow motion the kinetic hierarchy makes almost no certificates.
TEST(SpherePath, PrunesCertificatesInSlowMotion) {
  Random random(12);
  Points from(200), to(200);
  for (std::size_t b = 0; b < from.size(); ++b) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from[b][axis] = (b == 0 ? 0 : from[b - 1][axis]) + uniform(random);
      to[b][axis] = from[b][axis] + 1e-4 * uniform(random);
    }
  }
  BeadPaths<3> paths;
  const Space motion = moving(from, to);
  paths.set(Curves<3>(motion));
  std::size_t watched = 0, all = 0;
  for (BeadId first = 0; first < 200; first += 25) {
    const BeadRange range{first, first + 24};
    const Basis basis = basis_at(motion, range, 0);
    const auto chord = sphere_chord(paths, basis, {});
    ASSERT_TRUE(chord.proved);
    std::vector<BeadId> beyond;
    find_beyond(paths, range, basis, chord, 0, beyond);
    watched += beyond.size();
    all += 25U - basis.size;
  }
  EXPECT_LE(watched, all / 50);
}

}  // namespace
}  // namespace kds::sphere_chord_test
