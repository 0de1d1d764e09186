#pragma once
// Standalone SVG drawings of planar necklaces with the circles of a hierarchy over them.

#include <cstddef>
#include <string>
#include <vector>

#include "structures/necklace/balls.h"

namespace kds {

struct CirclePanel {
  struct Bead {
    Sphere ball;            ///< drawn as a dark dot if its radius is 0
    bool of_basis = false;  ///< drawn dark
  };
  struct Cage {
    Sphere sphere;
    std::size_t level = 0;  ///< 0 for the root; selects the colour
  };
  std::string title;
  std::vector<Bead> beads;  ///< in the order of the chain. Its backbone is drawn unless all are points
  std::vector<Cage> cages;
};

/// Returns an SVG document with the panels side by side, each 380 units wide and as large as it fits. All
/// panels have one scale. `title` describes the drawing for screen readers.
[[nodiscard]] std::string svg_document(const std::vector<CirclePanel>& panels, const std::string& title);

}  // namespace kds
