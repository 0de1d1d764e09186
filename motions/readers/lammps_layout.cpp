#include "motions/readers/lammps_layout.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "motions/base/text_input.h"

namespace kds {

namespace {

struct CoordinateNames {
  std::array<std::string_view, 3> axes;
  bool wrapped, scaled;
};
// The preferred ones first.
constexpr std::array<CoordinateNames, 4> coordinate_names{{{{"xu", "yu", "zu"}, false, false},
                                                           {{"xsu", "ysu", "zsu"}, false, true},
                                                           {{"x", "y", "z"}, true, false},
                                                           {{"xs", "ys", "zs"}, true, true}}};

std::optional<std::size_t> column_named(std::string_view name, const std::vector<std::string_view>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

std::optional<std::array<std::size_t, 3>> columns_named(const std::array<std::string_view, 3>& axes,
                                                        const std::vector<std::string_view>& names) {
  const auto x = column_named(axes[0], names), y = column_named(axes[1], names),
             z = column_named(axes[2], names);
  if (!x || !y || !z) return std::nullopt;
  return std::array{*x, *y, *z};
}

}  // namespace

std::optional<DumpColumns> read_dump_columns(std::string_view names) {
  const std::vector<std::string_view> fields = split_fields(names);
  DumpColumns columns;
  columns.count = fields.size();
  columns.id = column_named("id", fields);
  columns.element = column_named("element", fields);
  columns.velocity = columns_named({"vx", "vy", "vz"}, fields);
  const CoordinateNames* taken = nullptr;
  std::vector<std::string> unread;
  for (const CoordinateNames& kind : coordinate_names) {
    const auto found = columns_named(kind.axes, fields);
    if (!found) continue;
    if (taken != nullptr) {
      unread.push_back(fmt::format("{}", fmt::join(kind.axes, " ")));
      continue;
    }
    taken = &kind;
    columns.position = *found;
    columns.scaled = kind.scaled;
    if (kind.wrapped) columns.image = columns_named({"ix", "iy", "iz"}, fields);
  }
  if (taken == nullptr) return std::nullopt;
  const std::string axes = fmt::format("{}", fmt::join(taken->axes, " "));
  if (!unread.empty())
    columns.note =
        fmt::format("coordinates are {}; columns {} are left unread", axes, fmt::join(unread, ", "));
  if (columns.image)
    columns.note +=
        fmt::format("{}image flags ix iy iz unwrap the coordinates {}", unread.empty() ? "" : "; ", axes);
  return columns;
}

DumpBox read_dump_box(const std::array<std::array<double, 4>, 3>& lines, std::size_t columns) {
  DumpBox box;
  if (columns == 4) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      box.vectors.col(column) << lines[i][0], lines[i][1], lines[i][2];
      box.origin[column] = lines[i][3];
    }
    return box;
  }
  const double xy = lines[0][2], xz = lines[1][2], yz = lines[2][2];  // zeros in an upright box
  const double x_low = lines[0][0] - std::min({0.0, xy, xz, xy + xz});
  const double x_high = lines[0][1] - std::max({0.0, xy, xz, xy + xz});
  const double y_low = lines[1][0] - std::min(0.0, yz), y_high = lines[1][1] - std::max(0.0, yz);
  box.origin << x_low, y_low, lines[2][0];
  box.vectors << x_high - x_low, xy, xz,  //
      0, y_high - y_low, yz,              //
      0, 0, lines[2][1] - lines[2][0];
  return box;
}

}  // namespace kds
