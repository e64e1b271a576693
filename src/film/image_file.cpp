#include "src/film/image_file.h"

#include <dlfcn.h>

#include <cassert>
#include <string>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "src/film/image_codec.h"

namespace arcus::render {
namespace {

const ImageCodec& load() {
  // Found by the run path of the program. Lazily bound: most of what is loaded is never called. Never unloaded: libraries below it keep threads.
  void* const module = dlopen(ARCUS_IMAGE_CODEC, RTLD_LAZY | RTLD_LOCAL);
  const void* const codec = module ? dlsym(module, "arcus_image_codec") : nullptr;
  if (!codec) {
    const std::string why = dlerror();
    // What the loader says where there is no room for a library.
    const bool is_full = why.find("failed to map segment") != std::string::npos || why.find("annot allocate memory") != std::string::npos;
    throw cannot("cannot read or write pictures", why + (is_full ? "; there is not enough memory for it" : ""));
  }
  return *static_cast<const ImageCodec*>(codec);
}

const ImageCodec& codec() {
  static const ImageCodec& loaded = load();
  return loaded;
}

}  // namespace

void load_image_files() { codec(); }

void write_exr(const std::string& path, const Image& image) {
  assert(!image.channel_names().empty() && image.box().pixels() > 0);
  WholeFile file(path);
  codec().write_exr(path, file.temporary_path(), image);
  file.commit();
}

Image read_exr(const std::string& path) { return codec().read_exr(path); }

void write_png(const std::string& path, const DisplayPicture& picture) {
  // By way of memory: OpenImageIO 2.4's PNG output does not notice a disk that is full.
  write_whole_file(path, png_bytes(picture));
}

std::string png_bytes(const DisplayPicture& picture, bool has_few_colours) {
  return codec().png_bytes(picture, has_few_colours);
}

}  // namespace arcus::render
