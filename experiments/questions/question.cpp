#include "experiments/questions/question.h"

#include <algorithm>

#include "motions/models/model.h"
#include "motions/models/shapes.h"

namespace kds {

namespace {

constexpr std::size_t kFrames = 200;

Subject first_frames(Subject subject) {
  subject.frames.resize(std::min(kFrames, subject.frames.size()));
  return subject;
}

Subject wandering_chain(std::uint64_t seed) {
  constexpr std::size_t beads = 640;
  const models::Settings settings{
      .beads = beads, .frames = kFrames, .seed = seed, .motion = models::ShapeMotion::wander, .step = 0.01};
  Subject subject;
  subject.frames = models::generate(*models::find_model("random-chain"), settings).front().frames;
  subject.radii.assign(beads, models::radius);
  subject.necklaces = {{0, static_cast<BeadId>(beads - 1)}};
  return subject;
}

}  // namespace

NamedSubject moving_subject(std::size_t which, const std::filesystem::path& data, std::uint64_t seed) {
  switch (which) {
    case 0:
      return {"villin", first_frames(protein(data, "trajectories/villin_hp36_300K.dcd",
                                             "trajectories/villin_hp36_300K.pdb"))};
    case 1:
      return {"random protein", first_frames(protein(data, "trajectories/random100_400K_first200.dcd",
                                                     "trajectories/random100_400K.pdb"))};
    default:
      return {"wandering chain", wandering_chain(seed)};
  }
}

}  // namespace kds
