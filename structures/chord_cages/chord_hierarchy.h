#pragma once
// A hierarchy of chord cages in a run: beside other structures on their clock, but with no certificate and no
// event. It cannot say when a basis changes, and has nothing to log or to replay.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "kds/kinetic_structure.h"
#include "motions/base/bead_range.h"
#include "motions/curves/motion_ref.h"
#include "structures/chord_cages/chord_cages.h"
#include "structures/chord_cages/tight_cages.h"

namespace kds {

class Simulator;

template <class Hierarchy>
class ChordHierarchy final : public KineticStructure {
 public:
  static constexpr int dimension = Hierarchy::dimension;

  /// Of what is counted where tightness is asked for: parts of nodes' steps.
  enum Kind : std::uint8_t { bisection, unproved };

  /// `tightness`: radii are to be within 1 + this of the smallest at all times (tight_cages.h). Throws
  /// std::invalid_argument where the motion is lifted, and where layered spheres are to be tight.
  ChordHierarchy(Simulator& simulator, const MotionRef<dimension>& motion,
                 std::span<const BeadRange> necklaces, std::optional<double> tightness = {});

  [[nodiscard]] std::string_view name() const override;
  /// None, or what is counted: these are no events, they are not recorded.
  [[nodiscard]] std::span<const EventKind> kinds() const override;
  [[nodiscard]] const ChordCages<Hierarchy>& cages() const { return cages_; }
  /// Null where no tightness is asked for.
  [[nodiscard]] const TightCages<dimension>* tight() const { return tight_ ? &*tight_ : nullptr; }

  /// A node's sphere at time u of the present step, exactly a double: rounded up, so that it holds the true
  /// one.
  [[nodiscard]] Sphere sphere_at(NodeId node, double u) const;

  void build() override;
  void start_step() override;
  void fail(unsigned, std::uint32_t) override {}
  void apply(const Change& change) override;
  /// At an end of the step the spheres are compared with those built statically, and all control points'
  /// cages must hold their beads; at another time the blended ones. Exact.
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  MotionRef<dimension> motion_;
  ChordCages<Hierarchy> cages_;
  std::optional<TightCages<dimension>> tight_;
};

}  // namespace kds
