#pragma once
// What `kds collide` found, for programs and for people.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/collide/compare_detectors.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"

namespace kds {

[[nodiscard]] Json collide_rows_json(const CollideReport& report);
/// Returns the findings of one frame that all methods agree on.
[[nodiscard]] Json collide_frame_json(const FrameFound& frame);
/// A header and one line a row.
[[nodiscard]] std::string collide_csv(const CollideReport& report);
/// The header of frames.csv, and a line of it.
inline constexpr std::string_view collide_frames_header = "frame,collide,pairs,i,j,distance\n";
[[nodiscard]] std::string collide_frame_csv(const FrameFound& frame);
[[nodiscard]] std::string collide_table(const CollideReport& report);

/// The closest distance in the course of the frames. Consecutive frames share a bin if there are many, and
/// the bin keeps their least distance.
class ClosestCourse {
 public:
  explicit ClosestCourse(std::size_t frames);
  void add(const FrameFound& frame);
  /// Returns a figure for a page; empty if fewer than two bins have a closest pair.
  [[nodiscard]] std::string figure() const;

 private:
  std::size_t frames_, width_, added_ = 0;
  std::vector<std::pair<double, double>> points_;  // number of a frame and distance
  std::size_t bin_of_last_ = 0;
};

/// `map`: of contacts, empty where there are none; `page` says how it was made.
[[nodiscard]] std::string collide_page(const CollideReport& report, const std::string& input,
                                       const std::string& map, const ClosestCourse& course, Page page);

}  // namespace kds
