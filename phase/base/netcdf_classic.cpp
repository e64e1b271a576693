// The header of a classic NetCDF file, read only to know how long the file must be.

#include <algorithm>

#include "phase/base/netcdf_file.h"

namespace arcus {
namespace {

/// Thrown inside this file where the header goes on beyond the bytes.
struct Ends {};

class Header {
 public:
  explicit Header(std::string_view bytes) : bytes_(bytes), version_(static_cast<unsigned char>(bytes[3])) { at_ = 4; }

  std::uint64_t size() {
    const std::uint64_t records = count();
    std::vector<std::uint64_t> lengths;
    for (std::uint64_t n = list(); n > 0; --n) {
      skip_text();
      lengths.push_back(count());
    }
    skip_attributes();
    std::uint64_t end = at_, record_begin = 0, record_end = 0, record_bytes = 0, record_variables = 0;
    for (std::uint64_t n = list(); n > 0; --n) {
      skip_text();
      bool is_record = false;
      std::uint64_t values = 1;
      const std::uint64_t rank = count();
      for (std::uint64_t i = 0; i < rank; ++i) {
        const std::uint64_t dimension = count();
        if (dimension >= lengths.size()) throw Ends();
        if (i == 0 && lengths[dimension] == 0) is_record = true;
        else values *= lengths[dimension];
      }
      skip_attributes();
      const std::uint64_t bytes = values * width(number(4));
      count();  // the padded size, which is not always true
      const std::uint64_t begin = number(version_ == 1 ? 4 : 8);
      if (!is_record) {
        end = std::max(end, begin + bytes);
        continue;
      }
      record_begin = record_variables == 0 ? begin : std::min(record_begin, begin);
      record_end = std::max(record_end, begin + bytes);
      record_bytes += padded(bytes);
      if (++record_variables == 1) single_ = bytes;
    }
    if (record_variables == 0 || records == 0 || is_streaming(records)) return end;
    if (record_variables == 1) record_bytes = single_;  // a record variable alone is not padded
    return std::max(end, record_end + (records - 1) * record_bytes);
  }

 private:
  static std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }
  static std::uint64_t width(std::uint64_t type) {
    constexpr int widths[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};  // byte char short int float double ubyte ... uint64
    return type < std::size(widths) ? static_cast<std::uint64_t>(widths[type]) : 1;
  }
  bool is_streaming(std::uint64_t records) const { return records == (version_ == 5 ? ~std::uint64_t{0} : 0xffffffffu); }
  std::uint64_t number(int bytes) {
    if (at_ + static_cast<std::size_t>(bytes) > bytes_.size()) throw Ends();
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | static_cast<unsigned char>(bytes_[at_++]);
    return value;
  }
  std::uint64_t count() { return number(version_ == 5 ? 8 : 4); }
  std::uint64_t list() {
    number(4);  // what it is a list of
    return count();
  }
  void skip(std::uint64_t bytes) {
    if (bytes > bytes_.size() || at_ + bytes > bytes_.size()) throw Ends();
    at_ += bytes;
  }
  void skip_text() { skip(padded(count())); }
  void skip_attributes() {
    for (std::uint64_t n = list(); n > 0; --n) {
      skip_text();
      const std::uint64_t type = number(4), values = count();
      if (values > bytes_.size()) throw Ends();
      skip(padded(values * width(type)));
    }
  }

  std::string_view bytes_;
  int version_;
  std::size_t at_ = 0;
  std::uint64_t single_ = 0;
};

}  // namespace

std::optional<std::uint64_t> classic_netcdf_size(std::string_view bytes) {
  if (bytes.size() < 4 || !bytes.starts_with("CDF") || (bytes[3] != 1 && bytes[3] != 2 && bytes[3] != 5)) return 0;
  try {
    return Header(bytes).size();
  } catch (const Ends&) {
    return std::nullopt;
  }
}

}  // namespace arcus
