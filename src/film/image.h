#pragma once
// A picture as numbers: named channels of float values, and what is known about it.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace arcus::render {

/// A rectangle of pixels: columns x0 to x1 and rows y0 to y1, the ends excluded.
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  std::size_t pixels() const {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
  bool operator==(const PixelBox&) const = default;
};

/// What is known about a picture: names with a text, a whole number or a number, in the order they
/// were set.
class Metadata {
 public:
  using Value = std::variant<std::string, int, double>;
  /// Sets a value; an earlier one of that name is replaced in its place.
  void set(std::string_view name, Value value);
  /// The text of that name; nothing where there is none or it is not a text.
  std::optional<std::string> text(std::string_view name) const;
  /// The number of that name, whole or not; nothing where there is none or it is not a number.
  std::optional<double> number(std::string_view name) const;
  const std::vector<std::pair<std::string, Value>>& entries() const { return entries_; }

 private:
  std::vector<std::pair<std::string, Value>> entries_;
};

/// All of a picture but its values.
struct ImageHeader {
  int width_px = 0, height_px = 0;  ///< of the whole picture
  PixelBox box;                     ///< the part of it that is there
  std::vector<std::string> channel_names;
  Metadata metadata;
};

/// Channels over a rectangle of pixels that is part of a larger picture (or all of it).
class Image {
 public:
  Image() = default;
  /// All values 0. `box` lies within the picture of width_px x height_px pixels.
  Image(int width_px, int height_px, PixelBox box, std::vector<std::string> channel_names);
  /// The whole picture.
  Image(int width_px, int height_px, std::vector<std::string> channel_names);
  explicit Image(const ImageHeader& header);

  ImageHeader header() const { return {width_px_, height_px_, box_, channel_names_, metadata}; }
  int width_px() const { return width_px_; }    ///< of the whole picture
  int height_px() const { return height_px_; }  ///< of the whole picture
  const PixelBox& box() const { return box_; }
  const std::vector<std::string>& channel_names() const { return channel_names_; }
  /// Position of a channel among the names; nothing where there is none of that name.
  std::optional<std::size_t> channel(std::string_view name) const;

  /// Value at column x and row y of the whole picture; (x, y) must lie within the box.
  float value(int x, int y, std::size_t channel) const { return values_[index(x, y, channel)]; }
  float& value(int x, int y, std::size_t channel) { return values_[index(x, y, channel)]; }
  /// [row][column][channel] over the box, channel fastest.
  const std::vector<float>& values() const { return values_; }
  std::vector<float>& values() { return values_; }

  Metadata metadata;

 private:
  std::size_t index(int x, int y, std::size_t channel) const {
    const auto row = static_cast<std::size_t>(y - box_.y0),
               column = static_cast<std::size_t>(x - box_.x0);
    return (row * static_cast<std::size_t>(box_.width()) + column) * channel_names_.size() +
           channel;
  }

  int width_px_ = 0, height_px_ = 0;
  PixelBox box_;
  std::vector<std::string> channel_names_;
  std::vector<float> values_;
};

}  // namespace arcus::render
