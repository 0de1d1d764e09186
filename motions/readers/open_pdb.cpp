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
  explicit PdbModels(const std::filesystem::path& path) : file_(path.string()), reader_(path) {
    while (reader_.skip()) {
    }
    held_ = reader_.held();
    if (held_.whole == 0)
      throw InputError(fmt::format("{}: no ATOM or HETATM line; is this a PDB file?", file_));
    reader_.rewind();
  }

  FramesHeld held() const override { return held_; }

  StructureModel model(std::size_t k) override {
    if (k < next_) {
      reader_.rewind();
      next_ = 0;
    }
    bool there = true;
    for (; there && next_ < k; ++next_) there = reader_.skip();
    PdbModel text;
    if (!there || !reader_.next(text))
      throw InputError(fmt::format("{}: frame {}: is gone since the file was first read", file_, k));
    ++next_;
    try {
      return {gemmi::read_pdb_string(text.atom_lines, file_).models.at(0), text.cell};
    } catch (const std::exception& error) {
      throw InputError(fmt::format("{}: frame {}: {}", file_, k, one_line_message(error.what())));
    }
  }

 private:
  std::string file_;
  PdbModelReader reader_;
  FramesHeld held_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<StructureModels> open_pdb(const std::filesystem::path& path) {
  return std::make_unique<PdbModels>(path);
}

}  // namespace kds
