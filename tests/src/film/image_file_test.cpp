#include "src/film/image_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>

#include "phase/base/error.h"
#include "phase/base/random.h"
#include "phase/settings/toml_text.h"

namespace arcus::render {
namespace {

/// A folder of its own that goes with the test.
class ImageFile : public testing::Test {
 protected:
  ImageFile() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("image_file_" + std::string(test->name()) + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~ImageFile() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_),
                                                  std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path folder_;
};

Image example() {
  Image image(40, 30, {5, 10, 37, 28}, {"R", "G", "B", "variance.R", "S0.385.0nm", "Z"});
  Random random(1, 1, 1);
  for (float& value : image.values()) value = 1e-3f * std::exp(20 * random.uniform());
  image.values()[7] = std::numeric_limits<float>::infinity();
  image.metadata.set("arcus:scene", std::string("[camera]\ntype = \"perspective\"  # \xc2\xb5m\n"));
  image.metadata.set("arcus:samples_per_pixel", 64);
  image.metadata.set("arcus:sun:elevation_deg", 20.123456789012345);
  image.metadata.set("arcus:camera:position_m:x", -1e-7);
  return image;
}

DisplayPicture noise_picture() {
  DisplayPicture picture{400, 300, std::vector<std::uint8_t>(360000)};
  Random random(4, 4, 4);
  for (auto& value : picture.rgb) value = static_cast<std::uint8_t>(random.bits());
  return picture;
}

void expect_fault(Fault fault, const std::function<void()>& action, const std::string& part) {
  try {
    action();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

}  // namespace

TEST_F(ImageFile, ExrKeepsEveryChannelItsPlaceAndAllMetadata) {
  const Image image = example();
  write_exr(path("a.exr"), image);
  const Image copy = read_exr(path("a.exr"));
  EXPECT_EQ(copy.width_px(), 40);
  EXPECT_EQ(copy.height_px(), 30);
  EXPECT_EQ(copy.box(), image.box());
  for (const std::string& name : image.channel_names()) {
    ASSERT_TRUE(copy.channel(name)) << name;
    for (int y = 10; y < 28; ++y)
      for (int x = 5; x < 37; ++x)
        ASSERT_EQ(copy.value(x, y, *copy.channel(name)), image.value(x, y, *image.channel(name)))
            << name;
  }
  for (const auto& [name, value] : image.metadata.entries()) {
    if (const auto* text = std::get_if<std::string>(&value))
      EXPECT_EQ(copy.metadata.text(name), *text);
    else
      EXPECT_EQ(copy.metadata.number(name), image.metadata.number(name)) << name;
  }
}

TEST_F(ImageFile, EqualPicturesGiveEqualBytes) {
  write_exr(path("a.exr"), example());
  write_exr(path("b.exr"), example());
  EXPECT_EQ(read_text_file(path("a.exr")), read_text_file(path("b.exr")));
}

TEST_F(ImageFile, PiecesGiveTheBytesOfTheWhole) {
  Image image(50, 100, {3, 20, 50, 91}, {"R", "G", "B", "S0.385.0nm"});
  Random random(2, 2, 2);
  for (float& value : image.values()) value = random.uniform();
  image.metadata.set("arcus:samples_per_pixel", 64);
  write_exr(path("whole.exr"), image);
  const DisplayPicture picture = noise_picture();
  write_png(path("whole.png"), picture);
  for (const std::size_t rows : {1, 7, 16, 40}) {  // lines are packed sixteen together
    ExrWriter exr(path("pieces.exr"), image.header());
    const std::span<const float> values = image.values();
    const std::size_t length = rows * 47 * 4;
    for (std::size_t at = 0; at < values.size(); at += length) exr.append(values.subspan(at, std::min(length, values.size() - at)));
    exr.commit();
    EXPECT_EQ(read_text_file(path("pieces.exr")), read_text_file(path("whole.exr"))) << rows;
    PngWriter png(path("pieces.png"), picture.width_px, picture.height_px);
    const std::span<const std::uint8_t> bytes = picture.rgb;
    const std::size_t png_length = rows * 1200;
    for (std::size_t at = 0; at < bytes.size(); at += png_length) png.append(bytes.subspan(at, std::min(png_length, bytes.size() - at)));
    png.commit();
    EXPECT_EQ(read_text_file(path("pieces.png")), read_text_file(path("whole.png"))) << rows;
  }
}

TEST_F(ImageFile, LargePicturesKeepEveryBit) {
  Image band(1024, 64, {"R", "G", "B", "S0.385.0nm"});
  Random random(5, 5, 5);
  for (float& value : band.values()) {
    const std::uint32_t bits = random.bits();
    value = std::isnan(std::bit_cast<float>(bits)) ? std::numeric_limits<float>::infinity() : std::bit_cast<float>(bits);
  }
  constexpr int bands = 260;
  ImageHeader header = band.header();
  header.height_px = header.box.y1 = bands * 64;
  ASSERT_GT(header.box.pixels() * 4 * sizeof(float), 1u << 28);  // packed in another way from there on
  ExrWriter exr(path("large.exr"), header);
  const std::vector<float> black(band.values().size());
  const auto is_noise = [](int i) { return i % 50 == 0; };
  for (int i = 0; i < bands; ++i) exr.append(is_noise(i) ? band.values() : black);
  exr.commit();
  const Image copy = read_exr(path("large.exr"));
  const auto bits = [](const Image& image, int x, int y, const std::string& name) {
    return std::bit_cast<std::uint32_t>(image.value(x, y, *image.channel(name)));
  };
  for (const std::string& name : band.channel_names())
    for (int y = 0; y < header.height_px; ++y)
      for (int x = 0; x < 1024; x += is_noise(y / 64) ? 1 : 77)
        ASSERT_EQ(bits(copy, x, y, name), is_noise(y / 64) ? bits(band, x, y % 64, name) : 0u) << name << " at " << x << ", " << y;
}

TEST_F(ImageFile, WhatIsNotCommittedLeavesNothing) {
  const Image image = example();
  testing::internal::CaptureStderr();
  for (const std::size_t rows : {0, 1, 16, 18}) {
    ExrWriter exr(path("a.exr"), image.header());
    exr.append(std::span(image.values()).first(rows * 32 * 6));
    PngWriter png(path("a.png"), 2, 20);
    const std::vector<std::uint8_t> bytes(rows * 6, 100);
    png.append(bytes);
  }
  EXPECT_EQ(files(), 0u);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ImageFile, CutOffOrForeignOrMissingFilesAreBadInput) {
  write_exr(path("whole.exr"), example());
  const std::string bytes = read_text_file(path("whole.exr"));
  for (const double share : {0.0, 0.001, 0.05, 0.3, 0.9, 0.999}) {
    const auto length = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
    std::ofstream(path("part.exr"), std::ios::binary) << bytes.substr(0, length);
    expect_fault(
        Fault::input, [&] { read_exr(path("part.exr")); }, "part.exr");
  }
  std::ofstream(path("words.exr")) << "This is no picture, it only is called one.\n";
  expect_fault(
      Fault::input, [&] { read_exr(path("words.exr")); }, "words.exr");
  expect_fault(
      Fault::input, [&] { read_exr(path("missing.exr")); }, "missing.exr");
  write_png(path("a.png"), {2, 1, {0, 1, 2, 3, 4, 5}});
  expect_fault(
      Fault::input, [&] { read_exr(path("a.png")); }, "png");
}

TEST_F(ImageFile, OutputThatCannotBeWrittenIsAFailureAndLeavesNothing) {
  expect_fault(
      Fault::failed, [&] { write_exr(path("no/such/folder/a.exr"), example()); }, "cannot write");
  expect_fault(
      Fault::failed,
      [&] {
        write_png(path("no/such/folder/a.png"), {1, 1, {0, 0, 0}});
      },
      "cannot write");
  std::filesystem::create_directory(path("folder.exr"));
  expect_fault(
      Fault::failed, [&] { write_exr(path("folder.exr"), example()); }, "folder");
  EXPECT_EQ(files(), 1u);
}

TEST_F(ImageFile, DiskThatFillsUpIsAFailureAndLeavesNothing) {
  // A limit on the size of files stands for the full disk; the signal that comes with it is
  // ignored.
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  auto* handler = std::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit small { 20000, before.rlim_max };
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  Image image(400, 300, {"R", "G"});
  Random random(3, 3, 3);
  for (float& value : image.values()) value = random.uniform();
  expect_fault(
      Fault::failed, [&] { write_exr(path("a.exr"), image); }, "cannot write");
  expect_fault(
      Fault::failed, [&] { write_png(path("a.png"), noise_picture()); }, "cannot write");
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(files(), 0u);
}

TEST_F(ImageFile, PngHoldsTheBytesGiven) {
  const DisplayPicture picture{3, 1, {0, 128, 255, 10, 20, 30, 200, 100, 50}};
  write_png(path("a.png"), picture);
  const std::string bytes = read_text_file(path("a.png"));
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  EXPECT_EQ(png_bytes(picture), bytes);
}

}  // namespace arcus::render
