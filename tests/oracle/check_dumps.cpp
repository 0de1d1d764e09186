// Judges the dumps of `kds run --dump` with CGAL's static structures and exact proofs. Shares no code with
// kds.
//
//   check_dumps --dump DIR INPUT... [--frames FIRST:LAST:STRIDE] [--radius R|file:PATH|auto] [--every K]
//   INPUT: --dcd FILE [--select-from PDB] | --pdb FILE | --xyz FILE   (several: several necklaces)
//          | --instance FILE
//   check_dumps --make --dump DIR INPUT...     writes a correct dump from static structures
//   check_dumps --self-test [INPUT...]         corrupts correct dumps and requires that each is noticed
//
// Exit code: 0 if all is correct, 1 for a mismatch, 2 for wrong usage.

#include <charconv>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "check_dump.h"
#include "self_test.h"

namespace {

using oracle::UsageError;

struct Options {
  oracle::SceneOptions scene;
  std::filesystem::path dump;
  std::size_t every = 10;
  bool make = false, self_test = false;
};

std::size_t whole_number(const std::string& text, const std::string& option) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw UsageError(option + ": '" + text + "' is no whole number");
  }
  return value;
}

void parse_frames(const std::string& text, oracle::SceneOptions& scene) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ':') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  if (parts.size() > 3) throw UsageError("--frames: FIRST:LAST:STRIDE expected");
  if (!parts[0].empty()) scene.first = whole_number(parts[0], "--frames");
  if (parts.size() > 1 && !parts[1].empty()) scene.last = whole_number(parts[1], "--frames");
  if (parts.size() > 2 && !parts[2].empty()) scene.stride = whole_number(parts[2], "--frames");
  if (scene.stride == 0) throw UsageError("--frames: the stride is at least 1");
}

Options parse(const std::vector<std::string>& words) {
  Options options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--make" || word == "--self-test" || word == "--auto-radius") {
      if (word == "--make") options.make = true;
      if (word == "--self-test") options.self_test = true;
      if (word == "--auto-radius") options.scene.radius = "auto";
      continue;
    }
    if (i + 1 == words.size()) throw UsageError(word + ": unknown, or lacks its value");
    const std::string& value = words[++i];
    if (word == "--dump") {
      options.dump = value;
    } else if (word == "--dcd") {
      options.scene.inputs.push_back({oracle::FileKind::dcd, value, {}});
    } else if (word == "--pdb") {
      options.scene.inputs.push_back({oracle::FileKind::pdb, value, {}});
    } else if (word == "--xyz") {
      options.scene.inputs.push_back({oracle::FileKind::xyz, value, {}});
    } else if (word == "--instance") {
      options.scene.inputs.push_back({oracle::FileKind::instance, value, {}});
    } else if (word == "--select-from") {
      if (options.scene.inputs.empty()) throw UsageError("--select-from: belongs after its --dcd");
      options.scene.inputs.back().names = value;
    } else if (word == "--frames") {
      parse_frames(value, options.scene);
    } else if (word == "--radius") {
      options.scene.radius = value;
    } else if (word == "--every") {
      options.every = whole_number(value, word);
    } else {
      throw UsageError(word + ": unknown option");
    }
  }
  return options;
}

int run(const Options& options) {
  std::optional<oracle::Scene> scene;
  if (!options.scene.inputs.empty()) scene = oracle::read_scene(options.scene);
  if (options.self_test) return oracle::self_test(scene);
  if (!scene) throw UsageError("an input is needed: --dcd, --pdb, --xyz or --instance");
  if (options.dump.empty()) throw UsageError("--dump: a directory is needed");
  if (options.make) {
    oracle::write_static_dump(*scene, options.dump);
    return 0;
  }
  const oracle::Report report = oracle::check_dump(*scene, options.dump, options.every);
  for (const std::string& line : report.mismatches) std::printf("%s\n", line.c_str());
  if (report.mismatch_count > report.mismatches.size()) {
    std::printf("... and %zu more\n", report.mismatch_count - report.mismatches.size());
  }
  std::printf("%zu frames, %zu cells, %zu nodes (%zu also by CGAL), %zu degenerate frames, %zu mismatches\n",
              report.frames, report.cells, report.nodes, report.cross_checked, report.degenerate,
              report.mismatch_count);
  return report.mismatch_count == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse(std::vector<std::string>(argv + 1, argv + argc)));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "check_dumps: %s\n", error.what());
    return 2;
  }
}
