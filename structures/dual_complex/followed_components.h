#pragma once
// Connected components of a graph that changes, each with a number that it keeps while it exists.
//
// If components merge, the merged one has the smallest of their numbers. If a component splits, the part with
// the most nodes keeps the number (of equal parts, the part with the first node in the caller's order), and
// the others get new numbers; the outside keeps 0 whatever its size. Numbers are not used again. In one
// update, merges come before splits.
//
// After an arc is removed, its ends are searched in lockstep (Even and Shiloach, "An on-line edge-deletion
// problem", 1981). If the ends lie in different parts, the search takes time linear in the smaller part, or
// in the larger one if the outside is the smaller. If the ends are still joined, it takes time linear in the
// nodes that are found before the searches meet, at most all of the component.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace kds {

class FollowedComponents {
 public:
  using Node = std::uint32_t;
  using Number = std::uint32_t;
  static constexpr Number none = std::numeric_limits<Number>::max();
  /// The component that contains all outer nodes (Graph::is_outer), if the graph has any.
  static constexpr Number outside = 0;

  /// An arc that was added between nodes that the graph had before.
  struct Join {
    Node a, b;
    std::uint32_t by;  ///< any number, which the merge repeats
  };
  static constexpr std::uint32_t by_no_arc = std::numeric_limits<std::uint32_t>::max();
  struct Merge {
    Number kept, gone;
    std::uint32_t by;  ///< the join's number; by_no_arc if new nodes joined the components
  };
  struct Split {
    Number from, made;
    Node first;  ///< of the new component's nodes, in the graph's order
  };
  struct Born {
    Number number;
    Node first;             ///< of its nodes, in the graph's order
    Number heir_of = none;  ///< the smallest number that Graph::heir_of gives its nodes
  };
  struct Ended {
    Number number;
    Node last;  ///< its last node, which was forgotten
  };
  /// Changes made by update(), in the order in which they are to be applied.
  struct Changes {
    std::vector<Merge> merges;
    std::vector<Split> splits;
    std::vector<Ended> ended;
    std::vector<Born> born;
    std::vector<Node> added;  ///< nodes that were added or got another number by a split
  };

  /// With `has_outside`, number 0 is for the outer nodes.
  explicit FollowedComponents(bool has_outside)
      : has_outside_(has_outside), parent_(has_outside ? 1 : 0), size_(parent_.size()) {}

  /// Returns the number of the node's component, or `none` for a node that is not in the graph.
  [[nodiscard]] Number of(Node node) const {
    return node < number_.size() && number_[node] != none ? root(number_[node]) : none;
  }
  /// Returns the number of components, without the outside.
  [[nodiscard]] std::int64_t count() const { return count_; }
  /// Removes all nodes. Their numbers stay valid as heirs in the next update.
  void forget_all() {
    for (Node node = 0; node < number_.size(); ++node) forget(node);
  }
  /// Removes a node. Its neighbours are cut nodes of the next update.
  void forget(Node node) {
    const Number number = of(node);
    if (number == none) return;
    if (--size_[number] == 0) emptied_.push_back({number, node});
    number_[node] = none;
  }
  /// Follows changes of the graph: `added` nodes, arcs that join nodes, and `cut` nodes, which lost an arc or
  /// a neighbour. Nodes that are not in the graph are ignored among `joins` and `cut`.
  ///
  /// The graph has these members:
  ///   for_neighbours(node, visit)  calls `visit` with each neighbour
  ///   is_outer(node)               whether the node belongs to the outside
  ///   is_before(a, b)              a strict order of nodes that does not depend on their numbers
  ///   heir_of(node)                for an added node: the component that had its place before, or `none`. A
  ///                                component of added nodes keeps this number if no other node has it.
  template <class Graph>
  [[nodiscard]] const Changes& update(const Graph& graph, std::vector<Node> added,
                                      std::span<const Join> joins, std::vector<Node> cut) {
    changes_.merges.clear();
    changes_.splits.clear();
    changes_.ended.clear();
    changes_.born.clear();
    changes_.added.clear();
    std::sort(added.begin(), added.end(), [&](Node a, Node b) { return graph.is_before(a, b); });
    for (const Node node : added) add(graph, node);
    for (const Join& join : joins) {
      const Number a = of(join.a), b = of(join.b);
      if (a != none && b != none) merge(a, b, join.by);
    }
    std::erase_if(cut, [this](Node node) { return of(node) == none; });
    const auto key = [this](Node node) { return std::pair(of(node), node); };
    std::sort(cut.begin(), cut.end(), [&](Node a, Node b) { return key(a) < key(b); });
    cut.erase(std::unique(cut.begin(), cut.end()), cut.end());
    for (auto first = cut.begin(); first != cut.end();) {
      const Number number = of(*first);
      const auto last = std::find_if(first, cut.end(), [&](Node node) { return of(node) != number; });
      if (last - first > 1) split(graph, number, std::span(first, last));
      first = last;
    }
    end_emptied();
    const auto size = [](const auto& list) { return static_cast<std::int64_t>(list.size()); };
    count_ += size(changes_.born) + size(changes_.splits) - size(changes_.merges) - size(changes_.ended);
    return changes_;
  }

 private:
  /// The nodes found from one or several cut nodes. Empty if another front has taken them.
  struct Front {
    std::vector<Node> nodes;
    std::vector<Node> queue;  ///< from `next` on: nodes whose neighbours are not found yet
    std::size_t next = 0;
    bool has_outer = false;

    [[nodiscard]] bool is_complete() const { return next == queue.size(); }
  };

  [[nodiscard]] Number root(Number number) const {
    while (parent_[number] != number) number = parent_[number] = parent_[parent_[number]];
    return number;
  }
  [[nodiscard]] Number new_number() {
    const auto number = static_cast<Number>(parent_.size());
    parent_.push_back(number);
    size_.push_back(0);
    return number;
  }
  void put(Node node, Number number) {
    if (node >= number_.size()) number_.resize(node + std::size_t{1}, none);
    number_[node] = number;
    ++size_[number];
  }
  void take(Number kept, Number gone) {
    parent_[gone] = kept;
    size_[kept] += std::exchange(size_[gone], 0);
  }
  void merge(Number a, Number b, std::uint32_t by) {
    const auto [kept, gone] = std::minmax({root(a), root(b)});
    if (kept == gone) return;
    take(kept, gone);
    changes_.merges.push_back({kept, gone, by});
  }

  /// Adds a node and the added nodes that it reaches through others.
  template <class Graph>
  void add(const Graph& graph, Node first) {
    if (of(first) != none) return;
    Born born{new_number(), first};
    std::vector<Node> group{first};
    std::vector<Number> touched;
    put(first, born.number);
    for (std::size_t next = 0; next < group.size(); ++next) {
      const Node node = group[next];
      born.heir_of = std::min(born.heir_of, graph.heir_of(node));
      if (graph.is_outer(node)) touched.push_back(outside);
      graph.for_neighbours(node, [&](Node other) {
        const Number number = of(other);
        if (number == none) {
          put(other, born.number);
          group.push_back(other);
        } else if (number != born.number) {
          touched.push_back(number);
        }
      });
    }
    changes_.added.insert(changes_.added.end(), group.begin(), group.end());
    if (touched.empty()) {
      changes_.born.push_back(born);
      return;
    }
    const Number kept = *std::min_element(touched.begin(), touched.end());
    take(kept, born.number);
    for (const Number number : touched) merge(kept, number, by_no_arc);
  }

  /// Searches from the ends of removed arcs, which have one number, and gives new numbers to parts.
  template <class Graph>
  void split(const Graph& graph, Number number, std::span<const Node> ends) {
    std::vector<Front> fronts(ends.size());
    found_by_.resize(number_.size(), none);
    const auto find = [&](std::uint32_t front, Node node) {
      fronts[front].nodes.push_back(node);
      fronts[front].queue.push_back(node);
      fronts[front].has_outer |= graph.is_outer(node);
      found_by_[node] = front;
    };
    for (std::uint32_t front = 0; front < fronts.size(); ++front) find(front, ends[front]);
    /// Joins two fronts and returns the one that has all nodes, the larger of both.
    const auto join = [&](std::uint32_t front, std::uint32_t other) {
      if (fronts[front].nodes.size() < fronts[other].nodes.size()) std::swap(front, other);
      Front& from = fronts[other];
      for (const Node node : from.nodes) found_by_[node] = front;
      fronts[front].nodes.insert(fronts[front].nodes.end(), from.nodes.begin(), from.nodes.end());
      fronts[front].queue.insert(fronts[front].queue.end(),
                                 from.queue.begin() + static_cast<std::ptrdiff_t>(from.next),
                                 from.queue.end());
      fronts[front].has_outer |= from.has_outer;
      from = {};
      return front;
    };
    const auto must_go_on = [&] {
      std::size_t open = 0, largest_open = 0, largest_complete = 0;
      bool outer_is_complete = false;
      for (const Front& front : fronts) {
        open += front.is_complete() ? 0 : 1;
        std::size_t& largest = front.is_complete() ? largest_complete : largest_open;
        largest = std::max(largest, front.nodes.size());
        outer_is_complete |= front.is_complete() && front.has_outer;
      }
      // The last open part keeps the number, unless the outside or a larger part is complete.
      if (open != 1 || largest_complete == 0) return open > 1;
      return number == outside && has_outside_ ? outer_is_complete : largest_open <= largest_complete;
    };
    while (must_go_on())
      for (std::uint32_t front = 0; front < fronts.size(); ++front) {
        if (fronts[front].is_complete()) continue;
        const Node node = fronts[front].queue[fronts[front].next++];
        std::uint32_t own = front;
        graph.for_neighbours(node, [&](Node other) {
          if (found_by_[other] == none) return find(own, other);
          if (found_by_[other] != own) own = join(own, found_by_[other]);
        });
      }
    for (const Front& front : fronts)
      for (const Node node : front.nodes) found_by_[node] = none;
    renumber(graph, number, std::move(fronts));
  }

  template <class Graph>
  void renumber(const Graph& graph, Number number, std::vector<Front> parts) {
    std::erase_if(parts, [](const Front& part) { return part.nodes.empty(); });
    if (parts.size() < 2) return;
    const auto is_before = [&](Node a, Node b) { return graph.is_before(a, b); };
    for (Front& part : parts)  // the first node comes first
      std::iter_swap(part.nodes.begin(), std::min_element(part.nodes.begin(), part.nodes.end(), is_before));
    std::sort(parts.begin(), parts.end(), [&](const Front& a, const Front& b) {
      const auto rank = [](const Front& part) {
        return std::tuple(!part.has_outer, part.is_complete(),
                          -static_cast<std::ptrdiff_t>(part.nodes.size()));
      };
      return rank(a) != rank(b) ? rank(a) < rank(b) : is_before(a.nodes[0], b.nodes[0]);
    });
    for (std::size_t part = 1; part < parts.size(); ++part) {
      const Number made = new_number();
      changes_.splits.push_back({number, made, parts[part].nodes[0]});
      size_[number] -= parts[part].nodes.size();
      for (const Node node : parts[part].nodes) put(node, made);
      changes_.added.insert(changes_.added.end(), parts[part].nodes.begin(), parts[part].nodes.end());
    }
  }

  void end_emptied() {
    std::erase_if(changes_.born, [this](const Born& born) {
      if (born.heir_of == none) return false;
      const Number heir = root(born.heir_of);
      if (size_[heir] > 0 || root(born.number) != born.number) return false;
      take(heir, born.number);
      return true;
    });
    for (const Ended& ended : emptied_)
      if (size_[ended.number] == 0 && root(ended.number) == ended.number &&
          (ended.number != outside || !has_outside_))
        changes_.ended.push_back(ended);
    emptied_.clear();
  }

  bool has_outside_ = false;
  std::int64_t count_ = 0;
  std::vector<Number> number_;           // by node; may have been merged into another one
  mutable std::vector<Number> parent_;   // by number: the one it was merged into, or itself
  std::vector<std::size_t> size_;        // by number: its nodes
  std::vector<Ended> emptied_;           // numbers whose last node was forgotten since the last update
  std::vector<std::uint32_t> found_by_;  // by node: a front of split(), or none
  Changes changes_;
};

}  // namespace kds
