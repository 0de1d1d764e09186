#pragma once
// Kinetic tournament tree: keeps the contestant that is ahead of all others while the contestants move. The
// contestants are the leaves of a binary tree. Every inner node stores the winner of its two children and one
// certificate, which states that the winner is ahead of the loser. So each node's winner is ahead of all
// contestants below the node. When a certificate fails, the loser wins at this node, and the contests above
// it are updated as far as their winners change. There are n - 1 certificates in a tree of n contestants, and
// at most one on each level names a given contestant.
//
// Contestants may be absent: the opponent of an absent contestant wins without a certificate. A contestant
// that is inserted, erased or changes course during a step costs at most the contests on one path to the
// root, which are then held anew.
//
// If contestants are level with each other for the rest of a step, the least of them wins.

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstdint>
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "kds/certificate_table.h"

namespace kds {

/// The tree of a tournament over any number of contestants: node 1 is the root, nodes 2i and 2i + 1 are the
/// children of i, and the leaves follow the inner nodes. Other trees have the same members, but resize. In
/// each tree, children have higher numbers than their parents.
class CompleteTree {
 public:
  static constexpr std::uint32_t root = 1;
  static constexpr std::uint32_t none = 0;  ///< the parent of a root

  void resize(std::uint32_t contestants) { contestants_ = contestants; }

  /// Returns a number above those of all nodes.
  [[nodiscard]] std::size_t end() const { return 2 * std::size_t{contestants_}; }
  /// Returns a number above those of the inner nodes.
  [[nodiscard]] std::uint32_t inner_end() const { return contestants_; }
  [[nodiscard]] std::ranges::iota_view<std::uint32_t, std::uint32_t> inner_nodes() const {
    return {1, std::max(1U, contestants_)};
  }
  [[nodiscard]] std::uint32_t leaf(std::uint32_t contestant) const { return contestants_ + contestant; }
  [[nodiscard]] std::uint32_t parent(std::uint32_t node) const { return node / 2; }
  [[nodiscard]] std::uint32_t left(std::uint32_t node) const { return 2 * node; }
  [[nodiscard]] std::uint32_t right(std::uint32_t node) const { return 2 * node + 1; }

  /// Calls `visit` with groups of inner nodes that do not contain each other, children before their parents.
  template <class Visit>
  void each_level(Visit visit) const {
    if (contestants_ < 2) return;
    for (std::uint32_t first = std::bit_floor(contestants_ - 1); first > 0; first /= 2)
      visit(std::ranges::iota_view(first, std::min(2 * first, contestants_)));
  }

 private:
  std::uint32_t contestants_ = 0;
};

/// `Ahead` takes two contestants, numbered from 0, and makes the certificate that holds while the first is
/// ahead. `Tree` may be a forest, whose roots have winners of their own. `Table` holds the certificates, like
/// a CertificateTable.
template <std::invocable<std::uint32_t, std::uint32_t> Ahead, class Tree = CompleteTree,
          class Table = CertificateTable<std::invoke_result_t<const Ahead&, std::uint32_t, std::uint32_t>>>
class Tournament {
 public:
  static constexpr std::uint32_t none = 0xffffffffU;

  /// Several tournaments may share a table: the places of this one are `which`, `which` + `of`, ...
  Tournament(Table& table, Ahead ahead, std::uint32_t which = 0, std::uint32_t of = 1, Tree tree = {})
      : table_(table), ahead_(std::move(ahead)), which_(which), of_(of), tree_(std::move(tree)) {}

  /// Starts the tournament at the start of a step, or within it after give_up_all. The contestants are 0 ...
  /// contestants-1, except those marked in `absent`, if any are marked.
  void start(std::uint32_t contestants, std::span<const char> absent = {}) {
    if constexpr (requires { tree_.resize(contestants); }) tree_.resize(contestants);
    winner_.resize(tree_.end());
    for (std::uint32_t i = 0; i < contestants; ++i) set_present(i, i >= absent.size() || absent[i] == 0);
    handles_.assign(tree_.inner_end(), CertificateHandle::violated);
    tree_.each_level([this](const auto& nodes) { this->hold_contests(nodes); });
  }

  /// Returns the winner of the whole tree, or `none` if all contestants are absent. There must be at least
  /// one contestant.
  [[nodiscard]] std::uint32_t winner() const { return winner_[Tree::root]; }
  /// Returns the winner among the contestants below a node, or `none` if all of them are absent.
  [[nodiscard]] std::uint32_t winner(std::uint32_t node) const { return winner_[node]; }

  /// Returns whether both children of an inner node have winners.
  [[nodiscard]] bool is_contested(std::uint32_t node) const { return loser(node) != none; }

  /// The contest at a place of the table.
  struct Contest {
    std::uint32_t winner, loser;
  };
  [[nodiscard]] Contest contest(std::uint32_t place) const {
    const std::uint32_t node = place / of_;
    return {winner_[node], loser(node)};
  }
  /// Handles the failure, at the present time, of the certificate at this place.
  void fail(std::uint32_t place) {
    std::uint32_t node = place / of_;
    handles_[node] = CertificateHandle::violated;
    winner_[node] = loser(node);
    handles_[node] = watch(node, KnownAtStart::at_own_root);
    std::uint32_t before = 0;
    do {
      node = tree_.parent(node);
      if (node == Tree::none) return;
      before = winner_[node];
      hold_contest(node);
    } while (winner_[node] != before);
  }

  // Edits: all contestants that are inserted, erased or change course first give up their contests; then
  // their curves change; then hold_again holds these contests again.

  void give_up(std::uint32_t contestant) {
    for (std::uint32_t node = tree_.parent(tree_.leaf(contestant)); node != Tree::none;
         node = tree_.parent(node)) {
      drop(node);
      given_up_.push_back(node);
      if (winner_[node] != contestant) return;
    }
  }
  void give_up_all() {
    for (const std::uint32_t node : tree_.inner_nodes()) drop(node);
  }
  void set_present(std::uint32_t contestant, bool present) {
    winner_[tree_.leaf(contestant)] = present ? contestant : none;
  }
  void hold_again() {
    std::make_heap(given_up_.begin(), given_up_.end());
    std::uint32_t held = none;
    while (!given_up_.empty()) {  // children before parents
      std::pop_heap(given_up_.begin(), given_up_.end());
      const std::uint32_t node = given_up_.back();
      given_up_.pop_back();
      if (node == held) continue;
      held = node;
      const std::uint32_t before = winner_[node];
      hold_contest(node);
      if (winner_[node] == before || tree_.parent(node) == Tree::none) continue;
      given_up_.push_back(tree_.parent(node));
      std::push_heap(given_up_.begin(), given_up_.end());
    }
  }

  /// Calls `visit` with the two contestants of every contest.
  template <std::invocable<std::uint32_t, std::uint32_t> Visit>
  void each_contest(Visit visit) const {
    for (const std::uint32_t node : tree_.inner_nodes())
      if (loser(node) != none) visit(left(node), right(node));
  }

 private:
  // The winners of a node's children.
  [[nodiscard]] std::uint32_t left(std::uint32_t node) const { return winner_[tree_.left(node)]; }
  [[nodiscard]] std::uint32_t right(std::uint32_t node) const { return winner_[tree_.right(node)]; }
  /// Returns the loser, or `none` if the winner is unopposed.
  [[nodiscard]] std::uint32_t loser(std::uint32_t node) const {
    return winner_[node] == left(node) ? right(node) : left(node);
  }

  /// Chooses one of the children's winners: the previous winner of this node, if possible.
  void enter_contest(std::uint32_t node) {
    if (winner_[node] == right(node) && right(node) != none) return;
    winner_[node] = left(node) != none ? left(node) : right(node);
  }

  [[nodiscard]] bool stands(std::uint32_t node) const {
    if (handles_[node] == CertificateHandle::zero) return winner_[node] < loser(node);
    return handles_[node] != CertificateHandle::violated;
  }

  [[nodiscard]] CertificateHandle watch(std::uint32_t node, KnownAtStart known) {
    return table_.watch(ahead_(winner_[node], loser(node)), node * of_ + which_, known);
  }

  void drop(std::uint32_t node) {
    table_.drop(handles_[node]);
    handles_[node] = CertificateHandle::violated;
  }

  void hold_contest(std::uint32_t node) {
    drop(node);
    enter_contest(node);
    if (loser(node) == none) return;
    handles_[node] = watch(node, KnownAtStart::unknown);
    if (!stands(node)) turn(node);
  }

  /// Makes the other contestant win.
  void turn(std::uint32_t node) {
    table_.drop(handles_[node]);
    winner_[node] = loser(node);
    handles_[node] = watch(node, KnownAtStart::unknown);
  }

  /// Holds the contests of nodes on one level, all at once.
  void hold_contests(const auto& nodes) {
    for (const std::uint32_t node : nodes) {
      enter_contest(node);
      if (const std::uint32_t second = loser(node); second != none)
        table_.enqueue_one_of_many(ahead_(winner_[node], second), node * of_ + which_, KnownAtStart::unknown);
    }
    table_.watch_enqueued(
        [&](std::uint32_t place, CertificateHandle handle) { handles_[place / of_] = handle; });
    for (const std::uint32_t node : nodes)
      if (!stands(node) && loser(node) != none) turn(node);
  }

  Table& table_;
  Ahead ahead_;
  std::uint32_t which_, of_;
  Tree tree_;
  std::vector<std::uint32_t> winner_;       // for each node
  std::vector<CertificateHandle> handles_;  // for each inner node's contest; violated: no certificate
  std::vector<std::uint32_t> given_up_;     // nodes whose contests must be held again
};

}  // namespace kds
