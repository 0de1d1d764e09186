#pragma once
// The models of a file whose format names residues, in sequence: PDB, mmCIF, GRO, PSF and prmtop (the last
// two have one model without positions). A reader returns every atom of a model; polymer_selection.h decides
// which of them are beads.

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <gemmi/elem.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motions/frames/frame_selection.h"
#include "motions/frames/periodic.h"

namespace kds {

struct StructureAtom {
  std::string name;
  char alternate = '\0';  ///< location indicator, 0 if the atom has one location
  gemmi::Element element{gemmi::El::X};
  bool element_is_given = false;  ///< given in its own column, not guessed from the name
  bool is_massless = false;       ///< its mass is below that of any nucleus
  std::size_t index = 0;          ///< index among the model's atoms in the file, from 0
  std::optional<double> occupancy = {}, b_factor = {};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// The kind of molecule that the file says a residue belongs to.
enum class Entity { unknown, polymer, other };

struct StructureResidue {
  std::string chain, number, name;  ///< the number includes its insertion code, as in 52A
  std::string sequence;             ///< number in the entity's sequence (mmCIF), empty if the file has none
  std::string molecule;             ///< within the chain, by TER and segment, or label_asym_id
  bool het = false;                 ///< its first atom is a HETATM
  bool repeated = false;            ///< an earlier residue of the molecule has the same number
  Entity entity = Entity::unknown;
  std::vector<StructureAtom> atoms;
};

struct StructureModel {
  std::vector<StructureResidue> residues;  ///< in the order of the file
  std::size_t atom_count = 0;
  bool lists_bonds = false;  ///< molecules follow from the bonds in the file
  CellRead cell;
  std::optional<double> picoseconds = {};  ///< either all models of a file have a time, or none has one
  std::vector<std::string> notes;  ///< about how this model was read, one line each, without the file's name
};

class StructureModels {
 public:
  virtual ~StructureModels() = default;
  [[nodiscard]] virtual FramesHeld held() const = 0;
  /// Returns the k-th model. Fast if models are requested in order. Throws InputError naming file and model.
  [[nodiscard]] virtual StructureModel model(std::size_t k) = 0;
  /// Whether a model may have a cell.
  [[nodiscard]] virtual bool may_have_cell() const { return false; }
  /// Whether the cell of a file with one model is that of a crystal, which is not used.
  [[nodiscard]] virtual bool lone_cell_is_crystal() const { return true; }
  /// Lines about parts of the file that are not read, without the file's name.
  [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }
};

/// The one model of a file without frames.
class LoneModel final : public StructureModels {
 public:
  explicit LoneModel(StructureModel model) : model_(std::move(model)) {}
  [[nodiscard]] FramesHeld held() const override { return {1}; }
  [[nodiscard]] StructureModel model(std::size_t) override { return model_; }

 private:
  StructureModel model_;
};

}  // namespace kds
