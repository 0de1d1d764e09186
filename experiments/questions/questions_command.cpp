#include "experiments/questions/questions_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/output/output_files.h"
#include "experiments/output/page/result_page.h"
#include "experiments/output/text.h"
#include "experiments/program/data_folder.h"
#include "experiments/program/option_values.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_results.h"
#include "experiments/questions/bounds_question.h"
#include "experiments/questions/combination_question.h"
#include "experiments/questions/energy_question.h"
#include "experiments/questions/questions_report.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr const char* kQuestionsName = "questions";
constexpr std::array<std::string_view, 4> kQuestions{"energy", "bounds", "trust", "combination"};

constexpr std::array kQuestionsOptions{
    OptionSpec{"--data", "DIR", "the folder data of the sources, for proteins (default: where it was built)"},
    OptionSpec{"--seed", "N", "of random chains (default: 1)"},
    OptionSpec{"--rounds", "N",
               "of each measurement of time (trust), of which the median counts (default: 5)"},
    OptionSpec{"--out", "DIR", "write questions.json, questions.csv and report.html there (default: none)"},
    OptionSpec{"--json", "FILE", "write the rows there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr CommandSpec kQuestionsCommand{
    "kds questions",
    "What Agarwal et al. (2004) leave open, measured: exponents with confidence intervals, no theorem.\n\n"
    "  energy       basis changes and flips by the energy of bending and torsion that a step takes\n"
    "  bounds       how rarely near pairs are searched anew, by what is known of speed and displacement\n"
    "  trust        what it saves to trust bases for some frames, and how far beads may stick out\n"
    "  combination  what diagram and hierarchy give together",
    "[QUESTION]...",
    "energy, bounds, trust, combination (default: all)",
    kQuestionsOptions,
    "kds questions --out report\n"
    "kds questions energy --seed 7 --json -",
};

struct QuestionsAsked {
  std::vector<std::string> questions;
  std::filesystem::path data;
  std::uint64_t seed = 1;
  std::size_t rounds = 5;
  Destinations destinations;
};

QuestionsAsked parse_questions(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kQuestionsCommand, arguments);
  QuestionsAsked asked;
  std::array<bool, kQuestions.size()> chosen_ones{};
  for (const std::string& name : parsed.operands()) {
    bool& chosen = chosen_ones[place_among("QUESTION", name, kQuestions)];
    if (chosen) throw InputError(fmt::format("QUESTION: {} is listed twice", name));
    chosen = true;
  }
  const bool all = parsed.operands().empty();
  for (std::size_t q = 0; q < kQuestions.size(); ++q)
    if (all || chosen_ones[q]) asked.questions.emplace_back(kQuestions[q]);
  if (const auto text = parsed.value("--seed"))
    asked.seed = parse_whole_number("--seed", *text, 0, UINT64_MAX);
  if (const auto text = parsed.value("--rounds")) {
    asked.rounds = parse_whole_number("--rounds", *text, 1, 1000);
    if (std::ranges::find(asked.questions, "trust") == asked.questions.end())
      throw InputError("--rounds: no question asked measures time; trust does");
  }
  asked.destinations = {path_of(parsed, "--out"), parsed.value("--json"), parsed.has("--quiet")};
  asked.data = data_folder(parsed, {"trajectories", "paper"});
  return asked;
}

void check_destinations(const Destinations& destinations, const std::filesystem::path& data) {
  TakenPaths taken;
  taken.read_folder("--data", data);
  if (destinations.out) taken.write_into("--out", *destinations.out, {"report.html"});
  check_table_destinations(destinations, kQuestionsName, taken);
  if (!destinations.out) return;
  check_page(*destinations.out, "questions");
}

std::size_t steps_of(const std::string& question) {
  if (question == "energy") return energy_steps();
  if (question == "bounds") return bounds_steps();
  if (question == "trust") return trust_steps();
  return combination_steps();
}

std::vector<Question> measure(const QuestionsAsked& asked) {
  ProgressBar bar(!asked.destinations.quiet, "measurement");
  std::size_t done = 0, total = 0;
  for (const std::string& question : asked.questions) total += steps_of(question);
  const std::function<void()> step_done = [&] { bar.update(++done, total); };
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
  check_destinations(asked.destinations, asked.data);
  const std::vector<Question> questions = measure(asked);

  const std::string command_line = "kds questions " + shell_words(arguments);
  const Json settings{{"questions", asked.questions}, {"seed", asked.seed}, {"rounds", asked.rounds}};
  Json json;
  json["settings"] = settings;
  json["rows"] = question_rows_json(questions);
  json["questions"] = questions_json(questions);
  add_provenance(json, command_line);
  deliver_table(asked.destinations, kQuestionsName,
                {text_of(json), questions_csv(questions), questions_text(questions),
                 [&] { return questions_page(questions, made_by(kQuestionsName, command_line, settings)); }});
  return 0;
}

}  // namespace kds
