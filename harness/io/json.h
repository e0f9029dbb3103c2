#pragma once
// JSON in which a number that is not finite never hides: nlohmann's writer would turn it into null.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ddem::harness {

/// Objects keep the order in which their keys were set.
using Json = nlohmann::ordered_json;

/// The number, or {"status": "not a number: REASON"} where it is not finite.
Json number_or_status(double value, std::string_view reason);

/// Every element by number_or_status().
Json numbers_or_status(const std::vector<double>& values, std::string_view reason);

/// Text of a document, indented by two blanks, with a final line break. Throws std::invalid_argument, naming
/// the place, where a number in it is not finite. Bytes that are not UTF-8 become U+FFFD.
std::string to_text(const Json& document);

/// to_text() to a file, whole or not at all; errors as in write_file().
void write_json(const std::filesystem::path& target, const Json& document);

/// Of a text; `place` is for messages. Throws InputError with line and column of what is wrong, nesting deeper than 200
/// levels included.
Json parse_json(const std::string& text, const std::string& place);

/// What an exception of nlohmann's says, without its names and numbers.
std::string in_words(const Json::exception& error);

/// `document`, an object, with a last member "digest": the SHA-256 of to_text() of the others.
Json sealed(Json document);

/// The document without its digest. InputError with `place` where the digest does not hold; a document without one (of an
/// older program, or made by hand) is taken as it is.
Json unsealed(Json document, const std::string& place);

/// Throws InputError unless the member "schema_version" is 1, the only version there is; another is named, with what to do.
void require_schema_version(const Json& document, const std::string& place);

/// Of a regular file, unsealed. Throws InputError.
Json read_json(const std::filesystem::path& path);

}  // namespace ddem::harness
