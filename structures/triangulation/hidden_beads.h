#pragma once
// The hidden beads of a power diagram, which have no cell of their own. Each hidden bead has a host, the
// cell of the triangulation that contains its centre, or no known host. Stored in flat arrays, with a linked
// list of the hidden beads in each cell.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/base/bead.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

struct HiddenBead {
  BeadId bead;
  CellId host;  ///< or no_cell
};

class HiddenBeads {
 public:
  /// Makes exactly the beads `hidden` hidden, with unknown hosts.
  void assign(std::size_t beads, std::span<const BeadId> hidden) {
    count_ = hidden.size();
    host_.assign(beads, no_cell);
    next_.assign(beads, no_bead);
    is_hidden_.assign(beads, 0);
    first_.clear();
    for (const BeadId bead : hidden) is_hidden_[bead] = 1;
  }

  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] bool contains(BeadId bead) const { return is_hidden_[bead] != 0; }
  [[nodiscard]] CellId host(BeadId bead) const { return host_[bead]; }
  /// Returns the hidden beads, ascending.
  [[nodiscard]] std::vector<BeadId> beads() const {
    std::vector<BeadId> beads;
    for (BeadId b = 0; b < is_hidden_.size() && beads.size() < count_; ++b) {
      if (contains(b)) beads.push_back(b);
    }
    return beads;
  }
  /// Returns the hidden beads, ascending, with their hosts.
  [[nodiscard]] std::vector<HiddenBead> with_hosts() const {
    std::vector<HiddenBead> hidden;
    for (const BeadId b : beads()) hidden.push_back({b, host_[b]});
    return hidden;
  }

  void hide(BeadId bead) {
    is_hidden_[bead] = 1;
    ++count_;
  }
  void show(BeadId bead) {
    leave(bead);
    is_hidden_[bead] = 0;
    --count_;
  }
  void enter(BeadId bead, CellId cell) {
    leave(bead);
    if (cell >= first_.size()) first_.resize(cell + 1, no_bead);
    host_[bead] = cell;
    next_[bead] = first_[cell];
    first_[cell] = bead;
  }
  /// Removes all hidden beads from this cell and appends them to `beads`.
  void empty_out(CellId cell, std::vector<BeadId>& beads) {
    if (cell >= first_.size()) return;
    for (BeadId b = first_[cell]; b != no_bead; b = next_[b]) {
      beads.push_back(b);
      host_[b] = no_cell;
    }
    first_[cell] = no_bead;
  }

 private:
  void leave(BeadId bead) {
    if (host_[bead] == no_cell) return;
    BeadId* link = &first_[host_[bead]];
    while (*link != bead) link = &next_[*link];
    *link = next_[bead];
    host_[bead] = no_cell;
  }

  std::size_t count_ = 0;
  std::vector<char> is_hidden_;
  std::vector<CellId> host_;   // for each bead
  std::vector<BeadId> next_;   // the next bead in the same host
  std::vector<BeadId> first_;  // the first bead in each cell
};

}  // namespace kds
