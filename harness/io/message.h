#pragma once
// What people are told: on standard error, and never at the price of a result.

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace ddem::harness {

/// A line or more on standard error. Where that is closed or full the message is lost, and nothing else. Control characters
/// (of a file's name, or of what a file holds) are shown as \x1b, so that they do not reach a terminal.
void say(std::string_view text);

/// say() of a formatted text and a line break.
template <class... Values>
void message(fmt::format_string<Values...> format, Values&&... values) {
  say(fmt::format(format, std::forward<Values>(values)...) + "\n");
}

/// The text with control characters shown, but for line breaks and tabs.
std::string printable(std::string_view text);

}  // namespace ddem::harness
