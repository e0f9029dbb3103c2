#include "harness/campaign/read_campaign.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/campaign/registry.h"
#include "harness/io/errors.h"
#include "harness/scene/nearest_name.h"
#include "harness/scene/text_file.h"

namespace ddem::harness {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;
constexpr std::string_view kStudies = "studies";

class CampaignReader {
 public:
  CampaignReader(const Document& document, const std::filesystem::path& path) : document_(document), path_(path) {}

  CampaignSpec read() {
    refuse_strangers();
    for (const InputTable& t : input_tables()) {
      if (stands(t)) spec_.tables[std::string(t.name)] = t.read(document_, path_, problems_);
    }
    // [studies] alone chooses among those of a campaign without a file.
    if (spec_.tables.empty() && has_studies_) spec_ = default_campaign();
    if (spec_.tables.empty() && problems_.empty()) {
      problems_.push_back(fmt::format("{}: an empty campaign; write {}", path_.string(), fmt::join(helps(), ", or ")));
    }
    choose_studies();
    if (!problems_.empty()) throw InputError(problems_);
    return spec_;
  }

 private:
  void report(int line, const std::string& key, const std::string& value, const std::string& message, const std::string& remedy) {
    problems_.push_back(to_string(Violation{path_.string(), line, 0, key, value, message, remedy}));
  }

  static std::vector<std::string_view> helps() {
    std::vector<std::string_view> all;
    for (const InputTable& t : input_tables()) all.push_back(t.help);
    return all;
  }

  bool stands(const InputTable& t) const {
    const auto is_called = [&](const auto& table) { return table.name == t.name; };
    return t.is_list ? std::ranges::any_of(document_.elements, is_called) : std::ranges::any_of(document_.tables, is_called);
  }

  void refuse_strangers() {
    const auto refuse = [&](const auto& table, bool is_list) {
      const bool known = std::ranges::any_of(input_tables(), [&](const InputTable& t) { return t.name == table.name && t.is_list == is_list; });
      if (known) return;
      if (!is_list && table.name == kStudies) has_studies_ = true;
      else report(table.line, table.name, "", "unknown table", fmt::format("a campaign has {}, and [studies]", fmt::join(helps(), ", ")));
    };
    for (const TableHeader& t : document_.tables) refuse(t, false);
    for (const Element& e : document_.elements) refuse(e, true);
    for (const Entry& e : document_.entries) {
      const bool list = std::ranges::any_of(document_.elements, [&](const Element& x) { return x.name == e.key; });
      if (e.table.empty() && !list) report(e.node.line, e.key, e.node.text, "stands outside of a table", "move it below [strip]");
    }
  }

  /// Empty, with a problem, where it is no list of studies of this campaign.
  std::vector<std::string> study_names(const Entry& e) {
    std::vector<std::string_view> known;
    for (const StudyEntry& s : studies()) {
      if (spec_.has(s.table)) known.push_back(s.id);
    }
    std::vector<std::string> names;
    const auto* list = std::get_if<Node::List>(&e.node.value);
    const auto refuse = [&](const std::string& remedy) { report(e.node.line, "studies." + e.key, e.node.text, "no list of studies", remedy); };
    const std::string remedy = fmt::format("give a list of {}", fmt::join(known, ", "));
    if (list == nullptr || list->empty()) return refuse(remedy), names;
    for (const Node& item : *list) {
      const auto* text = std::get_if<std::string>(&item.value);
      std::string name = text == nullptr ? "" : *text;
      std::replace(name.begin(), name.end(), '-', '_');
      if (std::ranges::find(known, name) == known.end()) {
        const auto near = nearest_name(name, known);
        return refuse(near ? fmt::format("did you mean \"{}\"?", *near) : remedy), std::vector<std::string>{};
      }
      names.push_back(name);
    }
    return names;
  }

  void choose_studies() {
    const Entry* chosen = nullptr;
    for (const Entry& e : document_.entries) {
      if (e.table != kStudies) continue;
      if (e.key != "run" && e.key != "skip") {
        report(e.node.line, "studies." + e.key, e.node.text, "unknown key", "the keys are run, skip");
      } else if (chosen != nullptr) {
        report(e.node.line, "studies." + e.key, e.node.text, "beside studies." + chosen->key, "give run, or skip");
      } else {
        chosen = &e;
      }
    }
    if (chosen == nullptr) return;
    const std::vector<std::string> names = study_names(*chosen);
    if (names.empty()) return;
    for (const StudyEntry& s : studies()) {
      const bool named = std::ranges::find(names, s.id) != names.end();
      if (spec_.has(s.table) && named == (chosen->key == "run")) spec_.studies.emplace_back(s.id);
    }
    if (spec_.studies.empty()) report(chosen->node.line, "studies.skip", chosen->node.text, "nothing is left to run", "skip fewer");
  }

  const Document& document_;
  const std::filesystem::path& path_;
  std::vector<std::string> problems_;
  CampaignSpec spec_;
  bool has_studies_ = false;
};

}  // namespace

CampaignSpec read_campaign(const std::filesystem::path& path) {
  const auto text = read_text_file(path, kMostBytes, Pipes::taken);
  if (!text) throw InputError(to_string(text.violations));
  return parse_campaign(*text, path);
}

CampaignSpec parse_campaign(std::string_view text, const std::filesystem::path& path) {
  const auto document = parse_document(text, path.string());
  if (!document) throw InputError(to_string(document.violations));
  return CampaignReader(*document, path).read();
}

}  // namespace ddem::harness
