#include "motions/frames/periodic.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

namespace kds {

namespace {

// A Minkowski-reduced basis of at most three vectors. The vectors are sorted by length, and no vector becomes
// shorter by adding whole multiples of the vectors before it. Columns beyond `rank` are zero. (Semaev 2001:
// for three vectors this greedy reduction ends in a Minkowski-reduced basis.)
struct ReducedBasis {
  Eigen::Matrix3d steps = Eigen::Matrix3d::Zero();  // whole multiples of the cell's vectors
  Eigen::Matrix3d vectors = Eigen::Matrix3d::Zero();
  Eigen::Index rank = 0;
};

class LatticeReduction {
 public:
  explicit LatticeReduction(const Cell& cell) : cell_(cell) {
    for (Eigen::Index i = 0; i < 3; ++i)
      if (!cell.col(i).isZero(0)) basis_.steps(i, basis_.rank++) = 1;
    basis_.vectors = cell_ * basis_.steps;
  }

  ReducedBasis reduce() {
    constexpr int most_rounds = 1000;  // a few suffice for any cell with enough precision
    for (int round = 0; round < most_rounds; ++round) {
      sort();
      bool shorter = basis_.rank > 1 && shorten(1);
      if (!shorter) shorter = basis_.rank > 2 && shorten(2);
      if (!shorter) break;
    }
    return basis_;
  }

 private:
  void sort() {
    for (Eigen::Index i = 1; i < basis_.rank; ++i)
      for (Eigen::Index j = i; j > 0 && length(j) < length(j - 1); --j) {
        basis_.steps.col(j).swap(basis_.steps.col(j - 1));
        basis_.vectors.col(j).swap(basis_.vectors.col(j - 1));
      }
  }

  double length(Eigen::Index i) const { return basis_.vectors.col(i).squaredNorm(); }

  // Replaces vector `last` by the shortest of its sums with multiples of the vectors before it.
  bool shorten(Eigen::Index last) {
    const auto before = basis_.vectors.leftCols(last);
    const Eigen::MatrixXd gram = before.transpose() * before;
    const Eigen::VectorXd multiples = gram.inverse() * (before.transpose() * basis_.vectors.col(last));
    if (!multiples.allFinite()) return false;
    Eigen::Vector3d best = basis_.steps.col(last);
    double least = length(last) * (1 - 1e-12);
    bool found = false;
    for (int i = -1; i <= 1; ++i)
      for (int j = last == 2 ? -1 : 0; j <= (last == 2 ? 1 : 0); ++j) {
        Eigen::Vector3d steps = basis_.steps.col(last) - (std::round(multiples[0]) + i) * basis_.steps.col(0);
        if (last == 2) steps -= (std::round(multiples[1]) + j) * basis_.steps.col(1);
        const double now = (cell_ * steps).squaredNorm();
        if (!(now < least)) continue;
        least = now;
        best = steps;
        found = true;
      }
    basis_.steps.col(last) = best;
    basis_.vectors.col(last) = cell_ * best;
    return found;
  }

  Cell cell_;
  ReducedBasis basis_;
};

// The reduced vectors of a lattice are nearly at right angles: their volume is at least the product of
// their lengths over the square root of 2. Linearly dependent vectors have a smaller volume.
bool is_independent(const ReducedBasis& basis) {
  const Eigen::Matrix3d& v = basis.vectors;
  const double lengths = v.leftCols(basis.rank).colwise().norm().prod();
  const double volume = basis.rank == 1   ? v.col(0).norm()
                        : basis.rank == 2 ? v.col(0).cross(v.col(1)).norm()
                                          : std::abs(v.determinant());
  return std::isfinite(lengths) && volume > lengths / 2;
}

std::string doubt_of(const Eigen::Vector3d& lengths, std::string_view expected) {
  return fmt::format("expected {}, found vectors of lengths {:.6g}, {:.6g}, {:.6g}", expected, lengths[0],
                     lengths[1], lengths[2]);
}

// Returns whether the lengths mean that there is no cell: files without one write zeros or ones.
bool tells_no_cell(const Eigen::Vector3d& lengths) {
  return lengths.minCoeff() >= 0 && lengths.maxCoeff() <= 1;
}

// Returns whether a vector of this length may span a cell. Beyond 1e8 the rounding of a skewed cell may
// exceed its shortest vector, and the search for the nearest image might take a step for each unit of length.
bool is_length_of_cell(double length) { return length > 1 && length < 1e8; }

// Returns the sum of the deviations of the logarithms of bond lengths from their median.
double unlikeness(const Eigen::Matrix3Xd& chain) {
  std::vector<double> logs;
  for (Eigen::Index i = 0; i + 1 < chain.cols(); ++i)
    logs.push_back(std::log(std::max((chain.col(i + 1) - chain.col(i)).stableNorm(), 1e-6)));
  const auto middle = logs.begin() + static_cast<std::ptrdiff_t>(logs.size() / 2);
  std::nth_element(logs.begin(), middle, logs.end());
  const double median = *middle;
  return std::accumulate(logs.begin(), logs.end(), 0.0,
                         [&](double sum, double log) { return sum + std::abs(log - median); });
}

bool are_bonds_more_alike(const Eigen::Matrix3Xd& whole, const Eigen::Matrix3Xd& before) {
  const double rounding = 1e-9 * static_cast<double>(whole.cols());
  return unlikeness(whole) < unlikeness(before) - rounding;
}

}  // namespace

Images::Images(const Cell& cell) : cell_(cell) {
  const ReducedBasis basis = LatticeReduction(cell).reduce();
  reduced_ = basis.vectors;
  steps_ = basis.steps;
  inverse_.setZero();
  if (basis.rank == 3) {
    inverse_ = reduced_.inverse();
  } else if (basis.rank > 0) {
    const Eigen::MatrixXd spanned = reduced_.leftCols(basis.rank);
    inverse_.topRows(basis.rank) = (spanned.transpose() * spanned).inverse() * spanned.transpose();
  }
  upright_ = cell_ == Cell(cell_.diagonal().asDiagonal());
}

Eigen::Vector3d Images::nearest(const Eigen::Vector3d& difference) const {
  const Eigen::Vector3d guess = -(inverse_ * difference).array().round().matrix();
  // No real file has beads that far off, and the sums below would lose precision.
  if (!(guess.cwiseAbs().maxCoeff() < 1e6)) return Eigen::Vector3d::Zero();
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double shortest = difference.squaredNorm();
  const auto take_if_shorter = [&](const Eigen::Vector3d& shift) {
    const double length = (difference + reduced_ * shift).squaredNorm();
    if (!(length < shortest)) return false;
    shortest = length;
    best = shift;
    return true;
  };
  take_if_shorter(guess);
  for (bool found = !upright_; found;) {
    found = false;
    const Eigen::Vector3d from = best;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (take_if_shorter(from + Eigen::Vector3d(i, j, k))) found = true;
  }
  return steps_ * best;
}

Eigen::Vector3d Images::shifted(const Eigen::Vector3d& point, const Eigen::Vector3d& shift) const {
  if (shift.isZero(0)) return point;
  return point + cell_ * shift;
}

bool is_space_group_p1(std::string_view group) {
  std::string letters;
  for (const char c : group)
    if (c != ' ' && c != '\t') letters += c;
  return letters == "P1" || letters == "p1";
}

CellRead read_cell(const Eigen::Matrix3d& vectors, const std::array<bool, 3>& periodic) {
  Cell cell = Cell::Zero();
  Eigen::Vector3d lengths;
  std::vector<double> of_periodic;
  for (Eigen::Index i = 0; i < 3; ++i) {
    lengths[i] = vectors.col(i).stableNorm();
    if (!periodic[static_cast<std::size_t>(i)]) continue;
    cell.col(i) = vectors.col(i);
    of_periodic.push_back(lengths[i]);
  }
  if (of_periodic.empty() || (lengths.allFinite() && tells_no_cell(lengths))) return {};
  constexpr std::string_view expected = "linearly independent vectors longer than 1 and shorter than 1e8";
  const bool usable = cell.allFinite() && std::ranges::all_of(of_periodic, is_length_of_cell);
  if (!usable) return {std::nullopt, doubt_of(lengths, expected)};
  const ReducedBasis basis = LatticeReduction(cell).reduce();
  if (!is_independent(basis) || !(basis.vectors.col(0).norm() > 1))
    return {std::nullopt, doubt_of(lengths, expected)};
  return {cell, ""};
}

CellRead read_cell_from_lengths(const Eigen::Vector3d& lengths, const Eigen::Vector3d& cosines) {
  if (lengths.allFinite() && tells_no_cell(lengths)) return {};
  if (!(is_length_of_cell(lengths.minCoeff()) && is_length_of_cell(lengths.maxCoeff())))
    return {std::nullopt, doubt_of(lengths, "lengths above 1 and below 1e8")};
  const auto [cos_alpha, cos_beta, cos_gamma] = std::array{cosines[0], cosines[1], cosines[2]};
  const double sin_gamma = std::sqrt(1 - cos_gamma * cos_gamma);
  const double y = (cos_alpha - cos_beta * cos_gamma) / sin_gamma;
  const double z = std::sqrt(1 - cos_beta * cos_beta - y * y);
  if (!cosines.allFinite() || !(sin_gamma > 1e-3 && z > 1e-3))  // also false for NaN
    return {std::nullopt,
            doubt_of(lengths, fmt::format("angles that span a volume, not of cosines {:.6g}, {:.6g}, {:.6g}",
                                          cos_alpha, cos_beta, cos_gamma))};
  Cell cell;
  cell << lengths[0], lengths[1] * cos_gamma, lengths[2] * cos_beta,  //
      0, lengths[1] * sin_gamma, lengths[2] * y,                      //
      0, 0, lengths[2] * z;
  return read_cell(cell);
}

CellRead read_cell_from_angles(const Eigen::Vector3d& lengths, const Eigen::Vector3d& degrees) {
  const bool possible = degrees.minCoeff() > 0 && degrees.maxCoeff() < 180;  // false for NaN
  if (!possible && !(lengths.allFinite() && tells_no_cell(lengths)))
    return {std::nullopt, fmt::format("expected angles from 0 to 180 degrees, found {:.6g}, {:.6g}, {:.6g}",
                                      degrees[0], degrees[1], degrees[2])};
  const auto cosine = [](double angle) {
    return angle == 90 ? 0.0 : std::cos(angle * std::numbers::pi / 180);
  };
  return read_cell_from_lengths(lengths, {cosine(degrees[0]), cosine(degrees[1]), cosine(degrees[2])});
}

ImageBeside nearest_image_beside(const Eigen::Matrix3Xd& others, const Eigen::Matrix3Xd& chain,
                                 const Cell& cell) {
  constexpr double most_pairs = 4e6;
  const double pairs = static_cast<double>(others.cols()) * static_cast<double>(chain.cols());
  const auto every = static_cast<Eigen::Index>(std::ceil(std::sqrt(std::max(pairs / most_pairs, 1.0))));
  const Images images(cell);
  ImageBeside beside;
  beside.distance = beside.present = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < chain.cols(); i += every)
    for (Eigen::Index j = 0; j < others.cols(); j += every) {
      const Eigen::Vector3d difference = chain.col(i) - others.col(j);
      beside.present = std::min(beside.present, difference.norm());
      const Eigen::Vector3d shift = images.nearest(difference);
      const double distance = images.shifted(difference, shift).norm();
      if (!(distance < beside.distance)) continue;
      beside.distance = distance;
      beside.shift = shift;
    }
  return beside;
}

std::optional<ImageBeside> EarlierNecklaces::nearer_image(const Eigen::Matrix3Xd& chain,
                                                          const std::optional<Cell>& cell) const {
  if (!cell) return std::nullopt;
  const auto found =
      std::find_if(cells_.begin(), cells_.end(), [&](const InCell& in) { return in.cell == *cell; });
  if (found == cells_.end()) return std::nullopt;
  const std::vector<double>& numbers = found->coordinates;
  const Eigen::Matrix3Xd others =
      Eigen::Map<const Eigen::Matrix3Xd>(numbers.data(), 3, static_cast<Eigen::Index>(numbers.size() / 3));
  const ImageBeside beside = nearest_image_beside(others, chain, *cell);
  if (beside.shift.isZero(0) || !(beside.distance < beside.present)) return std::nullopt;
  return beside;
}

void EarlierNecklaces::add(const Eigen::Matrix3Xd& chain, const std::optional<Cell>& cell) {
  if (!cell) return;
  auto found = std::find_if(cells_.begin(), cells_.end(), [&](const InCell& in) { return in.cell == *cell; });
  if (found == cells_.end()) found = cells_.insert(cells_.end(), {*cell, {}});
  found->coordinates.insert(found->coordinates.end(), chain.data(), chain.data() + chain.size());
}

std::optional<LongerThanCell> longer_than_cell(const Eigen::Ref<const Eigen::Matrix3Xd>& chain,
                                               const Cell& cell) {
  constexpr double rounding = 1.01;  // coordinates in files are rounded, and the cell may be of another step
  const Images images(cell);
  std::optional<LongerThanCell> longer;
  for (Eigen::Index i = 0; i < 3 && !longer; ++i) {
    if (images.reduced().col(i).isZero(0)) continue;
    const Eigen::Vector3d along = images.reduced().col(i).normalized();
    const Eigen::RowVectorXd offsets = along.transpose() * chain;
    const double length = offsets.maxCoeff() - offsets.minCoeff();
    // Beads may be put into the cell of either basis, so take the longer one.
    const double most = std::max((along.transpose() * images.reduced()).cwiseAbs().sum(),
                                 (along.transpose() * cell).cwiseAbs().sum());
    if (length > rounding * most) longer = LongerThanCell{length, most};
  }
  if (!longer) return std::nullopt;
  for (Eigen::Index i = 0; i + 1 < chain.cols(); ++i)
    if (!images.nearest(chain.col(i + 1) - chain.col(i)).isZero(0)) return std::nullopt;
  return longer;
}

WholeChain::Outcome WholeChain::make_whole(Frame frame, const std::optional<Cell>& cell) {
  if (!cell || frame.cols() == 0) {
    last_centroid_.reset();
    return Outcome::unmoved;
  }
  return make_whole(frame, Images(*cell));
}

WholeChain::Outcome WholeChain::make_whole(Frame frame, const Images& images) {
  Eigen::Matrix3Xd shifts = Eigen::Matrix3Xd::Zero(3, frame.cols());
  Eigen::Matrix3Xd whole = frame;
  bool joined = false;
  for (Eigen::Index i = 1; i < frame.cols(); ++i) {
    const Eigen::Vector3d before = images.shifted(frame.col(i), shifts.col(i - 1));
    const Eigen::Vector3d step = images.nearest(before - whole.col(i - 1));
    joined = joined || !step.isZero(0);
    shifts.col(i) = shifts.col(i - 1) + step;
    whole.col(i) = images.shifted(frame.col(i), shifts.col(i));
  }
  if (joined && frame.cols() > 2 && !are_bonds_more_alike(whole, frame)) {
    last_centroid_ = frame.rowwise().mean();
    return Outcome::doubtful;
  }
  const Eigen::Vector3d all =
      last_centroid_ ? images.nearest(whole.rowwise().mean() - *last_centroid_) : start_;
  if (!all.isZero(0)) {
    shifts.colwise() += all;
    for (Eigen::Index i = 0; i < frame.cols(); ++i)
      whole.col(i) = images.shifted(frame.col(i), shifts.col(i));
  }
  frame = whole;
  last_centroid_ = frame.rowwise().mean();
  return joined ? Outcome::joined : all == start_ ? Outcome::unmoved : Outcome::shifted;
}

Cell continued(const Cell& cell, const Cell& before) {
  Eigen::FullPivLU<Cell> lu(cell);
  if (!lu.isInvertible()) return cell;
  const Cell multiples = lu.solve(before).array().round().matrix();
  if (multiples == Cell::Identity() || std::abs(std::abs(multiples.determinant()) - 1) > 0.5) return cell;
  return cell * multiples;
}

void UnwrappedBeads::follow(WholeChain::Frame frame, const Cell& cell) {
  const Images images(cell);
  if (last_.cols() != frame.cols()) {
    shifts_ = Eigen::Matrix3Xd::Zero(3, frame.cols());
    last_ = frame;
    for (Eigen::Index bead = 1; bead < frame.cols() && !joined_.empty(); ++bead) {
      if (!joined_[static_cast<std::size_t>(bead)]) continue;
      shifts_.col(bead) = images.nearest(last_.col(bead) - frame.col(bead - 1));
      frame.col(bead) = images.shifted(last_.col(bead), shifts_.col(bead));
    }
    return;
  }
  for (Eigen::Index bead = 0; bead < frame.cols(); ++bead) {
    const Eigen::Vector3d now = frame.col(bead);
    shifts_.col(bead) += images.nearest(now - last_.col(bead));
    last_.col(bead) = now;
    frame.col(bead) = images.shifted(now, shifts_.col(bead));
  }
}

SequenceInCell sequence_in_cell(const Eigen::Ref<const Eigen::Matrix3Xd>& beads, const Cell& cell) {
  if (beads.cols() < 8) return SequenceInCell::chain;
  const Images images(cell);
  std::vector<double> lengths;
  for (Eigen::Index i = 1; i < beads.cols(); ++i) {
    lengths.push_back(images.shortest(beads.col(i) - beads.col(i - 1)).norm());
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  const double third = images.reduced().col(0).norm() / 3;
  if (*middle > third) return SequenceInCell::fluid;
  return *std::max_element(middle, lengths.end()) > third ? SequenceInCell::several_chains
                                                          : SequenceInCell::chain;
}

}  // namespace kds
