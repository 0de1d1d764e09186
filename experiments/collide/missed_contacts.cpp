#include "experiments/collide/missed_contacts.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/run/load_scene.h"
#include "experiments/run/radius_hint.h"
#include "experiments/run/run_scene.h"
#include "motions/base/input_error.h"
#include "structures/contacts/sampled_contacts.h"

namespace kds {

namespace {

std::size_t frames_looked_at(std::size_t frames, std::size_t stride) { return (frames - 1) / stride + 1; }

std::vector<std::size_t> strides_for(const MissedTask& task, std::size_t frames) {
  const auto too_long = [&](std::size_t stride) { return frames_looked_at(frames, stride) < 2; };
  if (!task.strides.empty()) {
    if (too_long(task.strides.back()))
      throw InputError(fmt::format("--strides: {} looks at one of the {} frames of {}; expected two or more",
                                   task.strides.back(), frames, task.inputs.front().string()));
    return task.strides;
  }
  std::vector<std::size_t> strides;
  for (std::size_t stride = 1; stride <= 64 && !too_long(stride); stride *= 2) strides.push_back(stride);
  return strides;
}

MissedInput input_of(const Scene& scene) {
  const auto [least, most] = std::minmax_element(scene.radii().begin(), scene.radii().end());
  return {
      scene.bead_count(), scene.necklaces().size(), scene.frame_count(), scene.dimension(), *least, *most};
}

std::vector<SampledContacts::Sampling> samplings_of(const MissedTask& task, const Scene& scene,
                                                    std::span<const std::size_t> strides,
                                                    const std::function<void(std::size_t)>& at_frame) {
  RunOptions options;
  options.inputs = task.inputs;
  options.structures = {"contacts"};
  options.motion = task.motion;
  options.apart = task.apart;
  const auto run = open_run(options, scene, AuditMode::none);
  SampledContacts sampled(strides);
  run->listen(sampled);
  run_steps(*run, options, [&](std::size_t frame) {
    if (frame == 0) {
      std::vector<BeadPair> at_start;
      for (const Event& event : run->session().built(0)) at_start.push_back({event.ids()[0], event.ids()[1]});
      sampled.add_built(at_start);
    }
    at_frame(frame);
  });
  sampled.finish(scene.step_count());
  return sampled.samplings();
}

}  // namespace

MissedReport count_missed(const MissedTask& task, const std::function<void(const std::string&)>& warn,
                          const std::function<void(std::size_t, std::size_t)>& progress) {
  MissedReport report;
  report.input = input_of(load_necklaces(task, task.motion, 1, warn));
  const std::vector<std::size_t> strides = strides_for(task, report.input.frames);
  for (std::size_t run = 0; run < task.factors.size(); ++run) {
    const double factor = task.factors[run];
    const Scene scene = load_necklaces(task, task.motion, factor, [](const std::string&) {});
    const auto samplings = samplings_of(task, scene, strides, [&](std::size_t frame) {
      progress(run * scene.step_count() + frame, task.factors.size() * scene.step_count());
    });
    for (const SampledContacts::Sampling& sampling : samplings)
      report.rows.push_back({factor, sampling.stride, frames_looked_at(scene.frame_count(), sampling.stride),
                             sampling.contacts, sampling.found});
    const bool none = std::ranges::all_of(report.rows, [](const auto& row) { return row.contacts == 0; });
    if (none && run + 1 == task.factors.size() && task.radius == "auto")
      if (const auto hint = factor_hint(scene, factor, task.apart)) warn(*hint);
  }
  return report;
}

}  // namespace kds
