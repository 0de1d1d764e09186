#include "motions/readers/reader_registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "motions/readers/atom_frames.h"
#include "motions/readers/dcd_reader.h"
#include "motions/readers/gro_reader.h"
#include "motions/readers/imd_reader.h"
#include "motions/readers/lammps_reader.h"
#include "motions/readers/netcdf_reader.h"
#include "motions/readers/pdb_reader.h"
#include "motions/readers/prmtop_reader.h"
#include "motions/readers/psf_reader.h"
#include "motions/readers/read_options.h"
#include "motions/readers/topology.h"
#include "motions/readers/trr_reader.h"
#include "motions/readers/xtc_reader.h"
#include "motions/readers/xyz_reader.h"

namespace kds {

namespace {

using OpenAtoms = std::unique_ptr<AtomFrames> (*)(const std::filesystem::path&, const ReadOptions&);

// Returns the specification of a format of atoms without residues.
ReaderSpec atom_format(std::string name, std::vector<std::string> endings,
                       bool (*recognises)(std::string_view), OpenAtoms open) {
  ReaderSpec spec{std::move(name), std::move(endings), true};
  spec.recognises = recognises;
  spec.open = [open](const std::filesystem::path& path, const ReadOptions& options) {
    return open_atom_frames(path, options, open(path, options));
  };
  return spec;
}

// Adds the readers of this library: one line each.
void add_own_readers(ReaderRegistry& own) {
  own.add(structure_format("pdb", {".pdb", ".ent", ".pdb1"}, looks_like_pdb, open_pdb));
  own.add(structure_format("mmcif", {".cif", ".mmcif"}, looks_like_mmcif, open_mmcif));
  own.add(structure_format("gro", {".gro"}, looks_like_gro, open_gro));
  own.add(topology_format("psf", {".psf"}, looks_like_psf, open_psf));
  own.add(topology_format("prmtop", {".prmtop", ".parm7"}, looks_like_prmtop, open_prmtop));
  own.add(atom_format("dcd", {".dcd"}, looks_like_dcd, open_dcd));
  own.add(atom_format("xyz", {".xyz", ".extxyz"}, looks_like_xyz, open_xyz));
  own.add(atom_format("netcdf", {".nc", ".ncdf"}, looks_like_netcdf, open_netcdf));
  own.add(atom_format("lammps", {".lammpstrj", ".dump", ".lammpsdump"}, looks_like_lammps, open_lammps));
  own.add(atom_format("xtc", {".xtc"}, looks_like_xtc, open_xtc));
  own.add(atom_format("trr", {".trr"}, looks_like_trr, open_trr));
  own.add(atom_format("imd", {}, nullptr, open_imd));
}

bool has_ending(const ReaderSpec& reader, const std::string& ending) {
  return std::find(reader.endings.begin(), reader.endings.end(), ending) != reader.endings.end();
}

std::string listed(const std::vector<std::string>& texts) {
  std::string list;
  for (std::size_t i = 0; i < texts.size(); ++i)
    list += (i == 0 ? "" : i + 1 == texts.size() ? " or " : ", ") + texts[i];
  return list;
}

}  // namespace

std::string ReaderRegistry::first_bytes(const std::filesystem::path& path) {
  InputFile file(path);
  std::string bytes(bytes_seen, '\0');
  std::size_t size = 0;
  try {
    while (size < bytes.size()) {
      const std::size_t got = file.read(bytes.data() + size, bytes.size() - size);
      if (got == 0) break;
      size += got;
    }
  } catch (const CutFile&) {  // the reader reports the truncated file
  }
  bytes.resize(size);
  if (constexpr std::string_view mark = "\xef\xbb\xbf"; bytes.starts_with(mark)) bytes.erase(0, mark.size());
  return bytes;
}

void ReaderRegistry::add(ReaderSpec reader) {
  for (const ReaderSpec& other : readers_) {
    if (other.name == reader.name) throw std::logic_error("two readers are called " + reader.name);
    for (const std::string& ending : reader.endings)
      if (has_ending(other, ending))
        throw std::logic_error("readers " + other.name + " and " + reader.name + " both read " + ending);
  }
  readers_.push_back(std::move(reader));
}

const ReaderSpec* ReaderRegistry::find_by_ending(const std::filesystem::path& path) const {
  std::string ending = file_ending(path);
  if (ending == ".gz") ending = file_ending(path.stem());
  if (is_assembly_ending(ending)) ending = ".pdb1";
  for (const ReaderSpec& reader : readers_)
    if (has_ending(reader, ending)) return &reader;
  return nullptr;
}

const ReaderSpec* ReaderRegistry::find(const std::filesystem::path& path,
                                       const std::optional<std::string>& format) const {
  const bool is_live = is_live_address(path);
  if (is_live && format && *format != "imd")
    throw InputError("--format", fmt::format("{} has the format imd, found {}", path.string(), *format));
  if (format || is_live) {
    for (const ReaderSpec& reader : readers_)
      if (reader.name == format.value_or("imd")) return &reader;
    throw InputError("--format", fmt::format("expected {}, found {}", listed(names()), in_quotes(*format)));
  }
  const ReaderSpec* const by_ending = find_by_ending(path);
  const std::string start = first_bytes(path);
  if (by_ending != nullptr && (!by_ending->recognises || by_ending->recognises(start))) return by_ending;
  for (const ReaderSpec& reader : readers_)
    if (reader.recognises && reader.recognises(start)) return &reader;
  return by_ending;
}

std::vector<std::string> ReaderRegistry::names() const {
  std::vector<std::string> names;
  for (const ReaderSpec& reader : readers_) names.push_back(reader.name);
  return names;
}

std::vector<std::string> ReaderRegistry::names_with_frames() const {
  std::vector<std::string> names;
  for (const ReaderSpec& reader : readers_)
    if (reader.open) names.push_back(reader.name);
  return names;
}

std::string ReaderRegistry::endings() const {
  std::vector<std::string> all;
  for (const ReaderSpec& reader : readers_)
    if (reader.open) all.insert(all.end(), reader.endings.begin(), reader.endings.end());
  return listed(all);
}

std::string ReaderRegistry::trajectory_endings() const {
  std::vector<std::string> all;
  for (const ReaderSpec& reader : readers_)
    if (reader.takes_topology) all.insert(all.end(), reader.endings.begin(), reader.endings.end());
  return listed(all);
}

std::string ReaderRegistry::topology_endings() const {
  std::vector<std::string> all;
  for (const ReaderSpec& reader : readers_)
    if (reader.topology) all.insert(all.end(), reader.endings.begin(), reader.endings.end());
  return listed(all);
}

Topology read_topology(const std::filesystem::path& path, const ReadOptions& options) {
  const ReaderSpec* const reader = reader_registry().find(path);
  if (reader == nullptr || !reader->topology)
    throw InputError("--topology", fmt::format("{} names no atoms; expected {}", path.string(),
                                               reader_registry().topology_endings()));
  return reader->topology(path, options);
}

ReaderRegistry& reader_registry() {
  static ReaderRegistry registry = [] {
    ReaderRegistry own;
    add_own_readers(own);
    return own;
  }();
  return registry;
}

}  // namespace kds
