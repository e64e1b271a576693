#include "src/film/image.h"

#include <algorithm>
#include <cassert>

namespace arcus::render {

void Metadata::set(std::string_view name, Value value) {
  for (auto& [known, old] : entries_) {
    if (known != name) continue;
    old = std::move(value);
    return;
  }
  entries_.emplace_back(std::string(name), std::move(value));
}

std::optional<std::string> Metadata::text(std::string_view name) const {
  for (const auto& [known, value] : entries_)
    if (known == name)
      if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return std::nullopt;
}

std::optional<double> Metadata::number(std::string_view name) const {
  for (const auto& [known, value] : entries_) {
    if (known != name) continue;
    if (const auto* whole = std::get_if<int>(&value)) return *whole;
    if (const auto* number = std::get_if<double>(&value)) return *number;
  }
  return std::nullopt;
}

Image::Image(int width_px, int height_px, PixelBox box, std::vector<std::string> channel_names)
    : width_px_(width_px),
      height_px_(height_px),
      box_(box),
      channel_names_(std::move(channel_names)),
      values_(box.pixels() * channel_names_.size()) {
  assert(box.x0 >= 0 && box.y0 >= 0 && box.width() > 0 && box.height() > 0);
  assert(box.x1 <= width_px && box.y1 <= height_px);
}

Image::Image(int width_px, int height_px, std::vector<std::string> channel_names)
    : Image(width_px, height_px, {0, 0, width_px, height_px}, std::move(channel_names)) {}

Image::Image(const ImageHeader& header) : Image(header.width_px, header.height_px, header.box, header.channel_names) {
  metadata = header.metadata;
}

std::optional<std::size_t> Image::channel(std::string_view name) const {
  const auto found = std::find(channel_names_.begin(), channel_names_.end(), name);
  if (found == channel_names_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - channel_names_.begin());
}

}  // namespace arcus::render
