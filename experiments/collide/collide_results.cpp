#include "experiments/collide/collide_results.h"


#include "experiments/output/output_files.h"

namespace kds {

namespace {

constexpr std::string_view kCommand = "collide";

}  // namespace

void CollideResults::begin(const CollideFrames& scene) {
  if (destinations_.out || destinations_.json) frames_.emplace();
  if (!destinations_.out) return;
  files_.emplace(*destinations_.out, kCommand, "--out");
  pairs_.emplace(files_->open("pairs.csv"), scene);
  frames_csv_ = &files_->open("frames.csv");
  *frames_csv_ << collide_frame_columns().csv_header();
  course_.emplace(scene.frame_count());
  contacts_.emplace(scene.radii().size());
}

void CollideResults::add_frame(const FrameRead& frame, const FrameFound& found,
                               std::optional<std::span<const BeadPair>> pairs) {
  if (frames_) frames_->add(collide_frame_columns().json(found));
  if (!files_) return;
  *frames_csv_ << collide_frame_columns().csv_line(found);
  course_->add(found);
  if (pairs) pairs_->add(frame, *pairs);
  if (pairs) contacts_->add_frame(*pairs);
  files_->check();
}

void CollideResults::deliver(const CollideReport& report, const Json& json, const std::string& input,
                             Page page) {
  const auto write_to = [&](std::ostream& stream) {
    frames_->write_within(json, "frames", [&stream](std::string_view text) { stream << text; });
  };
  const bool json_on_stdout = destinations_.json == "-";
  const bool table_on_stdout = !destinations_.quiet && !json_on_stdout;
  if (files_) {
    write_to(files_->open("collide.json"));
    files_->write("collide.csv", collide_columns().csv(report.rows));
    page.data = {"collide.json", "collide.csv", "pairs.csv", "frames.csv"};
    files_->write("report.html",
                  collide_page(report, input, contacts_->empty() ? "" : contacts_->plot(), *course_, page));
  }
  AtomicFiles json_file;
  if (destinations_.json && !json_on_stdout) write_to(json_file.open(*destinations_.json));
  commit_together({files_ ? &*files_ : nullptr, &json_file});
  if (json_on_stdout)
    frames_->write_within(json, "frames", [](std::string_view text) { print_to_stdout(std::string(text)); });
  if (table_on_stdout) print_to_stdout(collide_table(report));
  if (files_ && table_on_stdout)
    print_to_stdout("report " + (*destinations_.out / "report.html").string() + "\n");
}

}  // namespace kds
