#include <fmt/format.h>

#include <array>
#include <gemmi/mmcif.hpp>
#include <map>

#include "motions/base/input_error.h"
#include "motions/base/one_line.h"
#include "motions/base/text_input.h"
#include "motions/readers/cif_syntax.h"
#include "motions/readers/structure_models.h"

namespace kds {

namespace {

// What stands in a column of _atom_site that a file leaves out: another column, or one value for all.
struct Substitute {
  std::string tag, other, value;
};

const std::array<Substitute, 7>& substitutes() {
  static const std::array<Substitute, 7> all{{{"_atom_site.id", "", "?"},
                                              {"_atom_site.type_symbol", "", "?"},
                                              {"_atom_site.label_alt_id", "", "."},
                                              {"_atom_site.label_asym_id", "_atom_site.auth_asym_id", "A"},
                                              {"_atom_site.auth_seq_id", "_atom_site.label_seq_id", "?"},
                                              {"_atom_site.occupancy", "", "1"},
                                              {"_atom_site.B_iso_or_equiv", "", "0"}}};
  return all;
}

// gemmi takes no atom at all where one of its columns is missing, even one that nothing here needs.
void complete_atoms(gemmi::cif::Block& block) {
  gemmi::cif::Column places = block.find_values("_atom_site.Cartn_x");
  gemmi::cif::Loop* const loop = places.length() > 0 ? places.get_loop() : nullptr;
  if (loop == nullptr) return;  // no atom, or a single one without a loop
  for (const char axis : {'y', 'z'})
    if (!loop->has_tag(std::string("_atom_site.Cartn_") + axis))
      throw InputError(std::string("the atoms have no column _atom_site.Cartn_") + axis);
  for (const Substitute& substitute : substitutes()) {
    if (loop->has_tag(substitute.tag)) continue;
    const std::size_t width = loop->width(), rows = loop->values.size() / width;
    const int other = substitute.other.empty() ? -1 : loop->find_tag(substitute.other);
    std::vector<std::string> values;
    values.reserve(rows * (width + 1));
    for (std::size_t row = 0; row < rows; ++row) {
      const auto begin = loop->values.begin() + static_cast<std::ptrdiff_t>(row * width);
      values.insert(values.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
      values.push_back(other < 0 ? substitute.value : *(begin + other));
    }
    loop->tags.push_back(substitute.tag);
    loop->values = std::move(values);
  }
}

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
    complete_atoms(document.blocks.at(0));
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
  StructureModel model(std::size_t k) override { return {structure_.models[k], cell()}; }

 private:
  std::optional<Cell> cell() const {
    const std::string& group = structure_.spacegroup_hm;
    if (!group.empty() && group != "P 1" && group != "P1") return std::nullopt;
    const gemmi::UnitCell& cell = structure_.cell;
    return cell_from_angles({cell.a, cell.b, cell.c}, {cell.alpha, cell.beta, cell.gamma});
  }

  gemmi::Structure structure_;
};

}  // namespace

std::unique_ptr<StructureModels> open_mmcif(const std::filesystem::path& path) {
  return std::make_unique<MmcifModels>(path);
}

}  // namespace kds
