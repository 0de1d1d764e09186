#pragma once
// Which numbers of a bead's curves a function looks at.

namespace kds {

/// What a function asks of beads besides their centres.
struct Channels {
  bool weights = false;
  bool radii = false;
};
inline constexpr Channels all_channels{true, true};

}  // namespace kds
