#include "motions/readers/read_trajectory.h"

#include <fmt/format.h>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/necklace_stream.h"

namespace kds {

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
  NecklaceStream stream(path, options);
  std::vector<Trajectory> necklaces = stream.heads();
  for (Trajectory& necklace : necklaces) {
    necklace.frames.clear();
    necklace.frame_numbers.clear();
  }
  for (FrameRead frame; stream.next(frame);) {
    Eigen::Index begin = 0;
    for (std::size_t n = 0; n < necklaces.size(); ++n) {
      const auto beads = static_cast<Eigen::Index>(stream.heads()[n].bead_count());
      necklaces[n].frames.emplace_back(frame.positions.middleCols(begin, beads));
      necklaces[n].frame_numbers.push_back(frame.stamp.number);
      if (frame.stamp.picoseconds) necklaces[n].times.push_back(*frame.stamp.picoseconds);
      begin += beads;
    }
  }
  for (std::size_t n = 0; n < necklaces.size(); ++n) necklaces[n].warnings = stream.warnings(n);
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
