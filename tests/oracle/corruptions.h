#pragma once
// Ways to spoil a right dump. Each must be wrong in any position of the beads.

#include <functional>
#include <vector>

#include "dump.h"
#include "scene.h"
#include "self_test.h"

namespace oracle {

/// What the files of one frame say.
struct Tables {
  std::vector<Cell> cells;
  std::vector<unsigned> hidden;
  std::vector<Node> nodes;
};

/// Spoils the tables of a frame; false where it cannot be done to them.
struct Corruption {
  const char* name;
  std::function<bool(const Scene&, Tables&, Dice&)> spoil;
};

[[nodiscard]] std::vector<Corruption> power_corruptions();
[[nodiscard]] std::vector<Corruption> wrapped_corruptions();

}  // namespace oracle
