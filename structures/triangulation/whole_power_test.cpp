#include "structures/triangulation/whole_power_test.h"

namespace kds {

template <int Dimension>
void WholePowerTest<Dimension>::set_minor(Integer& minor, const Integer& a, const Integer& b,
                                          const Integer& c, const Integer& d) {
  mpz_mul(minor.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  mpz_submul(minor.get_mpz_t(), c.get_mpz_t(), d.get_mpz_t());
}

template <int Dimension>
int WholePowerTest<Dimension>::sign(const std::array<WholePoint<Dimension>, rows + 1>& points) {
  constexpr std::size_t lift = rows - 1;
  const WholePoint<Dimension>& t = points[rows];
  for (std::size_t i = 0; i < rows; ++i) {
    mpz_ptr square = row_[i][lift].get_mpz_t();
    mpz_sub(square, t[lift], points[i][lift]);
    for (std::size_t axis = 0; axis < lift; ++axis) {
      mpz_ptr difference = row_[i][axis].get_mpz_t();
      mpz_sub(difference, points[i][axis], t[axis]);
      mpz_addmul(square, difference, difference);
    }
  }
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = i + 1; j < rows; ++j)
      set_minor(of_pair_[i][j], row_[i][0], row_[j][1], row_[j][0], row_[i][1]);
  }
  // Laplace expansion along the last column and, in space, also along the column before it.
  mpz_set_ui(determinant_.get_mpz_t(), 0);
  for (std::size_t out = 0; out < rows; ++out) {
    std::array<std::size_t, rows - 1> left{};
    for (std::size_t i = 0, next = 0; i < rows; ++i) {
      if (i != out) left[next++] = i;
    }
    mpz_srcptr minor = of_pair_[left[0]][left[1]].get_mpz_t();
    if constexpr (Dimension == 3) {
      mpz_mul(minor_.get_mpz_t(), row_[left[0]][2].get_mpz_t(), of_pair_[left[1]][left[2]].get_mpz_t());
      mpz_submul(minor_.get_mpz_t(), row_[left[1]][2].get_mpz_t(), of_pair_[left[0]][left[2]].get_mpz_t());
      mpz_addmul(minor_.get_mpz_t(), row_[left[2]][2].get_mpz_t(), of_pair_[left[0]][left[1]].get_mpz_t());
      minor = minor_.get_mpz_t();
    }
    const bool even = (out + lift) % 2 == 0;
    (even ? mpz_addmul : mpz_submul)(determinant_.get_mpz_t(), row_[out][lift].get_mpz_t(), minor);
  }
  return sgn(determinant_);
}

template class WholePowerTest<2>;
template class WholePowerTest<3>;

}  // namespace kds
