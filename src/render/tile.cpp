#include "src/render/tile.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

#include "phase/base/error.h"

namespace arcus::render {
namespace {

/// Takes a whole number from where `at` stands.
bool take_number(const char*& at, const char* end, long long& number) {
  const auto [next, fault] = std::from_chars(at, end, number);
  if (fault != std::errc() || number < 0) return false;
  at = next;
  return true;
}

}  // namespace

PixelBox tile_box(int width_px, int height_px, long long count, long long tile) {
  const long long width = width_px, height = height_px;
  assert(0 <= tile && tile < count && count <= width * height);
  const long long nearest = std::llround(std::sqrt(static_cast<double>(count) * static_cast<double>(height) / static_cast<double>(width)));
  const long long rows = std::clamp(nearest, (count + width - 1) / width, std::min(height, count));
  const auto first_of = [&](long long row) { return row * count / rows; };
  // A pixel for every row, and what is left over in proportion: no row is empty.
  const auto top_of = [&](long long row) { return row + (height - rows) * first_of(row) / count; };
  const long long row = ((tile + 1) * rows + count - 1) / count - 1;
  const long long tiles = first_of(row + 1) - first_of(row), column = tile - first_of(row);
  return {static_cast<int>(width * column / tiles), static_cast<int>(top_of(row)), static_cast<int>(width * (column + 1) / tiles),
          static_cast<int>(top_of(row + 1))};
}

TileList read_tile_list(const std::string& text, const std::string& option) {
  const auto wrong = [&](const char* expected) { return bad_input(option, "'" + text + "'", expected); };
  constexpr const char* form = "K/N, K,K,.../N or A-B/N expected: numbers of tiles, from 0, and how many there are in all";
  TileList list;
  const char* at = text.data();
  const char* const end = at + text.size();
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) throw wrong(form);
  const char* after = at + slash + 1;
  if (!take_number(after, end, list.count) || after != end) throw wrong(form);
  const char* const stop = at + slash;
  while (true) {
    long long first = 0, last = 0;
    if (!take_number(at, stop, first)) throw wrong(form);
    last = first;
    if (at != stop && *at == '-' && !take_number(++at, stop, last)) throw wrong(form);
    if (last < first) throw wrong("ranges A-B with B at least A expected");
    if (last >= list.count) throw wrong("tiles below N expected: they count from 0");
    if (last - first > 100'000'000) throw wrong("at most a hundred million tiles expected");
    for (long long tile = first; tile <= last; ++tile) list.tiles.push_back(tile);
    if (at == stop) break;
    if (*at++ != ',') throw wrong(form);
  }
  std::sort(list.tiles.begin(), list.tiles.end());
  list.tiles.erase(std::unique(list.tiles.begin(), list.tiles.end()), list.tiles.end());
  return list;
}

std::string text_of_tiles(const std::vector<long long>& tiles) {
  std::string text;
  for (const long long tile : tiles) text += (text.empty() ? "" : ",") + std::to_string(tile);
  return text;
}

}  // namespace arcus::render
