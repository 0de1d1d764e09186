#include "motions/readers/necklace_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

#include "motions/base/floating_point_scope.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/frames/trajectory.h"
#include "motions/readers/reader_registry.h"
#include "motions/readers/unread_formats.h"

namespace kds {

namespace {

// Returns the reader of a file. Throws InputError if there is none.
const ReaderSpec& reader_of(const std::filesystem::path& path,
                            const std::optional<std::string>& format = {}) {
  const ReaderSpec* const reader = reader_registry().find(path, format);
  if (reader != nullptr && (format || !reader->recognises)) return *reader;
  const std::string start = ReaderRegistry::first_bytes(path);
  if (reader == nullptr || !reader->recognises(start)) refuse_unread_content(path, start);
  if (reader != nullptr) return *reader;
  refuse_unread_ending(path);
  throw InputError(fmt::format("cannot tell the format of {} from its content or its ending; supported: {}",
                               path.string(), reader_registry().endings()));
}

// Throws InputError if the topology has a format that names no atoms and needs a topology itself.
void refuse_trajectory_as_topology(const std::filesystem::path& path, const std::filesystem::path& topology,
                                   bool path_takes_topology) {
  const ReaderSpec* const reader =
      path_takes_topology ? &reader_of(topology) : reader_registry().find_by_ending(topology);
  if (reader == nullptr || reader->topology || !reader->takes_topology) return;
  throw InputError(
      "--topology",
      fmt::format("{} names no atoms; {}", topology.string(),
                  path_takes_topology ? fmt::format("expected the file with the atoms of {} ({})",
                                                    path.string(), reader_registry().topology_endings())
                                      : fmt::format("the trajectory comes first: {} {} {}", topology.string(),
                                                    "--topology"_arg, path.string())));
}

// Warns if the file has the ending of another format than that of its reader.
void warn_of_ending(const std::filesystem::path& path, const ReaderSpec& reader, std::string_view hint,
                    std::vector<std::string>& warnings) {
  const ReaderSpec* const by_ending = reader_registry().find_by_ending(path);
  if (by_ending != nullptr && by_ending != &reader)
    warnings.push_back(
        fmt::format("{}: its content is that of the format {}, not {} as its ending says; read as {}{}",
                    path.string(), reader.name, by_ending->name, reader.name, hint));
}

FramesOpened open_frames(const std::filesystem::path& path, const ReadOptions& options) {
  const FloatingPointScope to_nearest;
  const ReaderSpec& reader = reader_of(path, options.format);
  if (options.topology) refuse_trajectory_as_topology(path, *options.topology, reader.takes_topology);
  if (!reader.open)
    throw InputError(fmt::format("{0}: {1} files have no frames; give the trajectory ({2}) with {3} {0}",
                                 path.string(), reader.name, reader_registry().trajectory_endings(),
                                 "--topology"_arg));
  FramesOpened opened = reader.open(path, options);
  if (options.topology && !reader.takes_topology)
    opened.warnings.push_back(fmt::format("{}: {} is left unread, this file names its atoms itself",
                                          opened.file, "--topology"_arg));
  if (options.units && reader.name != "lammps")
    opened.warnings.push_back(
        fmt::format("{}: {} is left unread, as only LAMMPS dumps take it", opened.file, "--units"_arg));
  if (!options.format)
    warn_of_ending(path, reader, fmt::format(" ({} overrides)", "--format"_arg), opened.warnings);
  if (options.topology && reader.takes_topology)
    warn_of_ending(*options.topology, reader_of(*options.topology), "", opened.warnings);
  return opened;
}

// Returns the error of a running simulation that gave fewer than two frames.
InputError too_few_frames(const FramesOpened& opened, const std::string& what) {
  return InputError(fmt::format("{}; expected two frames at least",
                                opened.frames->is_cut() ? opened.frames->closing_notes().front()
                                                        : fmt::format("{}: {}", opened.file, what)));
}

void check_finite(const std::string& file, const FrameRead& frame) {
  const auto check = [&](const Eigen::Matrix3Xd& numbers, std::string_view prefix,
                         std::string_view expected) {
    if (numbers.allFinite()) return;
    for (Eigen::Index bead = 0; bead < numbers.cols(); ++bead)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        if (!std::isfinite(numbers(axis, bead)))
          throw InputError(fmt::format("{}: frame {}: bead {} has {}{} = {}, expected a finite {}", file,
                                       frame.stamp.number, bead, prefix, "xyz"[axis], numbers(axis, bead),
                                       expected));
  };
  check(frame.positions, "", "coordinate");
  check(frame.velocities, "v", fmt::format("velocity ({} differences needs none)", "--velocities"_arg));
}

// Returns the elements of `of_beads` that belong to one chain. Returns an empty vector if `of_beads` is
// empty.
template <class T>
std::vector<T> of_chain(const std::vector<T>& of_beads, std::size_t first, std::size_t bead_count) {
  if (of_beads.empty()) return {};
  const auto begin = of_beads.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(bead_count)};
}

// Returns the groups of each bead of a file that does not name atoms.
std::uint8_t groups_without_names(const std::string& file, const std::vector<Selection>& groups) {
  for (const Selection& group : groups)
    if (group.needs_names())
      throw InputError("--groups",
                       fmt::format("{} does not name its atoms; expected a file that does", file));
  return static_cast<std::uint8_t>((1U << groups.size()) - 1);
}

void count_residues(const ChainRead& chain, Trajectory& head) {
  head.residues = chain.residues;
  head.residues_read = chain.residues_read;
}

// Returns a necklace for each chain, without frames yet.
std::vector<Trajectory> heads_of(const FramesOpened& opened) {
  std::vector<Trajectory> heads;
  if (opened.chains.size() < 2) {
    heads.emplace_back().file = opened.file;
    heads.front().element_radii = opened.element_radii;
    heads.front().element_lack = opened.element_lack;
    heads.front().bead_names = opened.bead_names;
    heads.front().bead_groups = opened.bead_groups;
    if (!opened.chains.empty()) count_residues(opened.chains.front(), heads.front());
    return heads;
  }
  std::size_t first = 0;
  for (const ChainRead& chain : opened.chains) {
    Trajectory& head = heads.emplace_back();
    count_residues(chain, head);
    head.file = fmt::format("{} chain {}", opened.file, chain.name.empty() ? "' '" : chain.name);
    head.element_radii = of_chain(opened.element_radii, first, chain.bead_count);
    head.element_lack = opened.element_lack;
    head.bead_names = of_chain(opened.bead_names, first, chain.bead_count);
    head.bead_groups = of_chain(opened.bead_groups, first, chain.bead_count);
    first += chain.bead_count;
  }
  return heads;
}

}  // namespace

namespace {

/// Returns whether consecutive beads look bonded, apart from breaks (ascending). If bonds were spread evenly
/// in their bounding box, each would be within its own length of N others, with N the sum of 4/3 pi length^3
/// over the volume. N is at most 2.4 for the backbones and C-alpha atoms of `data/`, and grows with the
/// number of beads if these are anywhere.
bool look_bonded(const Eigen::Matrix3Xd& beads, const std::vector<std::size_t>& breaks) {
  constexpr double most = 64;
  Eigen::Array3d low = beads.col(0), high = low;
  double cubes = 0, longest = 0;
  for (Eigen::Index b = 0; b + 1 < beads.cols(); ++b) {
    if (std::binary_search(breaks.begin(), breaks.end(), static_cast<std::size_t>(b))) continue;
    const double length = (beads.col(b + 1) - beads.col(b)).stableNorm();
    cubes += length * length * length;
    longest = std::max(longest, length);
    for (const Eigen::Index end : {b, b + 1}) {
      low = low.min(beads.col(end).array());
      high = high.max(beads.col(end).array());
    }
  }
  return !(4.19 * cubes > most * (high - low).max(longest).prod());
}

}  // namespace

NecklaceStream::NecklaceStream(const std::filesystem::path& path, const ReadOptions& options)
    : opened_(open_frames(path, options)),
      time_step_(options.time_step),
      until_damage_(options.until_damage),
      heads_(heads_of(opened_)),
      notes_(heads_.size()) {
  const FloatingPointScope to_nearest;
  FrameRead first;
  if (!opened_.frames->next(first))
    throw opened_.live ? too_few_frames(opened_, "no frame asked for has come")
                       : InputError(fmt::format("{}: the file holds no frame", opened_.file));
  check_finite(opened_.file, first);
  const auto guides = static_cast<Eigen::Index>(opened_.bonds.guides_before.size());
  for (std::size_t n = 0; n < heads_.size(); ++n)
    bead_counts_.push_back(heads_.size() == 1 ? first.positions.cols() - guides
                                              : static_cast<Eigen::Index>(opened_.chains[n].bead_count));
  for (std::size_t n = 0; n < heads_.size(); ++n)
    if (!options.groups.empty() && heads_[n].bead_groups.empty())
      heads_[n].bead_groups.assign(static_cast<std::size_t>(bead_counts_[n]),
                                   groups_without_names(opened_.file, options.groups));
  look_for_molecules(first);
  chain_like_ = opened_.chain_like && !is_fluid_;
  if (options.unwrap) is_fluid_ = are_several_ = false;  // the caller knows better how beads move
  if (are_several_)
    paths_.join_first_frame(std::vector<bool>(static_cast<std::size_t>(first.positions.cols()), true));
  find_pieces();
  unwrap_ = options.unwrap.value_or(is_fluid_ || are_several_ ? Unwrap::beads : Unwrap::chains);
  if (is_fluid_) opened_.chain_like = false;
  if (unwrap_ == Unwrap::chains) place(first);
  if (are_several_) paths_.follow(first.positions, *first.cell);
  drop_guides(first.positions);
  Eigen::Index begin = 0;
  for (std::size_t n = 0; n < heads_.size(); ++n) {
    const Eigen::Matrix3Xd& frame =
        heads_[n].frames.emplace_back(first.positions.middleCols(begin, bead_counts_[n]));
    if (opened_.chain_like) heads_[n].breaks = find_chain_breaks(frame, heads_[n].gaps);
    chain_like_ = chain_like_ && look_bonded(frame, heads_[n].breaks);
    heads_[n].frame_numbers.push_back(first.stamp.number);
    begin += bead_counts_[n];
  }
  rewind();
}

void NecklaceStream::look_for_molecules(const FrameRead& first) {
  if (!first.cell || !opened_.bonds.pieces.empty()) return;
  Eigen::Index begin = 0;
  for (const Eigen::Index count : bead_counts_) {
    const SequenceInCell sequence = sequence_in_cell(first.positions.middleCols(begin, count), *first.cell);
    is_fluid_ = is_fluid_ || sequence == SequenceInCell::fluid;
    are_several_ = are_several_ || sequence == SequenceInCell::several_chains;
    begin += count;
  }
  are_several_ = are_several_ && !is_fluid_ && heads_.size() == 1;
}

void NecklaceStream::place(FrameRead& first) {
  judge_cell(first);
  const std::optional<Images> images = first.cell ? std::optional<Images>(*first.cell) : std::nullopt;
  EarlierNecklaces earlier;
  for (Piece& piece : pieces_) {
    const auto beads = [&](const Eigen::Matrix3Xd& positions) -> Eigen::Matrix3Xd {
      return positions.middleCols(piece.first, piece.bead_count);
    };
    if (piece.placed) {
      Eigen::Matrix3Xd positions = first.positions;
      const bool doubtful = make_whole(piece, positions, images) == WholeChain::Outcome::doubtful;
      const auto beside = doubtful ? std::nullopt : earlier.nearer_image(beads(positions), first.cell);
      piece.whole.restart();
      if (beside) piece.whole.start_shifted(place_beside_earlier(piece, *beside));
    }
    static_cast<void>(make_whole(piece, first.positions, images));
    piece.whole.restart();
    if (piece.placed) earlier.add(beads(first.positions), first.cell);
  }
}

void NecklaceStream::find_pieces() {
  const std::vector<PieceRead>& read = opened_.bonds.pieces;
  const std::vector<std::size_t>& guides = opened_.bonds.guides_before;
  std::size_t next_piece = 0, guide = 0;
  Eigen::Index begin = 0, guide_column = 0;
  for (const Eigen::Index beads : bead_counts_) guide_column += beads;
  for (std::size_t n = 0; n < heads_.size(); ++n) {
    const Eigen::Index end = begin + bead_counts_[n];
    std::vector<std::size_t>& gaps = heads_[n].gaps;
    for (Eigen::Index bead = begin; bead < end; ++bead) {
      const auto number = static_cast<std::size_t>(bead);
      const bool begins_piece = next_piece < read.size() && read[next_piece].first == number;
      const bool behind_guides = guide < guides.size() && guides[guide] == number;
      if (bead > begin && (begins_piece || behind_guides))
        gaps.push_back(static_cast<std::size_t>(bead - begin) - 1);
      if (bead == begin || begins_piece) {
        pieces_.push_back({n, bead, 0, {}});
        pieces_.back().placed = !begins_piece || read[next_piece].polymer;
        ++notes_[n].pieces;
      }
      if (begins_piece) ++next_piece;
      Piece& piece = pieces_.back();
      for (; guide < guides.size() && guides[guide] == number; ++guide) piece.route.push_back(guide_column++);
      piece.route.push_back(bead);
      ++piece.bead_count;
    }
    begin = end;
  }
  for (Piece& piece : pieces_) {
    Notes& notes = notes_[piece.necklace];
    piece.placed = piece.placed || notes.pieces == 1;
    if (!piece.placed) ++notes.pieces_left;
  }
}

Eigen::Vector3d NecklaceStream::place_beside_earlier(const Piece& piece, const ImageBeside& beside) {
  const std::string distances = fmt::format("({:.4g} away, not {:.4g})", beside.distance, beside.present);
  Notes& notes = notes_[piece.necklace];
  std::string name = heads_[piece.necklace].file;
  if (notes.pieces > 1)
    name += fmt::format(": molecule of {}", counted(static_cast<std::size_t>(piece.bead_count), "bead"));
  if (beside.is_much_nearer()) {
    notes.placed.push_back(
        fmt::format("{}: moved to its periodic image nearest to the chains before it {}", name, distances));
    return beside.shift;
  }
  if (beside.distance < (1 - 1e-3) * beside.present)  // otherwise the two are printed alike
    notes.placed.push_back(fmt::format(
        "{}: has a periodic image nearer to the chains before it {}, left where it is", name, distances));
  return Eigen::Vector3d::Zero();
}

WholeChain::Outcome NecklaceStream::make_whole(Piece& piece, Eigen::Matrix3Xd& positions,
                                               const std::optional<Images>& images) {
  if (!images) {
    piece.whole.restart();
    return WholeChain::Outcome::unmoved;
  }
  Eigen::Matrix3Xd along = positions(Eigen::all, piece.route);
  // The bonds of a small molecule are too few to tell whether they become more alike.
  bool joined = false;
  for (Eigen::Index i = 1; i < along.cols() && !piece.placed; ++i) {
    const Eigen::Vector3d step = images->nearest(along.col(i) - along.col(i - 1));
    joined = joined || !step.isZero(0);
    along.col(i) = images->shifted(along.col(i), step);
  }
  const WholeChain::Outcome outcome = piece.whole.make_whole(along, *images);
  positions(Eigen::all, piece.route) = along;
  return joined ? WholeChain::Outcome::joined : outcome;
}

void NecklaceStream::drop_guides(Eigen::Matrix3Xd& numbers) const {
  const auto guides = static_cast<Eigen::Index>(opened_.bonds.guides_before.size());
  if (guides > 0 && numbers.cols() > 0) numbers.conservativeResize(Eigen::NoChange, numbers.cols() - guides);
}

void NecklaceStream::judge_cell(FrameRead& frame) {
  if (!frame.cell || bonds_joined_ || unwrap_ != Unwrap::chains) return;
  std::optional<LongerThanCell> longer;
  // Waters and lipids are always shorter than the cell.
  const auto any_chain = [&](const auto& holds) {
    return std::any_of(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
      return piece.placed && holds(Eigen::Matrix3Xd(frame.positions(Eigen::all, piece.route)));
    });
  };
  const auto is_longer = [&](const Eigen::Matrix3Xd& chain) {
    longer = longer_than_cell(chain, *frame.cell);
    return longer.has_value();
  };
  const auto is_joined = [&](Eigen::Matrix3Xd chain) {
    return WholeChain().make_whole(chain, frame.cell) == WholeChain::Outcome::joined;
  };
  if (cell_unsuited_.empty() && any_chain(is_longer) && !any_chain(is_joined))
    cell_unsuited_ = fmt::format(
        "a chain is {:.4g} long where the cell is {:.4g}, and no bond crosses the walls; is the cell in "
        "another unit?",
        longer->chain, longer->cell);
  if (cell_unsuited_.empty()) return;
  frame.cell.reset();
  frame.cell_doubt = cell_unsuited_;
}

void NecklaceStream::check_bead_count(const FrameRead& frame) const {
  Eigen::Index expected = 0;
  for (const Eigen::Index beads : bead_counts_) expected += beads;
  const auto guides = static_cast<Eigen::Index>(opened_.bonds.guides_before.size());
  if (frame.positions.cols() == expected + guides) return;
  throw InputError(fmt::format("{}: frame {}: {}, expected {} as in frame {}", opened_.file,
                               frame.stamp.number,
                               counted(static_cast<std::size_t>(frame.positions.cols() - guides), "bead"),
                               expected, heads_.front().frame_number(0)));
}

void NecklaceStream::note_cell(const FrameRead& frame) {
  if (!frame.cell_doubt.empty()) {
    if (cells_unused_++ == 0)
      first_doubt_ = fmt::format("{}: frame {}: its periodic cell is not used: {}", opened_.file,
                                 frame.stamp.number, frame.cell_doubt);
  } else if (frame.cell) {
    if (frames_with_cell_++ == 0) first_with_cell_ = frame.stamp.number;
  } else if (frames_without_cell_++ == 0) {
    first_without_cell_ = frame.stamp.number;
  }
}

void NecklaceStream::note_time(const FrameStamp& stamp) {
  if (!stamp.picoseconds || is_live()) return;  // LiveFrames ends before such a time
  if (last_timed_ && *stamp.picoseconds <= *last_timed_->picoseconds && times_disordered_++ == 0)
    first_disordered_ = fmt::format(
        "{}: frame {} has the time {} ps, which is not later than the {} ps of frame {}", opened_.file,
        stamp.number, *stamp.picoseconds, *last_timed_->picoseconds, last_timed_->number);
  last_timed_ = stamp;
}

void NecklaceStream::note_breaks(std::size_t n, const Eigen::Ref<const Eigen::Matrix3Xd>& chain,
                                 std::size_t frame) {
  const std::vector<std::size_t> breaks = find_chain_breaks(chain, heads_[n].gaps);
  const std::vector<std::size_t>& known = heads_[n].breaks;
  if (std::includes(known.begin(), known.end(), breaks.begin(), breaks.end())) return;
  LaterBreaks& later = heads_[n].later_breaks;
  if (later.frames++ > 0) return;
  later.first_frame = frame;
  notes_[n].later_breaks.clear();
  std::set_difference(breaks.begin(), breaks.end(), known.begin(), known.end(),
                      std::back_inserter(notes_[n].later_breaks));
}

void NecklaceStream::follow(FrameRead& frame) {
  struct Moved {
    bool joined = false, shifted = false, doubtful = false;
  };
  std::vector<Moved> moved(heads_.size());
  if (unwrap_ == Unwrap::beads) {
    frame.cell ? paths_.follow(frame.positions, *frame.cell) : paths_.restart();
  }
  const bool in_pieces = unwrap_ == Unwrap::chains;
  const std::optional<Images> images =
      frame.cell && in_pieces ? std::optional<Images>(*frame.cell) : std::nullopt;
  for (Piece& piece : pieces_) {
    const WholeChain::Outcome outcome = make_whole(piece, frame.positions, images);
    if (outcome == WholeChain::Outcome::joined) moved[piece.necklace].joined = bonds_joined_ = true;
    if (outcome == WholeChain::Outcome::shifted) moved[piece.necklace].shifted = true;
    if (outcome == WholeChain::Outcome::doubtful) moved[piece.necklace].doubtful = true;
  }
  drop_guides(frame.positions);
  drop_guides(frame.velocities);
  if (!frame.asked) return;
  Eigen::Index begin = 0;
  for (std::size_t n = 0; n < heads_.size(); ++n) {
    Notes& notes = notes_[n];
    if (moved[n].joined) ++notes.frames_joined;
    if (moved[n].shifted && notes.frames_shifted++ == 0) notes.first_shifted = frame.stamp.number;
    if (moved[n].doubtful && notes.frames_doubtful++ == 0) notes.first_doubtful = frame.stamp.number;
    if (opened_.chain_like && !surveyed_)
      note_breaks(n, frame.positions.middleCols(begin, bead_counts_[n]), frame.stamp.number);
    begin += bead_counts_[n];
  }
  if (images) note_apart(frame);
}

void NecklaceStream::note_apart(const FrameRead& frame) {
  const Images images(*frame.cell);
  std::optional<Eigen::Vector3d> first_centroid;
  std::vector<bool> is_apart(heads_.size(), false);
  for (Piece& piece : pieces_) {
    if (!piece.placed) continue;
    const Eigen::Vector3d centroid =
        frame.positions.middleCols(piece.first, piece.bead_count).rowwise().mean();
    if (!first_centroid) first_centroid = centroid;
    const Eigen::Vector3d apart = images.nearest(centroid - *first_centroid);
    if (!piece.apart_at_first) piece.apart_at_first = apart;
    if (apart != *piece.apart_at_first) is_apart[piece.necklace] = true;
  }
  for (std::size_t n = 0; n < heads_.size(); ++n)
    if (is_apart[n] && notes_[n].frames_apart++ == 0) notes_[n].first_apart = frame.stamp.number;
}

bool NecklaceStream::next(FrameRead& frame) {
  const FloatingPointScope to_nearest;
  if (ended_) return false;
  const auto holds_two = [&] { return last_read_ && *last_read_ != heads_.front().frame_number(0); };
  try {
    if (read(frame)) return true;
  } catch (const InputError& error) {
    close();
    if (is_live() ? !holds_two() : !until_damage_ || !last_read_) throw;
    damage_ = fmt::format("{}; frames up to {} are read", error.what(), *last_read_);
    if (!is_live()) damage_ += fmt::format(" ({})", "--until-damage"_arg);
  }
  ended_ = true;
  if (!is_live() || holds_two()) return false;
  throw too_few_frames(opened_,
                       fmt::format("the frames have ended after frame {}", heads_.front().frame_number(0)));
}

bool NecklaceStream::read(FrameRead& frame) {
  for (;;) {
    frame.cell_doubt.clear();
    frame.note.clear();
    frame.velocities.resize(3, 0);
    frame.asked = true;
    if (!opened_.frames->next(frame)) {
      surveyed_ = true;
      return false;
    }
    if (!frame.asked && !frame.cell) {
      for (Piece& piece : pieces_) piece.whole.restart();
      paths_.restart();
      continue;
    }
    check_finite(opened_.file, frame);
    check_bead_count(frame);
    judge_cell(frame);
    if (frame.cell && last_cell_) frame.cell = continued(*frame.cell, *last_cell_);
    last_cell_ = frame.cell;
    follow(frame);
    if (frame.asked) break;
  }
  if (time_step_) {
    if (frame.stamp.picoseconds) has_times_ = true;
    frame.stamp.picoseconds = static_cast<double>(frame.stamp.number) * *time_step_;
  }
  note_time(frame.stamp);
  last_read_ = frame.stamp.number;
  note_cell(frame);
  if (!frame.note.empty() && frames_noted_++ == 0)
    first_note_ = fmt::format("{}: frame {}: {}", opened_.file, frame.stamp.number, frame.note);
  return true;
}

void NecklaceStream::rewind() {
  opened_.frames->rewind();
  paths_.restart();
  last_cell_.reset();
  for (Piece& piece : pieces_) {
    piece.whole.restart();
    piece.apart_at_first.reset();
  }
  for (Notes& notes : notes_)
    notes.frames_joined = notes.frames_shifted = notes.frames_doubtful = notes.frames_apart = 0;
  if (!surveyed_)
    for (Trajectory& head : heads_) head.later_breaks = {};
  bonds_joined_ = false;
  ended_ = false;
  last_read_.reset();
  last_timed_.reset();
  times_disordered_ = 0;
  cell_unsuited_.clear();
  cells_unused_ = frames_noted_ = frames_with_cell_ = frames_without_cell_ = 0;
}

std::vector<std::string> NecklaceStream::warnings(std::size_t necklace) const {
  // Report warnings about the whole file with the first necklace.
  std::vector<std::string> lines;
  if (necklace == 0) {
    lines = opened_.warnings;
    if (!damage_.empty()) lines.push_back(damage_);
    const std::vector<std::string> closing = opened_.frames->closing_notes();
    lines.insert(lines.end(), closing.begin(), closing.end());
    if (has_times_)
      lines.push_back(fmt::format("{}: has times of its own, which {} {} replaces", opened_.file, "--dt"_arg,
                                  *time_step_));
    if (times_disordered_ > 0)
      lines.push_back(fmt::format("{} ({}; {} PS replaces times)", first_disordered_,
                                  counted(times_disordered_, "frame"), "--dt"_arg));
    if (cells_unused_ > 0)
      lines.push_back(fmt::format("{} ({})", first_doubt_, counted(cells_unused_, "frame")));
    if (frames_with_cell_ > 0 && frames_without_cell_ > 0)
      lines.push_back(fmt::format(
          "{}: frame {} has a periodic cell, frame {} has none and stays as it is ({} with and {} "
          "without a cell)",
          opened_.file, first_with_cell_, first_without_cell_, counted(frames_with_cell_, "frame"),
          frames_without_cell_));
    if (frames_noted_ > 0)
      lines.push_back(fmt::format("{} ({})", first_note_, counted(frames_noted_, "frame")));
  }
  const Trajectory& head = heads_[necklace];
  const Notes& notes = notes_[necklace];
  const bool in_pieces = notes.pieces > 1;
  lines.insert(lines.end(), notes.placed.begin(), notes.placed.end());
  if (is_fluid_ && necklace == 0)
    lines.push_back(
        fmt::format("{}: names no molecules, and consecutive beads are as far apart as in a fluid, so each "
                    "bead moves alone to "
                    "its nearest image ({} chains follows bonds)",
                    head.file, "--unwrap"_arg));
  if (are_several_ && necklace == 0)
    lines.push_back(fmt::format(
        "{}: names no molecules, and some consecutive beads are too far apart to tell which of their images "
        "are "
        "bonded, so beads are joined in the first frame and each moves alone from there to its nearest image "
        "({} chains joins all beads to one chain in each frame)",
        head.file, "--unwrap"_arg));
  if (notes.pieces_left > 0 && frames_with_cell_ > 0 && unwrap_ == Unwrap::chains)
    lines.push_back(fmt::format(
        "{}: {} molecules are not bonded to the beads before them (waters, ions, lipids, residues of "
        "no known polymer); each starts in the periodic image that the file gives",
        head.file, notes.pieces_left));
  if (notes.frames_joined > 0)
    lines.push_back(fmt::format("{}: made whole across the periodic cell in {}", head.file,
                                counted(notes.frames_joined, "frame")));
  if (notes.frames_shifted > 0)
    lines.push_back(fmt::format(
        "{}: frame {}: {} to {} nearest to the frame before, no bond crosses the walls ({})", head.file,
        notes.first_shifted, in_pieces ? "molecules moved" : "moved as a whole",
        in_pieces ? "their periodic images" : "its periodic image", counted(notes.frames_shifted, "frame")));
  if (notes.frames_doubtful > 0)
    lines.push_back(fmt::format(
        "{}: frame {}: {}not made whole, because across the periodic cell bonds would be shorter but "
        "not more alike; is the cell right? ({})",
        head.file, notes.first_doubtful, in_pieces ? "a molecule is " : "",
        counted(notes.frames_doubtful, "frame")));
  const auto placed = std::find_if(pieces_.begin(), pieces_.end(), [](const Piece& p) { return p.placed; });
  const std::string reference = placed == pieces_.end() ? "" : heads_[placed->necklace].file;
  if (notes.frames_apart > 0)
    lines.push_back(fmt::format(
        "{}: frame {}: has drifted into another periodic image, nearer to {} by its centroid ({})", head.file,
        notes.first_apart, reference, counted(notes.frames_apart, "frame")));
  if (!head.breaks.empty()) lines.push_back(describe_chain_breaks(head.file, head.breaks));
  if (head.later_breaks.frames > 0)
    lines.push_back(fmt::format(
        "{}, not in frame {} ({})",
        describe_chain_breaks(fmt::format("{}: frame {}", head.file, head.later_breaks.first_frame),
                              notes.later_breaks),
        head.frame_number(0), counted(head.later_breaks.frames, "frame")));
  return lines;
}

}  // namespace kds
