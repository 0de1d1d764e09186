#pragma once
// The parts of a LAMMPS dump that say how its numbers are to be read: the columns of the atoms, and the
// simulation box.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace kds {

/// The columns of the atoms' lines.
struct DumpColumns {
  std::size_t count = 0;
  std::optional<std::size_t> id, element;
  std::array<std::size_t, 3> position{};
  std::optional<std::array<std::size_t, 3>> image;  ///< flags that unwrap the position
  std::optional<std::array<std::size_t, 3>> velocity;
  bool scaled = false;  ///< positions are fractions of the box
  std::string note;     ///< which columns are the positions, if several could be, or if flags unwrap them
};

/// Reads the names after ITEM: ATOMS. If there are several kinds of coordinates, takes the first
/// of these: xu yu zu, xsu ysu zsu (scaled by the box), x y z, xs ys zs. Returns nothing if no three columns
/// are coordinates.
[[nodiscard]] std::optional<DumpColumns> read_dump_columns(std::string_view names);

/// The simulation box of a frame, in the units of the file.
struct DumpBox {
  Eigen::Matrix3d vectors = Eigen::Matrix3d::Zero();  ///< a column each
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::array<bool, 3> periodic{};
};

/// Makes the box from the numbers in its three lines. Two columns are the bounds of an upright box. Three are
/// the bounds of a tilted box, which hold all its corners, and its tilts xy, xz and yz. Four are a vector and
/// a coordinate of the origin.
[[nodiscard]] DumpBox read_dump_box(const std::array<std::array<double, 4>, 3>& lines, std::size_t columns);

}  // namespace kds
