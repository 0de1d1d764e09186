#pragma once
// A node of a hierarchy and its sphere, for people and programs to read.

#include "motions/base/bead_range.h"
#include "structures/necklace/sphere.h"

namespace kds {

struct NodeSphere {
  BeadRange range;
  Sphere sphere;
};

}  // namespace kds
