#pragma once
// The syntax of CIF, read into gemmi's document. (gemmi's own reader needs the PEGTL headers, which Debian's
// package of gemmi does not bring along.)

#include <string>
#include <string_view>
#include <vector>

namespace gemmi::cif {
struct Document;
}

namespace kds {

/// Keeps the items of the named categories ("_atom_site."), in each data block. Throws InputError naming file
/// and line.
[[nodiscard]] gemmi::cif::Document read_cif(const std::string& file, std::string_view text,
                                            const std::vector<std::string>& categories);

}  // namespace kds
