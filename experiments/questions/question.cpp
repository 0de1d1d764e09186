#include "experiments/questions/question.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/run/load_scene.h"
#include "motions/base/input_error.h"
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

std::vector<CurveFit> QuestionCurve::fits() const {
  const auto part = [this](std::size_t first, std::size_t count, std::string of_points) {
    const auto of = [&](const std::vector<std::pair<double, double>>& all) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(std::min(first, all.size()));
      return std::vector(begin,
                         all.begin() + static_cast<std::ptrdiff_t>(std::min(first + count, all.size())));
    };
    const auto some = of(points);
    std::vector<std::vector<std::pair<double, double>>> some_without;
    for (const auto& share : without) some_without.push_back(of(share));
    std::vector<CurveFit> fits;
    if (const auto fit = without.empty() ? fit_power(some) : fit_power(some, some_without)) {
      const auto [least, most] = std::ranges::minmax(some);
      fits.push_back({std::move(of_points), least.first, most.first, *fit});
    }
    return fits;
  };
  const std::size_t count = points.size();
  if (!crossover || count < 8) return part(0, count, "");
  std::vector<CurveFit> fits = part(0, 4, "the 4 least amplitudes");
  for (std::vector<CurveFit>& more : std::array{part(count - 6, 4, "4 amplitudes below the largest two"),
                                                part(count - 3, 3, "the 3 largest amplitudes")})
    fits.insert(fits.end(), more.begin(), more.end());
  return fits;
}

MovingSubjects usual_subjects(const std::filesystem::path& data, std::uint64_t seed) {
  return {{"villin", first_frames(protein(data, "trajectories/villin_hp36_300K.dcd",
                                          "trajectories/villin_hp36_300K.pdb"))},
          {"random protein", first_frames(protein(data, "trajectories/random100_400K_first200.dcd",
                                                  "trajectories/random100_400K.pdb"))},
          {"wandering chain", wandering_chain(seed)}};
}

MovingSubjects subjects_of(const InputOptions& options, const std::function<void(const std::string&)>& warn) {
  constexpr std::size_t least_frames = 3;
  constexpr std::size_t least_beads = 4;
  MovingSubjects subjects;
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    RunOptions run;
    run.inputs = {options.inputs[i]};
    run.reading = reading_of(options, i);
    run.radius = options.radius;
    const std::string file = options.inputs[i].string();
    if (is_instance_file(options.inputs[i]))
      throw InputError(file + ": an instance file has no frames; expected a trajectory");
    const Scene scene = load_scene(run, warn);
    if (scene.necklaces().size() != 1)
      throw InputError(fmt::format("{}: has {} necklaces; expected one (--chain chooses it)", file,
                                   scene.necklaces().size()));
    if (scene.frame_count() < least_frames || scene.bead_count() < least_beads)
      throw InputError(fmt::format("{}: has {} frames of {} beads; expected at least {} frames of {} beads",
                                   file, scene.frame_count(), scene.bead_count(), least_frames, least_beads));
    NamedSubject& subject = subjects.emplace_back(NamedSubject{options.inputs[i].filename().string(), {}});
    for (std::size_t k = 0; k < scene.frame_count(); ++k) subject.subject.frames.push_back(scene.centers(k));
    subject.subject.radii = scene.radii();
    subject.subject.necklaces = scene.necklaces();
  }
  return subjects;
}

}  // namespace kds
