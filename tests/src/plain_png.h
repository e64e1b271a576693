#pragma once
// PNG files for tests, without compression: 8 or 16 bits, grey or R, G, B.

#include <cstdint>
#include <string>
#include <vector>

namespace arcus::render {

namespace plain {

inline std::string big_endian(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = bytes; i-- > 0;) text += static_cast<char>(value >> (8 * i));
  return text;
}

inline std::string chunk(const std::string& kind, const std::string& data) {
  const std::string all = kind + data;
  std::uint32_t crc = 0xffffffff;
  for (const char c : all) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return big_endian(static_cast<std::uint32_t>(data.size()), 4) + all + big_endian(~crc, 4);
}

}  // namespace plain

/// values: [row][column][channel], of 8 or 16 bits. At most some 64 kB in all.
inline std::string plain_png(int width, int height, int bits, const std::vector<std::uint16_t>& values) {
  const std::size_t row = values.size() / static_cast<std::size_t>(height);
  const bool is_grey = row == static_cast<std::size_t>(width);
  std::string rows;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % row == 0) rows += '\0';
    rows += plain::big_endian(values[i], bits / 8);
  }
  std::uint32_t a = 1, b = 0;
  for (const char c : rows) a = (a + static_cast<std::uint8_t>(c)) % 65521, b = (b + a) % 65521;
  const auto size = static_cast<std::uint16_t>(rows.size());
  std::string stored("\x78\x01\x01", 3);
  for (const std::uint16_t word : {size, static_cast<std::uint16_t>(~size)}) stored += static_cast<char>(word & 255), stored += static_cast<char>(word >> 8);
  stored += rows + plain::big_endian(b << 16 | a, 4);
  std::string header = plain::big_endian(static_cast<std::uint32_t>(width), 4) + plain::big_endian(static_cast<std::uint32_t>(height), 4);
  header += static_cast<char>(bits);
  header += static_cast<char>(is_grey ? 0 : 2);
  header += std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + plain::chunk("IHDR", header) + plain::chunk("IDAT", stored) + plain::chunk("IEND", "");
}

}  // namespace arcus::render
