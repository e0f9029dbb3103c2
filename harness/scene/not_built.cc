#include "harness/scene/not_built.h"

#include <fmt/format.h>

#include <variant>

namespace ddem::harness {
namespace {

enum class When { given, equals };

struct NotBuilt {
  std::string_view key;
  When when;
  std::string_view value;  // of a choice, or of a number in decimal
  std::string_view remedy;
};

constexpr NotBuilt not_built[] = {
    {"time.integrator", When::equals, "exact", "use integrator = \"verlet\""},
};

std::string text_of(const Value& value) {
  if (const auto* choice = std::get_if<Choice>(&value)) return std::string(choice->name);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return "";
}

bool asks_for(const Values& values, const NotBuilt& setting) {
  if (!values.given(setting.key) || !values.has(setting.key)) return false;
  if (setting.when == When::given) return true;
  return text_of(values.value(setting.key)) == setting.value;
}

}  // namespace

void reject_not_built(Values& values) {
  for (const NotBuilt& setting : not_built) {
    if (asks_for(values, setting)) values.reject(setting.key, "not built yet", std::string(setting.remedy));
  }
}

}  // namespace ddem::harness
