#include "motions/frames/trajectory.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace kds {

namespace {

struct Bond {
  std::size_t first;  // it joins this bead and the next one
  double length;
};

/// Calls `visit(first, vector)` for each bond, which joins bead `first` to the next one.
template <class Visit>
void for_bonds(const Eigen::Ref<const Eigen::Matrix3Xd>& frame, const std::vector<std::size_t>& gaps,
               Visit visit) {
  auto gap = gaps.begin();
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(frame.cols()); ++i) {
    while (gap != gaps.end() && *gap < i) ++gap;
    if (gap != gaps.end() && *gap == i) continue;
    const auto column = static_cast<Eigen::Index>(i);
    visit(i, Eigen::Vector3d(frame.col(column + 1) - frame.col(column)));
  }
}

/// Returns whether the bonds are certainly so alike that none is 1.5 times as long as another. Most frames
/// are, and this is told without square roots.
bool are_bonds_alike(const Eigen::Ref<const Eigen::Matrix3Xd>& frame, const std::vector<std::size_t>& gaps) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for_bonds(frame, gaps, [&](std::size_t, const Eigen::Vector3d& bond) {
    const double squared = bond.squaredNorm();
    least = std::min(least, squared);
    most = std::max(most, squared);
  });
  // Squares outside these bounds may have lost digits.
  return least > 1e-280 && most < 1e280 && most < 2.24 * least;
}

std::vector<Bond> bonds_of(const Eigen::Ref<const Eigen::Matrix3Xd>& frame,
                           const std::vector<std::size_t>& gaps) {
  std::vector<Bond> bonds;
  for_bonds(frame, gaps, [&](std::size_t first, const Eigen::Vector3d& bond) {
    bonds.push_back({first, bond.stableNorm()});
  });
  return bonds;
}

double median(std::vector<double> values) {
  const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), upper, values.end());
  if (values.size() % 2 == 1) return *upper;
  return (*std::max_element(values.begin(), upper) + *upper) / 2;
}

}  // namespace

std::vector<std::size_t> find_chain_breaks(const Eigen::Ref<const Eigen::Matrix3Xd>& frame,
                                           const std::vector<std::size_t>& gaps) {
  std::vector<std::size_t> breaks;
  if (are_bonds_alike(frame, gaps)) return breaks;
  const std::vector<Bond> bonds = bonds_of(frame, gaps);
  if (bonds.size() < 2) return breaks;
  std::vector<double> lengths;
  for (const Bond& bond : bonds) lengths.push_back(bond.length);
  const double longest_bond = 1.5 * median(std::move(lengths));
  if (longest_bond == 0) return breaks;  // most beads coincide, so there is no typical bond length
  for (const Bond& bond : bonds)
    if (bond.length > longest_bond) breaks.push_back(bond.first);
  return breaks;
}

std::string describe_chain_breaks(const std::string& file, const std::vector<std::size_t>& breaks) {
  constexpr std::size_t most_named = 10;
  const std::size_t named = std::min(most_named, breaks.size());
  const auto end = breaks.begin() + static_cast<std::ptrdiff_t>(named);
  std::string text = fmt::format("{}: chain {} after {} {}", file, breaks.size() == 1 ? "break" : "breaks",
                                 breaks.size() == 1 ? "bead" : "beads", fmt::join(breaks.begin(), end, ", "));
  if (breaks.size() > named) text += fmt::format(" and {} more", breaks.size() - named);
  return text + " (joined)";
}

Trajectory every_nth(const Trajectory& trajectory, std::size_t n) {
  Trajectory some = trajectory;
  if (n == 1 || trajectory.frames.size() == 1) return some;
  some.frames.clear();
  some.frame_numbers.clear();
  some.times.clear();
  some.cells.clear();
  for (std::size_t k = 0; k < trajectory.frames.size(); k += n) {
    some.frames.push_back(trajectory.frames[k]);
    some.frame_numbers.push_back(trajectory.frame_number(k));
    if (!trajectory.cells.empty()) some.cells.push_back(trajectory.cells[k]);
  }
  return some;
}

}  // namespace kds
