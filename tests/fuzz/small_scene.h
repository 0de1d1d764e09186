#pragma once
// Small scenes for the fuzzer of kernels. Any bytes make a scene, and a scene is written as files that
// `kds run` reads.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "motions/scene/scene.h"
#include "tests/laws/law_structures.h"

namespace kds::test {

/// The numbers that bytes stand for.
enum class Values : std::uint8_t {
  whole,  ///< whole, from -8 to 8
  mild,   ///< also quarters, neighbours of other numbers, numbers with 53 bits; all below 100
  wild    ///< also numbers from 2^-1032 to 2^1009
};

struct SmallScene {
  struct Bead {
    bool begins = false;  ///< whether a necklace begins here, as with bead 0; ignored in an instance
    double radius = 0;    ///< ignored in an instance
    /// The bead's places in all frames, or its control points. All places of a scene have equally many
    /// numbers: coordinates and, if an instance has four, a weight.
    std::vector<std::vector<double>> places = {};
  };

  LawStructure structure = {};
  bool of_frames = false;  ///< frames in space; otherwise the control points of an instance
  bool hermite = false;    ///< how frames are joined
  std::vector<Bead> beads = {};

  [[nodiscard]] std::size_t place_count() const { return beads.front().places.size(); }
  [[nodiscard]] std::size_t columns() const { return beads.front().places.front().size(); }
};

/// Makes a scene of bytes: the structure, the shape, the number of beads, then a byte for each radius and two
/// for each coordinate. Missing bytes are 0. If a structure is given, the scene has it, and frames that are
/// joined by lines.
[[nodiscard]] SmallScene scene_of_bytes(std::string_view bytes, Values values,
                                        std::string_view structure = {});

/// Reads an instance file, or the frames of a trajectory, whose beads get this radius. Throws InputError.
[[nodiscard]] SmallScene read_scene(const std::filesystem::path& path, double radius);

/// Throws InputError if the scene is beyond a stated limit.
[[nodiscard]] Scene make_scene(const SmallScene& small);

/// Writes the scene as files whose names begin with `prefix`. Returns the arguments of the program that runs
/// it.
[[nodiscard]] std::vector<std::string> write_scene(const SmallScene& small, const std::string& prefix);

}  // namespace kds::test
