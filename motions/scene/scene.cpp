#include "motions/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

void check_radii(const std::vector<double>& radii) {
  for (std::size_t bead = 0; bead < radii.size(); ++bead) {
    if (std::isfinite(radii[bead] * radii[bead])) continue;
    throw InputError(
        fmt::format("bead {}: expected a radius with a finite square, found {}", bead, radii[bead]));
  }
}

}  // namespace

Scene::Scene(std::span<const Trajectory> necklaces, std::vector<double> radii, FrameMotion motion)
    : radii_(std::move(radii)) {
  auto frames = std::make_unique<MemoryFrames>(necklaces);
  const FrameSurvey survey = survey_frames(*frames, false);
  take(std::move(frames), survey, motion);
}

Scene::Scene(std::unique_ptr<FrameSource> frames, const FrameSurvey& survey, std::vector<double> radii,
             FrameMotion motion)
    : radii_(std::move(radii)) {
  take(std::move(frames), survey, motion);
}

void Scene::take(std::unique_ptr<FrameSource> frames, const FrameSurvey& survey, FrameMotion motion) {
  const std::vector<NecklaceBeads>& necklaces = frames->necklaces();
  const std::string file = necklaces.empty() ? "no input" : necklaces.front().file;
  if (frames->is_open()) live_ = frames.get();
  if (survey.frame_count < 2 && live_ == nullptr)
    throw InputError(
        fmt::format("{}: a run needs at least two frames, this input has {}", file, survey.frame_count));
  if (count_beads(necklaces) == 0) throw InputError(fmt::format("{}: expected beads, found none", file));
  if (radii_.size() != count_beads(necklaces))
    throw InputError(fmt::format("{}: {} in all, expected as many radii, found {}", file,
                                 counted(count_beads(necklaces), "bead"), radii_.size()));
  check_radii(radii_);
  necklaces_ = bead_ranges(necklaces);
  bonds_ = bonds_of(necklaces);
  at_rest_ = necklaces_at_rest(necklaces);
  bead_names_ = names_of_beads(necklaces);
  bead_groups_ = kds::bead_groups(necklaces);
  truncated_ = survey.truncated;
  periodic_ = survey.periodic;
  lacks_images_ = survey.lacks_images;
  plane_ = survey.plane.value_or(AxisPlane{});
  steps_ = std::make_unique<DiscreteStepAdapter>(std::move(frames), survey, motion);
  if (live_ != nullptr && !has_step(0))
    throw InputError(fmt::format("{}: has ended before its second frame; a run needs at least two", file));
}

Scene::Scene(PushedFrames frames) : radii_(std::move(frames.radii)), has_radii_(!radii_.empty()) {
  const int dimension = frames.dimension;
  if (dimension < 1 || dimension > 3)
    throw InputError(fmt::format("frames in {} dimensions: expected 1, 2 or 3", dimension));
  if (frames.motion == FrameMotion::lifted && dimension == 1)
    throw InputError("lifted motion in 1 dimension: expected 2 or 3, or another kind of motion");
  std::vector<NecklaceBeads> necklaces;
  for (const std::size_t count : frames.necklaces) {
    if (count == 0)
      throw InputError(fmt::format("necklace {}: expected beads, found none", necklaces.size()));
    necklaces.push_back({.count = count});
  }
  if (necklaces.empty()) throw InputError("frames of no necklace: expected beads, found none");
  necklaces_ = bead_ranges(necklaces);
  bonds_ = bonds_of(necklaces);
  const std::size_t beads = count_beads(necklaces);
  if (radii_.size() == 1) radii_.resize(beads, radii_.front());
  if (has_radii_ && radii_.size() != beads)
    throw InputError(fmt::format("{} beads: expected as many radii, or one, found {}", beads, radii_.size()));
  for (std::size_t bead = 0; bead < radii_.size(); ++bead)
    if (radii_[bead] < 0)
      throw InputError(
          fmt::format("bead {}: expected a radius that is not negative, found {}", bead, radii_[bead]));
  check_radii(radii_);
  radii_.resize(beads, 0);
  set_probe(frames.probe);
  periodic_ = frames.cell.has_value();
  if (periodic_ && (dimension < 2 ||
                    (dimension == 2 && !(frames.cell->col(2).isZero(0) && frames.cell->row(2).isZero(0)))))
    throw InputError(fmt::format("a periodic cell in {}: expected vectors in the plane or in space",
                                 counted(static_cast<std::size_t>(dimension), "dimension")));
  auto queue = std::make_unique<FrameQueue>(std::move(necklaces), dimension, frames.cell);
  pushed_ = queue.get();
  steps_ = std::make_unique<DiscreteStepAdapter>(std::move(queue), dimension, frames.motion, periodic_);
}

Scene::Scene(Instance instance, std::vector<double> radii)
    : radii_(std::move(radii)), has_radii_(!radii_.empty()) {
  auto step = std::make_unique<InstanceStep>(std::move(instance));
  const std::size_t points = step->instance().point_count();
  necklaces_.push_back({0, static_cast<BeadId>(points - 1)});
  if (has_radii_) {
    if (radii_.size() != points)
      throw InputError(fmt::format("{}: {} points, expected as many radii, found {}", step->instance().file,
                                   points, radii_.size()));
    check_radii(radii_);
  } else {
    radii_.assign(points, 0);
    for (std::size_t p = 0; p < points && step->has_weights(); ++p)
      radii_[p] = std::sqrt(std::max(0.0, step->weight(static_cast<BeadId>(p), 0)));
  }
  steps_ = std::move(step);
}

void Scene::set_probe(double length) {
  probe_ = length;
  for (std::size_t bead = 0; bead < radii_.size(); ++bead)
    if (const double radius = radii_[bead] + probe_; !std::isfinite(radius * radius))
      throw InputError(
          fmt::format("bead {}: its radius and the probe, {}, are too large to be squared", bead, radius));
}

void Scene::push(std::span<const double> coordinates, std::optional<double> picoseconds,
                 const std::optional<Cell>& cell) {
  if (pushed_ == nullptr) throw std::logic_error("a frame is pushed to a scene that has frames of its own");
  pushed_->push(coordinates, picoseconds, cell);
  steps_->read_on();
}

std::unique_ptr<const Scene> Scene::over(std::unique_ptr<FrameSource> frames) const {
  std::unique_ptr<Scene> scene(new Scene());
  scene->necklaces_ = necklaces_;
  scene->bonds_ = bonds_;
  scene->at_rest_ = at_rest_;
  scene->bead_names_ = bead_names_;
  scene->bead_groups_ = bead_groups_;
  scene->radii_ = radii_;
  scene->has_radii_ = has_radii_;
  scene->probe_ = probe_;
  scene->truncated_ = truncated_;
  scene->periodic_ = periodic_;
  scene->plane_ = plane_;
  scene->steps_ = steps_->over(std::move(frames));
  return scene;
}

void Scene::end_frames() {
  if (pushed_ != nullptr) pushed_->end();
  if (live_ != nullptr) live_->close();
}

FrameStamp Scene::stamp(std::size_t frame) const {
  require_index("frame", frame, frame_count());
  return steps_->stamp(frame);
}

Eigen::Vector3d Scene::in_input(const Eigen::Vector3d& point) const {
  Eigen::Vector3d there = Eigen::Vector3d::Constant(plane_.height);
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension()); ++k)
    there[plane_.axes[k]] = point[static_cast<Eigen::Index>(k)];
  return there;
}

void Scene::require_weights() const {
  if (!has_radii_ || equal_radii()) return;
  for (std::size_t bead = 0; bead < radii_.size(); ++bead) {
    const double radius = radii_[bead];
    if (radius == 0 || radius * radius >= std::numeric_limits<double>::min()) continue;
    throw InputError(
        fmt::format("bead {}: the square of its radius, {}, is too small a number for a power diagram; "
                    "give all lengths in a smaller unit",
                    bead, radius));
  }
}

bool Scene::equal_radii() const {
  if (has_radii_ || !steps_->has_weights())
    return std::all_of(radii_.begin(), radii_.end(), [&](double r) { return r == radii_.front(); });
  for (BeadId b = 0; b < bead_count(); ++b)
    for (int k = 0; k <= degree(); ++k)
      if (weight(b, k) != weight(0, k)) return false;
  return true;
}

double Scene::weight(BeadId bead, int k) const {
  if (!has_radii_ && steps_->has_weights()) return steps_->weight(bead, k);
  const double reach = radii_[bead] + probe_;
  return reach * reach;
}

Eigen::Matrix3Xd Scene::centers(std::size_t frame) const {
  require_index("frame", frame, frame_count());
  return steps_->centers(frame);
}

std::vector<double> Scene::weights(std::size_t frame) const {
  require_index("frame", frame, frame_count());
  std::vector<double> weights(bead_count());
  for (BeadId b = 0; b < bead_count(); ++b) weights[b] = weight(b, frame == 0 ? 0 : degree());
  return weights;
}

}  // namespace kds
