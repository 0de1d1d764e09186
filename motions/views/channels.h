#pragma once
// The numbers of a bead's curves that a function uses.

namespace kds {

/// The channels that a function uses besides the centres of beads.
struct Channels {
  bool weights = false;
  bool radii = false;
};
inline constexpr Channels all_channels{true, true};

}  // namespace kds
