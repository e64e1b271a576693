#pragma once
// The one exception type. Its text says where, what was found, what was expected and what to do; its fault
// becomes the exit code of the program (tools/README.md, Exit codes).

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace arcus {

/// Whose fault an error is; the values are the exit codes of the command line.
enum class Fault {
  failed = 1,      ///< it could not be done: no space, no memory, an output that cannot be written
  input = 2,       ///< the command line or an input is wrong or missing
  mismatch = 3,    ///< inputs that do not belong together
  incomplete = 4,  ///< something is missing; the text lists it
};

class Error : public std::runtime_error {
 public:
  Error(Fault fault, const std::string& text) : std::runtime_error(text), fault_(fault) {}
  Fault fault() const { return fault_; }

 private:
  Fault fault_;
};

/// A wrong input: "where: found found; expected expected. hint".
/// where: file, line and column and the key or grid; hint: what to do, may be empty.
inline Error bad_input(std::string_view where, std::string_view found, std::string_view expected,
                       std::string_view hint = "") {
  std::string text(where);
  text.append(": ").append(found).append(" found; ").append(expected);
  if (!hint.empty()) text.append(". ").append(hint);
  return Error(Fault::input, text);
}

/// Something that could not be done although the input was right: "what: why".
inline Error cannot(std::string_view what, std::string_view why) {
  return Error(Fault::failed, std::string(what).append(": ").append(why));
}

/// The candidate with the smallest edit distance to `name`, or "" when none is near
/// (more than a third of the letters differ, at least two allowed).
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

/// "a, b or c" for messages.
std::string list_of(std::span<const std::string> names);

}  // namespace arcus
