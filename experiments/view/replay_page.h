#pragma once
// Writes a replay: one HTML page that shows a recorded run in a browser, without a network. The page holds
// its own script and the data of the run in compressed blocks (docs/formats.md).
//
// Frames are written block by block, so memory does not grow with their number.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/view/replay_blocks.h"
#include "motions/scene/scene.h"
#include "structures/session/replay_recorder.h"

namespace kds {

/// Title, inputs and command of a run, as the page shows them.
struct ReplayLabels {
  std::string title = "kds run";
  std::string command = {};              ///< the command line that made the page; may be empty
  std::vector<std::string> inputs = {};  ///< names of the input files
  bool in_angstrom = true;               ///< lengths are in angstrom; otherwise they have no unit
  std::size_t stride = 1;                ///< the run takes every stride-th of the frames asked for
  bool lone_frame = false;               ///< the second frame of the run repeats the first and is not shown
};

struct ReplayPageOptions {
  ReplayLabels labels = {};
  /// The step of the grid to which positions are rounded. No value: 0.02 angstrom; for lengths without a unit
  /// a hundredth of the least radius or, for points, 2^-16 of the extent of the first frame.
  std::optional<double> quantum = {};
  std::optional<std::uint64_t> most_bytes = {};  ///< no value: the page may have any size
};

/// Thrown if a page would exceed `most_bytes`. `expected` estimates the number of bytes of the page.
class ReplayTooLarge : public std::runtime_error {
 public:
  explicit ReplayTooLarge(std::uint64_t expected_bytes)
      : std::runtime_error("the replay exceeds its size"), expected(expected_bytes) {}
  std::uint64_t expected;
};

class ReplayPage {
 public:
  /// Begins a page. The stream and the scene must outlive it.
  ReplayPage(std::ostream& stream, const Scene& scene, ReplayPageOptions options);

  /// Reads all frames of the scene, from the first one on, and writes them. Throws InputError if coordinates
  /// are too large for the quantum. Throws ReplayTooLarge.
  void write_frames();
  /// Writes the record and ends the page. `write_frames` must have been called. Throws ReplayTooLarge.
  void write_record(const ReplayRecorder& recorder);

  /// Returns the number of bytes written.
  [[nodiscard]] std::uint64_t bytes() const { return written_; }

 private:
  void choose_quantum(const Eigen::Matrix3Xd& first);
  /// Returns the largest difference of a bead's coordinate from the corner of the first frame.
  [[nodiscard]] double farthest() const;
  [[nodiscard]] std::size_t frame_count() const {
    return options_.labels.lone_frame ? 1 : scene_.frame_count();
  }
  [[nodiscard]] std::int32_t rounded(double value, int axis, BeadId bead, std::size_t frame) const;
  [[nodiscard]] FrameBlocks::Numbers numbers_of(const Eigen::Matrix3Xd& points, std::size_t frame) const;
  void write_beads();
  [[nodiscard]] Json write_structure(std::size_t index, const ReplayRecorder::Structure& structure);
  void write_spheres(std::size_t index, const ReplayRecorder::Structure& structure);
  void put(std::string_view text);
  void put_block(const std::string& name, std::string_view bytes);
  void require_size(std::uint64_t expected) const;

  std::ostream& stream_;
  const Scene& scene_;
  ReplayPageOptions options_;
  std::string_view rest_of_page_;  // the text after the data
  std::string page_;
  std::uint64_t written_ = 0;
  double quantum_ = 0;
  std::string quantum_note_;
  std::array<double, 3> origin_{}, low_{}, high_{};
  std::size_t block_frames_ = 1;
  bool has_times_ = false;
  Json blocks_ = Json::object();
};

/// Writes the replay of a run that has ended, from the scene's frames and the record.
void write_replay_page(std::ostream& stream, const Scene& scene, const ReplayRecorder& recorder,
                       const ReplayPageOptions& options = {});
/// Same, to a file that appears whole or not at all.
void write_replay_page(const std::filesystem::path& file, const Scene& scene, const ReplayRecorder& recorder,
                       const ReplayPageOptions& options = {});

}  // namespace kds
