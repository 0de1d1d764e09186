#pragma once
// Kinetic tournament: which of some contestants is ahead of all others, kept while they move. The contestants
// are the leaves of a balanced binary tree; every inner node has the winner of its two children, and one
// certificate that says so: the winner is ahead of the loser. So the root's winner is ahead of all. When a
// certificate fails the loser wins there, and its contests further up are held anew, as far as they change:
// n - 1 certificates, of a contestant at most one a level.
//
// Of contestants level with each other for the rest of a step the least wins.

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "kds/certificate_table.h"

namespace kds {

/// Ahead makes of two contestants, numbered from 0, the certificate that holds while the first is ahead.
template <std::invocable<std::uint32_t, std::uint32_t> Ahead>
class Tournament {
 public:
  using Certificate = std::invoke_result_t<const Ahead&, std::uint32_t, std::uint32_t>;

  /// Several may share a table: this one's places in it are `which`, `which` + `of`, ...
  Tournament(CertificateTable<Certificate>& table, Ahead ahead, std::uint32_t which = 0, std::uint32_t of = 1)
      : table_(table), ahead_(std::move(ahead)), which_(which), of_(of) {}

  /// When a step starts: among so many contestants.
  void start(std::uint32_t contestants) {
    if (contestants_ != contestants || winner_.empty()) {
      contestants_ = contestants;
      winner_.resize(2 * std::size_t{contestants});
      for (std::uint32_t i = 0; i < contestants; ++i) winner_[contestants + i] = i;
    }
    guards_.assign(contestants, CertificateHandle::violated);
    if (contestants < 2) return;
    for (std::uint32_t first = std::bit_floor(contestants - 1); first > 0; first /= 2)
      hold_contests(first, std::min(2 * first, contestants));
  }

  /// There must be contestants.
  [[nodiscard]] std::uint32_t winner() const { return winner_[1]; }

  /// The contest at a place of the table.
  struct Contest {
    std::uint32_t winner, loser;
  };
  [[nodiscard]] Contest contest(std::uint32_t place) const {
    const std::uint32_t node = place / of_;
    return {winner_[node], loser(node)};
  }
  /// The certificate at this place fails now.
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

  /// Calls `visit` with the two of every contest.
  template <std::invocable<std::uint32_t, std::uint32_t> Visit>
  void each_contest(Visit visit) const {
    for (std::uint32_t node = 1; node < contestants_; ++node)
      visit(winner_[2 * std::size_t{node}], winner_[2 * std::size_t{node} + 1]);
  }

 private:
  // Node 1 is the root, 2i and 2i + 1 are the children of i, and leaves follow on the inner nodes.

  [[nodiscard]] std::uint32_t loser(std::uint32_t node) const {
    const std::uint32_t left = winner_[2 * std::size_t{node}], right = winner_[2 * std::size_t{node} + 1];
    return winner_[node] == left ? right : left;
  }

  /// One of its children's: who won it before, if possible.
  void enter_contest(std::uint32_t node) {
    const std::uint32_t left = winner_[2 * std::size_t{node}];
    if (winner_[node] != winner_[2 * std::size_t{node} + 1]) winner_[node] = left;
  }

  [[nodiscard]] bool stands(std::uint32_t node) const {
    if (guards_[node] == CertificateHandle::zero) return winner_[node] < loser(node);
    return guards_[node] != CertificateHandle::violated;
  }

  [[nodiscard]] CertificateHandle watch(std::uint32_t node, KnownAtStart known) {
    return table_.watch(ahead_(winner_[node], loser(node)), node * of_ + which_, known);
  }

  void hold_contest(std::uint32_t node) {
    table_.drop(guards_[node]);
    enter_contest(node);
    guards_[node] = watch(node, KnownAtStart::unknown);
    if (!stands(node)) turn(node);
  }

  /// The other wins.
  void turn(std::uint32_t node) {
    table_.drop(guards_[node]);
    winner_[node] = loser(node);
    guards_[node] = watch(node, KnownAtStart::unknown);
  }

  /// Those of nodes on one level, all at once.
  void hold_contests(std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t node = first; node < end; ++node) {
      enter_contest(node);
      table_.enqueue_one_of_many(ahead_(winner_[node], loser(node)), node * of_ + which_,
                                 KnownAtStart::unknown);
    }
    table_.watch_enqueued(
        [&](std::uint32_t place, CertificateHandle guard) { guards_[place / of_] = guard; });
    for (std::uint32_t node = first; node < end; ++node)
      if (!stands(node)) turn(node);
  }

  CertificateTable<Certificate>& table_;
  Ahead ahead_;
  std::uint32_t which_, of_;
  std::uint32_t contestants_ = 0;
  std::vector<std::uint32_t> winner_;      // of a node
  std::vector<CertificateHandle> guards_;  // of an inner node's contest; violated: none
};

}  // namespace kds
