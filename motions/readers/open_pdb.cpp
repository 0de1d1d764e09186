// One model at a time goes to gemmi, so that a long file costs no more than the frames asked for.

#include <fmt/format.h>

#include <gemmi/pdb.hpp>

#include "motions/base/input_error.h"
#include "motions/base/one_line.h"
#include "motions/base/text_input.h"
#include "motions/readers/pdb_models.h"
#include "motions/readers/structure_models.h"

namespace kds {

namespace {

class PdbModels : public StructureModels {
 public:
  explicit PdbModels(const std::filesystem::path& path)
      : file_(path.string()), text_(read_whole_file(path)), split_(split_pdb_models(text_)) {
    if (split_.models.empty())
      throw InputError(fmt::format("{}: no ATOM or HETATM line; is this a PDB file?", file_));
  }

  FramesHeld held() const override {
    return {split_.models.size() - (split_.ends_inside ? 1 : 0), split_.ends_inside};
  }

  gemmi::Model model(std::size_t k) const override {
    const std::string lines = atom_lines(file_, split_.models[k]);
    try {
      return gemmi::read_pdb_string(lines, file_).models.at(0);
    } catch (const std::exception& error) {
      throw InputError(fmt::format("{}: frame {}: {}", file_, k, one_line_message(error.what())));
    }
  }

  std::optional<Cell> cell(std::size_t k) const override { return split_.models[k].cell; }

 private:
  std::string file_;
  std::string text_;
  PdbText split_;
};

}  // namespace

std::unique_ptr<StructureModels> open_pdb(const std::filesystem::path& path) {
  return std::make_unique<PdbModels>(path);
}

}  // namespace kds
