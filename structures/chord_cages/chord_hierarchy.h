#pragma once
// A hierarchy of chord cages in a run. The structure shares the clock of the others but has no certificates
// and no events. The times at which bases change are unknown, and there is nothing to log or to replay.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "kds/kinetic_structure.h"
#include "motions/base/bead.h"
#include "motions/curves/curves.h"
#include "motions/curves/motion_ref.h"
#include "motions/numbers/exact_number.h"
#include "structures/chord_cages/chord_cages.h"
#include "structures/chord_cages/tight_cages.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

class Simulator;

template <class Hierarchy>
class ChordHierarchy final : public KineticStructure {
 public:
  static constexpr int dimension = Hierarchy::dimension;

  /// Kinds of counts if tightness is requested. Each one counts parts of the nodes' steps.
  enum Kind : std::uint8_t { bisection, unproved };

  /// If `tightness` is given, radii are kept within 1 + `tightness` of the smallest at all times
  /// (tight_cages.h). Throws std::invalid_argument if the motion is lifted, or if tightness is requested for
  /// layered spheres.
  ChordHierarchy(Simulator& simulator, const MotionRef<dimension>& motion,
                 std::span<const BeadRange> necklaces, std::optional<double> tightness = {});

  [[nodiscard]] std::string_view name() const override;
  /// Returns the kinds of counts, empty without tightness. The counts are no events and are not recorded.
  [[nodiscard]] std::span<const EventKind> kinds() const override;
  [[nodiscard]] const ChordCages<Hierarchy>& cages() const { return cages_; }
  /// Null if no tightness is requested.
  [[nodiscard]] const TightCages<dimension>* tight() const { return tight_ ? &*tight_ : nullptr; }

  /// Returns a node's sphere at time u of the present step. The radius is rounded up, so that the result
  /// encloses the exact blended sphere.
  [[nodiscard]] Sphere sphere_at(NodeId node, double u) const;

  void build() override;
  void start_step() override;
  void fail(unsigned, std::uint32_t) override {}
  void apply(const Change& change) override;
  /// Audits the cages exactly. At an end of the step, the spheres are compared with statically built ones,
  /// and the cages at all control points must hold their beads. At any other time, the blended cages must
  /// hold their beads.
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  MotionRef<dimension> motion_;
  ChordCages<Hierarchy> cages_;
  std::optional<TightCages<dimension>> tight_;
};

}  // namespace kds
