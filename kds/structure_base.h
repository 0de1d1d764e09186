#pragma once
// Bases that hold what structures repeat. A structure derives from StructureBase, from EditableBase if beads
// can be inserted, erased and given other curves while time runs, or from CertifiedPlaces
// (certified_places.h) if each of its places has one certificate.

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "kds/kinetic_structure.h"
#include "kds/simulator.h"
#include "motions/base/require_index.h"

namespace kds {

/// A structure with its registration in a run: its name, its kinds of events and its number in the simulator.
class StructureBase : public KineticStructure {
 public:
  StructureBase(const StructureBase&) = delete;
  StructureBase& operator=(const StructureBase&) = delete;

  [[nodiscard]] std::string_view name() const final { return name_; }
  [[nodiscard]] std::span<const EventKind> kinds() const final { return kinds_; }

 protected:
  /// Adds the structure to the simulator. The name and the kinds are in static storage.
  StructureBase(Simulator& simulator, std::size_t bead_count, std::string_view name,
                std::span<const EventKind> kinds)
      : simulator_(simulator),
        bead_count_(bead_count),
        name_(name),
        kinds_(kinds),
        index_(simulator.add(*this)) {}

  [[nodiscard]] Simulator& simulator() const { return simulator_; }
  /// Returns the structure's number in the simulator, which its certificate tables need.
  [[nodiscard]] std::size_t index() const { return index_; }
  [[nodiscard]] std::size_t bead_count() const { return bead_count_; }
  /// Reports a change that the structure makes at the present time.
  void record(const Change& change) const { simulator_.record(index_, change); }
  void record(std::size_t kind, std::initializer_list<BeadId> ids) const;

 private:
  Simulator& simulator_;
  std::size_t bead_count_;
  std::string_view name_;
  std::span<const EventKind> kinds_;
  std::size_t index_;
};

/// The set of beads that are present in a structure whose beads can be inserted and erased: all beads of the
/// motion except those left out or erased.
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

/// Role of the ids of an edit: the bead.
inline constexpr std::array<IdRole, 1> edited_bead{{{"bead"}}};

/// Appends the kinds of edits, in this order: insert, erase, change. `inserted` are the roles of the ids of
/// an insertion.
template <std::size_t N>
[[nodiscard]] constexpr std::array<EventKind, N + 3> with_edits(
    const std::array<EventKind, N>& kinds, std::span<const IdRole> inserted = edited_bead) {
  std::array<EventKind, N + 3> all;
  for (std::size_t i = 0; i < N; ++i) all[i] = kinds[i];
  all[N] = {"insert", false, true, inserted};
  all[N + 1] = {"erase", false, true, edited_bead};
  all[N + 2] = {"change", false, true, edited_bead};
  return all;
}

/// A structure whose beads can be inserted, erased and given other curves. The last kinds of events of the
/// structure are those of `with_edits`. The base checks each edit and keeps the set of present beads.
class EditableBase : public StructureBase, public BeadEdits {
 public:
  void leave_out(BeadId bead) final { present_.leave_out(bead); }
  void insert(BeadId bead) final { edit_now(inserted(), bead); }
  void erase(BeadId bead) final { edit_now(erased(), bead); }
  [[nodiscard]] bool is_absent(BeadId bead) const final { return present_.is_absent(bead); }

 protected:
  EditableBase(Simulator& simulator, std::size_t bead_count, std::string_view name,
               std::span<const EventKind> kinds)
      : StructureBase(simulator, bead_count, name, kinds), present_(name, bead_count) {}

  /// Inserts or erases the bead, as `kind` says, at the present time. The edit has been checked. Records the
  /// edit and updates present(). If the function throws, nothing may have changed.
  virtual void edit(std::uint8_t kind, BeadId bead) = 0;
  /// Follows the new curves of these beads, some of which may be absent.
  virtual void follow(std::span<const BeadId> beads) = 0;

  [[nodiscard]] PresentBeads& present() { return present_; }
  [[nodiscard]] const PresentBeads& present() const { return present_; }
  // The numbers of the kinds of edits.
  [[nodiscard]] std::uint8_t inserted() const { return static_cast<std::uint8_t>(kinds().size() - 3); }
  [[nodiscard]] std::uint8_t erased() const { return static_cast<std::uint8_t>(kinds().size() - 2); }
  /// Repeats a logged edit for the set of present beads. Returns false if the change is not an edit.
  [[nodiscard]] bool apply_edit(const Change& change) {
    if (change.kind < inserted()) return false;
    present_.apply(change, inserted());
    return true;
  }

 private:
  void edit_now(std::uint8_t kind, BeadId bead);
  void take_up(std::span<const BeadId> beads) final;

  PresentBeads present_;
};

}  // namespace kds
