#pragma once
// The models of a PDB or mmCIF file, one after the other: of a PDB file only the one asked for is in memory.

#include <cstddef>
#include <filesystem>
#include <gemmi/model.hpp>
#include <memory>
#include <optional>

#include "motions/frames/frame_selection.h"
#include "motions/frames/periodic.h"

namespace kds {

struct StructureModel {
  gemmi::Model model;  ///< an atom's serial number is its place among the model's atoms in the file, from 0
  std::optional<Cell> cell;
};

class StructureModels {
 public:
  virtual ~StructureModels() = default;
  [[nodiscard]] virtual FramesHeld held() const = 0;
  /// Quick where they are asked for in their order. Throws InputError naming file and model.
  [[nodiscard]] virtual StructureModel model(std::size_t k) = 0;
};

/// Throws InputError if the file cannot be read or holds no atoms.
[[nodiscard]] std::unique_ptr<StructureModels> open_pdb(const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<StructureModels> open_mmcif(const std::filesystem::path& path);

}  // namespace kds
