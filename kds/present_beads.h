#pragma once
// The set of beads that are present in a structure whose beads can be inserted and erased (bead_edits.h): all
// beads of the motion except those left out or erased.

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "kds/change.h"
#include "motions/base/require_index.h"

namespace kds {

class PresentBeads {
 public:
  /// `structure` is the structure's name for messages, in static storage.
  PresentBeads(std::string_view structure, std::size_t bead_count)
      : structure_(structure), bead_count_(bead_count) {}

  /// Throws std::invalid_argument if the bead does not exist.
  [[nodiscard]] bool is_absent(BeadId bead) const {
    require_index("bead", bead, bead_count_);
    return bead < absent_.size() && absent_[bead] != 0;
  }
  [[nodiscard]] std::size_t count() const { return bead_count_ - absent_count_; }
  /// Returns the beads that are present, in ascending order.
  [[nodiscard]] std::vector<BeadId> all() const {
    std::vector<BeadId> beads;
    for (BeadId bead = 0; bead < bead_count_; ++bead)
      if (!is_absent(bead)) beads.push_back(bead);
    return beads;
  }
  /// Returns a flag for each bead, true if the bead is absent. Empty if no bead was ever absent.
  [[nodiscard]] std::span<const char> absent() const { return absent_; }

  /// Throws std::invalid_argument if the bead does not exist, or if it is not absent (`absent`) or not
  /// present (otherwise) as required.
  void require(BeadId bead, bool absent) const {
    if (is_absent(bead) == absent) return;
    refuse("bead " + std::to_string(bead) +
           (absent ? " is among its beads already" : " is not among its beads"));
  }
  void set_absent(BeadId bead, bool absent) {
    if (is_absent(bead) == absent) return;
    absent_.resize(bead_count_, 0);
    absent_[bead] = absent ? 1 : 0;
    absent ? ++absent_count_ : --absent_count_;
  }

  /// Implements BeadEdits::leave_out. Throws once structure_is_built has been called.
  void leave_out(BeadId bead) {
    require(bead, false);
    if (built_) refuse("its beads are left out before it is built");
    set_absent(bead, true);
  }
  void structure_is_built() { built_ = true; }

  /// Updates this set by a logged edit. The kinds of edits are consecutive: `inserts`, then erases, then
  /// other curves.
  void apply(const Change& edit, std::uint8_t inserts) {
    const BeadId bead = edit.ids[0];
    require(bead, edit.kind == inserts);
    if (edit.kind <= inserts + 1) set_absent(bead, edit.kind != inserts);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw std::invalid_argument(std::string(structure_) + ": " + why);
  }

  std::string_view structure_;
  std::size_t bead_count_;
  std::vector<char> absent_;
  std::size_t absent_count_ = 0;
  bool built_ = false;
};

}  // namespace kds
