#pragma once
// The results of `kds collide`: collide.json, collide.csv, pairs.csv, frames.csv and report.html in --out,
// --json, standard output.

#include <functional>
#include <optional>
#include <ostream>
#include <string>

#include "experiments/collide/collide_report.h"
#include "experiments/collide/contact_map.h"
#include "experiments/collide/pairs_csv.h"
#include "experiments/output/destinations.h"
#include "experiments/output/staged_files.h"

namespace kds {

class CollideResults {
 public:
  explicit CollideResults(Destinations destinations) : destinations_(std::move(destinations)) {}

  /// The input is accepted: from now on there are files in the making. `scene` must outlive this.
  void begin(const CollideFrames& scene);
  void add_frame(const FrameRead& frame, const FrameFound& found,
                 std::optional<std::span<const BeadPair>> pairs);
  /// The files of --out appear together, in place of those of an earlier result.
  /// `json` lacks the frames.
  void deliver(const CollideReport& report, const Json& json, const std::string& input, Page page);

 private:
  Destinations destinations_;
  std::optional<StagedFiles> files_;
  std::optional<PairsCsv> pairs_;
  std::ostream* frames_csv_ = nullptr;
  std::optional<JsonItems> frames_;  // none where no JSON is asked for
  std::optional<ClosestCourse> course_;
  std::optional<ContactMap> contacts_;
};

}  // namespace kds
