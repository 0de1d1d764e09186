#pragma once
// A check of the unit of lengths, which formats such as XYZ and arrays of a caller do not name. survey_frames
// (frame_survey.h) passes the doubt to the caller as a warning.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace kds {

/// Returns why a chain that is taken for angstrom seems to be in nanometres, without its name, or an empty
/// text. Bonds are distances of consecutive beads, apart from those at `breaks` (ascending). The chain seems
/// to be in nanometres if it has at least 8 bonds, and either
///
/// - the median bond is 0.12 to 0.195 and at most 1% are below 0.09, as between atoms in the order of a file,
/// - or the median bond is 0.33 to 0.395 and at least 80% are 0.28 to 0.42, as between C-alpha atoms (0.38)
/// or
///   backbone beads of Martini (0.35).
/// Points of any other kind fail the second conditions, because their bonds spread more, or they lie on a
/// smooth curve: beads two apart must have a median distance of at most 1.95 median bonds.
[[nodiscard]] std::string nanometres_doubt(const Eigen::Ref<const Eigen::Matrix3Xd>& chain,
                                           const std::vector<std::size_t>& breaks = {});

}  // namespace kds
