// Compares static detectors with exact decisions for all pairs.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "structures/collision/auto_detector.h"
#include "structures/collision/block_tree.h"
#include "structures/collision/brute_force.h"
#include "structures/collision/cell_list.h"
#include "structures/collision/distance_queries.h"
#include "structures/collision/hierarchy_search.h"
#include "tests/structures/collision/collision_scenes.h"
#include "tests/support/rounds.h"

namespace kds::collision_detectors_test {

void PrintTo(const BeadPair& pair, std::ostream* out) { *out << pair.first << "-" << pair.second; }

namespace {

using namespace test;

std::vector<VectorTarget> targets() {
  std::vector<VectorTarget> some;
  for (const VectorTarget target : {VectorTarget::plain, VectorTarget::avx2, VectorTarget::avx512})
    if (is_available(target)) some.push_back(target);
  return some;
}

template <int Dimension>
void expect_all_right(const CollisionScene& scene) {
  const Balls<Dimension> balls(scene.centers, scene.radii);
  const auto expected = all_pairs(scene.centers, scene.radii, scene.asked, Dimension);
  const std::string what = scene.name + ", " + std::to_string(scene.radii.size()) + " beads in " +
                           std::to_string(scene.asked.necklaces.size()) + " necklaces, dimension " +
                           std::to_string(Dimension);
  ASSERT_EQ(CellList<Dimension>(scene.asked).pairs(balls), expected) << "cell list, " << what;
  ASSERT_EQ(VerletList<Dimension>(scene.asked, 1.0).pairs(balls), expected) << "Verlet list, " << what;
  std::optional<typename BlockTree<Dimension>::Counts> counts, turned_counts;
  for (const VectorTarget target : targets()) {
    const std::string with = std::string(vector_target_names[static_cast<std::size_t>(target)]) + ", " + what;
    BlockTree<Dimension> sequence(scene.asked, BlockOrder::sequence, target);
    ASSERT_EQ(sequence.pairs(balls), expected) << "blocks in sequence, " << with;
    ASSERT_EQ(sequence.pairs(balls), expected) << "the same again, " << with;
    // All vector targets must give the same bits.
    if (!counts) counts = sequence.counts();
    EXPECT_EQ(counts->group_pairs, sequence.counts().group_pairs) << with;
    EXPECT_EQ(counts->candidates, sequence.counts().candidates) << with;
    Random random(scene.radii.size());
    sequence.turn(random_axes<Dimension>(random));
    ASSERT_EQ(sequence.pairs(balls), expected) << "blocks in sequence, turned, " << with;
    ASSERT_TRUE(balls.size() == 0 || sequence.conversion().axes) << with;
    if (!turned_counts) turned_counts = sequence.counts();
    EXPECT_EQ(turned_counts->group_pairs, sequence.counts().group_pairs) << "turned, " << with;
    EXPECT_EQ(turned_counts->candidates, sequence.counts().candidates) << "turned, " << with;
    BlockTree<Dimension> spatial(scene.asked, BlockOrder::spatial, target);
    ASSERT_EQ(spatial.pairs(balls), expected) << "blocks in space, " << with;
    ASSERT_EQ(AutoDetector<Dimension>(scene.asked, std::nullopt, target).pairs(balls), expected)
        << "auto, " << with;
  }
}

TEST(CollisionDetectors, RandomScenesOfAllSizesAndPlaces) {
  for (unsigned seed = 0; seed < rounds(600U); ++seed) {
    Random random(seed);
    const CollisionScene scene = random_scene(random, seed % 50 == 0 ? 400 : 60);
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_all_right<3>(scene);
    expect_all_right<2>(scene);
    if (HasFatalFailure()) return;
  }
}

/// Makes chains that are straight or bend, in a few places sharply. The steps are chosen so that beads that
/// are `apart` beads from each other along the chain touch exactly, almost touch, or are clearly apart.
template <int Dimension>
CollisionScene stretched_scene(Random& random) {
  CollisionScene scene{
      "stretched", Eigen::Matrix3Xd(3, 40 + static_cast<Eigen::Index>(random() % 200)), {}, {}};
  const auto beads = static_cast<std::size_t>(scene.centers.cols());
  const std::array<double, 6> factors{1, 1 + 0x1p-40, 1 + 0x1p-14, 1 - 0x1p-14, 1.2, 2};
  scene.asked.apart = static_cast<BeadId>(1 + random() % 3);
  const double step = factors[random() % factors.size()] / scene.asked.apart;
  const double bend = random() % 2 == 0 ? 0 : uniform(random, 0, 0.2);
  const double scatter = random() % 3 == 0 ? 0.05 : 0;
  const std::uint64_t straight_on = 10 + random() % 100;  // mean number of beads between two sharp bends
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  double angle = random() % 2 == 0 ? 0 : uniform(random, 0, 7);
  for (Eigen::Index b = 0; b < scene.centers.cols(); ++b) {
    scene.centers.col(b) =
        at + scatter * Eigen::Vector3d(uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1));
    angle += random() % straight_on == 0 ? uniform(random, -3.2, 3.2) : bend;
    at += step * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
  }
  if (Dimension == 3 && random() % 2 == 0) scene.centers.row(0).swap(scene.centers.row(2));
  scene.radii.assign(beads, 0.5);
  if (random() % 4 == 0) scene.radii[random() % beads] = 0.25;
  const auto last = static_cast<BeadId>(beads - 1), middle = static_cast<BeadId>(random() % beads);
  scene.asked.necklaces = {{0, last}};
  if (random() % 2 == 0 && middle < last) scene.asked.necklaces = {{0, middle}, {middle + 1, last}};
  return scene;
}

template <int Dimension>
void expect_right_when_stretched(Random& random, std::size_t& skipped, std::size_t& found) {
  const CollisionScene scene = stretched_scene<Dimension>(random);
  expect_all_right<Dimension>(scene);
  const Balls<Dimension> balls(scene.centers, scene.radii);
  BlockTree<Dimension> tree(scene.asked, BlockOrder::sequence);
  found += tree.pairs(balls).empty() ? 0 : 1;
  const std::size_t blocks = scene.radii.size() / 16;
  // Without skipping, the pairs of blocks with themselves alone would be as many.
  skipped += tree.counts().block_pairs < blocks ? 1 : 0;
}

TEST(CollisionDetectors, StretchedPiecesOfChainsAreSkipped) {
  std::size_t skipped = 0, found = 0;
  for (unsigned seed = 0; seed < rounds(600U); ++seed) {
    Random random(seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_right_when_stretched<3>(random, skipped, found);
    expect_right_when_stretched<2>(random, skipped, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(skipped, rounds(600U) / 10);
  EXPECT_GT(found, rounds(600U) / 4);
}

TEST(CollisionDetectors, NoBeadsOneBeadTwoBeads) {
  const PairsAsked none;
  const Balls<3> nothing(Eigen::Matrix3Xd(3, 0), {});
  EXPECT_TRUE(CellList<3>(none).pairs(nothing).empty());
  EXPECT_TRUE(BlockTree<3>(none).pairs(nothing).empty());
  EXPECT_TRUE(AutoDetector<3>(none).pairs(nothing).empty());
  for (const double distance : {0.0, 1.0, 2.0, std::nextafter(2.0, 3.0), 3.0}) {
    CollisionScene scene{"two beads", Eigen::Matrix3Xd::Zero(3, 2), {1, 1}, {{{0, 1}}, true, 1, true}};
    scene.centers(0, 1) = distance;
    expect_all_right<3>(scene);
    expect_all_right<2>(scene);
    EXPECT_EQ(BlockTree<3>(scene.asked).pairs(Balls<3>(scene.centers, scene.radii)).size(),
              distance <= 2 ? 1 : 0);
  }
}

// Many coincident beads, and grids in which every bead exactly touches its neighbours: all candidates are
// decided over rationals.
TEST(CollisionDetectors, AllCoincideOrTouch) {
  CollisionScene same{"coincident", Eigen::Matrix3Xd::Constant(3, 70, 0.1), std::vector<double>(70, 0.0), {}};
  same.asked.necklaces = {{0, 69}};
  expect_all_right<3>(same);
  for (const double spacing : {1.0, 0x1p-1060, 0x1p1015}) {
    CollisionScene grid{"grid", Eigen::Matrix3Xd(3, 343), std::vector<double>(343, spacing / 2), {}};
    for (Eigen::Index b = 0; b < 343; ++b)
      grid.centers.col(b) =
          spacing * Eigen::Vector3d(static_cast<double>(b % 7), static_cast<double>(b / 7 % 7),
                                    static_cast<double>(b / 49));
    grid.asked = {{{0, 199}, {200, 342}}, true, 1, true};
    expect_all_right<3>(grid);
    const auto found = BlockTree<3>(grid.asked).pairs(Balls<3>(grid.centers, grid.radii));
    EXPECT_EQ(found.size(), 3U * 7 * 7 * 6);
  }
}

TEST(CollisionDetectors, SequenceIsGivenUpWhereItCostsTooMuch) {
  Random random(1);
  const BeadId beads = rounds(4000U, 2500U);
  CollisionScene gas{"gas", Eigen::Matrix3Xd(3, Eigen::Index{beads}), std::vector<double>(beads, 0.4), {}};
  const double side = 14 * std::cbrt(beads / 4000.0);
  for (Eigen::Index b = 0; b < beads; ++b)
    gas.centers.col(b) =
        side * Eigen::Vector3d(uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1));
  gas.asked.necklaces = {{0, beads - 1}};
  const Balls<3> balls(gas.centers, gas.radii);
  BlockTree<3> tree(gas.asked);
  EXPECT_EQ(tree.pairs(balls), CellList<3>(gas.asked).pairs(balls));
  EXPECT_EQ(tree.order(), BlockOrder::spatial);
  EXPECT_EQ(tree.pairs(balls), all_pairs(gas.centers, gas.radii, gas.asked, 3));
  // A straight chain follows: the detector tries the sequence order again.
  for (Eigen::Index b = 0; b < beads; ++b) gas.centers.col(b) = Eigen::Vector3d(static_cast<double>(b), 0, 0);
  const Balls<3> straight(gas.centers, gas.radii);
  tree.forget_order();
  EXPECT_TRUE(tree.pairs(straight).empty());
  EXPECT_EQ(tree.order(), BlockOrder::sequence);
}

/// Makes a chain that runs to and fro through the rows of a grid of beads that touch exactly, turned about
/// its first bead.
template <int Dimension>
CollisionScene packed_chain(Eigen::Index side, double angle) {
  const Eigen::Index beads = Dimension == 3 ? side * side * side : side * side;
  CollisionScene scene{
      "packed", Eigen::Matrix3Xd(3, beads), std::vector<double>(static_cast<std::size_t>(beads), 0.5), {}};
  scene.asked.necklaces = {{0, static_cast<BeadId>(beads - 1)}};
  const auto to_and_fro = [side](Eigen::Index k) {
    return k / side % 2 == 0 ? k % side : side - 1 - k % side;
  };
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  if (Dimension == 3) {
    Eigen::Matrix3d other = Eigen::Matrix3d::Identity();
    other.bottomRightCorner<2, 2>() = turn.topLeftCorner<2, 2>();
    turn = turn * other;
  }
  for (Eigen::Index b = 0; b < beads; ++b)
    scene.centers.col(b) =
        turn * Eigen::Vector3d(static_cast<double>(to_and_fro(b)), static_cast<double>(to_and_fro(b / side)),
                               static_cast<double>(b / (side * side)));
  return scene;
}

template <int Dimension>
void expect_turned(Eigen::Index side) {
  CollisionScene scene = packed_chain<Dimension>(side, 0.6);
  BlockTree<Dimension> tree(scene.asked);
  CellList<Dimension> cells(scene.asked);
  for (const double spread : {1.0, 0.999, 1.001}) {  // about half of the pairs meet, all meet, none meets
    const Balls<Dimension> balls(spread * scene.centers, scene.radii);
    EXPECT_EQ(tree.pairs(balls), cells.pairs(balls));
    ASSERT_TRUE(tree.conversion().axes);
    EXPECT_EQ(tree.order(), BlockOrder::sequence);
  }
  const auto turned = tree.counts();
  // Near pairs of some blocks in a turned frame are the near pairs that have a bead in these blocks.
  const Balls<Dimension> balls(scene.centers, scene.radii);
  const auto near = tree.near_pairs(balls, 0.1, 100 * scene.radii.size());
  std::vector<BeadPair> all(near->begin(), near->end()), some;
  for (const BeadPair& pair : all)
    if (pair.first / 16 == 3 || pair.second / 16 == 3) some.push_back(pair);
  const std::vector<std::uint32_t> third{3};
  const auto again = tree.near_pairs_of(balls, third, all.size());
  std::vector<BeadPair> found(again->begin(), again->end());
  std::sort(some.begin(), some.end());
  std::sort(found.begin(), found.end());
  EXPECT_FALSE(some.empty());
  EXPECT_EQ(found, some);
  // Boxes along the coordinate axes need more work. Another scene starts with such boxes.
  BlockTree<Dimension> plain(scene.asked, BlockOrder::sequence);
  (void)plain.pairs(Balls<Dimension>(1.001 * scene.centers, scene.radii));
  EXPECT_GT(plain.counts().block_pairs + plain.counts().group_pairs,
            2 * (turned.block_pairs + turned.group_pairs));
  tree.forget_order();
  const CollisionScene straight = packed_chain<Dimension>(side, 0);
  const Balls<Dimension> along_axes(straight.centers, straight.radii);
  EXPECT_EQ(tree.pairs(along_axes), cells.pairs(along_axes));
  EXPECT_FALSE(tree.conversion().axes);
}

TEST(CollisionDetectors, BoxesAreTurnedToTheBonds) {
  expect_turned<3>(24);
  expect_turned<2>(128);
}

TEST(CollisionDetectors, ScenesThatFloatsDoNotTellApartAreLeftToCells) {
  Random random(1);
  CollisionScene far{
      "far", Eigen::Matrix3Xd(3, 2000), std::vector<double>(2000, 0.5), {{{0, 999}, {1000, 1999}}}};
  for (Eigen::Index b = 0; b < 2000; ++b)
    far.centers.col(b) = Eigen::Vector3d(10 * uniform(random, 0, 1) + (b < 1000 ? 0 : 1e8),
                                         10 * uniform(random, 0, 1), 10 * uniform(random, 0, 1));
  const Balls<3> balls(far.centers, far.radii);
  AutoDetector<3> detector(far.asked);
  const auto expected = all_pairs(far.centers, far.radii, far.asked, 3);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(detector.pairs(balls), expected);
  EXPECT_GE(detector.counts().by_cells, 1U);
}

TEST(CollisionDetectors, ListsAndBruteForceTakeGroups) {
  Random random(7);
  std::size_t joined = 0;
  for (unsigned round = 0; round < rounds(300U); ++round) {
    CollisionScene scene = random_scene(random, 60);
    std::vector<BeadPair> expected = all_pairs(scene.centers, scene.radii, scene.asked, 3);
    BeadGroups groups(scene.radii.size());
    for (std::uint8_t& of_bead : groups) of_bead = static_cast<std::uint8_t>(random() % 4);
    const auto is_in = [&](BeadId bead, unsigned group) { return (groups[bead] & group) != 0; };
    std::erase_if(expected, [&](const BeadPair& pair) {
      return !(is_in(pair.first, 1) && is_in(pair.second, 2)) &&
             !(is_in(pair.first, 2) && is_in(pair.second, 1));
    });
    scene.asked.groups = groups;
    const Balls<3> balls(scene.centers, scene.radii);
    ASSERT_EQ(CellList<3>(scene.asked).pairs(balls), expected) << scene.name;
    ASSERT_EQ(VerletList<3>(scene.asked, 1.0).pairs(balls), expected) << scene.name;
    ASSERT_EQ(pairs_by_force(balls, scene.asked), expected) << scene.name;
    const std::optional<ClosestPair> closest = closest_pair_by_force(balls, scene.asked);
    if (closest) {
      EXPECT_TRUE(scene.asked.asks({closest->first, closest->second})) << scene.name;
    }
    joined += expected.size();
  }
  EXPECT_GT(joined, rounds(150U));
}

// A detector that looks at all pairs would give a wrong answer.
TEST(CollisionDetectors, OthersRefuseGroups) {
  const Balls<3> balls(Eigen::Matrix3Xd::Random(3, 3), std::vector<double>(3, 1.0));
  PairsAsked asked{{{0, 2}}};
  asked.groups = {1, 2, 3};
  EXPECT_THROW(BlockTree<3>{asked}, std::invalid_argument);
  EXPECT_THROW(AutoDetector<3>{asked}, std::invalid_argument);
  EXPECT_THROW(DistanceQueries<3>{asked}, std::invalid_argument);
  SphereTree<3> tree(Hierarchy::wrapped, asked.necklaces);
  tree.build(balls);
  EXPECT_THROW((void)find_pairs(tree, asked), std::invalid_argument);
  EXPECT_THROW((void)find_closest_pair(tree, balls, asked), std::invalid_argument);
  asked.groups = {1, 2};
  EXPECT_THROW(CellList<3>{asked}, std::invalid_argument);
  EXPECT_THROW((void)pairs_by_force(balls, asked), std::invalid_argument);
}

TEST(CollisionDetectors, WrongUseIsRefused) {
  const Balls<3> two(Eigen::Matrix3Xd::Zero(3, 2), std::vector<double>(2, 1.0));
  const PairsAsked three{{{0, 2}}}, gap{{{0, 1}, {3, 4}}};
  EXPECT_THROW((void)BlockTree<3>(three).pairs(two), std::invalid_argument);
  EXPECT_THROW((void)CellList<3>(three).pairs(two), std::invalid_argument);
  EXPECT_THROW((void)AutoDetector<3>(three).pairs(two), std::invalid_argument);
  EXPECT_THROW(BlockTree<3>{gap}, std::invalid_argument);
  EXPECT_THROW((AutoDetector<3>{three, -1.0}), std::invalid_argument);
}

}  // namespace

}  // namespace kds::collision_detectors_test
