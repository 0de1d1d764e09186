// A user-defined certificate type of eight beads, more than any type of the framework: two cages of four
// beads are apart along the first axis as long as their centroids are in order.

#include <gmock/gmock.h>

#include <array>
#include <memory>
#include <random>

#include "certificates/search/define_certificate_search.h"
#include "kds/certificate_table.h"
#include "motions/curves/bezier_motion.h"
#include "tests/support/searches.h"

namespace kds::user_certificate_test {
namespace {

struct CagesInOrder {
  static constexpr CertificateType type{1000, "cages_in_order"};

  std::array<BeadId, 8> beads{};

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }
  [[nodiscard]] bool side() const { return true; }
  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 8>& b) {
    auto sum = view.difference(b[4], b[0])[0];
    for (std::size_t i = 1; i < 4; ++i) sum += view.difference(b[4 + i], b[i])[0];
    return sum;
  }
};
static_assert(CertificateFor<CagesInOrder, BezierMotion<2, 1>>);

constexpr std::array<BeadId, 8> in_a_row{0, 1, 2, 3, 4, 5, 6, 7};

/// Makes cages of width 2 whose centroids move from 0 to 6 and from 3 to 1. The two meet where 6 u = 3 - 2 u.
template <class M>
M crossing_cages(M motion, int degree) {
  for (BeadId b = 0; b < 8; ++b) {
    const double place = 2.0 / 3 * (b % 4) - 1;
    for (int k = 0; k <= degree; ++k) {
      const double u = static_cast<double>(k) / degree;
      motion.set_coordinate(b, k, 0, place + (b < 4 ? 6 * u : 3 - 2 * u));
      motion.set_coordinate(b, k, 1, b);
    }
  }
  return motion;
}

class Cages final : public KineticStructure {
 public:
  Cages(Simulator& simulator, const MotionRef<2>& motion)
      : simulator_(simulator), index_(simulator.add(*this)), table_(simulator, *this, index_, 1, motion) {}

  [[nodiscard]] std::string_view name() const override { return "cages"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override {
    static constexpr std::array<EventKind, 1> kinds{{{"passed"}}};
    return kinds;
  }
  void build() override { passed = 0; }
  void start_step() override { handle_ = table_.watch({in_a_row}, 0); }
  void fail(unsigned, std::uint32_t slot) override {
    EXPECT_EQ(table_.identity(slot).beads, in_a_row);
    time = table_.certificate(slot).beads == in_a_row ? simulator_.now().lower() : -1;
    ++passed;
    simulator_.record(index_, {0, 1, {7}});
  }
  void apply(const Change&) override {}
  [[nodiscard]] std::optional<std::string> audit(const Dyadic&) override { return std::nullopt; }

  int passed = 0;
  double time = 0;

 private:
  Simulator& simulator_;
  std::size_t index_;
  CertificateTable<CagesInOrder> table_;
  CertificateHandle handle_{};
};

template <class M>
void expect_passing(const M& motion) {
  for (const Kernel kernel : test::all_kernels) {
    SCOPED_TRACE(name_of(kernel));
    Simulator simulator(AuditMode::none, kernel);
    Cages cages(simulator, motion);
    simulator.build();
    simulator.run_step();
    simulator.finish();
    EXPECT_EQ(cages.passed, 1);
    EXPECT_NEAR(cages.time, 0.375, 1e-9);
    EXPECT_EQ(cages.statistics.certificates.failed, 1U);
  }
}

TEST(UserCertificates, OfEightBeadsRunInAQueue) {
  expect_passing(crossing_cages(BezierMotion<2, 1>(8), 1));
  expect_passing(crossing_cages(BezierMotion<2, 3>(8), 3));
  expect_passing(crossing_cages(AnyDegreeMotion<2>(8, 5), 5));
}

TEST(UserCertificates, OfEightBeadsAreNamedByAllOfThem) {
  auto others = in_a_row;
  others[7] = 8;
  EXPECT_NE(CagesInOrder{in_a_row}.identity(), CagesInOrder{others}.identity());
  EXPECT_LT(CagesInOrder{in_a_row}.identity(), CagesInOrder{others}.identity());
  EXPECT_EQ(CagesInOrder{in_a_row}.identity().beads, in_a_row);
}

}  // namespace
}  // namespace kds::user_certificate_test
