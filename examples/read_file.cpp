// Reads frames of a trajectory, makes a scene of the frames, and runs structures over the scene. FILE is PDB,
// mmCIF or XYZ.
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/radii.h"
#include "structures/session/kinetic_run.h"

namespace {

void run_file(const char* file) {
  kds::ReadOptions options;
  options.selection = kds::Selection::ca;
  options.frames = {.first = 0, .last = 4};
  const kds::Trajectory necklace = kds::read_trajectory(file, options);
  for (const std::string& warning : necklace.warnings) std::fprintf(stderr, "%s\n", warning.c_str());

  const std::span necklaces(&necklace, 1);
  const kds::Scene scene(necklaces, kds::bead_radii("auto", necklaces));
  kds::KineticRun run(scene, {.structures = {"wrapped", "power"}});
  run.finish();  // runs all steps
  run.audit_now();

  std::printf("%d beads from %s on, %d frames\n", static_cast<int>(scene.bead_count()),
              scene.bead_name(0).c_str(), static_cast<int>(scene.frame_count()));
  for (const kds::KineticStructure* structure : run.structures()) {
    std::uint64_t events = 0;
    for (const std::uint64_t in_step : structure->statistics.events_per_step) events += in_step;
    std::printf("%s: %d events\n", std::string(structure->name()).c_str(), static_cast<int>(events));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: read_file FILE\n");
    return 2;
  }
  try {
    run_file(argv[1]);
  } catch (const kds::InputError& error) {  // the message names the file, frame, bead or option
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
