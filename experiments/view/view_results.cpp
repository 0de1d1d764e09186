#include "experiments/view/view_results.h"

#include <fmt/format.h>

#include <string>

#include "motions/base/input_error.h"

namespace kds {

ViewResults::ViewResults(const ViewRequest& request, const ReplayLabels& labels, const Scene& scene,
                         KineticRun& run)
    : request_(request), scene_(scene), run_(run), recorder_(run) {
  if (request_.script) find_script_frame(labels.stride);
  if (request_.page) {
    AtomicFiles& files = request_.page_files != nullptr ? *request_.page_files : files_;
    page_.emplace(files.open(*request_.page), scene,
                  ReplayPageOptions{labels, request_.quantum, request_.most_bytes});
    page_->write_frames();
    files.check();
  }
  if (request_.vtk) vtk_.emplace(*request_.vtk, request_.replace);
  run.simulator().listen(recorder_);
}

void ViewResults::find_script_frame(std::size_t stride) {
  check_script_ending(*request_.script);
  if (!request_.at) return;
  const auto distance = [&](std::size_t number) {
    return number > *request_.at ? number - *request_.at : *request_.at - number;
  };
  std::size_t nearest = scene_.frame_number(0);
  for (std::size_t frame = 0; frame < scene_.frame_count(); ++frame) {
    const std::size_t number = scene_.frame_number(frame);
    if (distance(number) >= distance(nearest) && frame > 0) continue;
    nearest = number;
    script_frame_ = frame;
  }
  if (nearest == *request_.at) return;
  const std::string taken = stride > 1 ? fmt::format("takes one frame in {} (--max-mb) and ", stride) : "";
  throw InputError(fmt::format("--at {}: the run {}has no such frame; the nearest is --at {}", *request_.at,
                               taken, nearest));
}

void ViewResults::add_frame(std::size_t frame) {
  frame == 0 ? recorder_.begin() : recorder_.reach_frame();
  const bool in_script = request_.script && frame == script_frame_;
  if (!vtk_ && !in_script) return;
  const ShownFrame shown = shown_frame(frame, scene_, run_, recorder_);
  if (vtk_) vtk_->add(shown);
  if (in_script) files_.write(*request_.script, scene_script(*request_.script, shown));
}

void ViewResults::finish() {
  if (page_) page_->write_record(recorder_);
  if (vtk_) vtk_->finish();
  files_.check();
}

}  // namespace kds
