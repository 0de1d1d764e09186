#include "experiments/reproduce/subjects.h"

#include <utility>

#include "motions/models/model.h"
#include "motions/models/shape.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/radii.h"

namespace kds {

namespace {

constexpr double turns = 9;  // with 18 turns, 1000 beads would overlap

Subject of_models(std::vector<Trajectory> necklaces, bool planar) {
  Subject subject;
  subject.planar = planar;
  BeadId beads = 0;
  for (const Trajectory& necklace : necklaces) {
    const auto count = static_cast<BeadId>(necklace.bead_count());
    subject.necklaces.push_back({beads, beads + count - 1});
    beads += count;
  }
  subject.radii.assign(beads, 1.0);
  for (std::size_t k = 0; k < necklaces.front().frames.size(); ++k) {
    Eigen::Matrix3Xd& frame = subject.frames.emplace_back(3, beads);
    for (std::size_t n = 0; n < necklaces.size(); ++n)
      frame.middleCols(subject.necklaces[n].first, necklaces[n].frames[k].cols()) = necklaces[n].frames[k];
  }
  return subject;
}

}  // namespace

Subject model_subject(std::string_view name, std::size_t beads) {
  const models::Settings settings{.beads = beads, .frames = 1, .motion = models::ShapeMotion::rest};
  return of_models(models::generate(*models::find_model(name), settings), name == "grill");
}

Subject rolling_spiral(std::size_t beads, std::size_t frames) {
  const models::Settings settings{.beads = beads, .frames = frames, .turns = turns};
  return of_models(models::generate(*models::find_model("spiral"), settings), true);
}

Subject two_rolling_spirals(std::size_t beads, std::size_t frames) {
  const models::Settings settings{.beads = beads, .frames = frames, .turns = turns};
  const Trajectory one = models::generate(*models::find_model("spiral"), settings).front();
  Trajectory other = one;
  const double length = static_cast<double>(beads - 1) * 2 * models::usual_bond;
  for (std::size_t k = 0; k < frames; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(frames - 1);
    other.frames[k].row(2).array() += (1 - part) * 1.5 * length + part * 2.1;
  }
  return of_models({one, other}, false);
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
