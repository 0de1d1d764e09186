#include "experiments/load_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "motions/input_error.h"
#include "motions/radii.h"

namespace kds {

namespace {

Scene load_instance(const RunOptions& options) {
  const std::string file = options.inputs.front().string();
  const auto refuse = [&](bool given, const char* option) {
    if (given) throw InputError(fmt::format("{}: has no meaning for an instance file ({})", option, file));
  };
  const ReadOptions& reading = options.reading;
  refuse(reading.topology.has_value(), "--topology");
  refuse(reading.chain.has_value(), "--chain");
  refuse(reading.selection != Selection::automatic, "--select");
  refuse(reading.frames.first != 0 || reading.frames.last || reading.frames.stride != 1, "--frames");
  refuse(options.radius != "auto", "--radius");
  refuse(options.motion != FrameMotion::linear, "--motion");
  return Scene(read_instance(options.inputs.front()));
}

}  // namespace

Scene load_scene(const RunOptions& options, const std::function<void(const std::string&)>& warn) {
  const auto instance = std::find_if(options.inputs.begin(), options.inputs.end(),
                                     [](const auto& path) { return is_instance_file(path); });
  if (instance != options.inputs.end()) {
    if (options.inputs.size() > 1)
      throw InputError(instance->string() + ": an instance file runs alone, without further inputs");
    return load_instance(options);
  }
  std::vector<Trajectory> necklaces;
  for (const auto& input : options.inputs) {
    necklaces.push_back(read_trajectory(input, options.reading));
    for (const std::string& warning : necklaces.back().warnings) warn(warning);
  }
  std::vector<double> radii = bead_radii(options.radius, necklaces);
  return Scene(necklaces, std::move(radii), options.motion);
}

std::vector<std::string> structures_to_run(const RunOptions& options, const Scene& scene) {
  if (!options.structures.empty()) return options.structures;
  const bool instance = is_instance_file(options.inputs.front());
  if (!instance) return {"wrapped", "power"};
  return {scene.dimension() == 1 ? "sorted" : "power"};
}

}  // namespace kds
