// Crossings of bonds, judged over whole numbers, by copies of a periodic cell, and by the linking number.

#include "structures/crossings/crossings.h"
#include "kds/event_log.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "motions/curves/positions.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/parallel_run.h"
#include "tests/support/inputs/random.h"
#include "tests/support/judges/crossings.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::crossings_test {
namespace {

using namespace test;
using testing::IsEmpty;

Scene scene_of(const WholeFrames& frames, const std::vector<std::size_t>& chains,
               const std::vector<Cell>& cells = {}) {
  std::vector<Trajectory> necklaces;
  BeadId first = 0;
  for (const std::size_t beads : chains) {
    Trajectory& necklace = necklaces.emplace_back();
    for (const auto& frame : frames) {
      Eigen::Matrix3Xd& centers = necklace.frames.emplace_back(3, static_cast<Eigen::Index>(beads));
      for (std::size_t b = 0; b < beads; ++b)
        for (std::size_t axis = 0; axis < 3; ++axis)
          centers(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(b)) = frame[first + b][axis];
    }
    necklace.cells = cells;
    first += static_cast<BeadId>(beads);
  }
  return {necklaces, std::vector<double>(first, 1)};
}

std::vector<Event> events_of(const Scene& scene, Kernel kernel = Kernel::filtered,
                             AuditMode audits = AuditMode::none) {
  KineticRun run(scene, {{"crossings"}, kernel, audits});
  EventLog log;
  run.listen(log);
  run.run();
  return log.events;
}

void expect_same(const std::vector<Event>& some, const std::vector<Event>& others) {
  ASSERT_EQ(some.size(), others.size());
  for (std::size_t k = 0; k < others.size(); ++k) {
    EXPECT_EQ(some[k].step, others[k].step);
    EXPECT_EQ(some[k].change, others[k].change);
    EXPECT_EQ(some[k].lower, others[k].lower);
  }
}

void expect_judged(const WholeFrames& frames, const std::vector<std::size_t>& chains, std::size_t& count) {
  const Scene scene = scene_of(frames, chains);
  if (scene.dimension() < 3) return;
  for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
    const std::vector<Event> found = events_of(scene, kernel, AuditMode::events);
    ASSERT_EQ(crossings_fault(frames, scene.bonds(), found), std::nullopt);
    if (kernel == Kernel::exact) count += found.size();
  }
}

/// The ways in which frames are made.
enum class Made { anywhere, few_places, rests, in_planes };

WholeFrames random_frames(Random& random, std::size_t beads, Made made) {
  const int most = made == Made::anywhere ? 8 : 2;
  WholeFrames frames(static_cast<std::size_t>(pick(random, 2, 5)));
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (std::size_t b = 0; b < beads; ++b) {
      auto& point = frames[f].emplace_back();
      for (int& x : point) x = pick(random, -most, most);
      if (made == Made::rests && f > 0 && pick(random, 0, 2) > 0) point = frames[f - 1][b];
      if (made == Made::in_planes && pick(random, 0, 3) > 0) point[2] = f % 2 == 0 || b % 2 == 0 ? 0 : 1;
    }
  }
  return frames;
}

TEST(Crossings, RandomChains) {
  Random random(5301);
  std::size_t count = 0;
  for (int round = 0; round < rounds(120, 10); ++round) {
    for (const Made made : {Made::anywhere, Made::few_places, Made::rests, Made::in_planes}) {
      SCOPED_TRACE(text_of("round ", round, ", made ", static_cast<int>(made)));
      const std::vector<std::size_t> chains =
          pick(random, 0, 1) == 0 ? std::vector<std::size_t>{6} : std::vector<std::size_t>{3, 1, 4};
      expect_judged(random_frames(random, chains.size() == 1 ? 6 : 8, made), chains, count);
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(count, 100U);
}

// The bond of beads 2 and 3 falls through the bond of beads 0 and 1, which rests.
WholeFrames falls(const std::vector<int>& heights, int shift = 0) {
  WholeFrames frames;
  for (const int z : heights) frames.push_back({{-2, 0, 0}, {2, 0, 0}, {shift, -2, z}, {shift, 2, z}});
  return frames;
}

std::vector<int> kinds_of(const WholeFrames& frames, const std::vector<std::size_t>& chains = {2, 2}) {
  std::vector<int> kinds;
  for (const Event& event : events_of(scene_of(frames, chains))) kinds.push_back(event.change.kind);
  return kinds;
}

TEST(Crossings, AtFrames) {
  using C = Crossings;
  using testing::ElementsAre;
  EXPECT_THAT(kinds_of(falls({1, -1})), ElementsAre(C::cross_plus));
  EXPECT_THAT(kinds_of(falls({-1, 1, -1})), ElementsAre(C::cross_minus, C::cross_plus));
  EXPECT_THAT(kinds_of(falls({1, 0, -1})), ElementsAre(C::cross_plus));
  EXPECT_THAT(kinds_of(falls({1, 0, 1})), ElementsAre(C::touch));
  EXPECT_THAT(kinds_of(falls({1, 0})), IsEmpty());
  EXPECT_THAT(kinds_of(falls({0, -1})), IsEmpty());
  EXPECT_THAT(kinds_of(falls({1, -1}, 2)), ElementsAre(C::end_plus));
  EXPECT_THAT(kinds_of(falls({1, -1}, 3)), IsEmpty());
  // The bonds rest on each other for two steps.
  EXPECT_THAT(kinds_of(falls({1, 0, 0, 0, -1})), ElementsAre(C::cross_plus));
  EXPECT_THAT(kinds_of(falls({1, 0, 0, 0, 1})), ElementsAre(C::touch));
}

// A bead passes between the bonds of a bent strand, or the strand passes with its bend.
TEST(Crossings, AtABead) {
  const auto kinds = [](const std::array<int, 3>& end) {
    WholeFrames frames;
    for (const int z : {1, -1})
      frames.push_back({{0, -2, 0}, {0, 2, 0}, {-2, 0, z}, {0, 0, z}, {end[0], end[1], z}});
    return kinds_of(frames, {2, 3});
  };
  using C = Crossings;
  EXPECT_THAT(kinds({2, 1, 0}), testing::ElementsAre(C::end_minus, C::end_minus));
  EXPECT_THAT(kinds({-2, 1, 0}), testing::UnorderedElementsAre(C::end_plus, C::end_minus));
}

// Images in a cell cross as copies of the chains in space do.
TEST(Crossings, InACell) {
  Random random(5302);
  constexpr int size = 10;
  Cell cell = size * Cell::Identity();
  std::size_t count = 0;
  for (int round = 0; round < rounds(100, 20); ++round) {
    SCOPED_TRACE(round);
    cell(0, 1) = round % 2 == 1 ? 4 : 0;  // triclinic
    std::vector<Cell> cells(3, cell);
    if (round % 3 == 2) cells[1](0, 1) += 1, cells[1](2, 2) -= 1;
    WholeFrames frames(3);
    std::vector<std::array<int, 3>> at(6);
    for (std::size_t b = 0; b < at.size(); ++b)
      for (int axis = 0; axis < 3; ++axis) {
        const auto x = static_cast<std::size_t>(axis);
        at[b][x] = b % 3 == 0 ? pick(random, -9, 9) : at[b - 1][x] + pick(random, -4, 4);
      }
    for (auto& frame : frames) {
      frame = at;
      for (auto& point : at)
        for (int& x : point) x += pick(random, -2, 2);
    }
    const Scene periodic = scene_of(frames, {3, 3}, cells);
    ASSERT_TRUE(periodic.is_periodic());
    WholeFrames copied(frames.size());
    std::vector<std::size_t> chains;
    for (int i = -3; i <= 3; ++i)
      for (int j = -3; j <= 3; ++j)
        for (int k = -3; k <= 3; ++k) {
          for (std::size_t f = 0; f < frames.size(); ++f)
            for (const auto& [x, y, z] : frames[f])
              copied[f].push_back(
                  {x + static_cast<int>(cells[f](0, 0)) * i + static_cast<int>(cells[f](0, 1)) * j,
                   y + size * j, z + static_cast<int>(cells[f](2, 2)) * k});
          chains.insert(chains.end(), {3, 3});
        }
    // Keeps the events in which the chain with the lower beads is in the middle copy.
    constexpr BeadId middle = 6 * (7 * 7 * 7 / 2);
    std::vector<std::tuple<std::size_t, double, int, std::array<BeadId, 4>>> right, found;
    for (const Event& e : events_of(scene_of(copied, chains))) {
      std::array<BeadId, 4> beads{};
      bool in_middle = false;
      for (std::size_t k = 0; k < 4; ++k) beads[k] = e.change.ids[k] % 6;
      const bool swaps = beads[0] > beads[2];
      const BeadId lower = e.change.ids[swaps ? 2 : 0];
      in_middle = lower >= middle && lower < middle + 6;
      if (beads[0] == beads[2] || beads[1] == beads[2] || beads[3] == beads[0]) continue;
      if (swaps) beads = {beads[2], beads[3], beads[0], beads[1]};
      if (in_middle) right.emplace_back(e.step, e.lower, e.change.kind, beads);
    }
    for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
      found.clear();
      for (const Event& e : events_of(periodic, kernel, AuditMode::events))
        found.emplace_back(e.step, e.lower, e.change.kind,
                           std::array{e.change.ids[0], e.change.ids[1], e.change.ids[2], e.change.ids[3]});
      EXPECT_THAT(found, testing::UnorderedElementsAreArray(right));
    }
    count += right.size();
    if (HasFailure()) return;
  }
  EXPECT_GT(count, 20U);
}

/// Returns half of the sum of the signs of crossings of two closed strands, seen along a direction in which
/// no two points coincide.
int linking_number(const std::vector<Eigen::Vector3d>& one, const std::vector<Eigen::Vector3d>& other) {
  const Eigen::Vector3d view = Eigen::Vector3d(0.3, 0.2, 1).normalized();
  const Eigen::Vector3d x = view.unitOrthogonal(), y = view.cross(x);
  const auto side = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& p) {
    const Eigen::Vector3d d = b - a, e = p - a;
    return d.dot(x) * e.dot(y) - d.dot(y) * e.dot(x) > 0 ? 1 : -1;
  };
  int sum = 0;
  for (std::size_t i = 0; i + 1 < one.size(); ++i)
    for (std::size_t j = 0; j + 1 < other.size(); ++j) {
      const auto& [a, b, c, d] = std::tie(one[i], one[i + 1], other[j], other[j + 1]);
      if (side(a, b, c) == side(a, b, d) || side(c, d, a) == side(c, d, b)) continue;
      sum += (b - a).cross(c - a).dot(d - c) > 0 ? 1 : -1;
    }
  return sum / 2;
}

/// Returns the writhe of a closed strand: the double sum of Gauss integrals of its bonds (Klenin and
/// Langowski, Biopolymers 54, 2000).
double writhe(const std::vector<Eigen::Vector3d>& r) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < r.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < r.size(); ++j) {
      if (i == 0 && j + 2 == r.size()) continue;
      const Eigen::Vector3d corners[4] = {r[j] - r[i], r[j + 1] - r[i], r[j + 1] - r[i + 1], r[j] - r[i + 1]};
      Eigen::Vector3d normals[4];
      for (std::size_t k = 0; k < 4; ++k) normals[k] = corners[k].cross(corners[(k + 1) % 4]).normalized();
      double area = 0;
      for (std::size_t k = 0; k < 4; ++k)
        area += std::asin(std::clamp(normals[k].dot(normals[(k + 1) % 4]), -1.0, 1.0));
      const double sign = (r[j + 1] - r[j]).cross(r[i + 1] - r[i]).dot(r[j] - r[i]) > 0 ? 1 : -1;
      sum += sign * std::abs(area) / (2 * std::numbers::pi);
    }
  return sum;
}

/// Two rings that tumble through each other; the last bead of each is its first.
std::vector<Trajectory> rings(unsigned seed, std::size_t frames) {
  constexpr std::size_t beads = 13;
  Random random(seed);
  std::vector<Trajectory> rings(2);
  for (std::size_t ring = 0; ring < 2; ++ring) {
    Eigen::Matrix3Xd at(3, static_cast<Eigen::Index>(beads));
    for (std::size_t b = 0; b + 1 < beads; ++b) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(b) / (beads - 1);
      at.col(static_cast<Eigen::Index>(b)) = Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.1 * ring);
    }
    for (std::size_t f = 0; f < frames; ++f) {
      at.col(beads - 1) = at.col(0);
      rings[ring].frames.push_back(at);
      for (Eigen::Index b = 0; b < at.cols(); ++b)
        for (Eigen::Index axis = 0; axis < 3; ++axis)
          at(axis, b) += uniform(random, -0.4, 0.4) - 0.1 * at(axis, b);
    }
  }
  return rings;
}

std::vector<Eigen::Vector3d> strand(const Trajectory& ring, std::size_t frame, double u = 0) {
  std::vector<Eigen::Vector3d> points;
  const std::size_t next = u > 0 ? frame + 1 : frame;
  for (Eigen::Index b = 0; b < ring.frames[frame].cols(); ++b)
    points.emplace_back((1 - u) * ring.frames[frame].col(b) + u * ring.frames[next].col(b));
  return points;
}

TEST(Crossings, ChangeTheLinkingNumberAndTheWrithe) {
  int crossings = 0, self_crossings = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Trajectory> two = rings(seed, 40);
    const BeadId beads = static_cast<BeadId>(two[0].bead_count());
    int linking = linking_number(strand(two[0], 0), strand(two[1], 0));
    std::size_t frame = 0;
    const auto check_until = [&](std::size_t step) {
      for (; frame <= step; ++frame)
        EXPECT_EQ(linking, linking_number(strand(two[0], frame), strand(two[1], frame))) << "frame " << frame;
    };
    for (const Event& event : events_of(Scene(two, std::vector<double>(2 * beads, 0.1)))) {
      check_until(event.step);
      ASSERT_LE(event.change.kind, Crossings::cross_minus);
      const int sign = event.change.kind == Crossings::cross_plus ? 1 : -1;
      const std::size_t ring = event.change.ids[0] / beads;
      if (ring != event.change.ids[2] / beads) {
        linking += sign;
        ++crossings;
        continue;
      }
      constexpr double before_and_after = 1e-7;
      EXPECT_NEAR(writhe(strand(two[ring], event.step, event.upper + before_and_after)) -
                      writhe(strand(two[ring], event.step, event.lower - before_and_after)),
                  2 * sign, 1e-3);
      ++self_crossings;
    }
    check_until(39);
  }
  EXPECT_GT(crossings, 100);
  EXPECT_GT(self_crossings, 20);
}

std::vector<Event> in_parts(const Scene& scene, std::size_t threads, std::size_t steps) {
  EventLog log;
  ParallelRun run(scene, {{"crossings"}}, {.threads = threads, .steps_per_part = steps});
  run.listen(log);
  run.run([](std::size_t) {});
  return log.events;
}

TEST(Crossings, OnSeveralThreads) {
  const Scene scene(rings(7, 60), std::vector<double>(26, 0.1));
  const std::vector<Event> right = events_of(scene);
  ASSERT_GT(right.size(), 100U);
  for (const std::size_t threads : {2U, 3U}) expect_same(in_parts(scene, threads, 7), right);
}

// Bonds meet at frames where the run is cut, in space and in a cell.
TEST(Crossings, OnSeveralThreadsWhereBondsMeet) {
  for (const std::vector<Cell>& cells : {std::vector<Cell>(), std::vector<Cell>(7, 8 * Cell::Identity())}) {
    WholeFrames frames = falls({1, 0, 0, -1, 0, 1, 0});
    for (auto& frame : frames)
      for (const std::size_t bead : {2U, 3U})
        if (!cells.empty()) frame[bead][2] += 8;  // an image crosses
    const Scene scene = scene_of(frames, {2, 2}, cells);
    const std::vector<Event> right = events_of(scene);
    ASSERT_THAT(right, testing::SizeIs(2));
    for (const std::size_t threads : {2U, 3U}) expect_same(in_parts(scene, threads, 1), right);
  }
}

TEST(Crossings, ThroughAnObstacle) {
  std::vector<Trajectory> two(2);
  two[0].frames = {Eigen::Matrix3Xd::Zero(3, 2)};
  two[0].frames[0].row(0) << -2, 2;
  for (const double z : {1, -1}) {
    Eigen::Matrix3Xd& frame = two[1].frames.emplace_back(3, 2);
    frame << 0, 0, -2, 2, z, z;
  }
  const Scene scene(two, std::vector<double>(4, 1));
  ASSERT_FALSE(scene.at_rest().empty());
  EXPECT_THAT(events_of(scene), testing::SizeIs(1));
}

// Counts changes of sign at many times of the step.
TEST(Crossings, OnCurves) {
  const std::vector<Trajectory> two = rings(11, 6);
  const Scene scene(two, std::vector<double>(26, 0.1), FrameMotion::hermite);
  ASSERT_EQ(scene.degree(), 3);
  AnyDegreeMotion<3> motion(26, 3);
  std::size_t sampled = 0;
  for (std::size_t step = 0; step < scene.step_count(); ++step) {
    scene.load(step, motion);
    const Curves<3> curves(motion);
    std::map<std::array<BeadId, 4>, std::pair<double, bool>> before;
    for (int k = 0; k <= 8000; ++k) {
      const Eigen::Matrix3Xd at = approximate_positions(curves, k / 8000.0);
      for (const BeadId a : scene.bonds())
        for (const BeadId b : scene.bonds()) {
          if (b < a + 2) continue;
          const Eigen::Vector3d p = at.col(a), q = at.col(a + 1), r = at.col(b), s = at.col(b + 1);
          const double volume = (q - p).cross(r - p).dot(s - p);
          const auto sides = [](const Eigen::Vector3d& n, const Eigen::Vector3d& x, const Eigen::Vector3d& y,
                                const Eigen::Vector3d& z, const Eigen::Vector3d& w) {
            return n.dot((y - x).cross(z - x)) * n.dot((y - x).cross(w - x)) < 0;
          };
          const Eigen::Vector3d normal = (q - p).cross(s - r);
          const bool meets = sides(normal, p, q, r, s) && sides(normal, r, s, p, q);
          const auto [found, is_new] = before.try_emplace({a, a + 1, b, b + 1}, volume, meets);
          if (!is_new && (found->second.first > 0) != (volume > 0) && meets && found->second.second)
            ++sampled;
          found->second = {volume, meets};
        }
    }
  }
  EXPECT_EQ(events_of(scene).size(), sampled);
  EXPECT_GT(sampled, 10U);
}

// Straight chains on a lattice, of which one is pushed through the other: all its bonds are coplanar with
// those of the other chain.
TEST(Crossings, OfCoplanarBondsAreTouches) {
  WholeFrames frames;
  for (const int y : {3, -3}) {
    auto& frame = frames.emplace_back();
    for (int x = 0; x < 4; ++x) frame.push_back({x, 0, 0});
    for (int x = 0; x < 4; ++x) frame.push_back({x, y, 0});
    frame.push_back({0, 0, 9});
  }
  std::map<int, int> kinds;
  for (const Event& event : events_of(scene_of(frames, {4, 4, 1}))) ++kinds[event.change.kind];
  EXPECT_THAT(kinds, testing::ElementsAre(
                         testing::Pair(int{Crossings::touch}, 7)));  // 3 pairs overlap, 4 touch at ends
}

TEST(Crossings, RefuseOtherChanges) {
  const Scene scene = scene_of(falls({1, -1}), {2, 2});
  KineticRun run(scene, {{"crossings"}});
  run.build();
  auto& crossings = run.structure<Crossings>(0);
  EXPECT_NO_THROW(crossings.apply({Crossings::touch, 4, {0, 1, 2, 3}}));
  for (const Change& wrong :
       {Change{Crossings::touch, 3, {0, 1, 2}}, Change{Crossings::touch, 4, {0, 1, 1, 2}},
        Change{Crossings::touch, 4, {2, 3, 0, 1}}, Change{Crossings::touch, 4, {0, 1, 2, 4}}})
    EXPECT_THROW(crossings.apply(wrong), std::invalid_argument);
}

TEST(Crossings, LeaveOutChainBreaks) {
  std::vector<Trajectory> two = rings(1, 3);
  two[0].gaps = {4, 5};
  const Scene scene(two, std::vector<double>(26, 0.1));
  EXPECT_EQ(scene.bonds().size(), 22U);
  EXPECT_THAT(scene.bonds(), testing::Not(testing::Contains(4U)));
  for (const Event& event : events_of(scene)) EXPECT_NE(event.change.ids[0], 4U);
}

}  // namespace
}  // namespace kds::crossings_test
