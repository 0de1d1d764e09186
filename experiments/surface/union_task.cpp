#include "experiments/surface/union_task.h"

#include <fmt/format.h>

#include <span>
#include <utility>

#include "experiments/program/option.h"
#include "experiments/run/load_scene.h"
#include "motions/base/input_error.h"

namespace kds {

const OptionList<UnionTask>& union_options() {
  using O = UnionTask;
  static const auto list =
      OptionList<O>()
          .with(input_options().with({obstacle_option(), velocities_option()}))
          .with({real_option(
                     {"--probe", "LENGTH",
                      fmt::format(
                          "radius of a probe, which is added to the radii of the beads (default: 1.4 with {} "
                          "element, otherwise 0)",
                          "--radius"_arg)},
                     &O::probe, {0, 1e100}),
                 // Lifted motion is excluded because it has no radii between frames.
                 choice_option({"--motion", "NAME",
                                "motion of beads between frames: linear or hermite (default: linear)"},
                               &O::motion, std::span(frame_motion_names).first(2))});
  return list;
}

std::string in_unit(const std::string& quantity, const std::string& unit, int power) {
  return unit.empty() ? quantity : fmt::format("{} ({}^{})", quantity, unit, power);
}

Scene load_union(const UnionTask& task, std::string_view command,
                 const std::function<void(const std::string&)>& warn, bool* lone_frame) {
  InputOptions of_files = task;  // without the defaults that an instance file refuses
  of_files.radius = InputOptions().radius;
  of_files.reading.selection = InputOptions().reading.selection;
  refuse_instance(of_files, "points and one step");
  Scene scene = load_necklaces(task, task.motion, 1, warn, {}, lone_frame);
  scene.set_probe(task.probe_length());
  if (scene.dimension() != 3)
    throw InputError(
        fmt::format("{}: all beads stay in one plane; {} expects balls in space", file_names(task), command));
  if (scene.is_periodic()) warn_of_images(std::string(command), warn);
  return scene;
}

}  // namespace kds
