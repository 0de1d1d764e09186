#pragma once
// The smallest axis-aligned box around the beads' centres: of each axis the first and the last bead along it.
// A kinetic tournament for each end. Where all radii are equal, the box of the balls is larger by the radius
// on every side; where they are not, it may be of other beads.
//
// Of beads that tie at an end for the rest of a step the least is there. At a time when several beads meet
// the end changes hands once, if at all: changes are recorded when all that happens at that time has
// happened.

#include <memory>
#include <vector>

#include "kds/kinetic_structure.h"
#include "motions/curves/motion_ref.h"

namespace kds {

class Simulator;

template <int Dimension>
class EnclosingBox final : public KineticStructure {
 public:
  EnclosingBox(Simulator& simulator, const MotionRef<Dimension>& motion);
  ~EnclosingBox() override;

  [[nodiscard]] std::string_view name() const override { return "box"; }
  /// Ids of a change of an end: the bead that was there, the bead that is. Of an overtaking further down in a
  /// tournament: the bead that was ahead, the bead that is.
  [[nodiscard]] std::span<const EventKind> kinds() const override;
  /// First and last bead along the first axis, then the next; none where there are no beads.
  [[nodiscard]] const std::vector<BeadId>& ends() const { return ends_; }

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void after_batch() override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  class Ends;
  template <int Axis>
  class EndsAlong;

  Simulator& simulator_;
  MotionRef<Dimension> motion_;
  std::size_t index_;
  std::vector<std::unique_ptr<Ends>> axes_;
  std::vector<BeadId> ends_;
};

extern template class EnclosingBox<1>;
extern template class EnclosingBox<2>;
extern template class EnclosingBox<3>;

}  // namespace kds
