// Runs of certificate tables with constants, for the pairs within a cutoff of examples/new_structure.h.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "certificates/search/define_certificate_search.h"
#include "examples/new_structure.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/searches.h"

namespace kds::table_constants_test {
namespace {

using test::MotionKind;
using test::Random;

/// A slow and obvious reference: compares rational distances at the end of the step.
template <Motion M>
std::vector<std::array<BeadId, 2>> pairs_at_end(const M& motion, double cutoff) {
  std::vector<std::array<BeadId, 2>> pairs;
  for (BeadId b = 1; b < motion.bead_count(); ++b) {
    for (BeadId a = 0; a < b; ++a) {
      Rational left = Rational(cutoff) * Rational(cutoff);
      for (int axis = 0; axis < M::dimension; ++axis) {
        const Rational d =
            Rational(motion.coordinate(a, M::degree, axis)) - Rational(motion.coordinate(b, M::degree, axis));
        left -= d * d;
      }
      if (left > 0) pairs.push_back({a, b});
    }
  }
  return pairs;
}

/// Returns the cutoffs at the control points of the given step. Consecutive steps agree at their common
/// frame.
std::vector<double> cutoffs(int degree, int step) {
  std::vector<double> cutoff(static_cast<std::size_t>(degree) + 1, 1.25);
  cutoff.front() = step % 2 == 0 ? 0.5 : 2;
  cutoff.back() = step % 2 == 0 ? 2 : 0.5;
  return cutoff;
}

/// Makes steps, each of which starts where the step before ends.
template <Motion M>
std::vector<M> steps_of(Random& random, std::size_t beads, MotionKind kind, int count) {
  std::vector<M> steps;
  for (int step = 0; step < count; ++step) {
    steps.push_back(test::random_motion<M>(random, beads, kind));
    if (step == 0) continue;
    for (BeadId b = 0; b < beads; ++b)
      for (int axis = 0; axis < M::dimension; ++axis)
        steps.back().set_coordinate(b, 0, axis, steps[steps.size() - 2].coordinate(b, M::degree, axis));
  }
  return steps;
}

template <Motion M>
std::uint64_t fingerprint(Kernel kernel, const std::vector<M>& steps) {
  M motion = steps[0];
  Simulator simulator(AuditMode::events, kernel);
  NeighborPairs<M::dimension> neighbors(simulator, motion);
  for (std::size_t step = 0; step < steps.size(); ++step) {
    motion = steps[step];
    const auto cutoff = cutoffs(M::degree, static_cast<int>(step));
    neighbors.set_cutoff(Constant<1>(cutoff));
    if (step == 0) simulator.build();
    simulator.run_step();
    // A pair exactly at the cutoff at the end may change in the next step.
    auto expected = pairs_at_end(motion, cutoff.back());
    std::vector<std::array<BeadId, 2>> missing;
    const auto found = neighbors.pairs();
    for (const auto& pair : expected)
      if (std::find(found.begin(), found.end(), pair) == found.end()) missing.push_back(pair);
    EXPECT_THAT(missing, testing::IsEmpty());
    const auto reached = pairs_at_end(motion, std::nextafter(cutoff.back(), 3));
    for (const auto& pair : found) EXPECT_THAT(reached, testing::Contains(pair));
  }
  simulator.finish();
  EXPECT_GT(neighbors.statistics.certificates.created, 0U);
  return simulator.fingerprint();
}

template <Motion M>
void expect_one_history(MotionKind kind, std::size_t beads) {
  Random random(2121);
  const auto steps = steps_of<M>(random, beads, kind, 3);
  const std::uint64_t history = fingerprint(Kernel::filtered, steps);
  EXPECT_EQ(fingerprint(Kernel::exact, steps), history);
}

TEST(TableConstants, KernelsHaveOneHistory) {
  expect_one_history<BezierMotion<3, 1>>(MotionKind::generic, 12);
  expect_one_history<BezierMotion<2, 1>>(MotionKind::generic, 12);
  expect_one_history<BezierMotion<3, 3>>(MotionKind::generic, 8);
  expect_one_history<BezierMotion<2, 3>>(MotionKind::generic, 8);
}

TEST(TableConstants, DegenerateMotionIsAuditedToo) {
  for (const MotionKind kind : {MotionKind::grid, MotionKind::coincident, MotionKind::at_rest}) {
    expect_one_history<BezierMotion<2, 1>>(kind, 8);
    expect_one_history<BezierMotion<3, 3>>(kind, 5);
  }
}

TEST(TableConstants, OneBeadHasNoPairs) {
  BezierMotion<3, 1> motion(1);
  Simulator simulator(AuditMode::events);
  NeighborPairs<3> neighbors(simulator, motion);
  neighbors.set_cutoff(1);
  simulator.build();
  simulator.run_step();
  EXPECT_THAT(neighbors.pairs(), testing::IsEmpty());
}

/// Structures of one type with different cutoffs.
TEST(TableConstants, OtherConstantsAreOtherFunctions) {
  BezierMotion<2, 1> motion(2);
  motion.set_coordinate(1, 0, 0, 4);
  Simulator simulator(AuditMode::events);
  NeighborPairs<2> wide(simulator, motion), narrow(simulator, motion), nearly(simulator, motion),
      same(simulator, motion);
  wide.set_cutoff(3);
  narrow.set_cutoff(1);
  nearly.set_cutoff(std::nextafter(1.0, 2));  // reached slightly earlier
  same.set_cutoff(1);
  struct Listener final : EventListener {
    void on_event(const Event& event) override {
      order.push_back(event.structure_index);
      times.push_back(event.lower);
    }
    std::vector<std::size_t> order;
    std::vector<double> times;
  } listener;
  simulator.listen(listener);
  simulator.build();
  simulator.run_step();
  EXPECT_THAT(listener.order, testing::ElementsAre(0, 2, 1, 3));
  EXPECT_NEAR(listener.times[0], 0.25, 1e-9);
  EXPECT_EQ(listener.times[1], 0.75 - 0x1p-24);  // in the cell below
  EXPECT_NEAR(listener.times[3], 0.75, 1e-9);
  EXPECT_EQ(simulator.comparisons().ties, 1U);
}

/// A pair with many cutoffs, each in its own table. Records the order in which the cutoffs are reached.
class ManyCutoffs final : public KineticStructure {
 public:
  ManyCutoffs(Simulator& simulator, const MotionRef<2>& motion, std::size_t count)
      : simulator_(simulator), index_(simulator.add(*this)) {
    for (unsigned t = 0; t < count; ++t)
      tables_.push_back(std::make_unique<CertificateTable<Near>>(simulator, *this, index_, t, motion));
  }
  void set_cutoff(std::size_t table, double cutoff) { tables_[table]->set_constants({.cutoff = cutoff}); }
  [[nodiscard]] std::string_view name() const override { return "many_cutoffs"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override {
    static constexpr std::array<EventKind, 1> kinds{{{"reach"}}};
    return kinds;
  }
  void build() override {}
  void start_step() override {
    for (const auto& table : tables_) static_cast<void>(table->watch({{0, 1}, false}, 0));
  }
  void fail(unsigned table, std::uint32_t) override {
    reached.push_back(table);
    simulator_.record(index_, Change{0, 2, {0, 1}});
  }
  void apply(const Change&) override {}
  [[nodiscard]] std::optional<std::string> audit(const Dyadic&) override { return std::nullopt; }
  [[nodiscard]] Identity identity(std::size_t table) const {
    return tables_[table]->identity(Near{{0, 1}, false});
  }

  std::vector<unsigned> reached;

 private:
  Simulator& simulator_;
  std::size_t index_;
  std::vector<std::unique_ptr<CertificateTable<Near>>> tables_;
};

TEST(TableConstants, ManyTablesOfOneStructureAreManyFunctions) {
  constexpr std::size_t count = 40;
  BezierMotion<2, 1> motion(2);
  motion.set_coordinate(1, 0, 0, 4);
  Simulator simulator;
  ManyCutoffs cutoffs(simulator, motion, count);
  // The cutoffs differ only in their last bits, so doubles cannot decide the order of the failures. The last
  // table fails first.
  double cutoff = 1;
  for (std::size_t t = 0; t < count; ++t) {
    cutoffs.set_cutoff(t, cutoff);
    cutoff = std::nextafter(cutoff, 2);
  }
  EXPECT_NE(cutoffs.identity(0), cutoffs.identity(16));
  simulator.build();
  simulator.run_step();
  ASSERT_EQ(cutoffs.reached.size(), count);
  EXPECT_TRUE(std::is_sorted(cutoffs.reached.rbegin(), cutoffs.reached.rend()));
}

TEST(TableConstants, InTheMidstOfAStepTheyAreRefused) {
  BezierMotion<2, 1> motion(2);
  motion.set_coordinate(1, 0, 0, 4);
  Simulator simulator;
  NeighborPairs<2> neighbors(simulator, motion);
  EXPECT_THROW(simulator.build(), std::logic_error);  // no cutoff is set
  neighbors.set_cutoff(3);
  simulator.build();
  simulator.enter_step();
  try {
    neighbors.set_cutoff(2);
    ADD_FAILURE();
  } catch (const std::logic_error& reason) {
    EXPECT_STREQ(reason.what(),
                 "near: constants are set in the midst of a step, expected before its certificates");
  }
  simulator.leave_step();
  neighbors.set_cutoff(2);
}

}  // namespace
}  // namespace kds::table_constants_test
