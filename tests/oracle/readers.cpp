// Simple readers for DCD, PDB and instance files.

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <tuple>

#include "scene.h"

namespace oracle {
namespace {

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  if (at + 4 > bytes.size()) throw UsageError("DCD: the file ends inside its header");
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return word;
}

double float_at(const std::string& bytes, std::size_t at) {
  const std::uint32_t word = word_at(bytes, at);
  float value = 0;
  std::memcpy(&value, &word, sizeof value);
  return static_cast<double>(value);
}

std::string columns(const std::string& line, std::size_t first, std::size_t last) {
  return line.size() < first ? std::string() : line.substr(first - 1, last - first + 1);
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \r");
  return first == std::string::npos ? std::string()
                                    : text.substr(first, text.find_last_not_of(" \r") - first + 1);
}

// Picks N, CA and C of the residues of the first chain until its records end; atoms after TER are ligands.
class BackbonePicker {
 public:
  void add(const std::string& line, std::size_t atom) {
    const std::string chain = columns(line, 22, 22);
    if (!chain_) chain_ = chain;
    if (chain != *chain_ || ended_) return;
    const std::string residue = columns(line, 23, 27);
    if (residues_.empty() || residues_.back().name != residue) residues_.push_back({residue, {}, {}});
    static const std::map<std::string, std::size_t> wanted{{"N", 0}, {"CA", 1}, {"C", 2}};
    const auto slot = wanted.find(trimmed(columns(line, 13, 16)));
    Residue& current = residues_.back();
    if (slot == wanted.end() || current.found[slot->second]) return;  // the first alternate location counts
    current.found[slot->second] = atom + 1;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::string field = columns(line, 31 + 8 * c, 38 + 8 * c);
      current.atoms[slot->second][c] = std::stod(field);
    }
  }
  void end_chain(const std::string& line) {
    const std::string chain = columns(line, 22, 22);
    if (chain_ && (chain.empty() || chain == *chain_)) ended_ = true;
  }
  void finish(Points& points, std::vector<std::size_t>* places) const {
    for (const Residue& residue : residues_) {
      if (!residue.found[0] || !residue.found[1] || !residue.found[2]) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        points.push_back(residue.atoms[i]);
        if (places) places->push_back(residue.found[i] - 1);
      }
    }
  }

 private:
  struct Residue {
    std::string name;
    std::array<std::array<double, 3>, 3> atoms;
    std::array<std::size_t, 3> found;  ///< index + 1, or 0
  };
  std::optional<std::string> chain_;
  bool ended_ = false;
  std::vector<Residue> residues_;
};

}  // namespace

std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw UsageError(path.string() + ": cannot be read");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<Points> read_dcd(const std::filesystem::path& path) {
  const std::string bytes = read_text(path);
  if (bytes.size() < 92 || word_at(bytes, 0) != 84 || bytes.compare(4, 4, "CORD") != 0) {
    throw UsageError(path.string() + ": not a little-endian DCD file");
  }
  // Word i of the control block is at 8 + 4i.
  const bool charmm = word_at(bytes, 8 + 4 * 19) != 0;
  const bool has_cell = charmm && word_at(bytes, 8 + 4 * 10) != 0;
  if (word_at(bytes, 8 + 4 * 8) != 0) throw UsageError(path.string() + ": fixed atoms are not supported");
  if (charmm && word_at(bytes, 8 + 4 * 11) != 0) throw UsageError(path.string() + ": has four dimensions");
  std::size_t at = 92;
  at += word_at(bytes, at) + 8;  // titles
  if (word_at(bytes, at) != 4) throw UsageError(path.string() + ": no atom count where it should be");
  const std::size_t atoms = word_at(bytes, at + 4);
  at += 12;
  const std::size_t record = 4 * atoms + 8;
  const std::size_t cell = has_cell ? 48 + 8 : 0;
  std::vector<Points> frames;
  // The frame count of the header is unreliable, so all frames in the file are read.
  for (; at + cell + 3 * record <= bytes.size(); at += cell + 3 * record) {
    if (has_cell && word_at(bytes, at) != 48) throw UsageError(path.string() + ": unit cell block expected");
    Points points(atoms);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t start = at + cell + c * record;
      if (word_at(bytes, start) != 4 * atoms) {
        throw UsageError(path.string() + ": bad record in frame " + std::to_string(frames.size()));
      }
      for (std::size_t i = 0; i < atoms; ++i) points[i][c] = float_at(bytes, start + 4 + 4 * i);
    }
    frames.push_back(std::move(points));
  }
  return frames;
}

PdbBackbone read_pdb(const std::filesystem::path& path) {
  std::istringstream in(read_text(path));
  PdbBackbone backbone;
  std::optional<BackbonePicker> picker;
  std::size_t atoms = 0;
  const auto finish_model = [&] {
    if (!picker) return;
    const bool first = backbone.models.empty();
    backbone.models.emplace_back();
    picker->finish(backbone.models.back(), first ? &backbone.first_model_atoms : nullptr);
    if (first) backbone.atom_count = atoms;
    picker.reset();
    atoms = 0;
  };
  for (std::string line; std::getline(in, line);) {
    const std::string record = trimmed(columns(line, 1, 6));
    if (record == "MODEL" || record == "ENDMDL" || record == "END") finish_model();
    if (record == "TER" && picker) picker->end_chain(line);
    if (record != "ATOM" && record != "HETATM") continue;
    if (!picker) picker.emplace();
    picker->add(line, atoms++);
  }
  finish_model();
  for (std::size_t m = 0; m < backbone.models.size(); ++m) {
    if (backbone.models[m].empty() || backbone.models[m].size() != backbone.models[0].size()) {
      throw UsageError(path.string() + ": model " + std::to_string(m) + " has another backbone");
    }
  }
  return backbone;
}

std::vector<Points> read_xyz(const std::filesystem::path& path) {
  std::istringstream in(read_text(path));
  std::vector<Points> frames;
  for (std::string line; std::getline(in, line);) {
    Points points(std::stoul(line));
    std::getline(in, line);  // a comment
    for (auto& point : points) {
      if (!std::getline(in, line)) throw UsageError(path.string() + ": ends inside a frame");
      std::istringstream fields(line);
      std::string symbol, word;
      fields >> symbol;
      for (double& x : point) {
        fields >> word;
        x = std::stod(word);
      }
    }
    frames.push_back(std::move(points));
  }
  return frames;
}

std::vector<Frame> read_instance(const std::filesystem::path& path, int& dimension) {
  std::istringstream in(read_text(path));
  std::size_t n = 0, width = 0, degree = 0;
  if (!(in >> n >> width >> degree) || width < 2 || width > 4 || degree == 0) {
    throw UsageError(path.string() + ": not an instance with two columns, or three (and a weight)");
  }
  dimension = width == 2 ? 2 : 3;
  std::vector<Frame> frames(2, Frame(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t c = 0; c < width; ++c) {
      for (std::size_t k = 0; k <= degree; ++k) {
        std::string word;
        in >> word;
        if (word.empty()) throw UsageError(path.string() + ": ends too early");
        if (k != 0 && k != degree) continue;
        Ball& ball = frames[k == 0 ? 0 : 1][i];
        const double value = std::stod(word);
        if (c < 3) {
          ball.centre[c] = value;
        } else {
          ball.weight = value;
          ball.radius = std::sqrt(value);
        }
      }
    }
  }
  return frames;
}

}  // namespace oracle
