// The present time may lie anywhere in its bracket: what is proved from now on is proved from before it until
// after it.

#include "kds/proved_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "tests/support/inputs/script.h"

namespace kds::proved_table_test {
namespace {

/// Is proved until a time that the test sets, and notes from when on.
struct ProvedAsToldTo {
  static constexpr CertificateType type{1002, "proved_as_told_to"};
  static inline double until = 1;
  static inline std::vector<double> asked_from;

  BeadId bead = 0;

  [[nodiscard]] Identity identity() const { return identity_of(type, std::array{bead}); }
  template <int Dimension>
  [[nodiscard]] double proved_until(const Curves<Dimension>&, double from) const {
    asked_from.push_back(from);
    return std::max(from, until);
  }
};
static_assert(ProvedCertificate<ProvedAsToldTo, 1>);

/// Watches one certificate when another one fails, and what its own table tells of.
class Prover final : public KineticStructure {
 public:
  Prover(Simulator& simulator, const MotionRef<1>& motion)
      : simulator_(simulator), index_(simulator.add(*this)), table_(simulator, *this, index_, 1, motion) {}

  [[nodiscard]] std::string_view name() const override { return "prover"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override {
    static constexpr std::array<EventKind, 1> kinds{{{"ended"}}};
    return kinds;
  }
  void build() override {}
  void start_step() override {}
  void fail(unsigned table, std::uint32_t slot) override {
    EXPECT_EQ(table, 1U);
    EXPECT_EQ(table_.certificate(slot).bead, 5U);
    EXPECT_EQ(table_.place_in_structure(slot), 3U);
    ended.push_back(simulator_.now().lower());
  }
  void apply(const Change&) override {}
  [[nodiscard]] std::optional<std::string> audit(const Dyadic&) override { return std::nullopt; }

  CertificateHandle watch() { return table_.watch({5}, 3); }

  std::vector<double> ended;

 private:
  Simulator& simulator_;
  std::size_t index_;
  ProvedTable<ProvedAsToldTo, 1> table_;
};

class ProvedTableTest : public testing::Test {
 protected:
  /// Watches where u = 1/3, which no double is, and says what came of it.
  CertificateHandle watch_at_a_third(double until) {
    ProvedAsToldTo::until = until;
    ProvedAsToldTo::asked_from.clear();
    Simulator simulator;
    test::Log log;
    test::Script script{simulator, log, "a"};
    Prover prover(simulator, motion);
    CertificateHandle handle{};
    script.on_start = [&] {
      script.schedule("1/3", test::falling(1, 3), 1, [&] {
        now = {simulator.now().lower(), simulator.now().upper()};
        handle = prover.watch();
      });
    };
    simulator.build();
    simulator.run_step();
    ended = prover.ended;
    EXPECT_LT(now.first, now.second);
    EXPECT_EQ(ProvedAsToldTo::asked_from, std::vector<double>{now.first});
    return handle;
  }

  BezierMotion<1, 1> motion{8};
  std::pair<double, double> now;
  std::vector<double> ended;
};

TEST_F(ProvedTableTest, ProvesFromBeforeThePresentTime) {
  EXPECT_TRUE(has_slot(watch_at_a_third(0.75)));
  EXPECT_EQ(ended, std::vector<double>{0.75});
  EXPECT_EQ(watch_at_a_third(1), CertificateHandle::never);
  EXPECT_TRUE(ended.empty());
}

TEST_F(ProvedTableTest, WhatDoesNotReachBeyondThePresentTimeIsViolated) {
  EXPECT_EQ(watch_at_a_third(0), CertificateHandle::violated);
  EXPECT_EQ(watch_at_a_third(now.second), CertificateHandle::violated);
  EXPECT_TRUE(has_slot(watch_at_a_third(std::nextafter(now.second, 1.0))));
}

}  // namespace
}  // namespace kds::proved_table_test
