#pragma once
// The words and numbers of a .msh file one after another, as text or as bytes.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace ddem::meshes {

/// All of it throws MeshError, naming the line (of data in bytes, the byte), where the file does not hold what is asked for.
class MshSource {
 public:
  explicit MshSource(std::string_view bytes) : bytes_(bytes) {}

  bool at_end();                  ///< nothing but white space is left
  std::string_view word();        ///< up to the next white space
  void expect(std::string_view word);
  std::string_view rest_of_line();
  void skip_past(std::string_view section_end);

  /// Numbers of text.
  std::int64_t whole();
  double real();

  /// Numbers of data, which follow a line break where they are bytes: int, size_t and double of the machine.
  void use_bytes() { binary_ = true; }
  bool binary() const { return binary_; }
  void begin_data();
  std::int64_t data_int();
  std::uint64_t data_size();
  double data_real();

  [[noreturn]] void fail(const std::string& what) const;

 private:
  template <typename Number>
  Number bytes();

  std::string_view bytes_;
  std::size_t at_ = 0, word_at_ = 0;
  bool binary_ = false, in_data_ = false;
};

/// Any bytes as one may print them: shortened, what is no printable character as '?'.
std::string printable(std::string_view text, std::size_t most = 30);

}  // namespace ddem::meshes
