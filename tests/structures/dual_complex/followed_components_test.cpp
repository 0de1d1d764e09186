#include "structures/dual_complex/followed_components.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/rounds.h"

namespace kds::test {
namespace {

using Node = FollowedComponents::Node;
using Number = FollowedComponents::Number;
using Parts = std::map<Number, std::set<Node>>;

/// A small graph whose node 0 is outer.
class SmallGraph {
 public:
  template <class Visit>
  void for_neighbours(Node node, Visit visit) const {
    for (const Node other : arcs_.at(node)) visit(other);
  }
  [[nodiscard]] static bool is_outer(Node node) { return node == 0; }
  [[nodiscard]] static bool is_before(Node a, Node b) { return a < b; }
  [[nodiscard]] Number heir_of(Node node) const {
    const auto found = heirs.find(node);
    return found == heirs.end() ? FollowedComponents::none : found->second;
  }

  [[nodiscard]] bool has(Node node) const { return arcs_.contains(node); }
  [[nodiscard]] bool has_arc(Node a, Node b) const { return arcs_.at(a).contains(b); }
  void add(Node node) { arcs_[node]; }
  void remove(Node node) {
    for (const Node other : arcs_.at(node)) arcs_.at(other).erase(node);
    arcs_.erase(node);
  }
  void join(Node a, Node b) {
    arcs_.at(a).insert(b);
    arcs_.at(b).insert(a);
  }
  void cut(Node a, Node b) {
    arcs_.at(a).erase(b);
    arcs_.at(b).erase(a);
  }
  /// Finds the component of each node by a search, and the numbers that the components have.
  [[nodiscard]] Parts parts(const FollowedComponents& followed) const {
    Parts parts;
    std::set<Node> seen;
    for (const auto& [first, arcs] : arcs_) {
      if (!seen.insert(first).second) continue;
      std::set<Node> part{first};
      std::vector<Node> open{first};
      while (!open.empty()) {
        const Node node = open.back();
        open.pop_back();
        for (const Node other : arcs_.at(node)) {
          if (!part.insert(other).second) continue;
          seen.insert(other);
          open.push_back(other);
        }
      }
      EXPECT_TRUE(parts.emplace(followed.of(first), part).second) << "two components have one number";
      for (const Node node : part) EXPECT_EQ(followed.of(node), followed.of(first));
    }
    return parts;
  }

  std::map<Node, Number> heirs;

 private:
  std::map<Node, std::set<Node>> arcs_;
};

/// A graph and its components. Collects changes until `update`.
struct FollowedGraph {
  SmallGraph graph;
  FollowedComponents components{true};
  std::vector<Node> added, cut;
  std::vector<FollowedComponents::Join> joins;

  void add(Node node) {
    graph.add(node);
    added.push_back(node);
  }
  void remove(Node node) {
    graph.for_neighbours(node, [this](Node other) { cut.push_back(other); });
    graph.remove(node);
    components.forget(node);
    std::erase(added, node);
  }
  void join(Node a, Node b, std::uint32_t by = 0) {
    graph.join(a, b);
    joins.push_back({a, b, by});
  }
  void part(Node a, Node b) {
    graph.cut(a, b);
    cut.insert(cut.end(), {a, b});
  }
  FollowedComponents::Changes update() {
    std::erase_if(joins, [this](const auto& join) {
      return !graph.has(join.a) || !graph.has(join.b) || !graph.has_arc(join.a, join.b);
    });
    const auto changes = components.update(graph, std::exchange(added, {}), joins, std::exchange(cut, {}));
    joins.clear();
    return changes;
  }
};

TEST(FollowedComponents, AreThoseOfASearchWhateverChanges) {
  std::mt19937 random(20261130);
  const auto below = [&](Node n) { return static_cast<Node>(random() % n); };
  for (int round = 0; round < rounds(300, 30); ++round) {
    FollowedGraph followed;
    constexpr Node nodes = 14;
    followed.add(0);
    static_cast<void>(followed.update());
    Parts before = followed.graph.parts(followed.components);
    for (int updates = 0; updates < 60; ++updates) {
      for (Node changes = 1 + below(4); changes > 0; --changes) {
        const Node a = below(nodes), b = below(nodes);
        if (!followed.graph.has(a)) {
          followed.add(a);
        } else if (a == b && a > 0) {
          followed.remove(a);
        } else if (a != b && followed.graph.has(b)) {
          followed.graph.has_arc(a, b) ? followed.part(a, b) : followed.join(a, b);
        }
      }
      const FollowedComponents::Changes changes = followed.update();
      const Parts after = followed.graph.parts(followed.components);
      EXPECT_EQ(followed.components.count(), static_cast<std::int64_t>(after.size()) - 1);
      EXPECT_TRUE(after.at(FollowedComponents::outside).contains(0));
      // The changes lead from the numbers before to the numbers after.
      std::set<Number> numbers;
      for (const auto& [number, part] : before) numbers.insert(number);
      for (const auto& merge : changes.merges) {
        EXPECT_LT(merge.kept, merge.gone);
        EXPECT_TRUE(numbers.contains(merge.kept));
        EXPECT_EQ(numbers.erase(merge.gone), 1U);
      }
      for (const auto& split : changes.splits) {
        EXPECT_TRUE(numbers.contains(split.from));
        EXPECT_TRUE(numbers.insert(split.made).second);
        const auto &from = after.at(split.from), &made = after.at(split.made);
        EXPECT_EQ(*made.begin(), split.first);
        if (split.from == FollowedComponents::outside) continue;
        EXPECT_GE(from.size(), made.size());
        EXPECT_TRUE(from.size() > made.size() || *from.begin() < *made.begin());
      }
      for (const auto& ended : changes.ended) EXPECT_EQ(numbers.erase(ended.number), 1U);
      for (const auto& born : changes.born) EXPECT_TRUE(numbers.insert(born.number).second);
      std::set<Number> expected;
      for (const auto& [number, part] : after) expected.insert(number);
      EXPECT_EQ(numbers, expected);
      before = after;
      if (HasFailure()) return;
    }
  }
}

TEST(FollowedComponents, KeepNumbersWhenTheirNodesAreReplaced) {
  FollowedGraph followed;
  for (const Node node : {0, 1, 2, 3}) followed.add(node);
  followed.join(1, 2);
  static_cast<void>(followed.update());
  const Number pair = followed.components.of(1), single = followed.components.of(3);
  ASSERT_EQ(followed.components.count(), 2);

  followed.remove(1);
  followed.remove(2);
  followed.add(4);
  followed.graph.heirs[4] = pair;
  const auto replaced = followed.update();
  EXPECT_EQ(followed.components.of(4), pair);
  EXPECT_TRUE(replaced.born.empty() && replaced.ended.empty());

  followed.add(5);  // an heir of a component that is still there
  followed.graph.heirs[5] = single;
  const auto born = followed.update();
  ASSERT_EQ(born.born.size(), 1U);
  EXPECT_NE(followed.components.of(5), single);
}

TEST(FollowedComponents, TellWhichArcJoinedThem) {
  FollowedGraph followed;
  for (const Node node : {0, 1, 2}) followed.add(node);
  static_cast<void>(followed.update());
  followed.join(1, 2, 17);
  const auto joined = followed.update();
  ASSERT_EQ(joined.merges.size(), 1U);
  EXPECT_EQ(joined.merges[0].by, 17U);
  followed.join(0, 2, 18);
  followed.part(1, 2);
  const auto opened = followed.update();
  ASSERT_EQ(opened.merges.size(), 1U);
  EXPECT_EQ(opened.merges[0].kept, FollowedComponents::outside);
  ASSERT_EQ(opened.splits.size(), 1U);
  EXPECT_EQ(opened.splits[0].first, 1U);
}

}  // namespace
}  // namespace kds::test
