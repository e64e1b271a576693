#include "phase/base/content_hash.h"

#define XXH_INLINE_ALL  // header only: no library to link
#include <xxhash.h>

#include <fstream>
#include <memory>
#include <vector>

#include "phase/base/error.h"

namespace arcus {
namespace {

std::string digits_of(XXH128_hash_t hash) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, hash);
  std::string text;
  for (const unsigned char byte : canonical.digest) {
    constexpr char digits[] = "0123456789abcdef";
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

}  // namespace

std::string content_hash(std::string_view content) { return digits_of(XXH3_128bits(content.data(), content.size())); }

std::string file_hash(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw bad_input(path, "no file that can be read", "an existing file expected");
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::vector<char> buffer(1 << 20);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())), in.gcount() > 0)
    XXH3_128bits_update(state.get(), buffer.data(), static_cast<std::size_t>(in.gcount()));
  if (in.bad()) throw bad_input(path, "a file that cannot be read to its end", "a whole file expected");
  return digits_of(XXH3_128bits_digest(state.get()));
}

}  // namespace arcus
