#pragma once
// Reports the results of `kds collide`.

#include <string>
#include <utility>
#include <vector>

#include "experiments/collide/compare_detectors.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/page/table.h"

namespace kds {

/// Returns the columns of collide.csv, of the rows of collide.json, of the terminal and of the page.
[[nodiscard]] Table<CollideRow> collide_columns();
/// Returns the columns of frames.csv and of the frames in collide.json.
[[nodiscard]] const Table<FrameFound>& collide_frame_columns();
[[nodiscard]] std::string collide_table(const CollideReport& report);

/// The closest distance over the course of the frames. If there are many frames, consecutive frames share a
/// bin, and the bin keeps their least distance.
class ClosestCourse {
 public:
  explicit ClosestCourse(std::size_t frames);
  void add(const FrameFound& frame);
  /// Returns a figure for a page. Returns an empty text if fewer than two bins have a closest pair.
  [[nodiscard]] std::string figure() const;

 private:
  std::size_t frames_, width_, added_ = 0;
  std::vector<std::pair<double, double>> points_;  // frame number and distance
  std::size_t bin_of_last_ = 0;
};

/// `map` is the plot of the contacts, or empty. `page` already says how the results were made.
[[nodiscard]] std::string collide_page(const CollideReport& report, const std::string& input,
                                       const std::string& map, const ClosestCourse& course, Page page);

}  // namespace kds
