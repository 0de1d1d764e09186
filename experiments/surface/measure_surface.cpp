#include "experiments/surface/measure_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <numeric>

#include "motions/base/input_error.h"
#include "motions/base/interruption.h"
#include "motions/curves/positions.h"
#include "motions/readers/bead_name.h"
#include "structures/session/parallel_run.h"
#include "structures/session/scene_motion.h"
#include "structures/triangulation/static_dual_complex.h"

namespace kds {

namespace {

/// The radii of the balls, with the probe, and the beads' necklaces and residues.
struct MeasuredBalls {
  std::vector<double> radii, weights;
  std::vector<std::uint32_t> chain_of;
  const ContactElements* residues = nullptr;
  bool keep = false;
};

void measure(const MeasuredBalls& balls, const Eigen::Matrix3Xd& centers, SurfaceFrame& frame) {
  ComplexSimplices complex = static_dual_complex(centers, balls.weights);
  UnionMeasures measures = measure_union(centers, balls.radii, complex);
  frame.area = std::accumulate(measures.areas.begin(), measures.areas.end(), 0.0);
  frame.volume = std::accumulate(measures.volumes.begin(), measures.volumes.end(), 0.0);
  const double largest = *std::max_element(balls.radii.begin(), balls.radii.end());
  // The union contains its largest ball, so its area is at least that of the ball.
  if (!std::isfinite(frame.volume) || frame.area < 12 * largest * largest)
    throw InputError(
        "the balls are too large for their distances: doubles do not hold their areas and volumes");
  if (balls.residues != nullptr) {
    frame.residue_areas.resize(balls.residues->names.size());
    frame.residue_volumes.resize(balls.residues->names.size());
    for (std::size_t bead = 0; bead < balls.radii.size(); ++bead) {
      const std::uint32_t residue = balls.residues->of_bead[bead];
      frame.residue_areas[residue] += measures.areas[bead];
      frame.residue_volumes[residue] += measures.volumes[bead];
    }
  }
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const auto [first, second] =
        std::minmax(balls.chain_of[complex.edges[e][0]], balls.chain_of[complex.edges[e][1]]);
    if (first != second) frame.between[{first, second}] += measures.contacts[e];
  }
  if (!balls.keep) return;
  frame.measures = std::move(measures);
  frame.edges = std::move(complex.edges);
}

/// Returns the positions at times in ascending order.
class Positions {
 public:
  explicit Positions(const Scene& scene) : scene_(scene), motion_(make_scene_motion(scene)) {}

  [[nodiscard]] Eigen::Matrix3Xd at(double time, SurfaceFrame& frame) {
    const auto step = static_cast<std::size_t>(time);
    const double u = time - std::floor(time);
    const FrameStamp stamp = scene_.stamp(step);
    frame.frame = static_cast<double>(stamp.number);
    frame.picoseconds = stamp.picoseconds;
    if (u == 0) return scene_.centers(step);
    const FrameStamp next = scene_.stamp(step + 1);
    frame.frame += u * static_cast<double>(next.number - stamp.number);
    if (frame.picoseconds) *frame.picoseconds += u * (*next.picoseconds - *stamp.picoseconds);
    if (loaded_ != step) motion_->load(step);
    loaded_ = step;
    return std::visit([u](const auto& motion) { return approximate_positions(motion.curves(), u); },
                      motion_->ref());
  }

 private:
  const Scene& scene_;
  std::unique_ptr<SceneMotion> motion_;
  std::optional<std::size_t> loaded_;
};

bool has_residues(const Scene& scene) {
  for (BeadId bead = 0; bead < scene.bead_count(); ++bead)
    if (!bead_name_of(scene.bead_name(bead))) return false;
  return true;
}

}  // namespace

double SurfaceFrame::buried() const {
  double sum = 0;
  for (const auto& [chains, contact] : between) sum += contact;
  return sum;
}

SurfaceReport measure_surface(const SurfaceTask& task, bool keep,
                              const std::function<void(std::size_t, std::size_t)>& progress,
                              const std::function<void(const std::string&)>& warn) {
  bool lone_frame = false;
  SurfaceReport report;
  report.scene = std::make_unique<const Scene>(load_union(task, "kds surface", warn, &lone_frame));
  const Scene& scene = *report.scene;
  report.unit = length_unit(task);
  report.chains = elements_of(scene, ContactElement::chain);
  if (has_residues(scene)) report.residues = elements_of(scene, ContactElement::residue);

  std::vector<double> times = task.times;
  const std::size_t frames = report.frame_count = lone_frame ? 1 : scene.frame_count();
  if (times.empty()) {
    times.resize(frames);
    std::iota(times.begin(), times.end(), 0.0);
  }
  if (times.back() > static_cast<double>(frames - 1))
    throw InputError("--at", fmt::format("{} is after the last of {} frames; expected at most {}",
                                         times.back(), frames, frames - 1));

  MeasuredBalls balls{
      scene.radii(), {}, report.chains.of_bead, report.residues ? &*report.residues : nullptr, keep};
  for (double& radius : balls.radii) {
    radius += scene.probe();
    balls.weights.push_back(radius * radius);
  }
  report.frames.resize(times.size());
  Positions positions(scene);
  const std::size_t threads = std::min(task.threads.value_or(all_threads()), times.size());
  const std::size_t batch = 8 * threads;  // frames that are in memory at once
  for (std::size_t first = 0; first < times.size(); first += batch) {
    InterruptionCheck::ask();
    const std::size_t last = std::min(first + batch, times.size());
    std::vector<Eigen::Matrix3Xd> centers;
    for (std::size_t k = first; k < last; ++k) centers.push_back(positions.at(times[k], report.frames[k]));
    std::atomic<std::size_t> next = first;
    const auto work = [&] {
      for (std::size_t k = next++; k < last; k = next++) measure(balls, centers[k - first], report.frames[k]);
    };
    std::vector<std::future<void>> others;
    for (std::size_t thread = 1; thread < threads; ++thread)
      others.push_back(std::async(std::launch::async, work));
    work();
    for (std::future<void>& other : others) other.get();
    progress(last, times.size());
  }
  return report;
}

}  // namespace kds
