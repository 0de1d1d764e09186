#include "motions/scene/radii.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

using Necklaces = std::span<const NecklaceBeads>;

std::vector<double> element_radii(const std::string& policy, Necklaces necklaces) {
  std::vector<double> radii;
  for (const NecklaceBeads& necklace : necklaces) {
    if (necklace.element_radii.size() != necklace.count)
      throw InputError("--radius",
                       fmt::format("{} needs the elements of all beads: {}; give {} auto or a number", policy,
                                   necklace.element_lack.empty() ? necklace.file + " names no elements"
                                                                 : necklace.element_lack,
                                   "--radius"_arg));
    radii.insert(radii.end(), necklace.element_radii.begin(), necklace.element_radii.end());
  }
  return radii;
}

std::vector<double> radii_from_file(const std::string& file, std::size_t beads) {
  const std::string text = read_whole_file(file);
  std::vector<double> radii;
  std::string_view rest = text;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = trimmed(next_line(rest));
    if (line.empty()) continue;
    const auto radius = parse_double(line);
    if (!radius || !std::isfinite(*radius) || *radius < 0)
      throw InputError(fmt::format("{}:{}: expected a radius (finite, not negative), found {}", file, number,
                                   in_quotes(line)));
    radii.push_back(*radius);
  }
  if (radii.size() == 1) return std::vector<double>(beads, radii.front());
  if (radii.size() != beads)
    throw InputError(fmt::format("{}: {}, expected one for each of the {} or a single one for all", file,
                                 fmt::format("{} radii", radii.size()), counted(beads, "bead")));
  return radii;
}

struct Ball {
  Eigen::Vector3d centre;
  double radius;
  std::size_t necklace;
  std::size_t bead;  // index within its necklace
};

// Returns the balls of the first frame, from left to right.
std::vector<Ball> sorted_balls(const std::vector<double>& radii, Necklaces necklaces,
                               const Eigen::Matrix3Xd& frame) {
  std::vector<Ball> balls;
  for (std::size_t n = 0; n < necklaces.size(); ++n)
    for (std::size_t i = 0; i < necklaces[n].count; ++i)
      balls.push_back({frame.col(static_cast<Eigen::Index>(balls.size())), radii[balls.size()], n, i});
  std::stable_sort(balls.begin(), balls.end(),
                   [](const Ball& a, const Ball& b) { return a.centre.x() < b.centre.x(); });
  return balls;
}

bool adjacent(const Ball& a, const Ball& b) {
  return a.necklace == b.necklace && (a.bead + 1 == b.bead || b.bead + 1 == a.bead);
}

[[noreturn]] void refuse_coincident(const Ball& a, const Ball& b, Necklaces necklaces) {
  const auto name = [&](const Ball& ball) {
    return fmt::format("bead {} of {}", ball.bead, necklaces[ball.necklace].file);
  };
  const bool in_order = std::pair(a.necklace, a.bead) < std::pair(b.necklace, b.bead);
  throw InputError(
      "--radius",
      fmt::format("element:fit cannot separate {} and {}, which are at one position in the first frame",
                  name(in_order ? a : b), name(in_order ? b : a)));
}

// Returns the radii times one factor, at most 1, such that in the first frame no two beads touch except
// neighbours of one necklace. Throws InputError if two such beads have the same centre.
std::vector<double> fit_radii(std::vector<double> radii, Necklaces necklaces, const Eigen::Matrix3Xd& frame) {
  const std::vector<Ball> balls = sorted_balls(radii, necklaces, frame);
  const double largest = radii.empty() ? 0 : *std::max_element(radii.begin(), radii.end());
  double factor = 2;  // least ratio of distance to sum of radii, over all pairs that touch
  for (std::size_t i = 0; i < balls.size(); ++i)
    for (std::size_t j = i + 1; j < balls.size(); ++j) {
      if (balls[j].centre.x() - balls[i].centre.x() > 2 * largest) break;
      if (adjacent(balls[i], balls[j])) continue;
      const double distance = (balls[j].centre - balls[i].centre).stableNorm();
      const double reach = balls[i].radius + balls[j].radius;
      if (distance > reach) continue;
      if (distance == 0) refuse_coincident(balls[i], balls[j], necklaces);
      factor = std::min(factor, distance / reach);
    }
  if (factor > 1) return radii;
  // Touching counts as contact, so shrink slightly more, well above the rounding of the distances.
  factor *= 1 - 1e-12;
  for (double& radius : radii) radius *= factor;
  return radii;
}

std::vector<double> radii_by(const std::string& policy, Necklaces necklaces, const FrameSurvey& survey) {
  const std::size_t beads = count_beads(necklaces);
  constexpr std::string_view from_file = "file:";
  if (policy == "auto") return std::vector<double>(beads, survey.bonds.radius());
  if (policy == "element" || policy == "array") return element_radii(policy, necklaces);
  if (policy == "element:fit")
    return fit_radii(element_radii(policy, necklaces), necklaces, survey.first_positions);
  if (policy.starts_with(from_file)) return radii_from_file(policy.substr(from_file.size()), beads);
  const auto radius = parse_double(policy);
  if (!radius)
    throw InputError("--radius",
                     fmt::format("expected auto, a number, element, element:fit or file:PATH, found {}",
                                 in_quotes(policy)));
  if (!std::isfinite(*radius) || *radius <= 0)
    throw InputError("--radius",
                     fmt::format("expected a positive finite number, found {}", in_quotes(policy)));
  return std::vector<double>(beads, *radius);
}

}  // namespace

std::vector<double> bead_radii(const std::string& policy, std::span<const NecklaceBeads> necklaces,
                               const FrameSurvey& survey) {
  std::vector<double> radii = radii_by(policy, necklaces, survey);
  for (const double radius : radii)
    if (!std::isfinite(radius * radius))
      throw InputError(
          "--radius",
          fmt::format("{} gives {}, whose square (the weight) is too large for a double; give a smaller one",
                      policy, radius));
  return radii;
}

std::vector<double> bead_radii(const std::string& policy, std::span<const Trajectory> trajectories) {
  std::vector<NecklaceBeads> necklaces;
  for (const Trajectory& trajectory : trajectories) necklaces.push_back(beads_of(trajectory));
  FrameSurvey survey;
  survey.first_positions.resize(3, static_cast<Eigen::Index>(count_beads(necklaces)));
  Eigen::Index first = 0;
  for (const Trajectory& trajectory : trajectories) {
    if (trajectory.frames.empty()) continue;
    survey.first_positions.middleCols(first, trajectory.frames.front().cols()) = trajectory.frames.front();
    first += trajectory.frames.front().cols();
    if (policy != "auto") continue;
    const std::vector<std::size_t> breaks = beads_of(trajectory).breaks;
    for (const Eigen::Matrix3Xd& frame : trajectory.frames) survey.bonds.add(frame, breaks);
  }
  return bead_radii(policy, necklaces, survey);
}

}  // namespace kds
