#include "motions/readers/read_trajectory.h"

#include <fmt/format.h>

#include "motions/base/file_ending.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/chain_breaks.h"
#include "motions/readers/periodic.h"
#include "motions/readers/reader_registry.h"

namespace kds {

namespace {

const ReaderSpec& reader_of(const std::filesystem::path& path) {
  if (const ReaderSpec* reader = reader_registry().find(path)) return *reader;
  throw InputError(fmt::format("{}: the ending {} tells no format; expected {}", path.string(),
                               in_quotes(file_ending(path)), reader_registry().endings()));
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

// A necklace for each chain. What the file as a whole warns of goes with the first.
std::vector<Trajectory> split_chains(Trajectory all, const std::vector<ChainRead>& chains) {
  std::vector<Trajectory> necklaces;
  if (chains.size() < 2) {
    necklaces.push_back(std::move(all));
    return necklaces;
  }
  std::size_t first = 0;
  for (const auto& [name, bead_count] : chains) {
    Trajectory& necklace = necklaces.emplace_back();
    necklace.file = fmt::format("{} chain {}", all.file, name.empty() ? "' '" : name);
    necklace.frame_numbers = all.frame_numbers;
    necklace.times = all.times;
    for (const Eigen::Matrix3Xd& frame : all.frames)
      necklace.frames.emplace_back(
          frame.middleCols(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(bead_count)));
    if (!all.element_radii.empty()) {
      const auto radius = all.element_radii.begin() + static_cast<std::ptrdiff_t>(first);
      necklace.element_radii.assign(radius, radius + static_cast<std::ptrdiff_t>(bead_count));
    }
    first += bead_count;
  }
  necklaces.front().warnings = std::move(all.warnings);
  return necklaces;
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

std::vector<Trajectory> read_trajectories(const std::filesystem::path& path, const ReadOptions& options) {
  const ReaderSpec& reader = reader_of(path);
  FramesRead read = reader.read(path, options);
  check_finite(read.trajectory);
  if (options.topology && !reader.takes_topology)
    read.trajectory.warnings.push_back(
        fmt::format("{}: --topology is left unread, it serves DCD files", read.trajectory.file));
  std::vector<Trajectory> necklaces = split_chains(std::move(read.trajectory), read.chains);
  for (Trajectory& necklace : necklaces) {
    if (const std::size_t moved = make_whole(necklace.frames, read.cells); moved > 0)
      necklace.warnings.push_back(fmt::format("{}: made whole across the periodic cell in {}", necklace.file,
                                              counted(moved, "frame")));
    if (read.chain_like) necklace.breaks = find_chain_breaks(necklace.frames.front());
    if (!necklace.breaks.empty())
      necklace.warnings.push_back(describe_chain_breaks(necklace.file, necklace.breaks));
  }
  return necklaces;
}

Trajectory read_trajectory(const std::filesystem::path& path, const ReadOptions& options) {
  std::vector<Trajectory> necklaces = read_trajectories(path, options);
  if (necklaces.size() > 1)
    throw InputError(fmt::format("--chain: expected one chain of {}, found {}", path.string(),
                                 in_quotes(options.chain.value_or(""))));
  return std::move(necklaces.front());
}

}  // namespace kds
