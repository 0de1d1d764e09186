#include "motions/scene/radii.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/numbers/exact_number.h"
#include "motions/scene/fit_radii.h"

namespace kds {

namespace {

std::size_t bead_count(std::span<const Trajectory> necklaces) {
  std::size_t count = 0;
  for (const Trajectory& necklace : necklaces) count += necklace.bead_count();
  return count;
}

using Ends = std::array<Eigen::Vector3d, 2>;

// Calls visit(ends, rounded length) for every bond of every frame; a chain break is no bond.
template <class Visit>
void visit_bonds(std::span<const Trajectory> necklaces, const Visit& visit) {
  for (const Trajectory& necklace : necklaces) {
    const auto& breaks = necklace.breaks;
    for (const Eigen::Matrix3Xd& frame : necklace.frames)
      for (Eigen::Index i = 0; i + 1 < frame.cols(); ++i) {
        if (std::find(breaks.begin(), breaks.end(), static_cast<std::size_t>(i)) != breaks.end()) continue;
        const Ends ends{frame.col(i), frame.col(i + 1)};
        visit(ends, (ends[1] - ends[0]).stableNorm());
      }
  }
}

// Whether two balls of this radius meet, decided exactly.
bool balls_meet(const Ends& centers, double radius) {
  Rational rest = 4 * Dyadic(radius).rational() * Dyadic(radius).rational();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Rational d = Dyadic(centers[1][axis]).rational() - Dyadic(centers[0][axis]).rational();
    rest -= d * d;
  }
  return rest >= 0;
}

// The least double of which consecutive beads meet: half of a rounded length may leave a gap of half an ulp.
double automatic_radius(std::span<const Trajectory> necklaces) {
  double longest = 0;
  visit_bonds(necklaces, [&](const Ends&, double length) { longest = std::max(longest, length); });
  if (!(longest > 0))
    throw InputError(
        "--radius: auto is half the longest bond, and here no bond is longer than 0; give --radius NUMBER");
  if (!std::isfinite(longest))
    throw InputError(
        "--radius: auto is half the longest bond, and here that is beyond all numbers; "
        "give --radius NUMBER");
  constexpr double rounding = 0x1p-48;  // well above the relative error of a length
  double radius = longest / 2 * (1 - rounding);
  visit_bonds(necklaces, [&](const Ends& ends, double length) {
    if (length < longest * (1 - 2 * rounding) || balls_meet(ends, radius)) return;
    radius = std::max(radius, length / 2 * (1 - 4 * std::numeric_limits<double>::epsilon()));
    while (!balls_meet(ends, radius)) radius = std::nextafter(radius, longest);
  });
  return radius;
}

std::vector<double> element_radii(const std::string& policy, std::span<const Trajectory> necklaces) {
  std::vector<double> radii;
  for (const Trajectory& necklace : necklaces) {
    if (necklace.element_radii.size() != necklace.bead_count())
      throw InputError(
          fmt::format("--radius: {} needs the elements of all beads, which {} does not tell; give "
                      "--radius auto or a number{}",
                      policy, necklace.file, necklace.file.ends_with(".dcd") ? ", or --topology" : ""));
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

std::vector<double> radii_by(const std::string& policy, std::span<const Trajectory> necklaces) {
  const std::size_t beads = bead_count(necklaces);
  constexpr std::string_view from_file = "file:";
  if (policy == "auto") return std::vector<double>(beads, automatic_radius(necklaces));
  if (policy == "element") return element_radii(policy, necklaces);
  if (policy == "element:fit") return fit_radii(element_radii(policy, necklaces), necklaces);
  if (policy.starts_with(from_file)) return radii_from_file(policy.substr(from_file.size()), beads);
  const auto radius = parse_double(policy);
  if (!radius)
    throw InputError(fmt::format(
        "--radius: expected auto, a number, element, element:fit or file:PATH, found {}", in_quotes(policy)));
  if (!std::isfinite(*radius) || *radius <= 0)
    throw InputError(fmt::format("--radius: expected a positive finite number, found {}", in_quotes(policy)));
  return std::vector<double>(beads, *radius);
}

}  // namespace

std::vector<double> bead_radii(const std::string& policy, std::span<const Trajectory> necklaces) {
  std::vector<double> radii = radii_by(policy, necklaces);
  for (const double radius : radii)
    if (!std::isfinite(radius * radius))
      throw InputError(
          fmt::format("--radius: {} gives {}, whose square (the weight) is beyond all numbers; "
                      "give a smaller one",
                      policy, radius));
  return radii;
}

}  // namespace kds
