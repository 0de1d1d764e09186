#pragma once
// Deviation of a strided scene: how far beads in the skipped frames are from their positions in the scene.
// The scene takes every n-th frame of its files and interpolates the beads in between.
//
// The reference is linear motion between the files' frames. During one step of the files, a bead of the scene
// moves on a part of its Bezier curve. The difference of both motions is again a Bezier curve, so it is at
// most as long as its longest control point. The result therefore bounds the deviation at all times. For
// linear motion it is the exact maximum, which occurs at a frame, rounded up by at most 2^-44 of the
// coordinates. The bound is infinite if doubles overflow. Frames after the scene's last frame are ignored.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "motions/base/bead.h"
#include "motions/frames/frame_source.h"
#include "motions/scene/scene.h"

namespace kds {

struct StrideDeviation {
  std::size_t skipped = 0;      ///< number of skipped frames
  double largest = 0;           ///< largest deviation of any bead
  BeadId bead = 0;              ///< the bead with the largest deviation
  std::size_t frame = 0;        ///< the file's frame where it occurs; for a curved motion, the nearest frame
  std::vector<double> of_bead;  ///< largest deviation of each bead
};

/// Computes the deviation. `every` must read all frames of the files from the scene's first frame on; the
/// scene has each `stride`-th of them. Throws InputError if they are not the scene's frames.
///
/// `most` is a proved bound on the deviation of any bead, if one is known, for example for frames
/// straightened within a tolerance of which none is skipped (straightened_frames.h). No result exceeds it.
/// This limit is sharper than the computed bound for beads far from the origin, where rounding is larger.
[[nodiscard]] StrideDeviation deviation_of_stride(const Scene& scene, FrameSource& every, std::size_t stride,
                                                  std::optional<double> most = {});

/// Radii that bound contacts: the larger radii give a contact whenever the balls truly meet, the smaller ones
/// only if they do. Rounded outward.
struct RadiiWithin {
  std::vector<double> larger, smaller;
  std::vector<std::uint8_t> has_a_ball;  ///< 0: the smaller ball is empty, so no contact of the bead is sure
};
/// Computes the radii. Throws InputError naming the bead if a deviation is too large for its square to be a
/// number.
[[nodiscard]] RadiiWithin radii_within(const StrideDeviation& deviation, std::span<const double> radii);

}  // namespace kds
