#pragma once
// Delta debugging: makes a scene smaller while it keeps its fault.

#include <functional>

#include "tests/fuzz/small_scene.h"

namespace kds::test {

/// Returns a scene for which `is_faulty` holds, as it must for `scene`. No single change that is tried keeps
/// a fault: a bead, a place or the last column dropped, necklaces joined, lines instead of Hermite curves, a
/// simpler number. The fault may be another than that of `scene`.
[[nodiscard]] SmallScene minimized(SmallScene scene, const std::function<bool(const SmallScene&)>& is_faulty);

}  // namespace kds::test
