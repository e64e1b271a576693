#include "src/film/image_file.h"

#include <dlfcn.h>

#include <cassert>
#include <cmath>
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

ExrWriter::ExrWriter(const std::string& path, const ImageHeader& header)
    : file_(path),
      output_(codec().exr_output(path, file_.temporary_path(), header)),
      row_values_(static_cast<std::size_t>(header.box.width()) * header.channel_names.size()) {
  assert(row_values_ > 0 && header.box.height() > 0);
}

ExrWriter::~ExrWriter() = default;

void ExrWriter::append(std::span<const float> rows) {
  assert(rows.size() % row_values_ == 0);
  output_->append(rows.data(), static_cast<int>(rows.size() / row_values_));
}

void ExrWriter::commit() {
  output_->close();
  file_.commit();
}

void write_exr(const std::string& path, const Image& image) {
  ExrWriter writer(path, image.header());
  writer.append(image.values());
  writer.commit();
}

Image read_exr(const std::string& path) { return codec().read_exr(path); }

namespace {

void require_finite(const Raster& raster, const std::string& place) {
  const auto channels = static_cast<std::size_t>(raster.channels), width = static_cast<std::size_t>(raster.width);
  for (std::size_t i = 0; i < raster.values.size(); ++i)
    if (!std::isfinite(raster.values[i]))
      throw bad_input(place, "a value that is not finite in column " + std::to_string(i / channels % width) + ", row " + std::to_string(i / channels / width), "finite values expected");
}

float from_srgb(float coded) {
  return coded <= 0.04045f ? coded / 12.92f : std::pow((coded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace

Raster read_colours(const std::string& path, const std::string& where) {
  StoredRaster stored = codec().read_raster(path, where, 3);
  if (stored.is_whole)
    for (float& value : stored.raster.values) value = from_srgb(value);
  require_finite(stored.raster, where + ": " + path);
  return std::move(stored.raster);
}

Raster read_heights(const std::string& path, const std::string& where) {
  StoredRaster stored = codec().read_raster(path, where, 1);
  require_finite(stored.raster, where + ": " + path);
  return std::move(stored.raster);
}

PngWriter::PngWriter(std::string path, int width_px, int height_px)
    : path_(std::move(path)),
      output_(codec().png_output(width_px, height_px, false, bytes_)),
      row_values_(3 * static_cast<std::size_t>(width_px)) {}

PngWriter::~PngWriter() = default;

void PngWriter::append(std::span<const std::uint8_t> rows) {
  assert(rows.size() % row_values_ == 0);
  output_->append(rows.data(), static_cast<int>(rows.size() / row_values_));
}

void PngWriter::commit() {
  output_->close();
  write_whole_file(path_, {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()});
}

void write_png(const std::string& path, const DisplayPicture& picture) {
  PngWriter writer(path, picture.width_px, picture.height_px);
  writer.append(picture.rgb);
  writer.commit();
}

std::string png_bytes(const DisplayPicture& picture, bool has_few_colours) {
  std::vector<unsigned char> bytes;
  const auto output = codec().png_output(picture.width_px, picture.height_px, has_few_colours, bytes);
  output->append(picture.rgb.data(), picture.height_px);
  output->close();
  return std::string(bytes.begin(), bytes.end());
}

}  // namespace arcus::render
