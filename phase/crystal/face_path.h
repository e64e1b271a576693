#pragma once
// Which faces a ray met, one after the other: the names that halos have, "3-5" for the 22 degree
// halo, "1-3" for the circumzenithal arc, "3" for light reflected outside.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace arcus::phase {

/// The numbers of the faces, five bits each, the first twelve of them: two paths that differ only
/// later count as one.
class FacePath {
 public:
  static constexpr int longest = 12;

  FacePath() = default;
  /// From code().
  explicit constexpr FacePath(std::uint64_t code) : code_(code) {}
  /// From text such as "3-1-5", "..." at the end for a path of more than twelve; nothing where it
  /// is none.
  static std::optional<FacePath> from_text(std::string_view text);

  /// This path and one face more, 1 ... 31.
  constexpr FacePath then(int number) const {
    if (code_ >> (5 * longest - 5)) return FacePath(code_ | more);
    return FacePath(code_ << 5 | static_cast<std::uint64_t>(number));
  }
  /// Faces kept: 0 ... 12.
  int length() const;
  /// The number of face `i` of those kept, from 0.
  int face(int i) const;
  /// True where the ray met more than twelve.
  constexpr bool longer() const { return code_ & more; }
  constexpr std::uint64_t code() const { return code_; }
  std::string text() const;

  constexpr bool operator==(const FacePath&) const = default;
  constexpr auto operator<=>(const FacePath&) const = default;

 private:
  static constexpr std::uint64_t more = std::uint64_t{1} << 63;
  std::uint64_t code_ = 0;
};

}  // namespace arcus::phase

template <>
struct std::hash<arcus::phase::FacePath> {
  std::size_t operator()(const arcus::phase::FacePath& path) const {
    return std::hash<std::uint64_t>()(path.code() * 0x9E3779B97F4A7C15u);
  }
};
