#pragma once
// A structure without geometry, for tests of the simulator.

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "kds/simulator.h"
#include "tests/support/inputs/polynomial_source.h"

namespace kds::test {

using Log = std::vector<std::string>;

/// Plays a script and records every call that it receives.
class Script final : public KineticStructure, public FailureSource {
 public:
  Script(Simulator& simulator, Log& log, std::string name)
      : simulator_(simulator), log_(log), name_(std::move(name)), index_(simulator.add(*this)) {
    simulator.add_table(*this, {0, "a polynomial"});
  }

  /// Schedules an entry from now on: at the first failure of `function`, records `note` and runs the action.
  QueueHandle schedule(const std::string& note, Scaled function, BeadId bead,
                       std::function<void()> action = {}) {
    const auto slot = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({note, std::move(function), bead, std::move(action), false});
    StageCounts stages;
    // Takes the first root at or after now; the script is responsible for its functions.
    const Failure failure = exact_first_failure(*exact_function(slot), Instant(0), stages);
    return entries_[slot].handle = simulator_.schedule(failure.time, *this, slot);
  }
  void change(std::uint8_t kind, BeadId bead) { simulator_.record(index_, {kind, 1, {bead}}); }
  void note(const std::string& text) { log_.push_back(name_ + " " + text); }

  std::function<void()> on_build, on_start, on_batch_end;
  std::function<std::optional<std::string>(const Dyadic&)> on_audit;
  std::vector<Rational> audits;

  // KineticStructure
  [[nodiscard]] std::string_view name() const override { return name_; }
  [[nodiscard]] std::span<const EventKind> kinds() const override {
    static constexpr std::array<EventKind, 3> kinds{{{"turn"}, {"tick", false}, {"rebuild", false, true}}};
    return kinds;
  }
  void build() override {
    note("build");
    if (on_build) on_build();
  }
  void start_step() override {
    note("start");
    if (on_start) on_start();
  }
  void fail(unsigned, std::uint32_t) override { FAIL() << "the source was not asked"; }
  void after_batch() override {
    note("settle");
    if (on_batch_end) on_batch_end();
  }
  void finish_step() override { note("finish"); }
  void finish() override { note("end"); }
  void apply(const Change& c) override {
    note("apply " + std::to_string(c.ids[0]));
    if (c.ids[0] == 13) throw std::invalid_argument("unlucky");
  }
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override {
    audits.push_back(time.rational());
    return on_audit ? on_audit(time) : std::nullopt;
  }

  // FailureSource
  [[nodiscard]] ExactFunction exact_function(std::uint32_t slot) const override {
    EXPECT_FALSE(entries_.at(slot).retired) << entries_.at(slot).note << " is asked for after it was retired";
    return std::make_shared<const ExactPolynomial>(entries_.at(slot).function);
  }
  [[nodiscard]] Identity identity(std::uint32_t slot) const override { return named(entries_.at(slot).bead); }
  [[nodiscard]] TiePlace place(std::uint32_t slot) const override { return {0, slot}; }
  [[nodiscard]] std::size_t structure() const override { return index_; }
  void fail(std::uint32_t slot) override {
    const Entry entry = entries_.at(slot);  // the action may schedule more
    note(entry.note);
    EXPECT_FALSE(entry.retired);
    if (entry.action) {
      entry.action();
    } else {
      change(0, entry.bead);
    }
  }
  void retire(std::uint32_t slot) override {
    EXPECT_FALSE(entries_.at(slot).retired);
    entries_.at(slot).retired = true;
    ++retired;
  }
  void clear() override {
    entries_.clear();
    ++cleared;
  }
  int retired = 0;
  int cleared = 0;

 private:
  struct Entry {
    std::string note;
    Scaled function;
    BeadId bead;
    std::function<void()> action;
    bool retired;
    QueueHandle handle = 0;
  };

  Simulator& simulator_;
  Log& log_;
  std::string name_;
  std::size_t index_;
  std::vector<Entry> entries_;
};

struct Listener final : EventListener {
  struct Heard {
    std::string structure;
    Event event;
  };
  std::vector<Heard> heard;
  void on_event(const Event& event) override { heard.push_back({std::string(event.structure), event}); }
};

}  // namespace kds::test
