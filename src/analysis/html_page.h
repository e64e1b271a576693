#pragma once
// A page of text and pictures as one HTML file that needs no other.

#include <string>
#include <string_view>
#include <vector>

namespace arcus::render {

class HtmlPage {
 public:
  explicit HtmlPage(std::string_view title);

  void add_heading(std::string_view words);
  void add_paragraph(std::string_view words);
  void add_preformatted(std::string_view text);
  /// A picture of pixels, two in a row.
  void add_picture(const std::string& png, std::string_view words) { add_figure(png, words, "picture"); }
  /// A chart from png_of.
  void add_chart(const std::string& png, std::string_view words) { add_figure(png, words, "chart"); }
  /// The first row is the head.
  void add_table(const std::vector<std::vector<std::string>>& rows);

  std::string text() const { return text_ + "</body></html>\n"; }

 private:
  void add_figure(const std::string& png, std::string_view words, std::string_view kind);

  std::string text_;
};

}  // namespace arcus::render
