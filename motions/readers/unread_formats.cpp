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
constexpr std::array unread{
    UnreadFormat{".tng", "GROMACS", "convert it to XTC, as with gmx trjconv -f FILE -o traj.xtc"},
    UnreadFormat{".g96", "GROMACS", to_structure},
    UnreadFormat{".tpr", "GROMACS", to_structure},
    UnreadFormat{".top", "AMBER, GROMACS", to_topology},
    UnreadFormat{".mdcrd", "AMBER", to_trajectory},
    UnreadFormat{".crd", "AMBER, CHARMM", to_topology},
    UnreadFormat{".rst7", "AMBER", to_topology},
    UnreadFormat{".inpcrd", "AMBER", to_topology},
    UnreadFormat{".h5md", "H5MD", "convert it to DCD, as with MDAnalysis"},
    UnreadFormat{".h5", "MDTraj", to_trajectory},
    UnreadFormat{".mol2", "Tripos", "convert it to PDB, as with obabel FILE -O out.pdb"},
    UnreadFormat{".sdf", "MDL", "convert it to PDB, as with obabel FILE -O out.pdb"},
    UnreadFormat{".mmtf", "PDB", "download the mmCIF file of the entry"},
    UnreadFormat{".bcif", "PDB", "download the mmCIF file of the entry"},
    UnreadFormat{".bz2", "bzip2", to_unpacked},
    UnreadFormat{".xz", "xz", to_unpacked},
    UnreadFormat{".zst", "zstd", to_unpacked},
    UnreadFormat{".z", "compress", to_unpacked},
    UnreadFormat{".zip", "zip", to_unpacked},
};

}  // namespace

void refuse_unread_format(const std::filesystem::path& path) {
  std::string ending = file_ending(path);
  if (ending == ".gz") ending = file_ending(path.stem());
  const auto* const found = std::find_if(unread.begin(), unread.end(),
                                         [&](const UnreadFormat& format) { return format.ending == ending; });
  if (found == unread.end()) return;
  throw InputError(fmt::format("{}: {} files ({}) are not read yet; supported: {}; {}", path.string(), ending,
                               found->program, reader_registry().endings(), found->advice));
}

}  // namespace kds
