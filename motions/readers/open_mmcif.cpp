#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <gemmi/cif.hpp>
#include <gemmi/numb.hpp>
#include <map>
#include <optional>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/residue_grouping.h"
#include "motions/readers/structure_models.h"

namespace kds {

namespace {

bool begins_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

// A file and its text, for messages.
struct Source {
  std::string file, text;
};

// Returns the line of the `index`-th value of the loop that begins with this tag, at this line or after it.
// For a pair of a tag and a value, returns the line of the tag.
std::size_t line_of_value(std::string_view text, std::size_t line, const std::string& first_tag,
                          std::size_t columns, std::size_t index) {
  constexpr std::string_view blanks = " \t\n";
  std::size_t offset = 0;
  for (std::size_t left = line; left > 1 && offset < text.size(); --left)
    offset = std::min(text.find('\n', offset), text.size() - 1) + 1;
  bool found = false;
  std::size_t to_skip = columns - 1 + index;
  for (;;) {
    const std::size_t next = std::min(text.find_first_not_of(blanks, offset), text.size());
    line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(offset),
                                                text.begin() + static_cast<std::ptrdiff_t>(next), '\n'));
    offset = next;
    if (offset == text.size()) return line;
    if (text[offset] == '#') {
      offset = std::min(text.find('\n', offset), text.size());
      continue;
    }
    std::size_t end = text.find_first_of(blanks, offset);
    if (text[offset] == ';' && (offset == 0 || text[offset - 1] == '\n')) {
      end = text.find("\n;", offset);
      if (end != std::string_view::npos) end += 2;
    } else if (text[offset] == '\'' || text[offset] == '"') {
      end = offset;
      do end = text.find(text[offset], end + 1);
      while (end != std::string_view::npos && end + 1 < text.size() &&
             blanks.find(text[end + 1]) == std::string_view::npos);
      if (end != std::string_view::npos) ++end;
    }
    const std::string_view token = text.substr(offset, end - offset);
    if (found && to_skip-- == 0) return line;
    found = found || token == first_tag;
    line += static_cast<std::size_t>(std::count(token.begin(), token.end(), '\n'));
    offset += token.size();
  }
}

// A number as CIF writes it, perhaps with its standard uncertainty: 1.25, -3e2, 1.25(3).
std::optional<double> parse_cif_number(std::string_view text) {
  if (const std::size_t open = text.find('('); open != std::string_view::npos) {
    const std::string_view digits = text.substr(open + 1, text.size() - open - 2);
    if (text.back() != ')' || digits.empty() ||
        digits.find_first_not_of("0123456789") != std::string_view::npos)
      return std::nullopt;
    text = text.substr(0, open);
  }
  const std::optional<double> value = parse_double(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

// Rewords a complaint of gemmi, "line:column: message", and shows the line as far as it is short.
std::string explained(std::string_view text, std::string complaint) {
  std::size_t line = std::strtoul(complaint.c_str(), nullptr, 10);
  const std::size_t unsaid = complaint.rfind("parse error");
  if (unsaid != std::string::npos)
    complaint.replace(unsaid, std::string::npos,
                      "expected data_, a tag with its value, or loop_ with tags and values");
  for (; line > 1 && !text.empty(); --line)
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  const std::string_view shown = text.substr(0, std::min<std::size_t>(text.find_first_of("\r\n"), 40));
  return fmt::format("{}, found {}", complaint, shown.empty() ? "the end of the file" : in_quotes(shown));
}

// A bare word of CIF has ASCII characters only, and gemmi ends a loop where one begins otherwise.
std::string hint_at_foreign_letters(std::string_view text) {
  const auto foreign =
      std::find_if(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) > 0x7e; });
  if (foreign == text.end()) return "";
  return fmt::format("; line {} has a character that CIF allows only in quotes",
                     1 + std::count(text.begin(), foreign, '\n'));
}

// Throws InputError naming file and line. Depends on the texts of gemmi's exceptions.
gemmi::cif::Document read_cif(const std::string& file, std::string_view text) {
  gemmi::cif::Document document;
  const auto refuse = [&](const gemmi::cif::Item& item, const std::string& message) {
    throw InputError(fmt::format("{}:{}: {}", file, item.line_number, message));
  };
  try {
    gemmi::cif::parse_input(document, tao::pegtl::memory_input<>(text.data(), text.size(), ""));
  } catch (const tao::pegtl::parse_error& error) {
    std::string complaint = error.what();
    if (!complaint.empty() && complaint.front() == ':') complaint.erase(0, 1);
    const bool is_in_loop = document.items_ != nullptr && !document.items_->empty() &&
                            document.items_->back().type == gemmi::cif::ItemType::Loop;
    if (is_in_loop && complaint.find("Wrong number of values") != std::string::npos) {
      const gemmi::cif::Item& item = document.items_->back();
      const std::size_t columns = item.loop.tags.size();
      refuse(item, fmt::format("the loop of {} ends inside a row ({}, {} a row){}",
                               in_quotes(item.loop.tags.front()), counted(item.loop.values.size(), "value"),
                               columns, hint_at_foreign_letters(text)));
    }
    throw InputError(fmt::format("{}:{}{}", file, explained(text, complaint), hint_at_foreign_letters(text)));
  }
  if (document.blocks.empty())
    throw InputError(
        fmt::format("{}:1: expected data_ at the start of an mmCIF file, found the end of the file", file));
  for (const gemmi::cif::Block& block : document.blocks)
    for (const gemmi::cif::Item& item : block.items)
      if (item.type == gemmi::cif::ItemType::Pair && item.pair[1].empty())
        refuse(item, fmt::format("{} has no value", in_quotes(item.pair[0])));
  return document;
}

// The rows of one category of a data block, as a loop or a row of pairs.
class Table {
 public:
  // Throws InputError if the block has the category twice, or a tag of it.
  Table(const Source& source, const gemmi::cif::Block& block, const std::string& category)
      : source_(source), category_(category) {
    for (const gemmi::cif::Item& item : block.items) {
      if (item.type == gemmi::cif::ItemType::Pair && begins_with(lower_case(item.pair[0]), category)) {
        pairs_ = true;
        tags_.push_back(lower_case(item.pair[0]));
        values_.push_back(item.pair[1]);
        items_.push_back(&item);
      } else if (item.type == gemmi::cif::ItemType::Loop && !item.loop.tags.empty() &&
                 begins_with(lower_case(item.loop.tags.front()), category)) {
        loops_ += 1;
        tags_.clear();
        for (const std::string& tag : item.loop.tags) tags_.push_back(lower_case(tag));
        loop_ = &item;
      }
    }
    if (loops_ + (pairs_ ? 1 : 0) > 1)
      throw InputError(fmt::format("{}: data block {} has more than one table {}, expected one", source.file,
                                   in_quotes(block.name), category.substr(0, category.size() - 1)));
    std::vector<std::string> sorted = tags_;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end())
      throw InputError(fmt::format("{}: data block {} has the tag {} twice, expected it once", source.file,
                                   in_quotes(block.name), in_quotes(*twice)));
  }

  std::size_t rows() const { return tags_.empty() ? 0 : values().size() / tags_.size(); }
  bool has(const std::string& column) const { return index_of(column) < tags_.size(); }

  // The first of these columns that has a value in this row, "" if none has.
  std::string text(std::size_t row, std::initializer_list<std::size_t> columns) const {
    for (const std::size_t column : columns) {
      if (column >= tags_.size()) continue;
      const std::string& value = values()[row * tags_.size() + column];
      if (!gemmi::cif::is_null(value)) return gemmi::cif::as_string(value);
    }
    return "";
  }
  std::optional<double> find_number(std::size_t row, std::size_t column) const {
    return parse_cif_number(values()[row * tags_.size() + column]);
  }
  // Throws InputError naming the line if there is no number.
  double number(std::size_t row, std::size_t column) const {
    if (const auto number = find_number(row, column)) return *number;
    const std::size_t index = row * tags_.size() + column;
    const gemmi::cif::Item& item = loop_ != nullptr ? *loop_ : *items_[column];
    const auto begin = static_cast<std::size_t>(std::max(item.line_number, 1));
    const std::size_t line = loop_ != nullptr ? line_of_value(source_.text, begin, item.loop.tags.front(),
                                                              item.loop.tags.size(), index)
                                              : line_of_value(source_.text, begin, item.pair[0], 1, 0);
    throw InputError(fmt::format("{}:{}: expected a number for {}, found {}", source_.file, line,
                                 loop_ != nullptr ? item.loop.tags[column] : item.pair[0],
                                 in_quotes(values()[index])));
  }
  // The index of a column in a row; one past the last column if there is none.
  std::size_t index_of(const std::string& column) const {
    return static_cast<std::size_t>(std::find(tags_.begin(), tags_.end(), category_ + lower_case(column)) -
                                    tags_.begin());
  }

 private:
  const std::vector<std::string>& values() const { return loop_ != nullptr ? loop_->loop.values : values_; }

  const Source& source_;
  std::string category_;
  int loops_ = 0;
  bool pairs_ = false;
  std::vector<std::string> tags_, values_;
  std::vector<const gemmi::cif::Item*> items_;  // pairs
  const gemmi::cif::Item* loop_ = nullptr;
};

std::map<std::string, Entity> entities_of(const Source& source, const gemmi::cif::Block& block) {
  std::map<std::string, Entity> entities;
  const Table table(source, block, "_entity.");
  const std::size_t id = table.index_of("id"), type = table.index_of("type");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string said = lower_case(table.text(row, {type}));
    const bool other = said == "non-polymer" || said == "branched" || said == "water";
    entities[table.text(row, {id})] = said == "polymer" ? Entity::polymer
                                      : other           ? Entity::other
                                                        : Entity::unknown;
  }
  return entities;
}

void check_columns(const std::string& file, const Table& atoms) {
  for (const char* column : {"Cartn_x", "Cartn_y", "Cartn_z"})
    if (!atoms.has(column))
      throw InputError(fmt::format(
          "{}: the atoms have no column _atom_site.{}{}", file, column,
          atoms.has("fract_x") ? "; this is a small-molecule CIF, whose coordinates are fractions of its cell"
                               : ""));
  using Names = std::pair<const char*, const char*>;
  for (const auto& [one, other] :
       {Names("label_atom_id", "auth_atom_id"), Names("label_comp_id", "auth_comp_id")})
    if (!atoms.has(one) && !atoms.has(other))
      throw InputError(fmt::format("{}: the atoms have neither a column _atom_site.{} nor _atom_site.{}",
                                   file, one, other));
}

struct ModelRead {
  std::string name;
  ResidueGrouping grouping;
  std::size_t atoms = 0;
};

// Rows of several models may be mixed. Chains, numbers and names are the authors', as in PDB files.
std::vector<StructureModel> models_of(const Source& source, const gemmi::cif::Block& block) {
  const Table atoms(source, block, "_atom_site.");
  check_columns(source.file, atoms);
  const std::map<std::string, Entity> entities = entities_of(source, block);
  const auto column = [&](const char* name) { return atoms.index_of(name); };
  const std::size_t x = column("Cartn_x"), y = column("Cartn_y"), z = column("Cartn_z"),
                    model = column("pdbx_PDB_model_num"), group = column("group_PDB"),
                    asym = column("auth_asym_id"), label_asym = column("label_asym_id"),
                    number = column("auth_seq_id"), label_number = column("label_seq_id"),
                    insertion = column("pdbx_PDB_ins_code"), comp = column("auth_comp_id"),
                    label_comp = column("label_comp_id"), entity = column("label_entity_id"),
                    atom_id = column("auth_atom_id"), label_atom_id = column("label_atom_id"),
                    alternate = column("label_alt_id"), symbol = column("type_symbol"),
                    occupancy = column("occupancy"), b_factor = column("B_iso_or_equiv");
  std::vector<ModelRead> read;
  std::map<std::string, std::size_t> model_of;
  for (std::size_t row = 0; row < atoms.rows(); ++row) {
    const std::string name = atoms.text(row, {model});
    const auto [found, is_new] = model_of.emplace(name, read.size());
    if (is_new) read.emplace_back().name = name;
    ModelRead& into = read[found->second];
    StructureResidue residue;
    residue.chain = atoms.text(row, {asym, label_asym});
    if (asym == label_asym) residue.chain = "A";  // neither column is there
    residue.number = atoms.text(row, {number, label_number});
    if (residue.number.empty()) residue.number = "?";
    residue.number += atoms.text(row, {insertion});
    residue.name = atoms.text(row, {comp, label_comp});
    residue.sequence = atoms.text(row, {label_number});
    residue.molecule = atoms.text(row, {label_asym, asym});
    const std::string kind = atoms.text(row, {group});
    residue.het = !kind.empty() && (kind[0] == 'H' || kind[0] == 'h');
    const auto said = entities.find(atoms.text(row, {entity}));
    if (said != entities.end()) residue.entity = said->second;
    StructureAtom atom;
    atom.name = atoms.text(row, {atom_id, label_atom_id});
    const std::string location = atoms.text(row, {alternate});
    atom.alternate = location.empty() ? '\0' : location[0];
    atom.element = gemmi::Element(atoms.text(row, {symbol}));
    atom.element_is_given = atom.element != gemmi::El::X;
    atom.index = into.atoms++;
    atom.occupancy = parse_cif_number(atoms.text(row, {occupancy}));
    atom.b_factor = parse_cif_number(atoms.text(row, {b_factor}));
    atom.position = {atoms.number(row, x), atoms.number(row, y), atoms.number(row, z)};
    into.grouping.add(residue, std::move(atom));
  }
  std::vector<StructureModel> models;
  for (ModelRead& one : read) {
    models.emplace_back().residues = one.grouping.take();
    models.back().atom_count = one.atoms;
  }
  return models;
}

CellRead cell_of(const Source& source, const gemmi::cif::Block& block) {
  using Names = std::pair<const char*, const char*>;
  for (const auto& [category, tag] :
       {Names("_symmetry.", "space_group_name_H-M"), Names("_space_group.", "name_H-M_alt")}) {
    const Table table(source, block, category);
    if (table.rows() == 0 || !table.has(tag)) continue;
    const std::string group = table.text(0, {table.index_of(tag)});
    if (!group.empty() && !is_space_group_p1(group)) return {};
  }
  const Table table(source, block, "_cell.");
  if (table.rows() == 0) return {};
  std::array<double, 6> numbers{};
  constexpr std::array tags{"length_a", "length_b", "length_c", "angle_alpha", "angle_beta", "angle_gamma"};
  for (std::size_t i = 0; i < tags.size(); ++i) {
    // A value that is not known means that there is no cell.
    if (!table.has(tags[i]) || table.text(0, {table.index_of(tags[i])}).empty()) return {};
    const auto number = table.find_number(0, table.index_of(tags[i]));
    if (!number) return {std::nullopt, "_cell has a length or an angle that is no number"};
    numbers[i] = *number;
  }
  return read_cell_from_angles({numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]});
}

// Says what a file without atoms of mmCIF holds instead, by the tags of other dictionaries.
std::string contents_of(const gemmi::cif::Document& document) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kinds{
      {{"_atom_site_",
        "; this is a small-molecule CIF, which is not read; convert it to PDB, as with obabel"},
       {"_refln", "; this file holds structure factors; take the file with the model"},
       {"_chem_comp_atom.", "; this file describes chemical components"},
       {"_ihm_", "; this is an integrative model of IHMCIF"}}};
  for (const auto& [start, what] : kinds)
    for (const gemmi::cif::Block& block : document.blocks)
      for (const gemmi::cif::Item& item : block.items) {
        const bool is_loop = item.type == gemmi::cif::ItemType::Loop && !item.loop.tags.empty();
        if (!is_loop && item.type != gemmi::cif::ItemType::Pair) continue;
        if (begins_with(lower_case(is_loop ? item.loop.tags.front() : item.pair[0]), std::string(start)))
          return std::string(what);
      }
  return "";
}

class MmcifModels : public StructureModels {
 public:
  explicit MmcifModels(const std::filesystem::path& path) {
    Source source{path.string(), read_whole_file(path)};
    unify_line_ends(source.text);
    const std::string& file = source.file;
    const gemmi::cif::Document document = read_cif(file, source.text);
    const gemmi::cif::Block* chosen = nullptr;
    std::string others;
    for (const gemmi::cif::Block& block : document.blocks) {
      if (Table(source, block, "_atom_site.").rows() == 0) continue;
      if (chosen == nullptr)
        chosen = &block;
      else
        others += (others.empty() ? "" : ", ") + in_quotes(block.name);
    }
    if (chosen == nullptr)
      throw InputError(
          fmt::format("{}: no atom in any data block (_atom_site.){}", file, contents_of(document)));
    if (!others.empty())
      notes_.push_back(
          fmt::format("data block {} is read; the atoms of {} are not", in_quotes(chosen->name), others));
    models_ = models_of(source, *chosen);
    cell_ = cell_of(source, *chosen);
  }

  FramesHeld held() const override { return {models_.size(), false}; }
  bool may_have_cell() const override { return cell_.cell.has_value(); }
  std::vector<std::string> notes() const override { return notes_; }
  StructureModel model(std::size_t k) override {
    StructureModel model = models_[k];
    model.cell = cell_;
    return model;
  }

 private:
  std::vector<StructureModel> models_;
  CellRead cell_;
  std::vector<std::string> notes_;
};

}  // namespace

std::unique_ptr<StructureModels> open_mmcif(const std::filesystem::path& path) {
  return std::make_unique<MmcifModels>(path);
}

}  // namespace kds
