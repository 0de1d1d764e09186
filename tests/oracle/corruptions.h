#pragma once
// Ways to corrupt a correct dump. Each result is wrong for all positions of the beads.

#include <functional>
#include <vector>

#include "dump.h"
#include "scene.h"
#include "self_test.h"

namespace oracle {

/// The contents of the files of one frame.
struct Tables {
  std::vector<Cell> cells;
  std::vector<unsigned> hidden;
  std::vector<Node> nodes;
};

/// Corrupts the tables of a frame; returns false if this corruption does not apply to them.
struct Corruption {
  const char* name;
  std::function<bool(const Scene&, Tables&, Dice&)> spoil;
};

[[nodiscard]] std::vector<Corruption> power_corruptions();
[[nodiscard]] std::vector<Corruption> wrapped_corruptions();

}  // namespace oracle
