#include "experiments/program/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/program/input_options.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/questions/bounds_question.h"
#include "experiments/questions/combination_question.h"
#include "experiments/questions/energy_question.h"
#include "experiments/questions/questions_report.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr std::array<std::string_view, 4> kQuestions{"energy", "bounds", "trust", "combination"};

constexpr CommandSpec kQuestionsCommand{
    "kds questions",
    "Measures what Agarwal et al. (2004) leave open, and gives exponents with confidence intervals.\n\n"
    "  energy       how basis changes and flips grow with the energy of bending and torsion of a step\n"
    "  bounds       how many searches for near pairs a bound on speed or displacement saves\n"
    "  trust        time saved by not checking spheres for some frames, and how far beads then stick out\n"
    "  combination  whether diagram and hierarchy together do better than the better of the two alone",
    "[QUESTION]...",
    "energy, bounds, trust, combination (default: all)",
    "kds questions --out report\n"
    "kds questions energy --seed 7 --json -",
};

struct QuestionsAsked : Destinations {
  std::vector<std::string> questions;
  std::filesystem::path data = source_data_folder();
  std::uint64_t seed = 1;
  std::size_t rounds = 5;
};

const OptionList<QuestionsAsked>& questions_options() {
  using O = QuestionsAsked;
  static const auto list =
      OptionList<O>()
          .with({data_option(&O::data),
                 whole_option({"--seed", "N", "seed of the random chains (default: 1)"}, &O::seed, 0,
                              UINT64_MAX),
                 whole_option({"--rounds", "N",
                               "repeat each measurement of time (trust) N times and report the median "
                               "(default: 5)"},
                              &O::rounds, 1, 1000)})
          .with(destination_options(
              "write questions.json, questions.csv and report.html to DIR (default: none)"));
  return list;
}

// Returns the questions in the order of kQuestions.
std::vector<std::string> questions_of(const std::vector<std::string>& operands) {
  std::array<bool, kQuestions.size()> asked{};
  for (const std::string& name : operands) {
    bool& is_asked = asked[place_among("QUESTION", name, kQuestions)];
    if (is_asked) throw InputError(fmt::format("QUESTION: {} is listed twice", name));
    is_asked = true;
  }
  std::vector<std::string> questions;
  for (std::size_t q = 0; q < kQuestions.size(); ++q)
    if (operands.empty() || asked[q]) questions.emplace_back(kQuestions[q]);
  return questions;
}

QuestionsAsked parse_questions(const Arguments& arguments) {
  QuestionsAsked asked;
  const ParsedArguments parsed = read_arguments(kQuestionsCommand, questions_options(), arguments, asked);
  asked.questions = questions_of(parsed.operands());
  if (parsed.has("--rounds") && std::ranges::find(asked.questions, "trust") == asked.questions.end())
    throw InputError("--rounds applies only to the question trust, which measures time");
  for (const char* needed : {"trajectories", "paper"}) folder_in_data(asked.data, needed);
  return asked;
}

std::size_t steps_of(const std::string& question) {
  if (question == "energy") return energy_steps();
  if (question == "bounds") return bounds_steps();
  if (question == "trust") return trust_steps();
  return combination_steps();
}

std::vector<Question> measure(const QuestionsAsked& asked, const TableCommand::Progress& progress) {
  std::size_t done = 0, total = 0;
  for (const std::string& question : asked.questions) total += steps_of(question);
  const std::function<void()> step_done = [&] { progress(++done, total); };
  std::vector<Question> questions;
  for (const std::string& question : asked.questions) {
    if (question == "energy") {
      questions.push_back(ask_about_energy(asked.data, asked.seed, step_done));
    } else if (question == "bounds") {
      questions.push_back(ask_about_bounds(asked.data, asked.seed, step_done));
    } else if (question == "trust") {
      questions.push_back(ask_about_trust(asked.data, asked.seed, asked.rounds, step_done));
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
  taken.read_folder("--data", asked.data);
  command.check_destinations(std::move(taken));
  const std::vector<Question> questions = measure(asked, command.progress());
  command.bar().erase();

  Json json;
  json["settings"] = questions_options().settings_json(asked, {{"questions", asked.questions}});
  json["rows"] = question_rows_json(questions);
  json["questions"] = questions_json(questions);
  command.deliver(json, questions_csv(questions), questions_text(questions),
                  [&](Page page) { return questions_page(questions, std::move(page)); });
  return 0;
}

}  // namespace kds
