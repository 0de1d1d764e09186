#pragma once
// Helpers by which a specification makes its structure for motions of each dimension.

#include <memory>
#include <utility>
#include <variant>

#include "structures/session/structure_spec.h"

namespace kds {

/// Returns a specification's `make`, which calls make(simulator, scene, motion, settings) for motions of at
/// least LeastDimension dimensions. The specification must refuse scenes of fewer dimensions beforehand.
template <int LeastDimension, class Make>
[[nodiscard]] auto make_of_motion(Make make) {
  return [make = std::move(make)](Simulator& simulator, const Scene& scene, const SceneMotion::Ref& motion,
                                  const StructureSettings& settings) {
    return std::visit(
        [&]<int D>(const MotionRef<D>& ref) -> std::unique_ptr<RunningStructure> {
          if constexpr (D < LeastDimension) {
            return nullptr;
          } else {
            return make(simulator, scene, ref, settings);
          }
        },
        motion);
  };
}

/// Same for a structure without settings, constructed by InRun<D>(simulator, scene, motion).
template <template <int> class InRun, int LeastDimension>
[[nodiscard]] auto make_of_motion() {
  return make_of_motion<LeastDimension>(
      []<int D>(Simulator& simulator, const Scene& scene, const MotionRef<D>& motion,
                const StructureSettings&) { return std::make_unique<InRun<D>>(simulator, scene, motion); });
}

}  // namespace kds
