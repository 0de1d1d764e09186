#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kds/stopwatch.h"
#include "structures/collision/cell_list.h"
#include "structures/crossings/crossings.h"
#include "structures/session/own_structures.h"
#include "structures/session/structure_spec.h"

namespace kds {

namespace {

class CrossingsInRun final : public RunningStructure {
 public:
  CrossingsInRun(Simulator& simulator, const Scene& scene, const MotionRef<3>& motion)
      : scene_(scene), crossings_(simulator, motion, ChainBonds(scene), scene.is_periodic()) {}

  [[nodiscard]] KineticStructure& kinetic() override { return crossings_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override { return {}; }
  [[nodiscard]] bool can_be_cut() const override { return true; }
  [[nodiscard]] std::optional<std::vector<BeadId>> state() const override { return crossings_.state(); }
  /// Times a cell list over balls around the bonds, because a frame alone shows no crossing.
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    const Eigen::Matrix3Xd beads = scene_.centers(frame);
    const std::vector<BeadId>& bonds = crossings_.bonds().first_beads;
    Eigen::Matrix3Xd middles(3, static_cast<Eigen::Index>(bonds.size()));
    std::vector<double> radii;
    for (std::size_t bond = 0; bond < bonds.size(); ++bond) {
      const auto bead = static_cast<Eigen::Index>(bonds[bond]);
      middles.col(static_cast<Eigen::Index>(bond)) = 0.5 * (beads.col(bead) + beads.col(bead + 1));
      radii.push_back(0.5 * (beads.col(bead + 1) - beads.col(bead)).norm());
    }
    const Balls<3> balls(middles, radii);
    CellList<3> cells(crossings_.bonds().pairs);
    return seconds_per_call<WallClock>([&] { (void)cells.pairs(balls); });
  }

 private:
  const Scene& scene_;
  Crossings crossings_;
};

}  // namespace

void add_bond_structures(StructureRegistry& registry) {
  registry.add(
      {.name = "crossings",
       .about = "bonds of chains that pass through each other",
       .order = 45,
       .refusal = [](const Scene& scene) -> std::optional<std::string> {
         if (scene.is_lifted()) return "does not take lifted motion; expected linear or hermite";
         if (scene.dimension() < 3)
           return "is about bonds in space, and all beads of this input stay in one plane or on a line";
         if (scene.bonds().empty())
           return "is about bonds of consecutive beads, and no beads of this input are known to be "
                  "bonded; expected chains, or a selection such as CA or backbone";
         return std::nullopt;
       },
       .across_walls = "crossings",
       .make = [](Simulator& simulator, const Scene& scene, const SceneMotion::Ref& motion,
                  const StructureSettings&) -> std::unique_ptr<RunningStructure> {
         return std::make_unique<CrossingsInRun>(simulator, scene, std::get<MotionRef<3>>(motion));
       }});
}

}  // namespace kds
