#include "experiments/collide/compare_detectors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "experiments/output/text.h"
#include "experiments/run/load_scene.h"
#include "kds/stopwatch.h"
#include "motions/base/input_error.h"
#include "motions/scene/radii.h"
#include "structures/collision/auto_detector.h"
#include "structures/collision/brute_force.h"
#include "structures/collision/cell_list.h"
#include "structures/collision/hierarchy_search.h"
#include "structures/images/image_pairs.h"
#include "structures/necklace/pairs_in_question.h"

namespace kds {

CollideFrames::CollideFrames(const InputOptions& options, const std::function<void(const std::string&)>& warn)
    : frames_(open_frames(options, warn)) {
  const FrameSurvey survey = survey_frames(*frames_, options.radius == "auto", warn);
  radii_ = bead_radii(options.radius, frames_->necklaces(), survey);
  plane_ = survey.plane;
  periodic_ = survey.periodic && options.periodic;
  warn_of_cells("pairs", survey.lacks_images, options, warn);
  truncated_ = survey.truncated;
  frame_count_ = survey.frame_count;
  first_ = survey.first;
  last_ = survey.last;
  bead_groups_ = kds::bead_groups(frames_->necklaces());
  necklaces_ = bead_ranges(frames_->necklaces());
  at_rest_ = necklaces_at_rest(frames_->necklaces());
  bead_names_ = names_of_beads(frames_->necklaces());
}

bool CollideFrames::next(FrameRead& frame) {
  if (!frames_->next(frame)) return false;
  if (plane_) plane_->lay(frame.positions);
  if (!periodic_) frame.cell.reset();
  if (plane_ && frame.cell) frame.cell = plane_->laid(*frame.cell);
  return true;
}

namespace {

template <int Dimension>
class BruteForce final : public Detector<Dimension> {
 public:
  explicit BruteForce(const CollisionQuery& query) : query_(query) {}
  std::optional<std::string> refusal(const Balls<Dimension>&) const override {
    // These many pairs, those of 300,000 beads or 45,000 in a cell, take half a minute per frame.
    const std::uint64_t most = cell_ ? 1'000'000'000 : 45'000'000'000;
    const std::uint64_t pairs = PairsInQuestion(query_.asked).count();
    if (pairs <= most) return std::nullopt;
    return fmt::format("looks at {} pairs of beads; expected {} or fewer", with_thousands(pairs),
                       with_thousands(most));
  }
  void set_cell(const std::optional<Cell>& cell) override { cell_ = cell; }
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    found.pairs = cell_ ? image_pairs_by_force(balls, *cell_, query_.asked, query_.distance)
                        : pairs_by_force(balls, query_.asked, query_.distance);
  }
  void find_closest(const Balls<Dimension>& balls, Detection& found) override {
    found.closest = cell_ ? closest_images_by_force(balls, *cell_, query_.asked)
                          : closest_pair_by_force(balls, query_.asked);
  }

 private:
  CollisionQuery query_;
  std::optional<Cell> cell_;
};

template <int Dimension, Hierarchy kind>
class BySpheres : public Detector<Dimension> {
 public:
  explicit BySpheres(const CollisionQuery& query) : query_(query), tree_(kind, query.asked.necklaces) {}
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    tree_.build(balls);
    PairsFound result = find_pairs(tree_, query_.asked, query_.distance);
    found.pairs = std::move(result.pairs);
    found.family = result.family;
  }
  void find_closest(const Balls<Dimension>& balls, Detection& found) override {
    found.closest = find_closest_pair(tree_, balls, query_.asked);
  }

 private:
  CollisionQuery query_;
  SphereTree<Dimension> tree_;
};
template <int Dimension>
using Wrapped = BySpheres<Dimension, Hierarchy::wrapped>;
template <int Dimension>
using Layered = BySpheres<Dimension, Hierarchy::layered>;

template <int Dimension>
class Cells final : public Detector<Dimension> {
 public:
  explicit Cells(const CollisionQuery& query) : query_(query), cells_(query.asked) {}
  void set_cell(const std::optional<Cell>& cell) override { periodic_cell_ = cell; }
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    found.pairs = periodic_cell_ ? image_pairs_by_cells(balls, *periodic_cell_, query_.asked, query_.distance)
                                 : cells_.pairs_within(balls, query_.distance);
  }

 private:
  CollisionQuery query_;
  CellList<Dimension> cells_;
  std::optional<Cell> periodic_cell_;
};

template <int Dimension>
class Auto final : public Detector<Dimension> {
 public:
  explicit Auto(const CollisionQuery& query) : query_(query), detector_(query.asked) {}
  void set_cell(const std::optional<Cell>& cell) override { cell_ = cell; }
  void detect(const Balls<Dimension>& balls, Detection& found) override {
    const double distance = query_.distance;
    if (cell_) {
      found.pairs = image_pairs_by_cells(balls, *cell_, query_.asked, distance);
    } else {
      found.pairs = distance > 0 ? detector_.pairs_within(balls, distance) : detector_.pairs(balls);
    }
  }
  void find_closest(const Balls<Dimension>& balls, Detection& found) override {
    found.closest =
        cell_ ? closest_images_by_cells(balls, *cell_, query_.asked) : detector_.closest_pair(balls);
  }

 private:
  CollisionQuery query_;
  AutoDetector<Dimension> detector_;
  std::optional<Cell> cell_;
};

template <int Dimension, template <int> class Made>
std::unique_ptr<Detector<Dimension>> make(const CollisionQuery& query) {
  return std::make_unique<Made<Dimension>>(query);
}
template <template <int> class Made>
constexpr Method method(std::string_view name, std::string_view about, bool takes_groups = false,
                        bool takes_images = false) {
  return {name, about, takes_groups, takes_images, make<2, Made>, make<3, Made>};
}

constexpr std::array kMethods{
    method<BruteForce>("brute", "all pairs of beads", true, true),
    method<Wrapped>("wrapped", "hierarchy of minimum enclosing spheres"),
    method<Layered>("layered", "hierarchy of spheres around spheres"),
    method<Cells>("cells", "cell list", true, true),
    method<Auto>("auto", "blocks, and near pairs kept from frame to frame", false, true),
};

}  // namespace

std::span<const Method> collision_methods() { return kMethods; }

namespace {

/// Describes the first difference between the results of two methods, or returns nothing.
std::optional<std::string> difference(const Detection& a, const Detection& b) {
  if (a.pairs != b.pairs)
    return fmt::format("which beads collide ({} and {} pairs)", a.pairs.size(), b.pairs.size());
  if (a.closest && b.closest &&
      (a.closest->first != b.closest->first || a.closest->second != b.closest->second))
    return fmt::format("the closest pair ({}, {} and {}, {})", a.closest->first, a.closest->second,
                       b.closest->first, b.closest->second);
  return std::nullopt;
}

// Returns the methods that take all of this, as in "brute, cells and auto".
std::string names_of_methods(bool groups, bool images, std::string_view before_last) {
  std::vector<std::string_view> names;
  for (const Method& method : kMethods)
    if ((method.takes_groups || !groups) && (method.takes_images || !images)) names.push_back(method.name);
  const std::string_view last = names.back();
  names.pop_back();
  return fmt::format("{} {} {}", fmt::join(names, ", "), before_last, last);
}

template <int Dimension>
class Comparison {
 public:
  Comparison(CollideFrames& frames, const CollideTask& task) : frames_(frames), task_(task) {}

  CollideReport run(const OnFrame& on_frame, const std::function<void(const std::string&)>& warn,
                    const std::function<void(std::size_t, std::size_t)>& progress) {
    FrameRead frame;
    Balls<Dimension> balls;
    report_.timed = frames_.has_times();
    for (std::size_t k = 0; frames_.next(frame); ++k) {
      if (k == 0) {
        balls = Balls<Dimension>(frame.positions, frames_.radii());
        make_detectors(balls, frame.cell, warn);
      } else {
        balls.move_to(frame.positions);
      }
      const std::vector<Detection> found = detect(balls, frame);
      const FrameFound all = common(frame.stamp, found);
      ++report_.frames;
      if (all.pairs > 0) ++report_.colliding_frames;
      on_frame(frame, all, found.front().pairs);
      progress(k + 1, frames_.frame_count());
    }
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      report_.rows[m].seconds = spread_of(methods_[m].seconds);
      if (report_.rows[m].closest) report_.rows[m].closest_seconds = spread_of(methods_[m].closest_seconds);
    }
    return std::move(report_);
  }

 private:
  void make_detectors(const Balls<Dimension>& balls, const std::optional<Cell>& cell,
                      const std::function<void(const std::string&)>& warn) {
    const bool groups = !task_.query.asked.groups.empty(), images = cell.has_value();
    const std::string looks_at = groups ? fmt::format("all pairs, not at {}", "--groups"_arg)
                                        : "beads as they lie, not at their images in the periodic cell";
    std::vector<std::string_view> left_out;
    for (const Method* method : task_.methods) {
      std::unique_ptr<Detector<Dimension>> detector;
      std::optional<std::string> refusal;
      const bool lacks_groups = groups && !method->takes_groups;
      if (!lacks_groups && (!images || method->takes_images)) {
        detector = method->make<Dimension>(task_.query);
        detector->set_cell(cell);
        refusal = detector->refusal(balls);
      } else {
        if (task_.leave_out_refusing) {
          left_out.push_back(method->name);
          continue;
        }
        refusal =
            fmt::format("it looks at {}; expected {}{}", looks_at, names_of_methods(groups, images, "or"),
                        lacks_groups ? "" : fmt::format(", or {}", "--no-periodic"_arg));
      }
      if (refusal) {
        if (!task_.leave_out_refusing)
          throw InputError(fmt::format("{} {}: {}", "--method"_arg, method->name, *refusal));
        warn(fmt::format("{} {} is left out: {}", "--method"_arg, method->name, *refusal));
        continue;
      }
      Rounds& rounds = methods_.emplace_back();
      rounds.detectors.push_back(std::move(detector));
      while (rounds.detectors.size() < task_.rounds)
        rounds.detectors.push_back(method->make<Dimension>(task_.query));
      rounds.seconds.resize(task_.rounds);
      rounds.closest_seconds.resize(task_.rounds);
      CollideRow& row = report_.rows.emplace_back();
      row.method = method->name;
    }
    if (!left_out.empty())
      warn(fmt::format("the methods {} look at {}, and are left out; {} are compared",
                       fmt::join(left_out, ", "), looks_at, names_of_methods(groups, images, "and")));
  }

  std::vector<Detection> detect(const Balls<Dimension>& balls, const FrameRead& frame) {
    const FrameStamp& stamp = frame.stamp;
    std::vector<Detection> found(methods_.size());
    for (std::size_t round = 0; round < task_.rounds; ++round)
      for (std::size_t m = 0; m < methods_.size(); ++m) {
        Detector<Dimension>& detector = *methods_[m].detectors[round];
        found[m] = {};
        detector.set_cell(frame.cell);
        methods_[m].seconds[round] += seconds_of<WallClock>([&] { detector.detect(balls, found[m]); });
        methods_[m].closest_seconds[round] +=
            seconds_of<WallClock>([&] { detector.find_closest(balls, found[m]); });
      }
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      CollideRow& row = report_.rows[m];
      add(found[m], stamp, row);
      for (std::size_t other = 0; other < m; ++other)
        if (const auto what = difference(found[other], found[m]))
          throw std::runtime_error(fmt::format("frame {}: {} and {} disagree on {}", stamp.number,
                                               report_.rows[other].method, row.method, *what));
    }
    return found;
  }

  void add(const Detection& found, const FrameStamp& stamp, CollideRow& row) const {
    const bool first = report_.frames == 0;
    row.colliding_frames += found.pairs.empty() ? 0 : 1;
    row.pairs += found.pairs.size();
    if (found.family) row.family = row.family.value_or(0) + *found.family;
    const bool told_before = first || row.closest.has_value();
    if (!found.closest || !told_before) {
      row.closest.reset();
    } else if (first || found.closest->distance < row.closest->pair.distance) {
      row.closest = ClosestInFrame{stamp, *found.closest};
    }
  }

  static FrameFound common(const FrameStamp& stamp, const std::vector<Detection>& found) {
    FrameFound frame{stamp, found.front().pairs.size(), std::nullopt};
    for (const Detection& one : found)
      if (one.closest) frame.closest = one.closest;
    return frame;
  }

  CollideFrames& frames_;
  const CollideTask& task_;
  // Each round has its own detectors, because the data that a detector keeps from frame to frame is part of
  // its cost.
  struct Rounds {
    std::vector<std::unique_ptr<Detector<Dimension>>> detectors;
    std::vector<double> seconds, closest_seconds;
  };
  std::vector<Rounds> methods_;
  CollideReport report_;
};

}  // namespace

CollideReport compare_detectors(CollideFrames& frames, const CollideTask& task, const OnFrame& on_frame,
                                const std::function<void(const std::string&)>& warn,
                                const std::function<void(std::size_t, std::size_t)>& progress) {
  if (frames.dimension() == 2) return Comparison<2>(frames, task).run(on_frame, warn, progress);
  return Comparison<3>(frames, task).run(on_frame, warn, progress);
}

}  // namespace kds
