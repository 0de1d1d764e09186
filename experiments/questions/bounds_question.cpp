#include "experiments/questions/question.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/output/text.h"
#include "experiments/program/timing.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"

namespace kds {

namespace {

constexpr std::array<double, 4> kSkins{0.5, 1, 2, 4};  // in radii
constexpr std::array<std::size_t, 6> kFramesTrusted{1, 2, 4, 8, 16, 32};

Eigen::VectorXd moves(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, bool without_drift) {
  Eigen::Matrix3Xd by = to - from;
  if (without_drift) by.colwise() -= Eigen::Vector3d(by.rowwise().mean());
  return by.colwise().norm();
}

double two_largest(Eigen::VectorXd moved) {
  std::partial_sort(moved.begin(), moved.begin() + 2, moved.end(), std::greater<>());
  return moved[0] + moved[1];
}

// Returns the largest displacement of any bead between consecutive frames. A model with a speed limit
// promises this bound.
double speed_of(const Subject& subject) {
  double speed = 0;
  for (std::size_t k = 0; k + 1 < subject.frames.size(); ++k)
    speed = std::max(speed, moves(subject.frames[k], subject.frames[k + 1], false).maxCoeff());
  return speed;
}

// Returns how often near pairs must be found again after the first frame. The pairs are found again at each
// frame at which two beads may have approached by more than the skin since the last search. `nearer(found_at,
// now)` bounds the approach.
template <class Nearer>
double times_repeated(const Subject& subject, double skin, const Nearer& nearer) {
  std::size_t repeated = 0, at = 0;
  for (std::size_t k = 1; k < subject.frames.size(); ++k) {
    if (nearer(at, k) <= skin) continue;
    ++repeated;
    at = k;
  }
  return static_cast<double>(repeated);
}

// How far beads may stick out of a hierarchy whose bases are trusted: mean over the nodes, as a share of
// their radii.
struct Trusted {
  double by_speed = 0, by_displacement = 0, really = 0;
};

double really_out(const StaticWrappedHierarchy<3>& hierarchy, NodeId node, const Subject& subject,
                  std::size_t frame) {
  const Sphere sphere = hierarchy.sphere(node);
  double out = 0;
  const BeadRange& beads = hierarchy.tree().range(node);
  for (BeadId b = beads.first; b <= beads.last; ++b)
    out = std::max(out,
                   (subject.frames[frame].col(b) - sphere.center).norm() + subject.radii[b] - sphere.radius);
  return out / sphere.radius;
}

Trusted looseness(const StaticWrappedHierarchy<3>& hierarchy, const Subject& subject, std::size_t frame,
                  double by_speed, double by_displacement) {
  Trusted sum;
  const auto nodes = static_cast<double>(hierarchy.tree().node_count());
  for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node) {
    const double radius = hierarchy.sphere(node).radius;
    sum.by_speed += hierarchy.stick_out(node, by_speed) / radius / nodes;
    sum.by_displacement += hierarchy.stick_out(node, by_displacement) / radius / nodes;
    sum.really += really_out(hierarchy, node, subject, frame) / nodes;
  }
  return sum;
}

// `gains` has one entry for each subject whose search is repeated under either bound.
std::string bounds_answer(const std::vector<double>& gains, std::size_t subjects) {
  if (gains.empty()) return "Measured displacements never repeat a search at a skin of one radius.";
  const Spread rarer = spread_of(gains);
  return fmt::format(
      "Measured displacements repeat the search for near pairs {} to {} times more rarely than a bound on "
      "speed, at a skin of one radius, on {} of {} chains; on the others they never repeat it.",
      short_decimal(rarer.least), short_decimal(rarer.most), gains.size(), subjects);
}

// Returns the numbers of frames for which this subject can be trusted.
std::vector<std::size_t> frames_trusted(const Subject& subject) {
  std::vector<std::size_t> frames(kFramesTrusted.begin(), kFramesTrusted.end());
  std::erase_if(frames, [&](std::size_t trusted) { return trusted >= subject.frames.size(); });
  return frames;
}

}  // namespace

std::size_t bounds_steps(const MovingSubjects& subjects) { return subjects.size(); }
std::size_t trust_steps(const MovingSubjects& subjects) {
  std::size_t steps = 0;
  for (const NamedSubject& subject : subjects) steps += frames_trusted(subject.subject).size();
  return steps;
}

Question ask_about_bounds(const MovingSubjects& subjects, const std::function<void()>& step_done) {
  Question question;
  std::vector<double> gains;
  question.name = "bounds";
  question.title = "Which bounds on motion make updates rarer?";
  question.columns = {{"skin", "skin, radii"},        {"frames", "frames"},
                      {"speed", "by speed"},          {"displacement", "by displacement"},
                      {"two_largest", "two largest"}, {"without_drift", "and without drift"}};
  question.x_label = "skin, radii";
  question.y_label = "frames a repeated search";
  question.words =
      "A search finds the pairs of beads that are at most the skin apart. The search is repeated when two "
      "beads may have come closer by more than the skin. The figures count the repeated searches after the "
      "first frame. By speed: only the largest distance that any bead moves in a frame is known. By "
      "displacement: the largest displacement of a bead since the search is measured. Two largest: the sum "
      "of the two largest displacements is measured, because two beads approach each other. Without drift: "
      "the mean displacement of all beads, which changes no distance, is subtracted first. Plots leave out "
      "counts of 0.";
  for (const auto& [name, subject] : subjects) {
    const double speed = speed_of(subject), radius = subject.radii.front();
    const auto frames = static_cast<double>(subject.frames.size());
    QuestionCurve by_speed{"", name + ", by speed", {}, {}},
        best{"", name + ", two largest without drift", {}, {}};
    double speed_at_one = 0, best_at_one = 0;  // at a skin of one radius
    for (const double skin : kSkins) {
      const auto found = [&](const auto& nearer) { return times_repeated(subject, skin * radius, nearer); };
      const auto& at = subject.frames;
      const double with_speed = found(
          [&](std::size_t from, std::size_t now) { return 2 * speed * static_cast<double>(now - from); });
      const double displaced = found(
          [&](std::size_t from, std::size_t now) { return 2 * moves(at[from], at[now], false).maxCoeff(); });
      const double two = found(
          [&](std::size_t from, std::size_t now) { return two_largest(moves(at[from], at[now], false)); });
      const double no_drift = found(
          [&](std::size_t from, std::size_t now) { return two_largest(moves(at[from], at[now], true)); });
      question.rows.push_back({name, {skin, frames, with_speed, displaced, two, no_drift}});
      if (with_speed > 0) by_speed.points.emplace_back(skin, frames / with_speed);
      if (no_drift > 0) best.points.emplace_back(skin, frames / no_drift);
      if (skin == 1) {
        speed_at_one = with_speed;
        best_at_one = no_drift;
      }
    }
    if (best_at_one > 0) gains.push_back(speed_at_one / best_at_one);
    question.findings.push_back(fmt::format(
        "{}: at a skin of one radius a bound on speed repeats the search {} times in {} frames; measured "
        "displacements, the two largest without drift, {}.",
        name, speed_at_one, frames,
        best_at_one > 0 ? fmt::format("{} times, {} times more rarely", best_at_one,
                                      short_decimal(speed_at_one / best_at_one))
                        : fmt::format("never: at least {} times more rarely", speed_at_one)));
    question.curves.push_back(std::move(by_speed));
    question.curves.push_back(std::move(best));
    step_done();
  }
  question.answer = bounds_answer(gains, subjects.size());
  return question;
}

Question ask_about_trust(const MovingSubjects& subjects, std::size_t rounds,
                         const std::function<void()>& step_done) {
  Question question;
  std::vector<double> savings, slack;
  question.name = "trust";
  question.title = "How much time is saved if bases are trusted for some frames?";
  question.columns = {{"frames_trusted", "frames trusted"},
                      {"trust_per_verify", "time, trusting / verifying"},
                      {"least", "least"},
                      {"most", "most"},
                      {"by_speed", "out at most, by speed"},
                      {"by_displacement", "by displacement"},
                      {"really", "really"}};
  question.x_label = "frames trusted";
  question.y_label = "how far beads may stick out, share of the radius";
  question.words =
      "The wrapped hierarchy is verified at one frame. Some frames later its spheres are computed from the "
      "same bases without any test, so beads may stick out of them. A bound on speed, or the largest "
      "measured displacement, bounds how far. The table gives these bounds and how far beads really stick "
      "out, as means over all nodes and as shares of the radii. Times are medians of the rounds at one "
      "frame, with the least and the most.";
  for (const auto& [name, subject] : subjects) {
    const double speed = speed_of(subject);
    QuestionCurve by_speed{name, "by speed", {}, {}}, by_displacement{name, "by displacement", {}, {}},
        really{name, "really", {}, {}};
    double saved = 0;
    for (const std::size_t trusted : frames_trusted(subject)) {
      Trusted sum;
      std::size_t looks = 0;
      StaticWrappedHierarchy<3> hierarchy(subject.necklaces);
      for (std::size_t k = 0; k + trusted < subject.frames.size(); k += trusted) {
        const Balls<3> before(subject.frames[k], subject.radii),
            after(subject.frames[k + trusted], subject.radii);
        hierarchy.build(before);
        hierarchy.update(after, Update::trust);
        const Trusted one = looseness(hierarchy, subject, k + trusted, speed * static_cast<double>(trusted),
                                      greatest_move(before, after));
        sum.by_speed += one.by_speed;
        sum.by_displacement += one.by_displacement;
        sum.really += one.really;
        ++looks;
      }
      const auto count = static_cast<double>(looks);
      const Balls<3> first(subject.frames[0], subject.radii), later(subject.frames[trusted], subject.radii);
      const auto ratio_once = [&] {
        hierarchy.build(first);
        const double trusting = processor_seconds_per_call([&] { hierarchy.update(later, Update::trust); });
        hierarchy.build(first);
        const double verifying = processor_seconds_per_call([&] {
                                   hierarchy.update(later);
                                   hierarchy.update(first);
                                 }) /
                                 2;
        return trusting / verifying;
      };
      std::vector<double> ratios;
      for (std::size_t round = 0; round < rounds; ++round) ratios.push_back(ratio_once());
      const Spread ratio = spread_of(ratios);
      question.rows.push_back({name,
                               {static_cast<double>(trusted), ratio.median, ratio.least, ratio.most,
                                sum.by_speed / count, sum.by_displacement / count, sum.really / count}});
      by_speed.points.emplace_back(static_cast<double>(trusted), sum.by_speed / count);
      by_displacement.points.emplace_back(static_cast<double>(trusted), sum.by_displacement / count);
      really.points.emplace_back(static_cast<double>(trusted), sum.really / count);
      if (trusted == 1) saved = 1 / ratio.median;
      step_done();
    }
    savings.push_back(saved);
    slack.push_back(by_displacement.points.front().second / really.points.front().second);
    question.findings.push_back(fmt::format(
        "{}: trusting for one frame is {} times as fast as verifying; beads may stick out by {} of a radius "
        "by the bound on speed and by {} by measured displacements, and really stick out by {} (means).",
        name, short_decimal(saved), short_decimal(by_speed.points.front().second),
        short_decimal(by_displacement.points.front().second), short_decimal(really.points.front().second)));
    for (QuestionCurve* curve : {&by_speed, &by_displacement, &really}) {
      for (const CurveFit& fitted : curve->fits())
        question.findings.push_back(
            fmt::format("{}, {}: grows as frames^{}.", name, curve->name, exponent_text(fitted.fit)));
      question.curves.push_back(std::move(*curve));
    }
  }
  const Spread faster = spread_of(savings), beyond = spread_of(slack);
  question.answer = fmt::format(
      "Spheres of trusted bases are {} to {} times as fast as verified ones; the proved bound of how far "
      "beads stick out after a frame is {} to {} times the true value.",
      short_decimal(faster.least), short_decimal(faster.most), short_decimal(beyond.least),
      short_decimal(beyond.most));
  return question;
}

}  // namespace kds
