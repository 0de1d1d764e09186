#include "motions/frames/trajectory.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace kds {

namespace {

struct Bond {
  std::size_t first;  // it joins this bead and the next one
  double length;
};

std::vector<Bond> bonds_of(const Eigen::Ref<const Eigen::Matrix3Xd>& frame,
                           const std::vector<std::size_t>& gaps) {
  std::vector<Bond> bonds;
  for (Eigen::Index i = 0; i + 1 < frame.cols(); ++i)
    if (const auto bead = static_cast<std::size_t>(i); !std::binary_search(gaps.begin(), gaps.end(), bead))
      bonds.push_back({bead, (frame.col(i + 1) - frame.col(i)).stableNorm()});
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
  for (std::size_t k = 0; k < trajectory.frames.size(); k += n) {
    some.frames.push_back(trajectory.frames[k]);
    some.frame_numbers.push_back(trajectory.frame_number(k));
  }
  return some;
}

}  // namespace kds
