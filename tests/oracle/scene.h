#pragma once
// The beads of a run at each of its frames, read by separate readers, because the oracle shares no code with
// kds.

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace oracle {

/// Wrong usage, or an input that cannot be read.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Ball {
  std::array<double, 3> centre{};
  double radius = 0;
  double weight = 0;  ///< only differences of weights matter, so 0 for all beads of equal radii
};

using Frame = std::vector<Ball>;

struct Scene {
  std::vector<Frame> frames;
  std::vector<std::size_t> ends;  ///< one past the last bead of each necklace
  /// 2 for the points of a planar instance, and for the beads of a trajectory that stay in one plane x, y or
  /// z = constant. In that case `in_plane` returns the coordinates in that plane first.
  int dimension = 3;
  std::array<std::size_t, 3> axes{0, 1, 2};

  [[nodiscard]] Frame in_plane(std::size_t frame) const;
  [[nodiscard]] std::size_t bead_count() const { return ends.empty() ? 0 : ends.back(); }
};

enum class FileKind { dcd, pdb, xyz, instance };

struct Input {
  FileKind kind = FileKind::dcd;
  std::filesystem::path path;
  std::optional<std::filesystem::path> names;  ///< PDB file that names the atoms of a DCD file
};

struct SceneOptions {
  std::vector<Input> inputs;
  std::size_t first = 0;
  std::optional<std::size_t> last;  ///< excluded
  std::size_t stride = 1;
  std::string radius = "auto";  ///< auto, a number, or file:PATH
};

[[nodiscard]] Scene read_scene(const SceneOptions& options);

// Each reader returns every frame of the file, with every bead as a point.
using Points = std::vector<std::array<double, 3>>;

struct PdbBackbone {
  std::vector<Points> models;                  ///< backbone beads of each model
  std::vector<std::size_t> first_model_atoms;  ///< indices of those beads among all atoms of model 1
  std::size_t atom_count = 0;                  ///< all atoms of model 1
};

[[nodiscard]] std::vector<Points> read_dcd(const std::filesystem::path& path);
[[nodiscard]] PdbBackbone read_pdb(const std::filesystem::path& path);
[[nodiscard]] std::vector<Points> read_xyz(const std::filesystem::path& path);

/// Reads an instance and sets `dimension`. Points of a planar instance have z = 0.
[[nodiscard]] std::vector<Frame> read_instance(const std::filesystem::path& path, int& dimension);
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

}  // namespace oracle
