#include "experiments/program/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/page/table.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/questions/question.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

std::string shown(const Field& field) {
  constexpr double rounding = 1e-15;
  const double value = field.number();
  if (std::abs(value) < rounding) return "0";
  const bool whole = value == std::floor(value);
  if ((whole || value >= 1000) && value >= 0 && value < 1e15)
    return with_thousands(static_cast<std::uint64_t>(std::llround(value)));
  return fmt::format("{:.4g}", value);
}

struct PlacedRow {
  const Question* question;
  const QuestionRow* row;
};
std::vector<PlacedRow> rows_of(std::span<const Question> questions) {
  std::vector<PlacedRow> rows;
  for (const Question& question : questions)
    for (const QuestionRow& row : question.rows) rows.push_back({&question, &row});
  return rows;
}

// Returns the columns of all these questions, side by side.
Table<PlacedRow> columns_of(std::span<const Question> questions) {
  using Row = PlacedRow;
  Table<Row> table{{{.key = "question", .value = [](const Row& r) { return Field(r.question->name); }},
                    {"subject", "subject", [](const Row& r) { return Field(r.row->subject); }}}};
  for (const Question& question : questions)
    for (std::size_t c = 0; c < question.columns.size(); ++c) {
      const auto value = [&question, c](const Row& r) {
        return r.question == &question ? Field(r.row->values[c]) : Field();
      };
      table.add({{question.columns[c].name, question.columns[c].title, value, shown}});
    }
  return table;
}

// Returns the plot of the curves with this plot name, and of the powers that fit them.
PointPlot plot_of(const Question& question, const std::string& name) {
  PointPlot plot{question.x_label, question.y_label, {}, {}};
  for (const QuestionCurve& curve : question.curves) {
    if (curve.plot != name) continue;
    for (const auto& [x, y] : curve.points)
      if (x > 0 && y >= 0) plot.points.push_back({"", x, y, plot.series.size()});
    for (const CurveFit& part : curve.fits()) {
      PointPlot::Line law{{}, plot.series.size()};
      for (const double x : {part.from, part.to})
        law.points.emplace_back(x, part.fit.factor * std::pow(x, part.fit.exponent));
      plot.lines.push_back(std::move(law));
    }
    plot.series.push_back(curve.name);
  }
  return plot;
}

std::string plots_of(const Question& question) {
  std::vector<std::string> names;
  for (const QuestionCurve& curve : question.curves)
    if (std::ranges::find(names, curve.plot) == names.end()) names.push_back(curve.plot);
  std::string html;
  for (const std::string& name : names)
    html +=
        html_figure(svg_plot(plot_of(question, name)),
                    fmt::format("{}{}{} by {}; both axes are logarithmic. Dashed lines are fitted powers.",
                                html_escaped(name), name.empty() ? "" : ": ", html_escaped(question.y_label),
                                html_escaped(question.x_label)));
  return html;
}

Json question_rows_json(std::span<const Question> questions) {
  Json json = Json::array();
  for (const Question& question : questions) {
    const std::span<const Question> one(&question, 1);
    const Table<PlacedRow> columns = columns_of(one);
    for (const PlacedRow& row : rows_of(one)) json.push_back(columns.json(row));
  }
  return json;
}

// Returns the title, fits and findings of each question.
Json questions_json(std::span<const Question> questions) {
  Json json = Json::array();
  for (const Question& question : questions) {
    Json fits = Json::array();
    for (const QuestionCurve& curve : question.curves)
      for (const auto& [part, from, to, fit] : curve.fits())
        fits.push_back({{"curve", curve.plot.empty() ? curve.name : curve.plot + ", " + curve.name},
                        {"part", part},
                        {"from", from},
                        {"to", to},
                        {"points", fit.points},
                        {"left_out", fit.left_out},
                        {"exponent", fit.exponent},
                        {"lower", fit.error ? Json(fit.exponent - *fit.error) : Json()},
                        {"upper", fit.error ? Json(fit.exponent + *fit.error) : Json()},
                        {"factor", fit.factor}});
    json.push_back({{"question", question.name},
                    {"title", question.title},
                    {"answer", question.answer},
                    {"fits", fits},
                    {"findings", question.findings}});
  }
  return json;
}

// Returns a header and a line per row. Columns of other questions are empty.
std::string questions_csv(std::span<const Question> questions) {
  return columns_of(questions).csv(rows_of(questions));
}

std::string questions_text(std::span<const Question> questions) {
  std::string text;
  for (const Question& question : questions) {
    text += fmt::format("{}{}: {}\n", text.empty() ? "" : "\n", question.name, question.title);
    text += columns_of({&question, 1}).text(rows_of({&question, 1}), "  ");
    text += "  " + question.answer + "\n";
    for (const std::string& finding : question.findings) text += "  " + finding + "\n";
  }
  return text;
}

// `page` says how the results were made.
std::string questions_page(std::span<const Question> questions, Page page) {
  page.title = "kds questions";
  for (const Question& question : questions)
    page.found += fmt::format("<p>{}</p>\n", html_escaped(question.answer));
  page.found +=
      "<p><strong>No theorem is claimed</strong>: the exponents hold for these chains. Exponents of energy "
      "have intervals of 95% confidence, for independent shares of the measurements.</p>\n";
  for (const Question& question : questions) {
    std::string section = fmt::format("<p>{}</p>\n<ul>\n", html_escaped(question.words));
    for (const std::string& finding : question.findings)
      section += fmt::format("<li>{}</li>\n", html_escaped(finding));
    section += "</ul>\n" + plots_of(question) + columns_of({&question, 1}).html(rows_of({&question, 1}));
    page.body += html_section(question.title, section);
  }
  return html_page(page);
}

constexpr std::array<std::string_view, 4> kQuestions{"energy", "bounds", "trust", "combination"};

constexpr CommandSpec kQuestionsCommand{
    "kds questions",
    "Measures answers to the open questions of Agarwal et al. (2004), and fits exponents. Those of energy "
    "have 95% intervals.\n\n"
    "  energy       how basis changes and flips grow with the energy of bending and torsion of a step\n"
    "  bounds       how many searches for near pairs a bound on speed or displacement saves\n"
    "  trust        time saved by not checking spheres for some frames, and how far beads then stick out\n"
    "  combination  whether diagram and hierarchy together do better than the better of the two alone",
    "[QUESTION|INPUT]...",
    "energy, bounds, trust, combination (default: all). Other words are trajectories of one chain, which "
    "take the place of data/ and random chains in the first three",
    "kds questions --out report\n"
    "kds questions energy --seed 7 --json -\n"
    "kds questions energy villin.dcd --topology villin.pdb",
};

struct QuestionsAsked : InputOptions, Destinations {
  std::vector<std::string> questions;
  std::filesystem::path data = source_data_folder();
  std::uint64_t seed = 1;
  std::size_t seeds = 1;
  std::size_t rounds = 5;
};

const OptionList<QuestionsAsked>& questions_options() {
  using O = QuestionsAsked;
  static const auto list =
      OptionList<O>()
          .with({data_option(&O::data),
                 whole_option({"--seed", "N", "seed of the random chains (default: 1)"}, &O::seed, 0,
                              UINT64_MAX),
                 whole_option(
                     {"--seeds", "N", "energy: pool random chains of N seeds, from --seed on (default: 1)"},
                     &O::seeds, 1, 1000),
                 whole_option({"--rounds", "N",
                               "repeat each measurement of time (trust) N times and report the median "
                               "(default: 5)"},
                              &O::rounds, 1, 1000)})
          .with(input_options())
          .with(destination_options(
              "write questions.json, questions.csv and report.html to DIR (default: none)"));
  return list;
}

bool is_question(const std::string& word) { return std::ranges::find(kQuestions, word) != kQuestions.end(); }

// Returns whether the word can be a file: it exists, or looks like a path.
bool may_be_file(const std::string& word) {
  std::error_code none;
  return std::filesystem::exists(word, none) || word.find_first_of("./") != std::string::npos;
}

// Returns the questions in the order of kQuestions. If INPUTs are given, `combination` is not among them by
// default.
std::vector<std::string> questions_of(const std::vector<std::string>& words, bool of_inputs) {
  std::array<bool, kQuestions.size()> asked{};
  for (const std::string& name : words) {
    bool& is_asked = asked[place_among("QUESTION", name, kQuestions)];
    if (is_asked) throw InputError(fmt::format("QUESTION: {} is listed twice", name));
    is_asked = true;
  }
  if (of_inputs && asked[3])
    throw InputError("combination is asked of its own chains; expected energy, bounds or trust with INPUTs");
  std::vector<std::string> questions;
  for (std::size_t q = 0; q < kQuestions.size() - (of_inputs ? 1 : 0); ++q)
    if (words.empty() || asked[q]) questions.emplace_back(kQuestions[q]);
  return questions;
}

// Sorts the operands into questions and inputs, and checks the options that apply to one of the two.
void take_operands(const ParsedArguments& parsed, QuestionsAsked& asked) {
  std::vector<std::string> words;
  for (const std::string& word : parsed.operands()) {
    if (!is_question(word) && may_be_file(word))
      asked.inputs.emplace_back(word);
    else
      words.push_back(word);
  }
  asked.questions = questions_of(words, !asked.inputs.empty());
  if (asked.inputs.empty()) {
    for (const auto& option : input_options().all())
      if (parsed.has(option.spec.name))
        throw InputError(
            fmt::format("{}: applies only to INPUTs; expected a trajectory beside it", option.spec.name));
    for (const char* needed : {"trajectories", "paper"}) folder_in_data(asked.data, needed);
    return;
  }
  for (const char* of_models : {"--data", "--seed", "--seeds"})
    if (parsed.has(of_models)) throw InputError(fmt::format("{}: has no meaning for INPUTs", of_models));
  check_input_lists(asked);
}

QuestionsAsked parse_questions(const Arguments& arguments) {
  QuestionsAsked asked;
  const ParsedArguments parsed = read_arguments(kQuestionsCommand, questions_options(), arguments, asked);
  take_operands(parsed, asked);
  if (parsed.has("--rounds") && std::ranges::find(asked.questions, "trust") == asked.questions.end())
    throw InputError("--rounds applies only to the question trust, which measures time");
  return asked;
}

// The subjects of the questions about moving chains. Energy is not asked of the random chain that wanders, as
// it has random chains of its own.
struct Subjects {
  MovingSubjects all, of_energy;
  std::optional<RandomChains> chains;
};

Subjects subjects_for(const QuestionsAsked& asked, const TableCommand::Warn& warn) {
  if (!asked.inputs.empty()) {
    const MovingSubjects inputs = subjects_of(asked, warn);
    return {inputs, inputs, {}};
  }
  const MovingSubjects usual = usual_subjects(asked.data, asked.seed);
  return {usual, {usual.begin(), usual.end() - 1}, RandomChains{asked.seed, asked.seeds}};
}

std::size_t steps_of(const std::string& question, const Subjects& subjects) {
  if (question == "energy") return energy_steps(subjects.of_energy, subjects.chains.has_value());
  if (question == "bounds") return bounds_steps(subjects.all);
  if (question == "trust") return trust_steps(subjects.all);
  return combination_steps();
}

std::vector<Question> measure(const QuestionsAsked& asked, const TableCommand::Progress& progress,
                              const TableCommand::Warn& warn) {
  const Subjects subjects = subjects_for(asked, warn);
  std::size_t done = 0, total = 0;
  for (const std::string& question : asked.questions) total += steps_of(question, subjects);
  const std::function<void()> step_done = [&] { progress(++done, total); };
  std::vector<Question> questions;
  for (const std::string& question : asked.questions) {
    if (question == "energy") {
      questions.push_back(ask_about_energy(subjects.of_energy, subjects.chains, step_done));
    } else if (question == "bounds") {
      questions.push_back(ask_about_bounds(subjects.all, step_done));
    } else if (question == "trust") {
      questions.push_back(ask_about_trust(subjects.all, asked.rounds, step_done));
    } else {
      questions.push_back(ask_about_combination(asked.data, asked.seed, step_done));
    }
  }
  return questions;
}

}  // namespace

int questions_command(const Arguments& arguments) {
  const QuestionsAsked asked = parse_questions(arguments);
  TableCommand command("questions", arguments, asked, "measurement");
  TakenPaths taken;
  if (asked.inputs.empty()) {
    taken.read_folder("--data", asked.data);
    command.check_destinations(std::move(taken));
  } else {
    command.check_inputs_and_destinations(asked);
  }
  const std::vector<Question> questions = measure(asked, command.progress(), command.warn());
  command.bar().erase();

  Json json;
  json["settings"] = questions_options().settings_json(asked, {{"questions", asked.questions}});
  json["rows"] = question_rows_json(questions);
  json["questions"] = questions_json(questions);
  json["inputs"] = files_json(asked);
  json["warnings"] = command.warnings();
  command.deliver(json, questions_csv(questions), questions_text(questions),
                  [&](Page page) { return questions_page(questions, std::move(page)); });
  return 0;
}

}  // namespace kds
