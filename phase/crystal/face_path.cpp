#include "phase/crystal/face_path.h"

#include <bit>
#include <charconv>

namespace arcus::phase {

std::optional<FacePath> FacePath::from_text(std::string_view text) {
  const bool longer = text.ends_with("...");
  if (longer) text.remove_suffix(3);
  FacePath path;
  int faces = 0;
  while (true) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || number < 1 || number > 31 || ++faces > longest) return std::nullopt;
    path = path.then(number);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (text.empty()) break;
    if (text.front() != '-') return std::nullopt;
    text.remove_prefix(1);
  }
  if (longer) {
    if (faces != longest) return std::nullopt;
    path.code_ |= more;
  }
  return path;
}

int FacePath::length() const { return (std::bit_width(code_ & ~more) + 4) / 5; }

int FacePath::face(int i) const { return static_cast<int>(code_ >> (5 * (length() - 1 - i)) & 31); }

std::string FacePath::text() const {
  std::string text;
  for (int i = 0; i < length(); ++i) {
    if (i > 0) text += '-';
    text += std::to_string(face(i));
  }
  return longer() ? text + "..." : text;
}

}  // namespace arcus::phase
