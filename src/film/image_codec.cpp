#include "src/film/image_codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <vector>

#include "phase/base/error.h"

namespace arcus::render {
namespace {

/// Attributes that say how the file is laid out, not what the picture is.
bool is_layout(std::string_view name) {
  for (const std::string_view prefix :
       {"openexr:", "oiio:", "PixelAspectRatio", "compression", "screenWindow", "DateTime"})
    if (name.starts_with(prefix)) return true;
  return false;
}

void add_attribute(OIIO::ImageSpec& spec, const std::string& name, const Metadata::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value))
    spec.attribute(name, *text);
  else if (const auto* whole = std::get_if<int>(&value))
    spec.attribute(name, *whole);
  else
    spec.attribute(name, OIIO::TypeDesc::DOUBLE, std::get_if<double>(&value));
}

/// Of calm pictures ZIP makes smaller files than PIZ. Noise, which is what large pictures mostly are, it packs worse, in three times the
/// time: minutes for some gigabytes.
const char* compression_of(const OIIO::ImageSpec& spec) {
  constexpr std::size_t large_bytes = 1 << 28;
  return spec.image_bytes() < large_bytes ? "zip" : "piz";
}

OIIO::ImageSpec exr_spec(const ImageHeader& header) {
  const PixelBox& box = header.box;
  OIIO::ImageSpec spec(box.width(), box.height(), static_cast<int>(header.channel_names.size()),
                       OIIO::TypeDesc::FLOAT);
  spec.x = box.x0;
  spec.y = box.y0;
  spec.full_x = spec.full_y = 0;
  spec.full_width = header.width_px;
  spec.full_height = header.height_px;
  spec.channelnames = header.channel_names;
  spec.attribute("compression", compression_of(spec));
  spec.attribute("DateTime",
                 "");  // otherwise the plugin writes the present time, and no two files are equal
  for (const auto& [name, value] : header.metadata.entries()) add_attribute(spec, name, value);
  return spec;
}

OIIO::ImageSpec png_spec(int width_px, int height_px, bool has_few_colours) {
  OIIO::ImageSpec spec(width_px, height_px, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  constexpr int no_filter = 8;  // PNG_FILTER_NONE of libpng
  if (has_few_colours) spec.attribute("png:filter", no_filter);
  return spec;
}

/// Writes through the plugin that belongs to the ending of `name`.
class PluginOutput final : public ImageOutput {
 public:
  PluginOutput(std::string path, const std::string& name, const OIIO::ImageSpec& spec, std::unique_ptr<OIIO::Filesystem::IOProxy> target = nullptr)
      : path_(std::move(path)), target_(std::move(target)), output_(OIIO::ImageOutput::create(name, target_.get())), next_row_(spec.y) {
    if (!output_) throw cannot("cannot write " + path_, OIIO::geterror());
    require(output_->open(name, spec));
  }
  ~PluginOutput() override {
    // libpng prints a complaint about pictures that are given up before their first byte is packed.
    const OIIO::ImageSpec& spec = output_->spec();
    const std::vector<unsigned char> black(target_ ? spec.scanline_bytes() : 0);
    for (; target_ && next_row_ < spec.y + spec.height; ++next_row_) output_->write_scanline(next_row_, 0, spec.format, black.data());
  }

  void append(const void* values, int rows) override {
    require(output_->write_scanlines(next_row_, next_row_ + rows, 0, output_->spec().format, values));
    next_row_ += rows;
  }

  void close() override {
    const bool is_closed = output_->close();
    require(is_closed && !output_->has_error());
  }

 private:
  void require(bool is_done) {
    if (!is_done) throw cannot("cannot write " + path_, output_->geterror());
  }

  std::string path_;
  std::unique_ptr<OIIO::Filesystem::IOProxy> target_;  // outlives what writes to it
  std::unique_ptr<OIIO::ImageOutput> output_;
  int next_row_;
};

Metadata metadata_of(const OIIO::ImageSpec& spec) {
  Metadata metadata;
  for (const auto& attribute : spec.extra_attribs) {
    const std::string name = attribute.name().string();
    const OIIO::TypeDesc type = attribute.type();
    if (is_layout(name)) continue;
    if (type == OIIO::TypeDesc::STRING)
      metadata.set(name, attribute.get_string());
    else if (type == OIIO::TypeDesc::INT)
      metadata.set(name, attribute.get_int());
    else if (type == OIIO::TypeDesc::DOUBLE)
      metadata.set(name, *static_cast<const double*>(attribute.data()));
    else if (type == OIIO::TypeDesc::FLOAT)
      metadata.set(name, static_cast<double>(attribute.get_float()));
  }
  return metadata;
}

/// A message of the package in one line.
std::string one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::unique_ptr<ImageOutput> exr_output(const std::string& path, const std::string& temporary_path, const ImageHeader& header) {
  return std::make_unique<PluginOutput>(path, temporary_path, exr_spec(header));
}

Image read_exr(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw bad_input(path, "no file", "an EXR picture expected", "Check the name and the folder");
  const auto input = OIIO::ImageInput::open(path);
  if (!input)
    throw bad_input(path, "no readable picture (" + one_line(OIIO::geterror()) + ")",
                    "an EXR picture expected");
  const OIIO::ImageSpec& spec = input->spec();
  if (std::string_view(input->format_name()) != "openexr")
    throw bad_input(path, "a file of the kind " + std::string(input->format_name()),
                    "an EXR picture expected");
  if (spec.deep)
    throw bad_input(path, "a deep picture",
                    "an EXR picture with one value a pixel and channel expected");
  const PixelBox box{spec.x, spec.y, spec.x + spec.width, spec.y + spec.height};
  if (spec.full_x != 0 || spec.full_y != 0 || box.x0 < 0 || box.y0 < 0 ||
      box.x1 > spec.full_width || box.y1 > spec.full_height)
    throw bad_input(path, "a data window that is not within a display window from (0, 0)",
                    "a picture or a part of one expected");
  Image image(spec.full_width, spec.full_height, box, spec.channelnames);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.values().data()))
    throw bad_input(path, "a damaged or cut off picture (" + one_line(input->geterror()) + ")",
                    "a whole file expected");
  image.metadata = metadata_of(spec);
  return image;
}

std::unique_ptr<ImageOutput> png_output(int width_px, int height_px, bool has_few_colours, std::vector<unsigned char>& bytes) {
  return std::make_unique<PluginOutput>("a PNG picture", "memory.png", png_spec(width_px, height_px, has_few_colours),
                                        std::make_unique<OIIO::Filesystem::IOVecOutput>(bytes));
}

/// The positions of R, G and B among a file's channels, or of the one that stands for all; the first ones where none has such a name.
std::vector<int> colours_in(const OIIO::ImageSpec& spec, int wanted) {
  std::vector<int> found;
  if (wanted == 3)
    for (const std::string_view name : {"R", "G", "B"})
      for (int c = 0; c < spec.nchannels; ++c)
        if (spec.channelnames[static_cast<std::size_t>(c)] == name) found.push_back(c);
  if (found.size() == 3) return found;
  if (wanted == 3 && spec.nchannels >= 3) return {0, 1, 2};
  return std::vector<int>(static_cast<std::size_t>(wanted), 0);
}

StoredRaster read_raster(const std::string& path, const std::string& where, int channels) {
  const std::string place = where + ": " + path;
  if (!std::filesystem::is_regular_file(path)) throw bad_input(place, "no file", "a picture expected", "Check the name and the folder");
  OIIO::ImageSpec as_stored;
  as_stored.attribute("oiio:UnassociatedAlpha", 1);  // or colours come multiplied by the opacity
  const auto input = OIIO::ImageInput::open(path, &as_stored);
  if (!input) throw bad_input(place, "no readable picture (" + one_line(OIIO::geterror()) + ")", "EXR, PNG, TIFF or another kind that OpenImageIO reads expected");
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.deep || spec.depth > 1) throw bad_input(place, "a deep picture", "one value a pixel and channel expected");
  if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width || spec.height != spec.full_height)
    throw bad_input(place, "a part of a picture", "a whole one expected");
  constexpr double most_pixels = 1 << 26;
  if (static_cast<double>(spec.width) * spec.height > most_pixels)
    throw bad_input(place, std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels", "at most 67108864 pixels in all expected", "Make it smaller first");
  StoredRaster stored{{spec.width, spec.height, channels, {}}, !spec.format.is_floating_point()};
  const std::vector<int> from = colours_in(spec, channels);
  const int first = *std::min_element(from.begin(), from.end()), read = *std::max_element(from.begin(), from.end()) + 1 - first;
  std::vector<float>& values = stored.raster.values;
  values.resize(stored.raster.pixels() * static_cast<std::size_t>(read));
  if (!input->read_image(0, 0, first, first + read, OIIO::TypeDesc::FLOAT, values.data()))
    throw bad_input(place, "a damaged or cut off picture (" + one_line(input->geterror()) + ")", "a whole file expected");
  if (read == channels && std::is_sorted(from.begin(), from.end())) return stored;
  std::vector<float> sorted(stored.raster.pixels() * static_cast<std::size_t>(channels));
  for (std::size_t pixel = 0; pixel < stored.raster.pixels(); ++pixel)
    for (std::size_t c = 0; c < from.size(); ++c) sorted[pixel * from.size() + c] = values[pixel * static_cast<std::size_t>(read) + static_cast<std::size_t>(from[c] - first)];
  values = std::move(sorted);
  return stored;
}

}  // namespace
}  // namespace arcus::render

const arcus::render::ImageCodec arcus_image_codec{&arcus::render::exr_output, &arcus::render::read_exr, &arcus::render::png_output,
                                            &arcus::render::read_raster};
