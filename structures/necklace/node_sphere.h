#pragma once
// A node of a hierarchy with its sphere, for output.

#include "motions/base/bead_range.h"
#include "structures/necklace/sphere.h"

namespace kds {

struct NodeSphere {
  BeadRange range;
  Sphere sphere;
};

}  // namespace kds
