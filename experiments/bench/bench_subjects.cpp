#include "experiments/bench/bench_subjects.h"

#include <map>
#include <string>

#include "experiments/bench/subject.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

class CountedTurns final : public bench::Turns {
 public:
  explicit CountedTurns(std::size_t rounds) : left_(rounds) {}

  bool another() override { return left_-- > 0; }
  void took(double) override {}
  void note(std::string_view figure, double value) override { figures_[std::string(figure)] = value; }

  [[nodiscard]] std::optional<double> figure(const std::string& name) const {
    const auto found = figures_.find(name);
    return found == figures_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  std::size_t left_;
  std::map<std::string, double> figures_;
};

// Returns the row with the spread of its value, which the figures NAME_least and NAME_most hold.
BenchRow with_spread_of(BenchRow row, const CountedTurns& turns, const std::string& name) {
  row.spread = Spread{row.value, *turns.figure(name + "_least"), *turns.figure(name + "_most")};
  return row;
}

template <class AddRows>
std::vector<BenchRow> rows_of(const std::vector<bench::Subject>& subjects, std::size_t rounds,
                              const std::function<void(std::size_t, std::size_t)>& progress,
                              const AddRows& add_rows) {
  std::vector<BenchRow> rows;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    CountedTurns turns(rounds);
    subjects[i].run(turns);
    add_rows(subjects[i], turns, rows);
    progress(i + 1, subjects.size());
  }
  return rows;
}

void check_folder(const std::filesystem::path& instances) {
  std::error_code error;
  if (!std::filesystem::is_directory(instances, error))
    throw InputError("--instances: " + instances.string() + ": expected a folder of moving-point files");
}

}  // namespace

std::vector<BenchRow> bench_certificates(const SubjectBenchOptions& options,
                                         const std::function<void(std::size_t, std::size_t)>& progress) {
  check_folder(options.instances);
  std::vector<bench::Subject> subjects = bench::certificate_subjects(options.instances);
  for (bench::Subject& subject : bench::slack_subjects()) subjects.push_back(std::move(subject));
  return rows_of(
      subjects, options.rounds, progress,
      [](const bench::Subject& subject, const CountedTurns& turns, auto& rows) {
        const auto peer = turns.figure("peer_ns");
        rows.push_back(with_spread_of(
            {subject.name, subject.input, subject.beads, *turns.figure("ns"), "ns", peer ? subject.peer : "",
             peer, subject.most_ns ? subject.most_ns : subject.most_ratio, subject.most_ns.has_value()},
            turns, "ns"));
      });
}

std::vector<BenchRow> bench_engine(const SubjectBenchOptions& options,
                                   const std::function<void(std::size_t, std::size_t)>& progress) {
  check_folder(options.instances);
  const std::vector<bench::Subject> subjects = bench::engine_subjects(options.instances);
  if (subjects.empty())
    throw InputError("--instances: " + options.instances.string() +
                     ": expected files such as d3_n200_linear.txt");
  return rows_of(
      subjects, options.rounds, progress,
      [](const bench::Subject& subject, const CountedTurns& turns, auto& rows) {
        rows.push_back(with_spread_of({subject.name + ", an event", subject.input, subject.beads,
                                       *turns.figure("ns"), "ns", "", std::nullopt, subject.most_ns, true},
                                      turns, "ns"));
        rows.push_back(
            with_spread_of({subject.name + ", a run", subject.input, subject.beads, *turns.figure("run_us"),
                            "us", subject.peer, turns.figure("build_us"), subject.most_ratio},
                           turns, "run_us"));
      });
}

}  // namespace kds
