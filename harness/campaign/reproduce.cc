#include "harness/campaign/reproduce.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/io/digest.h"

namespace ddem::harness {
namespace {

constexpr std::size_t kLongestName = 150;  // of the folder; file systems take 255

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || std::string_view("-_=+.").find(c) != std::string_view::npos;
}

/// "ddem-only-static-random-dem-kt0.30". Where two cases were to share one, the second finds it taken (see campaign_folder.h).
std::string folder_of(std::string case_id) {
  std::replace_if(case_id.begin(), case_id.end(), [](char c) { return !is_plain(c); }, '-');
  if (case_id.size() > kLongestName) case_id = case_id.substr(0, kLongestName) + "-" + sha256(case_id).substr(0, 16);
  return "ddem-only-" + case_id;
}

}  // namespace

std::string shell_word(std::string_view text) {
  const auto needs_no_quotes = [](char c) { return is_plain(c) || c == '/' || c == ':' || c == '@' || c == ','; };
  if (!text.empty() && std::all_of(text.begin(), text.end(), needs_no_quotes)) return std::string(text);
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string validate_command(const CampaignSpec& spec, const std::string& file, const std::string& only) {
  // A name that begins as an option does would be taken for one.
  const std::string campaign = file.starts_with('-') ? "./" + file : file;
  const auto option = [](const char* name, const std::string& value) { return value.empty() ? "" : fmt::format(" {} {}", name, shell_word(value)); };
  const std::string ranks = spec.ranks > 0 ? std::to_string(spec.ranks) : "";
  return fmt::format("ddem validate{}{}{}{}", option("--only", only), option("--solver", spec.solver), option("--ranks", ranks), campaign.empty() ? "" : " " + shell_word(campaign));
}

std::string reproduce_command(const CampaignSpec& spec, const std::string& file, const std::string& only, const std::string& name) {
  return fmt::format("{} -o {}", validate_command(spec, file, only.empty() ? spec.only : only), shell_word(folder_of(name)));
}

}  // namespace ddem::harness
