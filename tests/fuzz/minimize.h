#pragma once
// Delta debugging: makes a scene smaller while it keeps its fault.

#include <functional>

#include "tests/fuzz/small_scene.h"

namespace kds::test {

/// Returns a scene for which `is_faulty` holds, as it must for `scene`, although it fails for every scene
/// that is one step smaller: one bead, place or coordinate less, necklaces joined, lines instead of Hermite
/// curves, or one number replaced by a simpler one.
[[nodiscard]] SmallScene minimized(SmallScene scene, const std::function<bool(const SmallScene&)>& is_faulty);

}  // namespace kds::test
