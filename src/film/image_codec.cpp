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

OIIO::ImageSpec exr_spec(const Image& image) {
  const PixelBox& box = image.box();
  OIIO::ImageSpec spec(box.width(), box.height(), static_cast<int>(image.channel_names().size()),
                       OIIO::TypeDesc::FLOAT);
  spec.x = box.x0;
  spec.y = box.y0;
  spec.full_x = spec.full_y = 0;
  spec.full_width = image.width_px();
  spec.full_height = image.height_px();
  spec.channelnames = image.channel_names();
  spec.attribute("compression", "zip");
  spec.attribute("DateTime",
                 "");  // otherwise the plugin writes the present time, and no two files are equal
  for (const auto& [name, value] : image.metadata.entries()) add_attribute(spec, name, value);
  return spec;
}

OIIO::ImageSpec png_spec(const DisplayPicture& picture, bool has_few_colours) {
  OIIO::ImageSpec spec(picture.width_px, picture.height_px, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  constexpr int no_filter = 8;  // PNG_FILTER_NONE of libpng
  if (has_few_colours) spec.attribute("png:filter", no_filter);
  return spec;
}

/// Writes all pixels through the plugin that belongs to the ending of `name`.
void write_pixels(const std::string& path, const std::string& name, const OIIO::ImageSpec& spec,
                  OIIO::TypeDesc type, const void* pixels,
                  OIIO::Filesystem::IOProxy* target = nullptr) {
  const auto output = OIIO::ImageOutput::create(name, target);
  if (!output) throw cannot("cannot write " + path, OIIO::geterror());
  const bool written = output->open(name, spec) && output->write_image(type, pixels);
  std::string fault = written ? "" : output->geterror();
  if (!output->close() && fault.empty()) fault = output->geterror();
  if (!written || !fault.empty()) throw cannot("cannot write " + path, fault);
}

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

void write_exr(const std::string& path, const std::string& temporary_path, const Image& image) {
  write_pixels(path, temporary_path, exr_spec(image), OIIO::TypeDesc::FLOAT, image.values().data());
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

std::string png_bytes(const DisplayPicture& picture, bool has_few_colours) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  write_pixels("a PNG picture", "memory.png", png_spec(picture, has_few_colours),
               OIIO::TypeDesc::UINT8, picture.rgb.data(), &memory);
  return std::string(bytes.begin(), bytes.end());
}

}  // namespace
}  // namespace arcus::render

const arcus::render::ImageCodec arcus_image_codec{&arcus::render::write_exr, &arcus::render::read_exr,
                                                  &arcus::render::png_bytes};
