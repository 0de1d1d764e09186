#pragma once
// How far beads are, in frames that a scene leaves out, from where the scene has them: the scene takes every
// so-manieth frame of its files, and moves beads over the others.
//
// Taken for the truth is linear motion between the files' frames. In one of their steps a bead of the scene
// moves on a part of its Bezier curve, and the difference of the two is a Bezier curve again: it is no longer
// than its longest control point. So what is found here bounds the deviation at all times, and in linear
// motion it is the largest there is, reached at a frame, but for being rounded up by up to 2^-44 of the
// coordinates; infinity where doubles overflow. Frames behind the scene's last one are not looked at.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "motions/base/bead.h"
#include "motions/frames/frame_reader.h"
#include "motions/scene/scene.h"

namespace kds {

struct StrideDeviation {
  std::size_t skipped = 0;      ///< frames between those of the scene
  double largest = 0;           ///< of any bead
  BeadId bead = 0;              ///< whose that is
  std::size_t frame = 0;        ///< at which frame of the file, or in a curved motion next to it
  std::vector<double> of_bead;  ///< the largest of each
};

/// `every`: all frames of the files from the scene's first on, of which it has each `stride`-th. Throws
/// InputError where these are not the frames that the scene has.
///
/// `most`: how far a bead is proved to be off at the most, where that is known, as of frames straightened
/// within a tolerance of which none is left out (straightened_frames.h). No bound is above it: near beads are
/// told apart better by it far from the origin, where what is found here is rounded by more.
[[nodiscard]] StrideDeviation deviation_of_stride(const Scene& scene, FrameReader& every, std::size_t stride,
                                                  std::optional<double> most = {});

/// Radii by which contacts are bounded: with the larger ones balls meet whenever they do in truth, with the
/// smaller ones only when they do. Rounded outward.
struct RadiiWithin {
  std::vector<double> larger, smaller;
  std::vector<std::uint8_t> has_a_ball;  ///< 0: nothing is left of it, and no contact of it is sure
};
/// Throws InputError naming the bead where one is too far off for its square to be a number.
[[nodiscard]] RadiiWithin radii_within(const StrideDeviation& deviation, std::span<const double> radii);

}  // namespace kds
