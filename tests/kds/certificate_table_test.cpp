#include "kds/certificate_table.h"

#include <gmock/gmock.h>

#include <array>
#include <functional>
#include <memory>
#include <random>

#include "certificates/search/define_radical_search.h"
#include "certificates/types/ball_in_sphere.h"
#include "certificates/types/distances.h"
#include "certificates/types/precedes.h"
#include "motions/curves/bezier_motion.h"
#include "tests/support/searches.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 1>>> search_over(const MotionRef<2>& motion) {
  return radical_search_over<BallInSphere<2, 1>>(motion);
}

namespace certificate_table_test {
namespace {

using test::all_kernels;
using Line = BezierMotion<1, 1>;

class Owner final : public KineticStructure {
 public:
  Owner(Simulator& simulator, const MotionRef<1>& motion)
      : unused(simulator, *this, 0, 3, motion), table(simulator, *this, simulator.add(*this), 5, motion) {}

  [[nodiscard]] std::string_view name() const override { return "owner"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override {
    static constexpr std::array<EventKind, 1> kinds{{{"event"}}};
    return kinds;
  }
  void build() override {}
  void start_step() override { on_start(); }
  void fail(unsigned number, std::uint32_t slot) override {
    EXPECT_EQ(number, 5U);
    failed.push_back(table.place_in_structure(slot));
    if (on_fail) on_fail(slot);
  }
  void apply(const Change&) override {}
  [[nodiscard]] std::optional<std::string> audit(const Dyadic&) override { return std::nullopt; }

  std::function<void()> on_start;
  std::function<void(std::uint32_t)> on_fail;
  std::vector<std::uint32_t> failed;
  CertificateTable<Precedes> unused;
  CertificateTable<Precedes> table;
};

// Bead i rests at i; bead 10 + i moves from 100 to -100 + i.
Line sweeping() {
  Line motion(20);
  for (BeadId i = 0; i < 10; ++i) {
    motion.set_coordinate(i, 0, 0, i);
    motion.set_coordinate(i, 1, 0, i);
    motion.set_coordinate(10 + i, 0, 0, 100);
    motion.set_coordinate(10 + i, 1, 0, -100 + static_cast<double>(i));
  }
  return motion;
}

class CertificateTableTest : public testing::TestWithParam<Kernel> {
 protected:
  void run(std::function<void()> start, std::function<void(std::uint32_t)> fail = {}) {
    owner.on_start = std::move(start);
    owner.on_fail = std::move(fail);
    simulator.build();
    simulator.run_step();
  }
  [[nodiscard]] const CertificateCounts& counts() const { return owner.statistics.certificates; }
  void expect_sum() const {
    EXPECT_EQ(counts().created, counts().never_failing + counts().cancelled + counts().failed);
  }

  Line motion = sweeping();
  Simulator simulator{AuditMode::none, GetParam()};
  Owner owner{simulator, motion};
};

INSTANTIATE_TEST_SUITE_P(Kernels, CertificateTableTest, testing::ValuesIn(all_kernels),
                         [](const auto& test) { return std::string(name_of(test.param)); });

TEST_P(CertificateTableTest, CountsWhatBecomesOfCertificates) {
  run([this] {
    EXPECT_EQ(owner.table.watch({{1, 0}}, 7), CertificateHandle::violated);
    owner.table.drop(CertificateHandle::violated);  // there is no certificate to drop
    EXPECT_EQ(counts().alive, 0U);
    const CertificateHandle a = owner.table.watch({{3, 12}}, 1);
    static_cast<void>(owner.table.watch({{4, 12}}, 2));
    const CertificateHandle never = owner.table.watch({{4, 5}}, 3);
    EXPECT_EQ(never, CertificateHandle::never);
    EXPECT_EQ(owner.table.watch({{5, 6}}, 3), CertificateHandle::never);
    EXPECT_EQ(counts().alive, 4U);
    owner.table.drop(a);
    owner.table.drop(never);
    EXPECT_EQ(counts().alive, 2U);
    EXPECT_EQ(counts().cancelled, 1U);
  });
  EXPECT_THAT(owner.failed, testing::ElementsAre(2));
  EXPECT_EQ(counts().created, 5U);
  EXPECT_EQ(counts().never_failing, 2U);
  EXPECT_EQ(counts().cancelled, 1U);
  EXPECT_EQ(counts().failed, 2U);
  EXPECT_EQ(counts().peak, 4U);
  EXPECT_EQ(counts().alive, 0U);
  expect_sum();
}

TEST_P(CertificateTableTest, TellsTheOwnerOfFailures) {
  run([this] {
    const CertificateHandle handle = owner.table.watch({{3, 12}}, 70);
    ASSERT_TRUE(has_slot(handle));
    const std::uint32_t slot = slot_of(handle);
    EXPECT_EQ(owner.table.certificate(slot).beads, (std::array<BeadId, 2>{3, 12}));
    EXPECT_EQ(owner.table.identity(slot), (Precedes{{12, 3}}).identity());
    // 100 - 198 u = 3
    EXPECT_NEAR(owner.table.time(slot).lower, 97.0 / 198, 1e-9);
    EXPECT_NEAR(owner.table.time(slot).upper, 97.0 / 198, 1e-9);
  });
  EXPECT_THAT(owner.failed, testing::ElementsAre(70));
}

TEST_P(CertificateTableTest, SlotsAreUsedAgain) {
  run([this] {
    const CertificateHandle a = owner.table.watch({{3, 12}}, 1);
    const CertificateHandle b = owner.table.watch({{4, 12}}, 2);
    owner.table.drop(a);
    const CertificateHandle c = owner.table.watch({{5, 12}}, 3);
    EXPECT_EQ(slot_of(c), slot_of(a));
    EXPECT_NE(slot_of(c), slot_of(b));
    EXPECT_EQ(owner.table.certificate(slot_of(c)).beads[0], 5U);
    EXPECT_EQ(owner.table.place_in_structure(slot_of(b)), 2U);
  });
  EXPECT_THAT(owner.failed, testing::ElementsAre(3, 2));
}

// The function of the present event must stay available while that event is handled.
TEST_P(CertificateTableTest, TheFailingSlotIsNotUsedAgainAtOnce) {
  std::vector<std::uint32_t> slots;
  run(
      [this] {
        (void)owner.table.watch({{9, 12}}, 9);
      },
      [&](std::uint32_t slot) {
        slots.push_back(slot);
        const BeadId next = 9 - static_cast<BeadId>(owner.failed.size());
        if (next > 4) {
          const CertificateHandle handle = owner.table.watch({{next, 12}}, next);
          EXPECT_TRUE(has_slot(handle));
          EXPECT_NE(slot_of(handle), slot);
        }
      });
  EXPECT_THAT(owner.failed, testing::ElementsAre(9, 8, 7, 6, 5));
  // The slot is reused after the event, so two slots are enough.
  EXPECT_EQ(*std::max_element(slots.begin(), slots.end()), 1U);
}

TEST_P(CertificateTableTest, PlacesTellStructuresTablesAndPlacesApart) {
  run([this] {
    const CertificateHandle a = owner.table.watch({{3, 12}}, 0xffffffffU);
    const CertificateHandle b = owner.unused.watch({{3, 12}}, 0xffffffffU);
    EXPECT_NE(owner.table.place(slot_of(a)), owner.unused.place(slot_of(b)));
    EXPECT_EQ(owner.table.place(slot_of(a)).place, 0xffffffffU);
    owner.unused.drop(b);
  });
  Simulator two(AuditMode::none, GetParam());
  Owner first(two, motion);
  Owner second(two, motion);
  first.on_start = [&] { (void)first.table.watch({{3, 12}}, 4); };
  second.on_start = [&] {
    const CertificateHandle handle = second.table.watch({{3, 12}}, 4);
    EXPECT_NE(first.table.place(0), second.table.place(slot_of(handle)));
    EXPECT_EQ(first.table.structure(), 0U);
    EXPECT_EQ(second.table.structure(), 1U);
  };
  two.build();
  two.run_step();
  EXPECT_EQ(first.failed.size(), 1U);
  EXPECT_EQ(second.failed.size(), 1U);
}

TEST_P(CertificateTableTest, TheNextStepStartsWithEmptyTables) {
  std::vector<std::uint32_t> slots;
  owner.on_start = [&] {
    EXPECT_EQ(counts().alive, 0U);
    slots.push_back(slot_of(owner.table.watch({{3, 12}}, 0)));
    (void)owner.table.watch({{0, 1}}, 0);
  };
  simulator.build();
  simulator.run_step();
  simulator.run_step();
  EXPECT_THAT(slots, testing::ElementsAre(0, 0));
  EXPECT_EQ(owner.failed.size(), 2U);
  EXPECT_EQ(counts().peak, 2U);
  expect_sum();
}

// Watching a few certificates at a time or all at once makes the same handles in the same order.
TEST_P(CertificateTableTest, ManyAreAsOneByOne) {
  std::vector<std::pair<std::uint32_t, CertificateHandle>> expected, many;
  for (const bool a_few_at_a_time : {false, true}) {
    run([&] {
      std::mt19937 random(6);
      auto& table = owner.table;
      for (int round = 0; round < 3; ++round) {
        for (std::uint32_t place = 0; place < 1300; ++place) {
          const auto left = static_cast<BeadId>(random() % 20);
          const auto right = static_cast<BeadId>((left + 1 + random() % 19) % 20);
          if (a_few_at_a_time) {
            table.enqueue_one_of_many({{left, right}}, place, KnownAtStart::unknown);
          } else {
            table.enqueue({{left, right}}, place, KnownAtStart::unknown);
          }
        }
        table.watch_enqueued([&](std::uint32_t place, CertificateHandle handle) {
          (a_few_at_a_time ? many : expected).emplace_back(place, handle);
        });
      }
    });
    expect_sum();
  }
  EXPECT_EQ(expected.size(), 3900U);
  EXPECT_EQ(many, expected);
}

// Random operations; the test checks only the statistics.
TEST_P(CertificateTableTest, TheBooksBalance) {
  std::mt19937 random(5);
  std::uint64_t peak = 0;
  std::vector<CertificateHandle> live;
  const auto act = [&] {
    for (int i = 0; i < 4; ++i) {
      const auto left = static_cast<BeadId>(random() % 20);
      const auto right = static_cast<BeadId>((left + 1 + random() % 19) % 20);
      const CertificateHandle handle =
          owner.table.watch({{left, right}}, static_cast<std::uint32_t>(random() % 1000));
      if (handle != CertificateHandle::violated) live.push_back(handle);
    }
    peak = std::max<std::uint64_t>(peak, live.size());
    if (live.size() > 2 && random() % 3 != 0) {
      const std::size_t chosen = random() % live.size();
      owner.table.drop(live[chosen]);
      live.erase(live.begin() + static_cast<std::ptrdiff_t>(chosen));
    }
    EXPECT_EQ(counts().alive, live.size());
  };
  int budget = 400;
  run(
      [&] {
        for (int i = 0; i < 50; ++i) act();
      },
      [&](std::uint32_t slot) {
        const auto gone = std::find(live.begin(), live.end(), static_cast<CertificateHandle>(slot));
        ASSERT_NE(gone, live.end());
        live.erase(gone);
        EXPECT_EQ(counts().alive, live.size());
        if (budget-- > 0) act();
      });
  EXPECT_GT(owner.failed.size(), 30U);
  EXPECT_EQ(counts().peak, peak);
  expect_sum();
}

// Another certificate type with the same type number as Precedes.
struct Follows {
  static constexpr CertificateType type{Precedes::type.number, "follows"};
  std::array<BeadId, 2> beads{};
  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }
  [[nodiscard]] bool side() const { return true; }
};

}  // namespace
}  // namespace certificate_table_test

template <>
std::unique_ptr<CertificateSearch<certificate_table_test::Follows>> search_over(const MotionRef<1>&) {
  return nullptr;  // the constructor throws before any search
}

namespace certificate_table_test {
namespace {

TEST(CertificateTables, OfTwoTypesOfOneNumberAreRefused) {
  const Line motion = sweeping();
  Simulator simulator;
  Owner owner(simulator, motion);
  // Two tables of one type are allowed.
  EXPECT_NO_THROW(CertificateTable<Precedes>(simulator, owner, 0, 7, MotionRef<1>(motion)));
  Simulator other;
  Owner another(other, motion);
  try {
    const CertificateTable<Follows> table(other, another, 0, 7, MotionRef<1>(motion));
    FAIL() << "no exception";
  } catch (const std::logic_error& refusal) {
    EXPECT_STREQ(refusal.what(),
                 "certificate types precedes and follows have the same number 0: give one of them another");
  }
}

// Polynomial and radical certificates share one queue.
class BallOwner final : public KineticStructure {
 public:
  BallOwner(Simulator& simulator, const MotionRef<2>& motion)
      : contacts(simulator, *this, simulator.add(*this), 0, motion), inside(simulator, *this, 0, 1, motion) {}

  [[nodiscard]] std::string_view name() const override { return "balls"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override {
    static constexpr std::array<EventKind, 1> kinds{{{"event"}}};
    return kinds;
  }
  void build() override {}
  void start_step() override {
    // The ball leaves the sphere at u = 1/3. The certificate of this type is watched before the contact's,
    // although its type comes later.
    EXPECT_TRUE(has_slot(inside.watch({{0, 1}, true}, 0)));
    EXPECT_TRUE(has_slot(contacts.watch(Contact({2, 3}, 1), 0)));
    EXPECT_EQ(contacts.watch(Contact({0, 2}, 1), 1), CertificateHandle::never);
    EXPECT_EQ(inside.watch({{0, 2}, true}, 1), CertificateHandle::violated);
    EXPECT_EQ(inside.watch({{0, 0}, true}, 2), CertificateHandle::zero);
  }
  void fail(unsigned number, std::uint32_t slot) override {
    failed.push_back(number);
    if (number == 1) {
      auto outside = inside.certificate(slot);
      outside.inside = false;
      EXPECT_EQ(inside.watch(outside, 0, KnownAtStart::at_own_root), CertificateHandle::never);
    }
  }
  void apply(const Change&) override {}
  [[nodiscard]] std::optional<std::string> audit(const Dyadic&) override { return std::nullopt; }

  std::vector<unsigned> failed;
  CertificateTable<Contact> contacts;
  CertificateTable<BallInSphere<2, 1>> inside;
};

void expect_balls_in_order(Kernel kernel, const std::vector<unsigned>& expected) {
  BezierMotion<2, 1> motion(4);
  const auto set = [&](BeadId bead, double from, double to, double y, double radius) {
    motion.set_coordinate(bead, 0, 0, from);
    motion.set_coordinate(bead, 1, 0, to);
    for (int k = 0; k <= 1; ++k) {
      motion.set_coordinate(bead, k, 1, y);
      motion.set_radius(bead, k, radius);
    }
  };
  set(0, 0, 0, 0, 1);
  set(1, 0, 1.5, 0, 0.5);
  set(2, 0, 0, 100, 1);
  set(3, 4, -2, 100, 1);  // meets bead 2 at x = 2
  Simulator simulator(AuditMode::none, kernel);
  BallOwner owner(simulator, motion);
  simulator.build();
  simulator.run_step();
  EXPECT_EQ(owner.failed, expected);
}

TEST(CertificateTables, OfRadicalsShareTheQueue) {
  expect_balls_in_order(Kernel::filtered, {0, 1});
  expect_balls_in_order(Kernel::exact, {0, 1});
}

}  // namespace
}  // namespace certificate_table_test
}  // namespace kds
