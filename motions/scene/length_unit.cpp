#include "motions/scene/length_unit.h"

#include <fmt/format.h>

#include <algorithm>

#include "motions/base/input_error.h"

namespace kds {

std::string nanometres_doubt(const Eigen::Ref<const Eigen::Matrix3Xd>& chain,
                             const std::vector<std::size_t>& breaks) {
  std::vector<double> bonds, turns;  // distances of a bead from the next one, and from the one after it
  for (Eigen::Index i = 0; i + 1 < chain.cols(); ++i) {
    if (std::binary_search(breaks.begin(), breaks.end(), static_cast<std::size_t>(i))) continue;
    bonds.push_back((chain.col(i + 1) - chain.col(i)).stableNorm());
    if (i + 2 < chain.cols()) turns.push_back((chain.col(i + 2) - chain.col(i)).stableNorm());
  }
  if (bonds.size() < 8) return "";
  std::sort(bonds.begin(), bonds.end());
  std::sort(turns.begin(), turns.end());
  const double median = bonds[bonds.size() / 2];
  const auto share = [&](double least, double most) {
    const auto end = std::upper_bound(bonds.begin(), bonds.end(), most);
    return static_cast<double>(end - std::lower_bound(bonds.begin(), end, least)) /
           static_cast<double>(bonds.size());
  };
  const bool atoms = median >= 0.12 && median <= 0.195 && share(0, 0.09) <= 0.01;
  const bool residues = median >= 0.33 && median <= 0.395 && share(0.28, 0.42) >= 0.8;
  const bool is_straight = turns[turns.size() / 2] > 1.95 * median;
  if ((!atoms && !residues) || is_straight) return "";
  return fmt::format(
      "the median bond is {:.3g} angstrom, which fits {} in nanometres; expected {}coordinates in angstrom, "
      "10 "
      "times as large",
      median, atoms ? "bonded atoms" : "C-alpha atoms", words("", "units='nm' for an array, or "));
}

}  // namespace kds
