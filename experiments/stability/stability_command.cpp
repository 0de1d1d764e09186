#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/stability/stability.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr CommandSpec kStabilityCommand{
    "kds stability",
    "Compares the two kernels (--kernel) on inputs that are hard for rounding. filtered and exact must "
    "agree.\n\n"
    "  subjects\n"
    "    certificates  precedes, reaches_further, orientation, power_test, contact, ball_reaches_further,\n"
    "                  bead_in_sphere_1 (to _3), ball_in_sphere_1 (to _4)\n"
    "    structures    those of kds help structures, and wrapped:chord; with radii boxes:balls,\n"
    "                  wrapped:balls, wrapped:balls:chord; layered:balls, contacts:balls only so\n"
    "    guarantees    tolerance, stride, contacts_of_tolerance, contacts_of_stride\n\n"
    "  extremes (a family, or one member of it, as in offset:2^50)\n"
    "    scale    coordinates times 2^-1000, 2^-300, 2^300 or 2^1000, or as large as doubles are (largest)\n"
    "    offset   2^20, 2^35 or 2^50 radii from the origin\n"
    "    step     subnormal, ulp or thousandfold motion, none (zero), or out and back (identical)\n"
    "    radii    of ratio 10^3, 10^6 or 10^9\n"
    "    beads    ulp-apart; coincident, collinear, coplanar or cospherical, or only at u = 1/2 "
    "(coincident-mid ...)\n"
    "    contact  balls that touch at u = 1/2: tangent (from outside) or inner\n"
    "    ties     many certificates are zero at the start, middle or end\n"
    "    basis    nearly degenerate spheres: a-near-0, flat\n"
    "    degree   18: cubic motion that winds\n"
    "    refused  nan, infinity: both kernels must refuse them",
    "",
    "",
    "kds stability --out stability\n"
    "kds stability --subjects power_test,power --extremes scale,offset:2^50 --cases 1000",
};

std::string family(std::string_view extreme) { return std::string(extreme.substr(0, extreme.find(':'))); }

template <class Names>
bool among(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> parse_names(std::string_view option, const std::string& list,
                                     const std::vector<std::string>& known) {
  const std::vector<std::string> names = split(list, ',');
  for (const std::string& name : names) {
    if (!among(known, name))
      refuse_unknown(option, name, std::vector<std::string_view>(known.begin(), known.end()));
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError(fmt::format("{}: {} is listed twice", option, name));
  }
  return names;
}

std::vector<std::string> subject_names() {
  std::vector<std::string> names;
  for (const StabilitySubject& subject : all_subjects())
    if (!among(names, subject.name)) names.push_back(subject.name);
  return names;
}

std::vector<std::string> extreme_names() {
  std::vector<std::string> names;
  for (const Extreme& extreme : all_extremes()) {
    if (!among(names, family(extreme.name))) names.push_back(family(extreme.name));
    names.emplace_back(extreme.name);
  }
  return names;
}

/// Returns an option that takes some of the names in `known`. The default is all names.
Option<StabilityOptions> names_option(OptionSpec spec, std::vector<std::string> StabilityOptions::*member,
                                      std::vector<std::string> (*known)()) {
  return value_option(
      spec, member, [=](const std::string& list) { return parse_names(spec.name, list, known()); },
      [](const std::vector<std::string>& names) {
        return names.empty() ? "all" : fmt::format("{}", fmt::join(names, ","));
      });
}

const OptionList<StabilityOptions>& stability_options() {
  using O = StabilityOptions;
  static const auto list =
      OptionList<O>()
          .with({names_option({"--subjects", "LIST", "comma list of the subjects above (default: all)"},
                              &O::subjects, subject_names),
                 names_option({"--extremes", "LIST",
                               "comma list of the extremes above or of single members (default: all)"},
                              &O::extremes, extreme_names)})
          .with(&O::cases, {{whole_option({"--cases", "N",
                                           "random cases per extreme; slow kinds get fewer (default: 200)"},
                                          &StabilityCases::cases, 1, 1'000'000),
                             whole_option({"--seed", "N", "seed of the random cases (default: 1)"},
                                          &StabilityCases::seed, 0, ~std::uint64_t{0})}})
          .with(destination_options(
              "write stability.json, stability.csv and report.html to DIR (default: none)"));
  return list;
}

std::string totals(std::span<const StabilityRow> rows) {
  std::uint64_t cases = 0, differing = 0, refused = 0, audits = 0, failed = 0;
  for (const StabilityRow& row : rows) {
    cases += row.cases;
    differing += row.disagreements + row.failed;
    refused += row.refused;
    audits += row.audits_run;
    failed += row.audits_failed;
  }
  std::string text = fmt::format(
      "\n{} rows, {} cases ({} refused); filtered differs from exact in {}; {} of {} audits failed\n",
      with_thousands(rows.size()), with_thousands(cases), with_thousands(refused), with_thousands(differing),
      with_thousands(failed), with_thousands(audits));
  for (const StabilityRow& row : rows)
    if (!row.holds()) text += fmt::format("DOES NOT HOLD: {}: {}\n", name_of(row), one_line(row.reason));
  return text;
}

}  // namespace

void note_trouble(StabilityRow& row, std::size_t number, const std::string& reason,
                  const std::string& motion) {
  if (!row.motion.empty()) return;
  row.reason = fmt::format("case {}: {}", number, reason);
  row.motion = motion;
}

std::string name_of(const StabilityRow& row) {
  return fmt::format("{} {}D degree {}, {}", row.subject, row.dimension, row.degree, row.extreme);
}

const Table<StabilityRow>& stability_columns() {
  using Row = StabilityRow;
  static const Table<Row> table = [] {
    const auto only_in_json = [](const char* key, std::string Row::*text) {
      return Column<Row>{.key = key, .json = [=](const Row& r) {
                           return (r.*text).empty() ? Json(nullptr) : Json(r.*text);
                         }};
    };
    std::vector<Column<Row>> columns{
        {"subject", "subject", [](const Row& r) { return Field(r.subject); }},
        {.key = "kind",
         .value = [](const Row& r) { return Field(r.structure ? "structure" : "certificate"); }},
        {"dimension", "D", [](const Row& r) { return Field(r.dimension); }},
        {"degree", "deg", [](const Row& r) { return Field(r.degree); }},
        {.key = "function_degree",
         .value = [](const Row& r) { return r.structure ? Field() : Field(r.function_degree); }},
        {"extreme", "extreme", [](const Row& r) { return Field(r.extreme); }},
        {"cases", "cases", [](const Row& r) { return Field(r.cases); }},
        {"events", "events", [](const Row& r) { return Field(r.events); }},
        {.key = "signs", .value = [](const Row& r) { return Field(r.signs); }},
        {.key = "agree", .value = [](const Row& r) { return Field(r.cases - r.disagreements - r.failed); }},
        {.key = "disagreements", .value = [](const Row& r) { return Field(r.disagreements); }},
        {.heading = "differ", .value = [](const Row& r) { return Field(r.disagreements + r.failed); }},
        {"refused", "refused", [](const Row& r) { return Field(r.refused); }},
        {.key = "failed", .value = [](const Row& r) { return Field(r.failed); }},
        only_in_json("reason", &Row::reason),
        only_in_json("motion", &Row::motion)};
    for (const Stage& stage : stage_table)
      columns.push_back({.key = fmt::format("stages_{}", stage.name),
                         .value = [count = stage.count](const Row& r) { return Field(r.stages.*count); }});
    columns.insert(
        columns.end(),
        {{.heading = "double",
          .value = [](const Row& r) { return Field(r.stages.coefficients + r.stages.isolation); }},
         {.heading = "tracked", .value = [](const Row& r) { return Field(r.stages.refined); }},
         {.heading = "integer",
          .value = [](const Row& r) { return Field(r.stages.exact + r.stages.identically_zero); }},
         {.key = "seconds_filtered", .value = [](const Row& r) { return Field(r.seconds.filtered); }},
         {.key = "seconds_exact", .value = [](const Row& r) { return Field(r.seconds.exact); }},
         {.key = "rebuilds", .value = [](const Row& r) { return Field(r.rebuilds); }},
         {"audits_run", "audits", [](const Row& r) { return Field(r.audits_run); }},
         {.key = "audits_failed", .value = [](const Row& r) { return Field(r.audits_failed); }},
         {.key = "holds", .value = [](const Row& r) { return Field(r.holds()); }}});
    return Table<Row>(std::move(columns));
  }();
  return table;
}

std::optional<std::string> complaint_about(std::span<const StabilityRow> rows) {
  std::vector<std::string> failing;
  for (const StabilityRow& row : rows)
    if (!row.holds()) failing.push_back(name_of(row));
  if (failing.empty()) return std::nullopt;
  return fmt::format("{} of {} rows do not hold: {}", failing.size(), rows.size(), fmt::join(failing, "; "));
}

bool StabilityOptions::wants(const StabilitySubject& subject) const {
  return subjects.empty() || among(subjects, subject.name);
}

bool StabilityOptions::wants(const Extreme& extreme) const {
  return extremes.empty() || among(extremes, extreme.name) || among(extremes, family(extreme.name));
}

StabilityOptions parse_stability_options(const Arguments& arguments) {
  StabilityOptions options;
  read_arguments(kStabilityCommand, stability_options(), arguments, options);
  return options;
}

std::vector<StabilitySubject> all_subjects() {
  std::vector<StabilitySubject> subjects;
  const auto add = [&subjects](std::vector<StabilitySubject> some) {
    std::ranges::move(some, std::back_inserter(subjects));
  };
  for (const int degree : {1, 3}) add(bead_certificates(degree));
  for (const int degree : {1, 3}) add(ball_certificates(degree));
  add(kinetic_structures());
  add(motion_levers());
  // Sorts subjects by name in the order of first appearance, then by dimension and degree.
  std::vector<std::string> names;
  for (const StabilitySubject& subject : subjects)
    if (std::ranges::find(names, subject.name) == names.end()) names.push_back(subject.name);
  const auto row_of = [&names](const StabilitySubject& subject) {
    return std::tuple(std::ranges::find(names, subject.name) - names.begin(), subject.dimension,
                      subject.degree);
  };
  std::ranges::stable_sort(subjects, {}, row_of);
  for (StabilitySubject& subject : subjects) {
    subject.run = [subject](const Extreme& extreme, const StabilityCases& cases) {
      StabilityRow row = subject.run(extreme, cases);
      row.subject = subject.name;
      row.structure = subject.structure;
      row.dimension = subject.dimension;
      row.degree = subject.degree;
      row.function_degree = subject.function_degree;
      return row;
    };
  }
  return subjects;
}

std::vector<StabilityRow> run_stability(const StabilityOptions& options,
                                        const std::function<void(std::size_t, std::size_t)>& progress) {
  const std::vector<StabilitySubject> subjects = all_subjects();
  std::vector<std::pair<const StabilitySubject*, const Extreme*>> pairs;
  for (const StabilitySubject& subject : subjects) {
    for (const Extreme& extreme : all_extremes())
      if (options.wants(subject) && options.wants(extreme) && subject.meets(extreme))
        pairs.emplace_back(&subject, &extreme);
  }
  if (pairs.empty()) throw InputError("none of the --extremes applies to any of the --subjects");
  std::vector<StabilityRow> rows;
  for (const auto& [subject, extreme] : pairs) {
    rows.push_back(subject->run(*extreme, options.cases));
    progress(rows.size(), pairs.size());
  }
  return rows;
}

int stability_command(const Arguments& arguments) {
  const StabilityOptions options = parse_stability_options(arguments);
  TableCommand command("stability", arguments, options, "row");
  command.check_destinations();

  const std::vector<StabilityRow> rows = run_stability(options, command.progress());
  command.bar().erase();
  const auto complaint = complaint_about(rows);
  Json json{{"settings", stability_options().settings_json(options)}};
  json["rows"] = stability_columns().json(rows);
  json["holds"] = !complaint;
  command.deliver(std::move(json), stability_columns().csv(rows),
                  stability_columns().text(rows) + totals(rows));
  if (complaint) throw std::runtime_error(*complaint);
  return 0;
}

}  // namespace kds
