#include "motions/readers/reader_registry.h"

#include <algorithm>
#include <stdexcept>

#include "motions/base/file_ending.h"
#include "motions/readers/dcd_reader.h"
#include "motions/readers/pdb_reader.h"
#include "motions/readers/xyz_reader.h"

namespace kds {

namespace {

bool knows(const ReaderSpec& reader, const std::string& ending) {
  return std::find(reader.endings.begin(), reader.endings.end(), ending) != reader.endings.end();
}

}  // namespace

void ReaderRegistry::add(ReaderSpec reader) {
  for (const std::string& ending : reader.endings) {
    for (const ReaderSpec& other : readers_) {
      if (knows(other, ending))
        throw std::logic_error("readers " + other.name + " and " + reader.name + " both read " + ending);
    }
  }
  readers_.push_back(std::move(reader));
}

const ReaderSpec* ReaderRegistry::find(const std::filesystem::path& path) const {
  const auto ending_of = [](const std::filesystem::path& name) {
    const std::string ending = file_ending(name);
    return is_assembly_ending(ending) ? ".pdb1" : ending;
  };
  const std::string last = ending_of(path);
  for (const std::string& ending : {ending_of(path.stem()) + last, last}) {
    for (const ReaderSpec& reader : readers_)
      if (knows(reader, ending)) return &reader;
  }
  return nullptr;
}

std::string ReaderRegistry::endings() const {
  std::vector<std::string> all;
  for (const ReaderSpec& reader : readers_)
    all.insert(all.end(), reader.endings.begin(), reader.endings.end());
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i)
    text += (i == 0 ? "" : i + 1 == all.size() ? " or " : ", ") + all[i];
  return text;
}

ReaderRegistry& reader_registry() {
  static ReaderRegistry registry = [] {
    ReaderRegistry own;
    own.add({"structure",
             {".pdb", ".ent", ".cif", ".mmcif", ".pdb1", ".pdb.gz", ".ent.gz", ".cif.gz", ".mmcif.gz",
              ".pdb1.gz"},
             false,
             open_structure_frames});
    own.add({"dcd", {".dcd", ".dcd.gz"}, true, open_dcd});
    own.add({"xyz", {".xyz", ".extxyz", ".xyz.gz", ".extxyz.gz"}, false, open_xyz});
    return own;
  }();
  return registry;
}

}  // namespace kds
