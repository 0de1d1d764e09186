#pragma once
// Reports the results of `kds collide` and writes them: collide.json, collide.csv, pairs.csv, frames.csv and
// report.html in --out, and the destinations --json and standard output.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiments/collide/compare_detectors.h"
#include "experiments/output/output_files.h"
#include "experiments/output/table.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// Returns the columns of collide.csv, of the rows of collide.json and of the terminal. JSON and
/// CSV have the time of the closest pair if the input is `timed`.
[[nodiscard]] Table<CollideRow> collide_columns(bool timed);
/// Returns the columns of frames.csv and of the frames in collide.json. The CSV has a column of times if the
/// input is `timed`.
[[nodiscard]] Table<FrameFound> collide_frame_columns(bool timed);
[[nodiscard]] std::string collide_table(const CollideReport& report);

/// Collisions over the course of the frames. If there are many frames, consecutive frames share a bin.
class CollisionCourse {
 public:
  explicit CollisionCourse(std::size_t frames);
  void add(const FrameFound& frame);
  /// Returns a row for each bin: the stamp of its first frame, the greatest number of pairs in one of its
  /// frames, and the closest pair of all of them.
  [[nodiscard]] const std::vector<FrameFound>& bins() const { return bins_; }

 private:
  std::size_t width_, added_ = 0;
  std::vector<FrameFound> bins_;
};

/// Counts how often each pair of beads collides, as a contact map shows it. If there are many beads, counts
/// pairs of groups of consecutive beads. Memory does not grow with frames or pairs.
class ContactMap {
 public:
  explicit ContactMap(std::size_t beads);

  void add_frame(std::span<const BeadPair> pairs);
  /// Returns {beads_in_group, groups: [{i, j, pairs}]} with the groups i <= j that have pairs, and their
  /// number over all frames.
  [[nodiscard]] Json json() const;

 private:
  static constexpr std::size_t most_groups = 240;
  std::size_t in_group_, groups_;
  std::vector<std::uint64_t> counts_;  // for the groups i <= j, at index i * groups_ + j
};

/// Writes the colliding pairs of each frame for other programs, frame by frame during the run.
/// The header is `frame,i,j,distance,name_i,name_j`, and `picoseconds` if the input has times. One line per
/// pair follows. `frame` is the frame's number in the file, and `picoseconds` its time. `i` and `j` are the
/// beads' numbers in the scene. `name_i` and `name_j` are the names in the file, in quotes, or empty if it
/// has none. `distance` is the rounded distance between the surfaces, printed so that it reads back exactly.
/// It is negative if the balls overlap.
class PairsCsv {
 public:
  /// Writes the header. Stream and scene must outlive this object.
  PairsCsv(std::ostream& stream, const CollideFrames& scene);
  void add(const FrameRead& frame, std::span<const BeadPair> pairs);

 private:
  std::ostream& stream_;
  const CollideFrames& scene_;
};

class CollideResults {
 public:
  CollideResults(Destinations destinations, std::unique_ptr<AtomicFiles> files)
      : destinations_(std::move(destinations)), files_(std::move(files)) {}

  /// Starts the output files once the input is accepted. `scene` must outlive this object.
  void begin(const CollideFrames& scene);
  void add_frame(const FrameRead& frame, const FrameFound& found, std::span<const BeadPair> pairs);
  /// Delivers all results. The files in --out appear together.
  /// `json` contains neither the frames nor the members `course`, `map` and `names`.
  void deliver(const CollideReport& report, Json json);

 private:
  /// Returns the names of the beads in closest pairs of rows and course, by their number.
  [[nodiscard]] Json names_json(const CollideReport& report) const;

  Destinations destinations_;
  std::unique_ptr<AtomicFiles> files_;
  std::optional<PairsCsv> pairs_;
  std::ostream* frames_csv_ = nullptr;
  Table<FrameFound> frame_columns_{{}};
  std::optional<JsonItems> frames_;  // empty if no JSON is requested, as are the next three
  const CollideFrames* scene_ = nullptr;
  std::optional<CollisionCourse> course_;
  std::optional<ContactMap> contacts_;
};

}  // namespace kds
