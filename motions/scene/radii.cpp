#include "motions/scene/radii.h"

#include <fmt/format.h>
#include <filesystem>

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

// Returns whether two balls of this radius meet, decided exactly.
bool balls_meet(const Ends& centers, double radius) {
  Rational rest = 4 * Dyadic(radius).rational() * Dyadic(radius).rational();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Rational d = Dyadic(centers[1][axis]).rational() - Dyadic(centers[0][axis]).rational();
    rest -= d * d;
  }
  return rest >= 0;
}

std::vector<double> element_radii(const std::string& policy, std::span<const Trajectory> necklaces) {
  std::vector<double> radii;
  for (const Trajectory& necklace : necklaces) {
    if (necklace.element_radii.size() != necklace.bead_count())
      throw InputError(fmt::format(
          "--radius: {} needs the elements of all beads, which {} does not tell; give "
          "--radius auto or a number{}",
          policy, necklace.file,
          std::filesystem::path(necklace.file).filename().string().find(".dcd") != std::string::npos
              ? ", or --topology"
              : ""));
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

std::vector<double> radii_by(const std::string& policy, std::span<const Trajectory> necklaces,
                             const LongestBond& bonds) {
  const std::size_t beads = bead_count(necklaces);
  constexpr std::string_view from_file = "file:";
  if (policy == "auto") return std::vector<double>(beads, bonds.radius());
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

void LongestBond::add(const Eigen::Ref<const Eigen::Matrix3Xd>& frame,
                      const std::vector<std::size_t>& breaks) {
  constexpr double rounding = 0x1p-48;  // well above the relative error of a length
  for (Eigen::Index i = 0; i + 1 < frame.cols(); ++i) {
    if (std::find(breaks.begin(), breaks.end(), static_cast<std::size_t>(i)) != breaks.end()) continue;
    const Ends ends{frame.col(i), frame.col(i + 1)};
    const double length = (ends[1] - ends[0]).stableNorm();
    longest_ = std::isfinite(length) ? std::max(longest_, length) : std::numeric_limits<double>::infinity();
    if (!std::isfinite(longest_)) return;
    if (length / 2 < radius_ * (1 - rounding) || balls_meet(ends, radius_)) continue;
    // Half of a rounded length may leave a gap of half an ulp.
    radius_ = std::max(radius_, length / 2 * (1 - 4 * std::numeric_limits<double>::epsilon()));
    while (!balls_meet(ends, radius_))
      radius_ = std::nextafter(radius_, std::numeric_limits<double>::infinity());
  }
}

double LongestBond::radius() const {
  if (!(longest_ > 0))
    throw InputError(
        "--radius: auto is half the longest bond, and here no bond is longer than 0; give --radius NUMBER");
  if (!std::isfinite(longest_))
    throw InputError(
        "--radius: auto is half the longest bond, and here that is beyond all numbers; "
        "give --radius NUMBER");
  return radius_;
}

std::vector<double> bead_radii(const std::string& policy, std::span<const Trajectory> necklaces,
                               const LongestBond& bonds) {
  std::vector<double> radii = radii_by(policy, necklaces, bonds);
  for (const double radius : radii)
    if (!std::isfinite(radius * radius))
      throw InputError(
          fmt::format("--radius: {} gives {}, whose square (the weight) is beyond all numbers; "
                      "give a smaller one",
                      policy, radius));
  return radii;
}

std::vector<double> bead_radii(const std::string& policy, std::span<const Trajectory> necklaces) {
  LongestBond bonds;
  if (policy == "auto")
    for (const Trajectory& necklace : necklaces)
      for (const Eigen::Matrix3Xd& frame : necklace.frames) bonds.add(frame, necklace.breaks);
  return bead_radii(policy, necklaces, bonds);
}

}  // namespace kds
