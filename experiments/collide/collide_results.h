#pragma once
// Writes the results of `kds collide`: collide.json, collide.csv, pairs.csv, frames.csv and report.html in
// --out, and the destinations --json and standard output.

#include <functional>
#include <optional>
#include <ostream>
#include <string>

#include "experiments/collide/collide_report.h"
#include "experiments/collide/contact_map.h"
#include "experiments/collide/pairs_csv.h"
#include "experiments/output/output_files.h"

namespace kds {

class CollideResults {
 public:
  explicit CollideResults(Destinations destinations) : destinations_(std::move(destinations)) {}

  /// Starts the output files once the input is accepted. `scene` must outlive this object.
  void begin(const CollideFrames& scene);
  void add_frame(const FrameRead& frame, const FrameFound& found,
                 std::optional<std::span<const BeadPair>> pairs);
  /// Delivers all results. The files in --out appear together and replace the files of an earlier result.
  /// `json` does not contain the frames.
  void deliver(const CollideReport& report, const Json& json, const std::string& input, Page page);

 private:
  Destinations destinations_;
  std::optional<AtomicFiles> files_;
  std::optional<PairsCsv> pairs_;
  std::ostream* frames_csv_ = nullptr;
  std::optional<JsonItems> frames_;  // empty if no JSON is requested
  std::optional<ClosestCourse> course_;
  std::optional<ContactMap> contacts_;
};

}  // namespace kds
