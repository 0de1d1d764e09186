#include "experiments/figures/stable_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "kds/event_log.h"
#include "motions/models/elementary.h"
#include "motions/models/shapes.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/necklace/necklace.h"
#include "structures/session/kinetic_run.h"

namespace kds {

namespace {

constexpr std::size_t kCosines = 4, kSteps = 20;

using Amplitudes = std::array<double, kCosines>;  // in turns of the whole chain

Amplitudes random_amplitudes(models::Random& random) {
  Amplitudes amplitudes;
  for (double& a : amplitudes) a = 1.5 * (random.uniform() - 0.5);
  return amplitudes;
}

Eigen::Matrix3Xd chain_of(const Amplitudes& amplitudes, std::size_t beads) {
  constexpr double step = 2 * models::radius * models::usual_bond;
  Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(beads));
  const auto bonds = static_cast<double>(beads - 1);
  double heading = 0;
  for (std::size_t b = 1; b < beads; ++b) {
    const auto [sine, cosine] = models::sine_cosine(heading);
    const auto at = static_cast<Eigen::Index>(b);
    centers.col(at) = centers.col(at - 1) + step * Eigen::Vector3d(cosine, sine, 0);
    for (std::size_t k = 0; k < kCosines; ++k)
      heading += amplitudes[k] / bonds *
                 models::sine_cosine(static_cast<double>(k) * static_cast<double>(b) / (2 * bonds)).cosine;
  }
  return centers;
}

std::vector<Eigen::Matrix3Xd> frames_between(const Amplitudes& from, const Amplitudes& to,
                                             std::size_t beads) {
  std::vector<Eigen::Matrix3Xd> frames;
  for (std::size_t k = 0; k <= kSteps; ++k) {
    const double share = static_cast<double>(k) / kSteps;
    Amplitudes at;
    for (std::size_t i = 0; i < kCosines; ++i) at[i] = from[i] + share * (to[i] - from[i]);
    frames.push_back(chain_of(at, beads));
  }
  return frames;
}

double deformation_between(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  double sum = 0, count = 0, longest = 0;
  for (Eigen::Index i = 0; i < from.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j, ++count) {
      const double before = std::sqrt(models::squared_distance(from.col(i), from.col(j)));
      const double after = std::sqrt(models::squared_distance(to.col(i), to.col(j)));
      sum += (after - before) * (after - before);
      longest = std::max({longest, before, after});
    }
  return std::sqrt(sum / count) / longest;
}

bool only_root_differs(StaticWrappedHierarchy<2>& hierarchy, std::span<const Eigen::Matrix3Xd> frames,
                       std::span<const double> radii) {
  hierarchy.build(Balls<2>(frames.front(), radii));
  const std::vector<Basis> first(hierarchy.bases().begin(), hierarchy.bases().end());
  for (const Eigen::Matrix3Xd& frame : frames.subspan(1)) {
    hierarchy.build(Balls<2>(frame, radii));
    if (!std::ranges::equal(first.begin() + 1, first.end(), hierarchy.bases().begin() + 1,
                            hierarchy.bases().end()))
      return false;
  }
  return !(first.front() == hierarchy.basis(0));
}

bool always_proper(std::span<const Eigen::Matrix3Xd> frames, std::span<const double> radii) {
  const BeadRange beads{0, static_cast<BeadId>(radii.size() - 1)};
  return std::ranges::all_of(frames, [&](const Eigen::Matrix3Xd& frame) {
    return Necklace(beads, frame, radii).validate().proper();
  });
}

// Returns the number of basis changes of the root during the motion, or none if another basis changes.
std::optional<std::size_t> root_changes_of(std::span<const Eigen::Matrix3Xd> frames) {
  const auto beads = static_cast<std::size_t>(frames.front().cols());
  KineticRun run(PushedFrames{2, {beads}, {models::radius}}, {.structures = {"wrapped"}});
  EventLog log;
  run.listen(log);
  for (const Eigen::Matrix3Xd& frame : frames) {
    std::vector<double> coordinates;
    for (Eigen::Index b = 0; b < frame.cols(); ++b)
      coordinates.insert(coordinates.end(), {frame(0, b), frame(1, b)});
    run.push(coordinates);
  }
  run.finish();
  run.run();
  for (const Event& event : log.events)
    if (event.ids()[0] != 0 || event.ids()[1] + 1 != beads) return std::nullopt;
  return log.events.size();
}

}  // namespace

std::optional<StablePair> find_stable_pair(const StablePairSearch& search) {
  models::Random random(search.seed);
  const std::vector<double> radii(search.beads, models::radius);
  const std::array necklaces{BeadRange{0, static_cast<BeadId>(search.beads - 1)}};
  StaticWrappedHierarchy<2> hierarchy(necklaces);
  std::optional<StablePair> best;
  for (std::size_t k = 0; k < search.candidates; ++k) {
    const Amplitudes from = random_amplitudes(random), to = random_amplitudes(random);
    std::vector<Eigen::Matrix3Xd> frames = frames_between(from, to, search.beads);
    const double deformation = deformation_between(frames.front(), frames.back());
    if (best && deformation <= best->deformation) continue;
    if (!only_root_differs(hierarchy, frames, radii) || !always_proper(frames, radii)) continue;
    if (const auto changes = root_changes_of(frames))
      best = StablePair{std::move(frames), deformation, *changes, k};
  }
  return best;
}

}  // namespace kds
