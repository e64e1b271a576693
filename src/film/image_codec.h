#pragma once
// What needs OpenImageIO. Its libraries take a third of a second to load, with all that they load (OpenCV, GDAL, codecs of films), so
// they stand behind a module of their own, which image_file loads when the first picture is read or written.

#include <string>

#include "src/film/image.h"
#include "src/film/tone.h"

namespace arcus::render {

struct ImageCodec {
  /// Writes to `temporary_path`; messages speak of `path`.
  void (*write_exr)(const std::string& path, const std::string& temporary_path, const Image& image);
  Image (*read_exr)(const std::string& path);
  std::string (*png_bytes)(const DisplayPicture& picture, bool has_few_colours);
};

}  // namespace arcus::render

/// The only name that the module gives away.
extern "C" const arcus::render::ImageCodec arcus_image_codec;
