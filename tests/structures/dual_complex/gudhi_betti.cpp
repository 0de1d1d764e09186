#include "tests/structures/dual_complex/gudhi_betti.h"

#include <algorithm>
#include <stdexcept>

#ifdef KDS_GUDHI
#include <gudhi/Alpha_complex_3d.h>
#include <gudhi/Persistent_cohomology.h>
#include <gudhi/Simplex_tree.h>
#endif

namespace kds::test {

#ifdef KDS_GUDHI

namespace {

Betti betti_of(Gudhi::Simplex_tree<>& tree) {
  using Field = Gudhi::persistent_cohomology::Field_Zp;
  Gudhi::persistent_cohomology::Persistent_cohomology<Gudhi::Simplex_tree<>, Field> cohomology(tree, true);
  cohomology.init_coefficients(11);
  cohomology.compute_persistent_cohomology();
  Betti betti{};
  for (int dimension = 0; dimension < 3; ++dimension)
    betti[static_cast<std::size_t>(dimension)] = static_cast<std::size_t>(cohomology.betti_number(dimension));
  return betti;
}

}  // namespace

bool has_gudhi() { return true; }

Betti gudhi_betti(std::span<const std::array<BeadId, 4>> simplices) {
  Gudhi::Simplex_tree<> tree;
  for (const auto& beads : simplices)
    tree.insert_simplex_and_subfaces(
        std::vector<int>(beads.begin(), std::find(beads.begin(), beads.end(), no_bead)));
  if (tree.num_simplices() != simplices.size())
    throw std::invalid_argument("a simplex is listed twice, or a face is missing");
  return betti_of(tree);
}

Betti gudhi_betti_of_union(std::span<const ExactPoint> balls) {
  using Alpha = Gudhi::alpha_complex::Alpha_complex_3d<Gudhi::alpha_complex::complexity::EXACT, true>;
  const auto number = [](const Rational& x) { return Alpha::FT(Alpha::FT::ET(x.get_mpq_t())); };
  std::vector<Alpha::Weighted_point_3> points;
  for (const ExactPoint& b : balls)
    points.emplace_back(Alpha::Bare_point_3(number(b[0]), number(b[1]), number(b[2])), number(b[3]));
  Gudhi::Simplex_tree<> tree;
  if (!Alpha(points).create_complex(tree, 0.0)) throw std::invalid_argument("the points lie in one plane");
  return betti_of(tree);
}

#else

bool has_gudhi() { return false; }
Betti gudhi_betti(std::span<const std::array<BeadId, 4>>) { throw std::logic_error("built without GUDHI"); }
Betti gudhi_betti_of_union(std::span<const ExactPoint>) { throw std::logic_error("built without GUDHI"); }

#endif

}  // namespace kds::test
