#include "motions/readers/read_trajectory.h"

#include <fmt/format.h>

#include "motions/base/file_ending.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/chain_breaks.h"
#include "motions/readers/dcd_reader.h"
#include "motions/readers/pdb_reader.h"
#include "motions/readers/periodic.h"
#include "motions/readers/xyz_reader.h"

namespace kds {

namespace {

FramesRead read_by_ending(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string ending = file_ending(path);
  if (ending == ".dcd") return read_dcd(path, options);
  if (ending == ".xyz") return read_xyz(path, options);
  if (is_structure_file(path)) return read_structure(path, options);
  throw InputError(
      fmt::format("{}: the ending {} tells no format; expected .pdb, .ent, .cif, .mmcif (or these with "
                  ".gz), .dcd or .xyz",
                  path.string(), in_quotes(ending)));
}

void check_finite(const Trajectory& trajectory) {
  for (std::size_t k = 0; k < trajectory.frames.size(); ++k) {
    const Eigen::Matrix3Xd& frame = trajectory.frames[k];
    if (frame.allFinite()) continue;
    for (Eigen::Index bead = 0; bead < frame.cols(); ++bead)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        if (!std::isfinite(frame(axis, bead)))
          throw InputError(fmt::format("{}: frame {}: bead {} has {} = {}, expected a finite coordinate",
                                       trajectory.file, trajectory.frame_numbers[k], bead, "xyz"[axis],
                                       frame(axis, bead)));
  }
}

}  // namespace

FrameRange parse_frame_range(std::string_view text) {
  const auto refuse = [&](std::string_view why) {
    return InputError(
        fmt::format("--frames: {} in {}, expected FIRST:LAST:STRIDE (whole numbers from 0, each may "
                    "be left out)",
                    why, in_quotes(text)));
  };
  std::vector<std::string_view> parts;
  for (std::string_view rest = text;;) {
    const std::size_t colon = rest.find(':');
    parts.push_back(rest.substr(0, colon));
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  if (parts.size() == 1) throw refuse("no colon");
  if (parts.size() > 3) throw refuse("too many colons");
  const auto number = [&](std::size_t i) -> std::optional<std::size_t> {
    if (i >= parts.size() || parts[i].empty()) return std::nullopt;
    const auto value = parse_count(parts[i]);
    if (!value) throw refuse(fmt::format("{} is no whole number", in_quotes(parts[i])));
    return value;
  };
  const FrameRange range{number(0).value_or(0), number(1), number(2).value_or(1)};
  if (range.stride == 0) throw refuse("a stride of 0");
  if (range.last && *range.last <= range.first) throw refuse("no frame");
  return range;
}

Trajectory read_trajectory(const std::filesystem::path& path, const ReadOptions& options) {
  FramesRead read = read_by_ending(path, options);
  Trajectory trajectory = std::move(read.trajectory);
  check_finite(trajectory);
  if (options.topology && file_ending(path) != ".dcd")
    trajectory.warnings.push_back(
        fmt::format("{}: --topology is left unread, it serves DCD files", trajectory.file));
  if (const std::size_t moved = make_whole(trajectory.frames, read.cells); moved > 0)
    trajectory.warnings.push_back(fmt::format("{}: made whole across the periodic cell in {}",
                                              trajectory.file, counted(moved, "frame")));
  if (read.chain_like) trajectory.breaks = find_chain_breaks(trajectory.frames.front());
  if (!trajectory.breaks.empty())
    trajectory.warnings.push_back(describe_chain_breaks(trajectory.file, trajectory.breaks));
  return trajectory;
}

}  // namespace kds
