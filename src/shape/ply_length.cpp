#include "src/shape/ply_length.h"

#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "phase/base/error.h"

namespace arcus::render {
namespace {

const std::map<std::string, int> bytes_of_type{{"char", 1},  {"uchar", 1},  {"short", 2}, {"ushort", 2}, {"int", 4},     {"uint", 4},    {"float", 4},   {"double", 8},
                                               {"int8", 1},  {"uint8", 1},  {"int16", 2}, {"uint16", 2}, {"int32", 4},   {"uint32", 4},  {"float32", 4}, {"float64", 8}};

struct Property {
  int bytes = 0;
  int count_bytes = 0;  ///< of the number of entries before a list; 0: no list
};
struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};
struct Header {
  std::string format;
  std::vector<Element> elements;
};

class Checker {
 public:
  Checker(const std::string& path, const std::string& where) : file_(path, std::ios::binary), where_(where) {}

  void check() {
    const Header header = read_header();
    for (const Element& element : header.elements)
      for (std::uint64_t i = 0; i < element.count; ++i)
        if (!(header.format == "ascii" ? skip_line() : skip_binary(element, header.format == "binary_big_endian")))
          throw bad_input(where_, std::to_string(i) + " of " + std::to_string(element.count) + " entries of '" + element.name + "'", "all that its header promises expected",
                          "The file is cut off");
  }

 private:
  int bytes(const std::string& type) const {
    const auto found = bytes_of_type.find(type);
    if (found == bytes_of_type.end()) throw bad_input(where_, "a property of type '" + type + "'", "a type of the PLY format expected");
    return found->second;
  }

  Header read_header() {
    Header header;
    std::string line;
    constexpr int most_lines = 1000;
    for (int number = 0; number < most_lines && std::getline(file_, line); ++number) {
      std::istringstream words(line);
      std::string word, type, count_type;
      words >> word;
      if (number == 0 && word != "ply") break;
      if (word == "format") words >> header.format;
      if (word == "element") {
        Element& element = header.elements.emplace_back();
        words >> element.name >> element.count;
      }
      if (word == "property" && !header.elements.empty()) {
        Property& property = header.elements.back().properties.emplace_back();
        words >> type;
        if (type == "list") {
          words >> count_type >> type;
          property.count_bytes = bytes(count_type);
        }
        property.bytes = bytes(type);
      }
      if (word == "end_header") return header;
    }
    throw bad_input(where_, "a header without end_header", "a PLY file expected");
  }

  bool skip_line() {
    std::string line;
    while (std::getline(file_, line))
      if (line.find_first_not_of(" \t\r") != std::string::npos) return true;
    return false;
  }

  bool skip(std::uint64_t count) {
    file_.ignore(static_cast<std::streamsize>(count));
    return static_cast<std::uint64_t>(file_.gcount()) == count;
  }

  bool skip_binary(const Element& element, bool is_big_endian) {
    for (const Property& property : element.properties) {
      std::uint64_t entries = 1;
      if (property.count_bytes > 0) {
        unsigned char raw[8] = {};
        if (!file_.read(reinterpret_cast<char*>(raw), property.count_bytes)) return false;
        entries = 0;
        for (int i = 0; i < property.count_bytes; ++i) entries = entries << 8 | raw[is_big_endian ? i : property.count_bytes - 1 - i];
      }
      if (!skip(entries * static_cast<std::uint64_t>(property.bytes))) return false;
    }
    return true;
  }

  std::ifstream file_;
  const std::string where_;
};

}  // namespace

void check_ply_length(const std::string& path, const std::string& where) { Checker(path, where).check(); }

}  // namespace arcus::render
