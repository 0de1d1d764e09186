#include "motions/frames/frame_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

NecklaceBeads beads_of(const Trajectory& necklace) {
  NecklaceBeads beads{.file = necklace.file,
                      .count = necklace.bead_count(),
                      .names = necklace.bead_names,
                      .element_radii = necklace.element_radii,
                      .element_lack = necklace.element_lack,
                      .groups = necklace.bead_groups};
  std::set_union(necklace.breaks.begin(), necklace.breaks.end(), necklace.gaps.begin(), necklace.gaps.end(),
                 std::back_inserter(beads.breaks));
  return beads;
}

std::size_t count_beads(std::span<const NecklaceBeads> necklaces) {
  std::size_t count = 0;
  for (const NecklaceBeads& necklace : necklaces) count += necklace.count;
  return count;
}

std::vector<BeadRange> bead_ranges(std::span<const NecklaceBeads> necklaces) {
  std::vector<BeadRange> ranges;
  BeadId first = 0;
  for (const NecklaceBeads& necklace : necklaces) {
    const auto count = static_cast<BeadId>(necklace.count);
    ranges.push_back({first, first + count - 1});
    first += count;
  }
  return ranges;
}

std::vector<BeadId> bonds_of(std::span<const NecklaceBeads> necklaces) {
  std::vector<BeadId> bonds;
  std::size_t first = 0;
  for (const NecklaceBeads& necklace : necklaces) {
    for (std::size_t b = 0; necklace.chain_like && b + 1 < necklace.count; ++b)
      if (!std::binary_search(necklace.breaks.begin(), necklace.breaks.end(), b))
        bonds.push_back(static_cast<BeadId>(first + b));
    first += necklace.count;
  }
  return bonds;
}

std::vector<std::string> names_of_beads(std::span<const NecklaceBeads> necklaces) {
  std::vector<std::string> names;
  std::size_t first = 0;
  for (const NecklaceBeads& necklace : necklaces) {
    if (!necklace.names.empty()) {
      names.resize(count_beads(necklaces));
      std::copy(necklace.names.begin(), necklace.names.end(),
                names.begin() + static_cast<std::ptrdiff_t>(first));
    }
    first += necklace.count;
  }
  return names;
}

BeadGroups bead_groups(std::span<const NecklaceBeads> necklaces) {
  BeadGroups groups;
  for (const NecklaceBeads& necklace : necklaces) {
    if (necklace.groups.empty()) return {};
    groups.insert(groups.end(), necklace.groups.begin(), necklace.groups.end());
  }
  return groups;
}

std::vector<bool> necklaces_at_rest(std::span<const NecklaceBeads> necklaces) {
  std::vector<bool> at_rest;
  for (const NecklaceBeads& necklace : necklaces) at_rest.push_back(necklace.at_rest);
  return std::ranges::find(at_rest, true) == at_rest.end() ? std::vector<bool>() : at_rest;
}

namespace {

const Trajectory& longest_of(std::span<const Trajectory> necklaces) {
  return *std::max_element(necklaces.begin(), necklaces.end(), [](const Trajectory& a, const Trajectory& b) {
    return a.frames.size() < b.frames.size();
  });
}

void check_frames(const Trajectory& necklace, const Trajectory& longest) {
  if (necklace.frames.size() != longest.frames.size() && necklace.frames.size() != 1)
    throw InputError(fmt::format(
        "{}: {} frames, but {} has {}; necklaces of a run need equal frame counts (or one frame: at rest)",
        necklace.file, necklace.frames.size(), longest.file, longest.frames.size()));
  for (std::size_t k = 0; k < necklace.frames.size(); ++k)
    if (necklace.frames[k].cols() != necklace.frames.front().cols())
      throw InputError(fmt::format(
          "{}: frame {}: {}, expected {} as in the first frame", necklace.file, necklace.frame_number(k),
          counted(static_cast<std::size_t>(necklace.frames[k].cols()), "bead"), necklace.bead_count()));
}

}  // namespace

MemoryFrames::MemoryFrames(std::span<const Trajectory> necklaces) {
  if (necklaces.empty()) return;
  const Trajectory& longest = longest_of(necklaces);
  for (const Trajectory& necklace : necklaces) {
    check_frames(necklace, longest);
    necklaces_.push_back(beads_of(necklace));
    necklaces_.back().at_rest = necklace.frames.size() < longest.frames.size();
    truncated_ = truncated_ || necklace.truncated;
  }
  beads_ = static_cast<Eigen::Index>(count_beads(necklaces_));
  const auto timed = std::find_if(necklaces.begin(), necklaces.end(), [&](const Trajectory& necklace) {
    return necklace.frames.size() == longest.frames.size() && !necklace.times.empty();
  });
  const auto has_these_cells = [&](const Trajectory& necklace) {
    return necklace.frames.size() < longest.frames.size() || necklace.cells == longest.cells;
  };
  if (std::ranges::all_of(necklaces, has_these_cells)) cells_ = longest.cells;
  const std::vector<double> times = timed == necklaces.end() ? std::vector<double>() : timed->times;
  own_.reserve(3 * count_beads(necklaces_) * longest.frames.size());
  for (std::size_t k = 0; k < longest.frames.size(); ++k) {
    FrameStamp& stamp = stamps_.emplace_back();
    stamp.number = longest.frame_number(k);
    if (k < times.size()) stamp.picoseconds = times[k];
    for (const Trajectory& necklace : necklaces) {
      const Eigen::Matrix3Xd& frame = necklace.frames[necklace.frames.size() == 1 ? 0 : k];
      own_.insert(own_.end(), frame.data(), frame.data() + frame.size());
    }
  }
  coordinates_ = own_;
  check_finite();
}

MemoryFrames::MemoryFrames(std::vector<NecklaceBeads> necklaces, std::span<const double> coordinates,
                           std::vector<FrameStamp> stamps)
    : necklaces_(std::move(necklaces)),
      beads_(static_cast<Eigen::Index>(count_beads(necklaces_))),
      coordinates_(coordinates),
      stamps_(std::move(stamps)) {
  const std::size_t expected = 3 * count_beads(necklaces_) * stamps_.size();
  if (coordinates_.size() != expected)
    throw InputError(fmt::format("{} of {}: expected {} coordinates, found {}",
                                 counted(stamps_.size(), "frame"), counted(count_beads(necklaces_), "bead"),
                                 expected, coordinates_.size()));
  check_finite();
}

/// Exact numbers cannot represent other coordinates. Readers also refuse such coordinates, naming the line.
void MemoryFrames::check_finite() const {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  const auto wrong = std::find_if_not(coordinates_.begin(), coordinates_.end(), is_finite);
  if (wrong == coordinates_.end()) return;
  const auto point = static_cast<std::size_t>(wrong - coordinates_.begin()) / 3;
  std::size_t n = 0, bead = point % static_cast<std::size_t>(beads_);
  for (; bead >= necklaces_[n].count; ++n) bead -= necklaces_[n].count;
  throw InputError(fmt::format("{}: frame {}, bead {}: expected finite coordinates, found {}, {}, {}",
                               necklaces_[n].file, stamps_[point / static_cast<std::size_t>(beads_)].number,
                               bead, coordinates_[3 * point], coordinates_[3 * point + 1],
                               coordinates_[3 * point + 2]));
}

bool MemoryFrames::next(FrameRead& frame) {
  if (next_ >= stamps_.size()) return false;
  const double* const first = coordinates_.data() + next_ * 3 * static_cast<std::size_t>(beads_);
  frame.positions = Eigen::Map<const Eigen::Matrix3Xd>(first, 3, beads_);
  frame.cell = next_ < cells_.size() ? std::optional(cells_[next_]) : std::nullopt;
  frame.stamp = stamps_[next_++];
  return true;
}

namespace {

/// Returns whether both cells are periodic along the same vectors.
bool have_same_vectors(const Cell& a, const Cell& b) {
  for (Eigen::Index vector = 0; vector < 3; ++vector)
    if (a.col(vector).isZero(0) != b.col(vector).isZero(0)) return false;
  return true;
}

}  // namespace

FrameQueue::FrameQueue(std::vector<NecklaceBeads> necklaces, int dimension, std::optional<Cell> cell)
    : necklaces_(std::move(necklaces)),
      beads_(count_beads(necklaces_)),
      columns_(static_cast<std::size_t>(dimension)),
      cell_(std::move(cell)) {}

void FrameQueue::push(std::span<const double> coordinates, std::optional<double> picoseconds,
                      const std::optional<Cell>& cell) {
  if (!open_) throw std::logic_error("a frame is pushed after the last one");
  if (coordinates.size() != columns_ * beads_)
    throw InputError(
        fmt::format("frame {}: expected {} of {} beads, {} numbers, found {}", pushed_,
                    columns_ == 1 ? "1 coordinate" : fmt::format("{} coordinates each", columns_), beads_,
                    columns_ * beads_, coordinates.size()));
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (std::isfinite(coordinates[i])) continue;
    throw InputError(fmt::format("frame {}, bead {}: expected finite coordinates, found {}", pushed_,
                                 i / columns_, coordinates[i]));
  }
  constexpr double most_cells = 100'000;
  const double farthest = cell_ ? most_cells * Images(cell ? *cell : *cell_).reduced().col(0).norm() : 0;
  for (std::size_t i = 0; cell_ && i < coordinates.size(); ++i) {
    if (std::abs(coordinates[i]) <= farthest) continue;
    throw InputError(
        fmt::format("frame {}, bead {}: is more than {:.0f} times the width of the cell away from "
                    "the origin; expected it nearer",
                    pushed_, i / columns_, most_cells));
  }
  if (cell && !(cell_ && have_same_vectors(*cell, *cell_)))
    throw InputError(
        fmt::format("frame {}: expected a cell that is periodic along the same vectors as the "
                    "run's, or none if the run has none",
                    pushed_));
  if (cell) {
    const Cell next = continued(*cell, *cell_);
    if (2 * (next - *cell_).norm() > Images(*cell_).reduced().col(0).norm())
      throw InputError(
          fmt::format("frame {}: its cell changes by more than half of the cell's shortest vector; "
                      "expected smaller changes",
                      pushed_));
    cell_ = next;
  }
  FrameRead& frame = waiting_.emplace_back();
  frame.stamp = {pushed_++, picoseconds};
  frame.cell = cell_;
  frame.positions.swap(spare_);
  frame.positions.setZero(3, static_cast<Eigen::Index>(beads_));
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    frame.positions(static_cast<Eigen::Index>(i % columns_), static_cast<Eigen::Index>(i / columns_)) =
        coordinates[i];
  if (!cell_) return;
  if (frame.stamp.number == 0) paths_.join_first_frame(bonded_in_cell(frame.positions));
  paths_.follow(frame.positions, *cell_);
}

std::vector<bool> FrameQueue::bonded_in_cell(const Eigen::Matrix3Xd& positions) const {
  std::vector<bool> bonded(beads_, false);
  Eigen::Index begin = 0;
  for (const NecklaceBeads& necklace : necklaces_) {
    const auto count = static_cast<Eigen::Index>(necklace.count);
    if (sequence_in_cell(positions.middleCols(begin, count), *cell_) != SequenceInCell::fluid)
      std::fill_n(bonded.begin() + begin + 1, count - 1, true);
    begin += count;
  }
  return bonded;
}

bool FrameQueue::next(FrameRead& frame) {
  if (waiting_.empty()) return false;
  std::swap(frame, waiting_.front());
  spare_.swap(waiting_.front().positions);
  waiting_.pop_front();
  return true;
}

void FrameQueue::seek(std::size_t k) {
  const std::size_t next = pushed_ - waiting_.size();
  if (k < next)
    throw InputError(fmt::format("frame {} is gone: only pushed frames from frame {} on are kept", k, next));
  if (k > pushed_)
    throw InputError(
        fmt::format("frame {} is not pushed yet: {} pushed so far", k, counted(pushed_, "frame")));
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(k - next));
}

}  // namespace kds
