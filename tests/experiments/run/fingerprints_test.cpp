// Runs of the program with recorded histories. tests/support/fingerprints.csv has a row for each run, with
// the fingerprint of all events in order and the number of events of each structure. A row changes only if a
// history is changed on purpose.
// The columns are:
// - `run`: the arguments of `kds run`; names with a slash are in the data folder
// - `fingerprint`
// - `events`
// - `model`: the arguments of `kds generate`, if the input is a model
// - `beads`: a hash of that model's coordinates, which distinguishes a changed model from a changed history
// - `replayed`: `always` or `all`. Rows marked `all` take minutes and are replayed only with
//   KDS_ALL_FINGERPRINTS=1 in the environment.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motions/models/model.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/support/rounds.h"

namespace kds::fingerprints_test {
namespace {

using test::ProgramRun;
using test::run_program;
using test::ScratchDirectory;
using Words = std::vector<std::string>;

struct Row {
  std::string run, fingerprint, events, model, beads, replayed;
};

enum class Source { instance, trajectory, model };

// Splits a line of CSV into fields. Fields with commas are quoted, and no field contains a quotation mark.
Words fields_of(const std::string& line) {
  Words fields{""};
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

std::vector<Row> read_rows() {
  std::ifstream file(test::data_file("../tests/support/fingerprints.csv"));
  std::vector<Row> rows;
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "run,fingerprint,events,model,beads,replayed");
  while (std::getline(file, line)) {
    const Words f = fields_of(line);
    if (f.size() != 6) {
      ADD_FAILURE() << "a row has 6 fields: " << line;
      continue;
    }
    rows.push_back({f[0], f[1], f[2], f[3], f[4], f[5]});
  }
  return rows;
}

Words words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

Source source_of(const Row& row) {
  if (!row.model.empty()) return Source::model;
  return row.run.starts_with("kinetic/") ? Source::instance : Source::trajectory;
}

// Returns the FNV-1a hash of the lines with beads.
std::string hash_of_beads(const std::string& xyz) {
  std::uint64_t hash = 0xcbf29ce484222325;
  std::istringstream lines(xyz);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("X ")) continue;
    for (const char c : line + '\n') hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  std::ostringstream text;
  text << std::hex;
  text.width(16);
  text.fill('0');
  text << hash;
  return text.str();
}

// Writes the model of a row into the directory and returns its files. Returns no files if the model differs
// from the recorded one.
Words generate(const Row& row, const ScratchDirectory& scratch) {
  Words arguments = words_of(row.model);
  Words files{scratch / "model.xyz"};
  if (arguments.front() == "two-spirals") files = {scratch / "model-1.xyz", scratch / "model-2.xyz"};
  // Recorded models have the full number of turns, even if the beads are too large for that.
  const models::Model* const model = models::find_model(arguments.front());
  if (model != nullptr && model->takes(models::Setting::turns) &&
      std::ranges::count(arguments, "--turns") == 0)
    arguments.insert(arguments.end(), {"--turns", std::to_string(*model->defaults.turns)});
  arguments.insert(arguments.begin(), "generate");
  arguments.insert(arguments.end(), {"-o", scratch / "model.xyz", "--quiet"});
  const ProgramRun run = run_program(std::move(arguments));
  std::string content;
  for (const std::string& file : files) content += test::content_of(file);
  if (run.code == 0 && hash_of_beads(content) == row.beads) return files;
  ADD_FAILURE() << "generate " << row.model << ": not the model on record, its beads have the hash "
                << hash_of_beads(content) << " and not " << row.beads << "\n"
                << run.err;
  return {};
}

// Returns the text after `key`, searched from `from` on, up to a character of `ends`.
std::string value_after(std::string_view text, std::string_view key, std::string_view ends,
                        std::size_t from = 0) {
  const std::size_t at = text.find(key, from);
  if (at == std::string_view::npos) return "missing";
  const std::size_t begin = at + key.size();
  return std::string(text.substr(begin, text.find_first_of(ends, begin) - begin));
}

// Returns the events in a summary, in the format of the table, of the structures that the table names.
std::string events_in(const std::string& summary, const std::string& expected) {
  std::string events;
  for (const std::string& word : words_of(expected)) {
    const std::string name = word.substr(0, word.find('='));
    const std::size_t structure = summary.find("\"" + name + "\": {");
    const std::string total =
        structure == std::string::npos ? "missing" : value_after(summary, "\"total\": ", ",\n ", structure);
    events += (events.empty() ? "" : " ") + name + "=" + total;
  }
  return events;
}

void replay(const Row& row, Words inputs) {
  Words arguments{"run"};
  arguments.insert(arguments.end(), inputs.begin(), inputs.end());
  for (const std::string& word : words_of(row.run))
    arguments.push_back(word.find('/') == std::string::npos ? word : test::data_file(word));
  arguments.insert(arguments.end(), {"--quiet", "--json", "-"});
  const ProgramRun run = run_program(std::move(arguments));
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(events_in(run.out, row.events), row.events);
  EXPECT_EQ(value_after(run.out, "\"fingerprint\": \"", "\""), row.fingerprint);
}

void replay_all(Source source, const std::string& kernel) {
  const ScratchDirectory scratch;
  const char* all = std::getenv("KDS_ALL_FINGERPRINTS");
  const bool all_rows = all != nullptr && std::string_view(all) == "1";
  std::string model;  // the model whose files are in the directory
  Words inputs;
  int rows = 0, replayed = 0;
  constexpr int every = 7 / test::rounds(7);
  for (const Row& row : read_rows()) {
    if (source_of(row) != source || row.run.find("--kernel " + kernel) == std::string::npos) continue;
    if (!all_rows && row.replayed != "always") continue;
    if (++rows % every != 0) continue;
    SCOPED_TRACE(row.model.empty() ? row.run : "model " + row.model + ": " + row.run);
    ++replayed;
    if (row.model != model) inputs = generate(row, scratch);
    model = row.model;
    if (model.empty() || !inputs.empty()) replay(row, inputs);
  }
  EXPECT_GT(replayed, 0);
}

TEST(Fingerprints, OfInstancesFiltered) { replay_all(Source::instance, "filtered"); }
TEST(Fingerprints, OfInstancesExact) { replay_all(Source::instance, "exact"); }
TEST(Fingerprints, OfTrajectoriesFiltered) { replay_all(Source::trajectory, "filtered"); }
TEST(Fingerprints, OfTrajectoriesExact) { replay_all(Source::trajectory, "exact"); }
TEST(Fingerprints, OfModelsFiltered) { replay_all(Source::model, "filtered"); }
TEST(Fingerprints, OfModelsExact) { replay_all(Source::model, "exact"); }

}  // namespace
}  // namespace kds::fingerprints_test
