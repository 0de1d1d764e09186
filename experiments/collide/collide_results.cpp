#include "experiments/collide/collide_results.h"

#include <array>

#include "experiments/output/output_files.h"
#include "experiments/output/page/result_page.h"
#include "experiments/output/staged.h"
#include "experiments/program/table_results.h"

namespace kds {

namespace {

constexpr std::string_view kCommand = "collide";
constexpr std::array<std::string_view, 3> kFurtherFiles{"pairs.csv", "frames.csv", "report.html"};

}  // namespace

void check_collide_destinations(const Destinations& destinations, TakenPaths taken) {
  if (destinations.out) {
    taken.write_into("--out", *destinations.out, {kFurtherFiles[0], kFurtherFiles[1], kFurtherFiles[2]});
  }
  check_table_destinations(destinations, "collide", taken);
  if (!destinations.out) return;
  check_directory(*destinations.out, kCommand, "--out",
                  {kFurtherFiles[0], kFurtherFiles[1], kFurtherFiles[2]});
  check_page(*destinations.out, kCommand);
}

void CollideResults::begin(const CollideFrames& scene) {
  if (!destinations_.out) return;
  files_.emplace(*destinations_.out, kCommand, "--out");
  pairs_.emplace(files_->open("pairs.csv"), scene);
  contacts_.emplace(scene.radii().size());
}

void CollideResults::add_frame(const FrameRead& frame, std::span<const BeadPair> pairs) {
  if (!files_) return;
  pairs_->add(frame, pairs);
  contacts_->add_frame(pairs);
  files_->check();
}

void CollideResults::deliver(const CollideReport& report, const std::string& json, const std::string& input,
                             Page page) {
  const bool json_on_stdout = destinations_.json == "-";
  const bool table_on_stdout = !destinations_.quiet && !json_on_stdout;
  if (files_) {
    files_->write("collide.json", json);
    files_->write("collide.csv", collide_csv(report));
    files_->write("frames.csv", collide_frames_csv(report));
    page.data = {"collide.json", "collide.csv", "pairs.csv", "frames.csv"};
    files_->write("report.html",
                  collide_page(report, input, contacts_->empty() ? "" : contacts_->plot(), page));
  }
  std::optional<AtomicFile> json_file;
  if (destinations_.json && !json_on_stdout) json_file.emplace(*destinations_.json, json);
  commit_together(std::array<Staged*, 2>{files_ ? &*files_ : nullptr, json_file ? &*json_file : nullptr});
  if (json_on_stdout) print_to_stdout(json);
  if (table_on_stdout) print_to_stdout(collide_table(report));
  if (files_ && table_on_stdout)
    print_to_stdout("report " + (*destinations_.out / "report.html").string() + "\n");
}

}  // namespace kds
