#include "src/analysis/html_page.h"

namespace arcus::render {
namespace {

std::string base64(std::string_view bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63u];
  }
  return text;
}

std::string escaped(std::string_view words) {
  std::string text;
  for (const char c : words) {
    if (c == '<')
      text += "&lt;";
    else if (c == '>')
      text += "&gt;";
    else if (c == '&')
      text += "&amp;";
    else if (c == '"')
      text += "&quot;";
    else
      text += c;
  }
  return text;
}

}  // namespace

HtmlPage::HtmlPage(std::string_view title) {
  const std::string name = escaped(title);
  text_ =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>" + name +
      "</title>\n<style>\n"
      "body{font-family:sans-serif;max-width:1500px;margin:1.5em auto;padding:0 1em;color:#222}\n"
      "figure{display:inline-block;margin:.4em;max-width:48%;vertical-align:top}img{max-width:100%}\n"
      ".picture{min-width:20em;image-rendering:pixelated}.chart{width:720px}\n"
      "figcaption{color:#555;font-size:.9em}pre{background:#f4f4f6;padding:1em;overflow-x:auto}\n"
      "table{border-collapse:collapse}td,th{padding:.2em .8em;text-align:right;border-bottom:1px solid #ddd}\n</style></head><body>\n<h1>" +
      name + "</h1>\n";
}

void HtmlPage::add_heading(std::string_view words) { text_ += "<h2>" + escaped(words) + "</h2>\n"; }

void HtmlPage::add_paragraph(std::string_view words) { text_ += "<p>" + escaped(words) + "</p>\n"; }

void HtmlPage::add_preformatted(std::string_view text) { text_ += "<pre>" + escaped(text) + "</pre>\n"; }

void HtmlPage::add_figure(const std::string& png, std::string_view words, std::string_view kind) {
  const std::string caption = escaped(words);
  text_ += "<figure><img class=\"" + std::string(kind) + "\" alt=\"" + caption + "\" src=\"data:image/png;base64," + base64(png) + "\"><figcaption>" +
           caption + "</figcaption></figure>\n";
}

void HtmlPage::add_table(const std::vector<std::vector<std::string>>& rows) {
  text_ += "<table>\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string cell = i == 0 ? "th" : "td";
    text_ += "<tr>";
    for (const std::string& words : rows[i]) text_ += "<" + cell + ">" + escaped(words) + "</" + cell + ">";
    text_ += "</tr>\n";
  }
  text_ += "</table>\n";
}

}  // namespace arcus::render
