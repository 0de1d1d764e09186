#include "experiments/collide/compare_detectors.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "kds/seconds.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

/// Describes the first difference between the results of two methods, or returns nothing.
std::optional<std::string> difference(const Detection& a, const Detection& b) {
  if (a.collide != b.collide) return "whether beads collide";
  if (a.pairs && b.pairs && *a.pairs != *b.pairs)
    return fmt::format("which beads collide ({} and {} pairs)", a.pairs->size(), b.pairs->size());
  if (a.closest && b.closest &&
      (a.closest->first != b.closest->first || a.closest->second != b.closest->second))
    return fmt::format("the closest pair ({}, {} and {}, {})", a.closest->first, a.closest->second,
                       b.closest->first, b.closest->second);
  return std::nullopt;
}

template <int Dimension>
class Comparison {
 public:
  Comparison(CollideFrames& frames, const CollideTask& task) : frames_(frames), task_(task) {}

  CollideReport run(const OnFrame& on_frame, const std::function<void(const std::string&)>& warn,
                    const std::function<void(std::size_t, std::size_t)>& progress) {
    FrameRead frame;
    Balls<Dimension> balls;
    for (std::size_t k = 0; frames_.next(frame); ++k) {
      if (k == 0) {
        balls = Balls<Dimension>(frame.positions, frames_.radii());
        make_detectors(balls, warn);
      } else {
        balls.move_to(frame.positions);
      }
      const std::vector<Detection> found = detect(balls, frame.stamp);
      const FrameFound all = common(frame.stamp, found);
      ++report_.frames;
      if (all.collide) ++report_.colliding_frames;
      const auto telling =
          std::find_if(found.begin(), found.end(), [](const Detection& d) { return d.pairs.has_value(); });
      on_frame(
          frame, all,
          telling != found.end() ? std::optional<std::span<const BeadPair>>(*telling->pairs) : std::nullopt);
      progress(k + 1, frames_.frame_count());
    }
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      report_.rows[m].seconds = spread_of(methods_[m].seconds);
      if (report_.rows[m].closest) report_.rows[m].closest_seconds = spread_of(methods_[m].closest_seconds);
    }
    return std::move(report_);
  }

 private:
  void make_detectors(const Balls<Dimension>& balls, const std::function<void(const std::string&)>& warn) {
    for (const Method* method : task_.methods) {
      auto detector = method->make<Dimension>(task_.query);
      if (const auto refusal = detector->refusal(balls)) {
        if (!task_.leave_out_refusing)
          throw InputError(fmt::format("--method {}: {}", method->name, *refusal));
        warn(fmt::format("--method {} is left out: {}", method->name, *refusal));
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
  }

  std::vector<Detection> detect(const Balls<Dimension>& balls, const FrameStamp& stamp) {
    std::vector<Detection> found(methods_.size());
    for (std::size_t round = 0; round < task_.rounds; ++round)
      for (std::size_t m = 0; m < methods_.size(); ++m) {
        Detector<Dimension>& detector = *methods_[m].detectors[round];
        found[m] = {};
        methods_[m].seconds[round] += seconds_of([&] { detector.detect(balls, found[m]); }).clock;
        methods_[m].closest_seconds[round] +=
            seconds_of([&] { detector.find_closest(balls, found[m]); }).clock;
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
    row.colliding_frames += found.collide ? 1 : 0;
    row.pairs = row.pairs && found.pairs ? std::optional(*row.pairs + found.pairs->size()) : std::nullopt;
    if (found.family) row.family = row.family.value_or(0) + *found.family;
    const bool told_before = first || row.closest.has_value();
    if (!found.closest || !told_before) {
      row.closest.reset();
    } else if (first || found.closest->distance < row.closest->pair.distance) {
      row.closest = ClosestInFrame{stamp, *found.closest};
    }
  }

  static FrameFound common(const FrameStamp& stamp, const std::vector<Detection>& found) {
    FrameFound frame{stamp, false, std::nullopt, std::nullopt};
    for (const Detection& one : found) {
      frame.collide = one.collide;
      if (one.pairs) frame.pairs = one.pairs->size();
      if (one.closest) frame.closest = one.closest;
    }
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
