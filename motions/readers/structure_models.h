#pragma once
// The models of a PDB or mmCIF file, one after the other.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>

#include "motions/readers/frame_selection.h"
#include "motions/readers/periodic.h"

namespace gemmi {
struct Model;
}

namespace kds {

/// In each model an atom's serial number is its place among the model's atoms in the file, from 0.
class StructureModels {
 public:
  virtual ~StructureModels() = default;
  [[nodiscard]] virtual FramesHeld held() const = 0;
  [[nodiscard]] virtual gemmi::Model model(std::size_t k) const = 0;
  [[nodiscard]] virtual std::optional<Cell> cell(std::size_t k) const = 0;
};

/// Throws InputError if the file cannot be read or holds no atoms.
[[nodiscard]] std::unique_ptr<StructureModels> open_pdb(const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<StructureModels> open_mmcif(const std::filesystem::path& path);

}  // namespace kds
