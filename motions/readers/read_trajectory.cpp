#include "motions/readers/read_trajectory.h"

#include <fmt/format.h>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/necklace_stream.h"

namespace kds {

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
      if (frame.cell) necklaces[n].cells.push_back(*frame.cell);
      if (frame.stamp.picoseconds) necklaces[n].times.push_back(*frame.stamp.picoseconds);
      begin += beads;
    }
  }
  for (std::size_t n = 0; n < necklaces.size(); ++n) {
    necklaces[n].later_breaks = stream.heads()[n].later_breaks;
    necklaces[n].warnings = stream.warnings(n);
    necklaces[n].truncated = stream.is_truncated();
    if (necklaces[n].cells.size() < necklaces[n].frames.size()) necklaces[n].cells.clear();
    const std::size_t frames = necklaces[n].frames.size(), timed = necklaces[n].times.size();
    if (timed == frames || timed == 0) continue;
    necklaces[n].times.clear();
    if (n == 0)
      necklaces[n].warnings.push_back(
          fmt::format("{}: {} of {} have no time: frames have numbers and no times", path.string(),
                      frames - timed, counted(frames, "frame")));
  }
  return necklaces;
}

Trajectory read_trajectory(const std::filesystem::path& path, const ReadOptions& options) {
  std::vector<Trajectory> necklaces = read_trajectories(path, options);
  if (necklaces.size() > 1)
    throw InputError("--chain", fmt::format("expected one chain of {}, found {}", path.string(),
                                            in_quotes(options.chain.value_or(""))));
  return std::move(necklaces.front());
}

}  // namespace kds
