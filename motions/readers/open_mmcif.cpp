#include <fmt/format.h>

#include <gemmi/mmcif.hpp>
#include <map>

#include "motions/base/input_error.h"
#include "motions/base/one_line.h"
#include "motions/base/text_input.h"
#include "motions/readers/cif_syntax.h"
#include "motions/readers/structure_models.h"

namespace kds {

namespace {

// gemmi keeps the atoms of a residue together; their place in the file goes along as their number.
void number_atoms(gemmi::cif::Block& block) {
  std::map<std::string, std::size_t> next_in_model;
  gemmi::cif::Column ids = block.find_values("_atom_site.id");
  const gemmi::cif::Column models = block.find_values("_atom_site.pdbx_PDB_model_num");
  for (int i = 0; i < ids.length(); ++i)
    ids[i] = std::to_string(next_in_model[models.length() == ids.length() ? models.at(i) : ""]++);
}

gemmi::Structure parse(const std::filesystem::path& path) {
  const std::string text = read_whole_file(path);
  gemmi::cif::Document document =
      read_cif(path.string(), text, {"_atom_site.", "_entity.", "_entity_poly.", "_cell.", "_symmetry."});
  try {
    number_atoms(document.blocks.at(0));
    return gemmi::make_structure(document);
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{}: {}", path.string(), one_line_message(error.what())));
  }
}

class MmcifModels : public StructureModels {
 public:
  explicit MmcifModels(const std::filesystem::path& path) : structure_(parse(path)) {
    if (structure_.models.empty())
      throw InputError(fmt::format("{}: no atom in the first data block (_atom_site)", path.string()));
  }

  FramesHeld held() const override { return {structure_.models.size(), false}; }
  gemmi::Model model(std::size_t k) const override { return structure_.models[k]; }

  std::optional<Cell> cell(std::size_t) const override {
    const std::string& group = structure_.spacegroup_hm;
    if (!group.empty() && group != "P 1" && group != "P1") return std::nullopt;
    const gemmi::UnitCell& cell = structure_.cell;
    return cell_from_angles({cell.a, cell.b, cell.c}, {cell.alpha, cell.beta, cell.gamma});
  }

 private:
  gemmi::Structure structure_;
};

}  // namespace

std::unique_ptr<StructureModels> open_mmcif(const std::filesystem::path& path) {
  return std::make_unique<MmcifModels>(path);
}

}  // namespace kds
