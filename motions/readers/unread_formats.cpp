#include "motions/readers/unread_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/reader_registry.h"

namespace kds {

namespace {

struct UnreadFormat {
  std::string_view ending;
  std::string_view program;  // the program that writes it
  std::string_view advice;
};

constexpr std::string_view to_trajectory = "convert it to DCD, as with mdconvert -o traj.dcd FILE";
constexpr std::string_view to_structure = "convert it to PDB, as with gmx editconf -f FILE -o conf.pdb";
constexpr std::string_view to_topology =
    "save a PDB file of the atoms, as with cpptraj or VMD, and give that one";
constexpr std::string_view to_unpacked = "unpack it, or pack it with gzip";
constexpr std::string_view to_pdb = "convert it to PDB, as with obabel FILE -O out.pdb";
constexpr std::string_view to_xyz = "convert it to XYZ, as with obabel -itxyz FILE -oxyz -O out.xyz";
constexpr std::string_view to_coordinates =
    "it holds no frames that kds reads; give the trajectory or a structure";
constexpr std::string_view to_models = "convert it to PDB, as with VMD or MDAnalysis";
constexpr std::array unread{
    UnreadFormat{".tng", "GROMACS", "convert it to XTC, as with gmx trjconv -f FILE -o traj.xtc"},
    UnreadFormat{".g96", "GROMACS", to_structure},
    UnreadFormat{".tpr", "GROMACS", to_structure},
    UnreadFormat{".cpt", "GROMACS", "convert it to TRR, as with gmx trjconv -f FILE -o traj.trr"},
    UnreadFormat{".edr", "GROMACS", to_coordinates},
    UnreadFormat{".itp", "GROMACS", to_topology},
    UnreadFormat{".ndx", "GROMACS", to_coordinates},
    UnreadFormat{".top", "AMBER, GROMACS", to_topology},
    UnreadFormat{".mdcrd", "AMBER", to_trajectory},
    UnreadFormat{".crd", "AMBER, CHARMM", to_topology},
    UnreadFormat{".cor", "CHARMM", to_topology},
    UnreadFormat{".rst", "AMBER, CHARMM", to_topology},
    UnreadFormat{".rst7", "AMBER", to_topology},
    UnreadFormat{".restrt", "AMBER", to_topology},
    UnreadFormat{".binpos", "AMBER", to_trajectory},
    UnreadFormat{".inpcrd", "AMBER", to_topology},
    UnreadFormat{".coor", "NAMD", to_models},
    UnreadFormat{".vel", "NAMD", to_coordinates},
    UnreadFormat{".xsc", "NAMD", to_coordinates},
    UnreadFormat{".data", "LAMMPS", to_models},
    UnreadFormat{".lmp", "LAMMPS", to_models},
    UnreadFormat{".gsd", "HOOMD", "convert it to DCD, as with MDAnalysis"},
    UnreadFormat{".dtr", "Desmond", to_trajectory},
    UnreadFormat{".mae", "Maestro", to_pdb},
    UnreadFormat{".cms", "Desmond", to_models},
    UnreadFormat{".arc", "Tinker", to_xyz},
    UnreadFormat{".txyz", "Tinker", to_xyz},
    UnreadFormat{".traj", "ASE", "convert it to extended XYZ, as with ase convert FILE out.extxyz"},
    UnreadFormat{".npy", "NumPy", "the Python module takes arrays"},
    UnreadFormat{".npz", "NumPy", "the Python module takes arrays"},
    UnreadFormat{".h5md", "H5MD", "convert it to DCD, as with MDAnalysis"},
    UnreadFormat{".h5", "MDTraj", to_trajectory},
    UnreadFormat{".mol2", "Tripos", to_pdb},
    UnreadFormat{".mol", "MDL", to_pdb},
    UnreadFormat{".sdf", "MDL", to_pdb},
    UnreadFormat{".mmtf", "PDB", "download the mmCIF file of the entry"},
    UnreadFormat{".bcif", "PDB", "download the mmCIF file of the entry"},
    UnreadFormat{".bz2", "bzip2", to_unpacked},
    UnreadFormat{".xz", "xz", to_unpacked},
    UnreadFormat{".zst", "zstd", to_unpacked},
    UnreadFormat{".z", "compress", to_unpacked},
    UnreadFormat{".zip", "zip", to_unpacked},
};

struct UnreadContent {
  std::string_view start, name, advice;
};

constexpr std::array contents{
    UnreadContent{
        "\x89HDF\r\n\x1A\n", "HDF5 (netCDF-4, H5MD, MDTraj)",
        "convert a file of AMBER to classic NetCDF, as with nccopy -k classic FILE out.nc, and others "
        "to DCD, as with mdconvert or MDAnalysis"},
    UnreadContent{"@<TRIPOS>", "MOL2", to_pdb},
    UnreadContent{"BZh", "compressed by bzip2", to_unpacked},
    UnreadContent{"\xFD"
                  "7zXZ",
                  "compressed by xz", to_unpacked},
    UnreadContent{"\x28\xB5\x2F\xFD", "compressed by zstd", to_unpacked},
    UnreadContent{"PK\x03\x04", "a zip archive", to_unpacked},
    UnreadContent{"version https://git-lfs", "a pointer of Git LFS", "fetch the file, as with git lfs pull"},
    UnreadContent{"<!doctype html", "an HTML page", "the download of the file has failed"},
    UnreadContent{"<html", "an HTML page", "the download of the file has failed"},
};

// Tinker writes the number of atoms with a title, perhaps a line with a cell, and then for each atom its
// number, name, coordinates, type and bonded atoms.
bool looks_like_tinker(std::string_view start) {
  const auto is_number = [](std::string_view field) { return parse_double(field).has_value(); };
  const auto head = split_fields(next_line(start));
  auto atom = split_fields(next_line(start));
  if (atom.size() == 6 && std::all_of(atom.begin(), atom.end(), is_number))
    atom = split_fields(next_line(start));
  return !head.empty() && parse_count(head[0]) && atom.size() >= 6 && atom[0] == "1" && !is_number(atom[1]) &&
         std::all_of(atom.begin() + 2, atom.begin() + 5, is_number) &&
         std::all_of(atom.begin() + 5, atom.end(), [](std::string_view field) { return parse_count(field); });
}

[[noreturn]] void refuse_content(const std::filesystem::path& path, std::string_view name,
                                 std::string_view advice) {
  throw InputError(fmt::format("{}: this is {}, which is not read; {}; supported: {}", path.string(), name,
                               advice, reader_registry().endings()));
}

}  // namespace

void refuse_unread_content(const std::filesystem::path& path, std::string_view start) {
  for (const UnreadContent& content : contents)
    if (lower_case(start.substr(0, content.start.size())) == lower_case(content.start))
      refuse_content(path, content.name, content.advice);
  // XDR texts: the length with a final zero, the length, the text.
  if (start.size() > 16 && start.substr(8, 8) == "VERSION ")
    refuse_content(path, "a TPR file of GROMACS", to_structure);
  if (looks_like_tinker(start)) refuse_content(path, "Tinker XYZ", to_xyz);
}

void refuse_unread_ending(const std::filesystem::path& path) {
  std::string ending = file_ending(path);
  if (ending == ".gz") ending = file_ending(path.stem());
  const auto* const found = std::find_if(unread.begin(), unread.end(),
                                         [&](const UnreadFormat& format) { return format.ending == ending; });
  if (found == unread.end()) return;
  throw InputError(fmt::format("{}: {} files ({}) are not read yet; supported: {}; {}", path.string(), ending,
                               found->program, reader_registry().endings(), found->advice));
}

}  // namespace kds
