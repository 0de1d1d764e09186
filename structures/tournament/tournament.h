#pragma once
// Kinetic tournament tree: keeps the contestant that is ahead of all others while the contestants move. The
// contestants are the leaves of a balanced binary tree. Every inner node stores the winner of its two
// children and one certificate, which states that the winner is ahead of the loser. So the root's winner is
// ahead of all others. When a certificate fails, the loser wins at this node, and the contests above it are
// updated as far as their winners change. There are n - 1 certificates, and at most one on each level names a
// given contestant.
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
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "kds/certificate_table.h"

namespace kds {

/// `Ahead` takes two contestants, numbered from 0, and makes the certificate that holds while the first is
/// ahead.
template <std::invocable<std::uint32_t, std::uint32_t> Ahead>
class Tournament {
 public:
  using Certificate = std::invoke_result_t<const Ahead&, std::uint32_t, std::uint32_t>;

  static constexpr std::uint32_t none = 0xffffffffU;

  /// Several tournaments may share a table: the places of this one are `which`, `which` + `of`, ...
  Tournament(CertificateTable<Certificate>& table, Ahead ahead, std::uint32_t which = 0, std::uint32_t of = 1)
      : table_(table), ahead_(std::move(ahead)), which_(which), of_(of) {}

  /// Starts the tournament at the start of a step, or within it after give_up_all. The contestants are 0 ...
  /// contestants-1, except those marked in `absent`, if any are marked.
  void start(std::uint32_t contestants, std::span<const char> absent = {}) {
    contestants_ = contestants;
    winner_.resize(2 * std::size_t{contestants});
    for (std::uint32_t i = 0; i < contestants; ++i) set_present(i, i >= absent.size() || absent[i] == 0);
    guards_.assign(contestants, CertificateHandle::violated);
    if (contestants < 2) return;
    for (std::uint32_t first = std::bit_floor(contestants - 1); first > 0; first /= 2)
      hold_contests(first, std::min(2 * first, contestants));
  }

  /// Returns the winner, or `none` if all contestants are absent. There must be at least one contestant.
  [[nodiscard]] std::uint32_t winner() const { return winner_[1]; }

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
    guards_[node] = CertificateHandle::violated;
    winner_[node] = loser(node);
    guards_[node] = watch(node, KnownAtStart::at_own_root);
    std::uint32_t before = 0;
    do {
      node /= 2;
      if (node == 0) return;
      before = winner_[node];
      hold_contest(node);
    } while (winner_[node] != before);
  }

  // Edits: all contestants that are inserted, erased or change course first give up their contests; then
  // their curves change; then hold_again holds these contests again.

  void give_up(std::uint32_t contestant) {
    for (std::uint32_t node = (contestants_ + contestant) / 2; node > 0; node /= 2) {
      drop(node);
      given_up_.push_back(node);
      if (winner_[node] != contestant) return;
    }
  }
  void give_up_all() {
    for (std::uint32_t node = 1; node < contestants_; ++node) drop(node);
  }
  void set_present(std::uint32_t contestant, bool present) {
    winner_[contestants_ + contestant] = present ? contestant : none;
  }
  void hold_again() {
    std::make_heap(given_up_.begin(), given_up_.end());
    std::uint32_t held = 0;
    while (!given_up_.empty()) {  // children before parents
      std::pop_heap(given_up_.begin(), given_up_.end());
      const std::uint32_t node = given_up_.back();
      given_up_.pop_back();
      if (node == held) continue;
      held = node;
      const std::uint32_t before = winner_[node];
      hold_contest(node);
      if (winner_[node] == before || node == 1) continue;
      given_up_.push_back(node / 2);
      std::push_heap(given_up_.begin(), given_up_.end());
    }
  }

  /// Calls `visit` with the two contestants of every contest.
  template <std::invocable<std::uint32_t, std::uint32_t> Visit>
  void each_contest(Visit visit) const {
    for (std::uint32_t node = 1; node < contestants_; ++node)
      if (loser(node) != none) visit(left(node), right(node));
  }

 private:
  // Node 1 is the root, nodes 2i and 2i + 1 are the children of i, and the leaves follow the inner nodes.

  [[nodiscard]] std::uint32_t left(std::uint32_t node) const { return winner_[2 * std::size_t{node}]; }
  [[nodiscard]] std::uint32_t right(std::uint32_t node) const { return winner_[2 * std::size_t{node} + 1]; }
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
    if (guards_[node] == CertificateHandle::zero) return winner_[node] < loser(node);
    return guards_[node] != CertificateHandle::violated;
  }

  [[nodiscard]] CertificateHandle watch(std::uint32_t node, KnownAtStart known) {
    return table_.watch(ahead_(winner_[node], loser(node)), node * of_ + which_, known);
  }

  void drop(std::uint32_t node) {
    table_.drop(guards_[node]);
    guards_[node] = CertificateHandle::violated;
  }

  void hold_contest(std::uint32_t node) {
    drop(node);
    enter_contest(node);
    if (loser(node) == none) return;
    guards_[node] = watch(node, KnownAtStart::unknown);
    if (!stands(node)) turn(node);
  }

  /// Makes the other contestant win.
  void turn(std::uint32_t node) {
    table_.drop(guards_[node]);
    winner_[node] = loser(node);
    guards_[node] = watch(node, KnownAtStart::unknown);
  }

  /// Holds the contests of nodes on one level, all at once.
  void hold_contests(std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t node = first; node < end; ++node) {
      enter_contest(node);
      if (const std::uint32_t second = loser(node); second != none)
        table_.enqueue_one_of_many(ahead_(winner_[node], second), node * of_ + which_, KnownAtStart::unknown);
    }
    table_.watch_enqueued(
        [&](std::uint32_t place, CertificateHandle guard) { guards_[place / of_] = guard; });
    for (std::uint32_t node = first; node < end; ++node)
      if (!stands(node) && loser(node) != none) turn(node);
  }

  CertificateTable<Certificate>& table_;
  Ahead ahead_;
  std::uint32_t which_, of_;
  std::uint32_t contestants_ = 0;
  std::vector<std::uint32_t> winner_;      // for each node
  std::vector<CertificateHandle> guards_;  // for each inner node's contest; violated: no guard
  std::vector<std::uint32_t> given_up_;    // nodes whose contests must be held again
};

}  // namespace kds
