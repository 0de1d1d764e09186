#include "structures/necklace/necklace_tree.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

namespace kds::necklace_tree_test {
namespace {

std::size_t height(const NecklaceTree& tree, NodeId node) {
  if (node == NecklaceTree::leaf) return 0;
  return 1 + std::max(height(tree, tree.left(node)), height(tree, tree.right(node)));
}

/// Checks the subtree; returns its number of nodes.
std::size_t check_subtree(const NecklaceTree& tree, NodeId node, const BeadRange& expected) {
  if (expected.first == expected.last) {
    EXPECT_EQ(node, NecklaceTree::leaf);
    return 0;
  }
  if (node >= tree.node_count()) {
    ADD_FAILURE() << "no node for " << expected.first << "-" << expected.last;
    return 0;
  }
  EXPECT_EQ(tree.range(node), expected);
  EXPECT_EQ(tree.find(expected), node);
  const NodeId l = tree.left(node), r = tree.right(node);
  EXPECT_GT(l, node);  // NecklaceTree::leaf is the largest number
  EXPECT_GT(r, node);
  // The two halves differ by at most one bead, and the left half is never the smaller one.
  const BeadId size = expected.last - expected.first + 1;
  const BeadId middle = expected.first + (size + 1) / 2 - 1;
  return 1 + check_subtree(tree, l, {expected.first, middle}) +
         check_subtree(tree, r, {middle + 1, expected.last});
}

TEST(NecklaceTree, OneBeadHasNoNode) {
  const std::vector<BeadRange> one{{0, 0}};
  const NecklaceTree tree(one);
  EXPECT_EQ(tree.node_count(), 0U);
  EXPECT_EQ(tree.find({0, 0}), std::nullopt);
  EXPECT_EQ(NecklaceTree(std::vector<BeadRange>{}).node_count(), 0U);
}

TEST(NecklaceTree, HalvesDownToSingleBeads) {
  for (BeadId n = 2; n <= 200; ++n) {
    const std::vector<BeadRange> necklaces{{0, n - 1}};
    const NecklaceTree tree(necklaces);
    ASSERT_EQ(tree.node_count(), n - 1);
    ASSERT_EQ(check_subtree(tree, 0, {0, n - 1}), n - 1) << n;
    ASSERT_EQ(height(tree, 0), static_cast<std::size_t>(std::ceil(std::log2(n)))) << n;
  }
}

TEST(NecklaceTree, FiveBeads) {
  const std::vector<BeadRange> necklaces{{0, 4}};
  const NecklaceTree tree(necklaces);
  ASSERT_EQ(tree.node_count(), 4U);
  EXPECT_EQ(tree.range(0), (BeadRange{0, 4}));
  EXPECT_EQ(tree.range(tree.left(0)), (BeadRange{0, 2}));
  EXPECT_EQ(tree.range(tree.right(0)), (BeadRange{3, 4}));
  EXPECT_EQ(tree.left(tree.right(0)), NecklaceTree::leaf);
  EXPECT_EQ(tree.right(tree.right(0)), NecklaceTree::leaf);
}

TEST(NecklaceTree, SeveralNecklaces) {
  const std::vector<BeadRange> necklaces{{0, 6}, {7, 7}, {8, 9}, {10, 10}, {11, 11}, {12, 30}};
  const NecklaceTree tree(necklaces);
  EXPECT_EQ(tree.node_count(), 6U + 1U + 18U);
  std::size_t nodes = 0;
  for (const BeadRange& necklace : necklaces) {
    if (necklace.first == necklace.last) continue;
    const auto root = tree.find(necklace);
    ASSERT_TRUE(root) << necklace.first;
    nodes += check_subtree(tree, *root, necklace);
  }
  EXPECT_EQ(nodes, tree.node_count());
}

TEST(NecklaceTree, FindsExactlyItsNodes) {
  for (const auto& necklaces :
       {std::vector<BeadRange>{{0, 22}}, std::vector<BeadRange>{{0, 0}, {1, 9}, {10, 10}, {11, 22}},
        std::vector<BeadRange>{{5, 6}, {7, 20}}}) {
    const NecklaceTree tree(necklaces);
    std::set<std::pair<BeadId, BeadId>> ranges;
    for (NodeId node = 0; node < tree.node_count(); ++node) {
      EXPECT_TRUE(ranges.insert({tree.range(node).first, tree.range(node).last}).second);
      EXPECT_EQ(tree.find(tree.range(node)), node);
    }
    for (BeadId first = 0; first < 26; ++first) {
      for (BeadId last = first; last < 26; ++last)
        EXPECT_EQ(tree.find({first, last}).has_value(), ranges.count({first, last}) == 1)
            << first << "-" << last;
    }
  }
}

}  // namespace
}  // namespace kds::necklace_tree_test
