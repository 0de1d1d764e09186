#include "motions/readers/necklace_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "motions/base/file_ending.h"
#include "motions/base/floating_point_guard.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/frames/chain_breaks.h"
#include "motions/readers/reader_registry.h"

namespace kds {

namespace {

FramesOpened open_frames(const std::filesystem::path& path, const ReadOptions& options) {
  const FloatingPointGuard to_nearest;
  const ReaderSpec* const reader = reader_registry().find(path);
  if (reader == nullptr)
    throw InputError(fmt::format("{}: the ending {} tells no format; expected {}", path.string(),
                                 in_quotes(file_ending(path)), reader_registry().endings()));
  FramesOpened opened = reader->open(path, options);
  if (options.topology && !reader->takes_topology)
    opened.warnings.push_back(fmt::format("{}: --topology is left unread, it serves DCD files", opened.file));
  return opened;
}

void check_finite(const std::string& file, const FrameRead& frame) {
  const Eigen::Matrix3Xd& positions = frame.positions;
  if (positions.allFinite()) return;
  for (Eigen::Index bead = 0; bead < positions.cols(); ++bead)
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      if (!std::isfinite(positions(axis, bead)))
        throw InputError(fmt::format("{}: frame {}: bead {} has {} = {}, expected a finite coordinate", file,
                                     frame.stamp.number, bead, "xyz"[axis], positions(axis, bead)));
}

// Those of a chain among those of all beads, where there are any.
template <class T>
std::vector<T> of_chain(const std::vector<T>& of_beads, std::size_t first, std::size_t bead_count) {
  if (of_beads.empty()) return {};
  const auto begin = of_beads.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(bead_count)};
}

// A necklace for each chain, without frames yet.
std::vector<Trajectory> heads_of(const FramesOpened& opened) {
  std::vector<Trajectory> heads;
  if (opened.chains.size() < 2) {
    heads.emplace_back().file = opened.file;
    heads.front().element_radii = opened.element_radii;
    heads.front().bead_names = opened.bead_names;
    return heads;
  }
  std::size_t first = 0;
  for (const auto& [name, bead_count] : opened.chains) {
    Trajectory& head = heads.emplace_back();
    head.file = fmt::format("{} chain {}", opened.file, name.empty() ? "' '" : name);
    head.element_radii = of_chain(opened.element_radii, first, bead_count);
    head.bead_names = of_chain(opened.bead_names, first, bead_count);
    first += bead_count;
  }
  return heads;
}

}  // namespace

NecklaceStream::NecklaceStream(const std::filesystem::path& path, const ReadOptions& options)
    : opened_(open_frames(path, options)),
      heads_(heads_of(opened_)),
      whole_(heads_.size()),
      frames_moved_(heads_.size(), 0) {
  const FloatingPointGuard to_nearest;
  FrameRead first;
  if (!opened_.frames->next(first))
    throw InputError(fmt::format("{}: the file holds no frame", opened_.file));
  check_finite(opened_.file, first);
  Eigen::Index begin = 0;
  for (std::size_t n = 0; n < heads_.size(); ++n) {
    const Eigen::Index beads =
        heads_.size() == 1 ? first.positions.cols() : static_cast<Eigen::Index>(opened_.chains[n].bead_count);
    Eigen::Matrix3Xd& frame = heads_[n].frames.emplace_back(first.positions.middleCols(begin, beads));
    WholeChain().make_whole(frame, first.cell);
    if (opened_.chain_like) heads_[n].breaks = find_chain_breaks(frame);
    heads_[n].frame_numbers.push_back(first.stamp.number);
    begin += beads;
  }
  opened_.frames->rewind();
}

bool NecklaceStream::next(FrameRead& frame) {
  const FloatingPointGuard to_nearest;
  if (!opened_.frames->next(frame)) return false;
  check_finite(opened_.file, frame);
  std::size_t expected = 0;
  for (const Trajectory& head : heads_) expected += head.bead_count();
  if (static_cast<std::size_t>(frame.positions.cols()) != expected)
    throw InputError(fmt::format("{}: frame {}: {}, expected {} as in frame {}", opened_.file,
                                 frame.stamp.number,
                                 counted(static_cast<std::size_t>(frame.positions.cols()), "bead"), expected,
                                 heads_.front().frame_number(0)));
  Eigen::Index begin = 0;
  for (std::size_t n = 0; n < heads_.size(); ++n) {
    const auto beads = static_cast<Eigen::Index>(heads_[n].bead_count());
    if (whole_[n].make_whole(frame.positions.middleCols(begin, beads), frame.cell)) ++frames_moved_[n];
    begin += beads;
  }
  return true;
}

void NecklaceStream::rewind() {
  opened_.frames->rewind();
  for (WholeChain& chain : whole_) chain.restart();
  std::fill(frames_moved_.begin(), frames_moved_.end(), 0);
}

std::vector<std::string> NecklaceStream::warnings(std::size_t necklace) const {
  // What the file as a whole warns of goes with the first.
  std::vector<std::string> lines = necklace == 0 ? opened_.warnings : std::vector<std::string>();
  const Trajectory& head = heads_[necklace];
  if (const std::size_t moved = frames_moved_[necklace]; moved > 0)
    lines.push_back(
        fmt::format("{}: made whole across the periodic cell in {}", head.file, counted(moved, "frame")));
  if (!head.breaks.empty()) lines.push_back(describe_chain_breaks(head.file, head.breaks));
  return lines;
}

}  // namespace kds
