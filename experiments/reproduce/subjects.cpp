#include "experiments/reproduce/subjects.h"

#include <utility>

#include "motions/models/model.h"
#include "motions/models/shapes.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/radii.h"

namespace kds {

namespace {

Subject of_frames(std::vector<Eigen::Matrix3Xd> frames, bool planar) {
  Subject subject;
  const auto beads = static_cast<std::size_t>(frames.front().cols());
  subject.frames = std::move(frames);
  subject.radii.assign(beads, models::radius);
  subject.necklaces = {{0, static_cast<BeadId>(beads - 1)}};
  subject.planar = planar;
  return subject;
}

}  // namespace

Subject spline_subject(std::size_t beads) {
  return of_frames({models::spline(beads, models::usual_bond, 2)}, true);
}

Subject grill_subject(std::size_t beads) { return of_frames({models::grill(beads)}, true); }

Subject helix_subject(std::size_t beads, double turns) {
  return of_frames({models::helix(beads, turns)}, false);
}

Subject rolling_spiral(std::size_t beads, std::size_t frames) {
  const models::Settings settings{
      .beads = beads, .frames = frames, .turns = spiral_turns, .rolled = models::Span{first_rolled, 1}};
  return of_frames(models::generate(*models::find_model("spiral"), settings).front().frames, true);
}

Subject two_spirals(std::size_t beads, std::span<const PairedStage> stages) {
  std::vector<Eigen::Matrix3Xd> frames;
  for (const PairedStage& stage : stages) {
    const models::Shape lower = models::spiral(beads, paired_spiral_turns, stage.rolled);
    models::Shape upper = lower;
    upper.row(2).array() += stage.distance;
    frames.emplace_back(3, 2 * lower.cols()) << lower, upper;
  }
  Subject subject = of_frames(std::move(frames), false);
  const auto first = static_cast<BeadId>(beads);
  subject.necklaces = {{0, first - 1}, {first, 2 * first - 1}};
  return subject;
}

Subject protein(const std::filesystem::path& data, std::string_view file, std::string_view topology) {
  ReadOptions options;
  if (!topology.empty()) options.topology = data / topology;
  Trajectory necklace = read_trajectory(data / file, options);
  Subject subject;
  subject.radii = bead_radii("auto", std::span(&necklace, 1));
  subject.necklaces = {{0, static_cast<BeadId>(subject.radii.size() - 1)}};
  subject.frames = std::move(necklace.frames);
  return subject;
}

}  // namespace kds
