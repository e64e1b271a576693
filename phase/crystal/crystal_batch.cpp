// Memory for the rays of crystal_packets.h.

#include <algorithm>
#include <bit>
#include <cassert>

#include "phase/crystal/crystal_packets.h"

namespace arcus::phase {

CrystalBatch::CrystalBatch(int rays, int events)
    : rays_(rays),
      padded_((rays + 15) / 16 * 16),
      events_(events),
      memory_(static_cast<std::size_t>(padded_) / 16 *
              static_cast<std::size_t>(first_exit + exit_rows * (events + 1) + state_rows)),
      codes_(new std::uint64_t[static_cast<std::size_t>(padded_)]()) {
  assert(rays > 0 && events >= 0);
  static_assert(sizeof(double) * lanes == 16 * sizeof(float));
  std::fill_n(
      row(0),
      static_cast<std::size_t>(padded_) * (first_exit + exit_rows * (events + 1) + state_rows),
      0.0f);
  // Whatever is not set, the rest of the last vector too, is some ray.
  for (int ray = 0; ray < padded_; ++ray) set(ray, {0, 0, -1}, 1.31, 0, 0.5f, 0.3f, 0.3f, 0);
}

void CrystalBatch::set(int ray, const Vec3& incoming, double n, double absorption_per_length,
                       Random& random) {
  const float u_face = random.uniform(), u1 = random.uniform(), u2 = random.uniform();
  set(ray, incoming, n, absorption_per_length, u_face, u1, u2, random.bits());
}

void CrystalBatch::set(int ray, const Vec3& incoming, double n, double absorption_per_length,
                       float u_face, float u1, float u2, std::uint32_t bits) {
  assert(ray >= 0 && ray < padded_ && n > 1 && absorption_per_length >= 0);
  row(in_x)[ray] = static_cast<float>(incoming.x);
  row(in_y)[ray] = static_cast<float>(incoming.y);
  row(in_z)[ray] = static_cast<float>(incoming.z);
  row(index)[ray] = static_cast<float>(n);
  row(absorption)[ray] = static_cast<float>(absorption_per_length);
  row(face_number)[ray] = u_face;
  row(first_number)[ray] = u1;
  row(second_number)[ray] = u2;
  row(random_bits)[ray] = std::bit_cast<float>(bits);
}

Vec3 CrystalBatch::direction(int event, int ray) const {
  return {exit_row(event, x)[ray], exit_row(event, y)[ray], exit_row(event, z)[ray]};
}

Stokes CrystalBatch::light(int event, int ray) const {
  return {exit_row(event, i)[ray], exit_row(event, q)[ray], exit_row(event, u)[ray],
          exit_row(event, v)[ray]};
}

FacePath CrystalBatch::path(int event, int ray) const {
  if (drawn_) return FacePath(codes_[static_cast<std::size_t>(ray)]);
  FacePath path;
  for (int e = 0; e <= event; ++e)
    path = path.then(std::bit_cast<std::int32_t>(exit_row(e, exit_rows - 1)[ray]));
  return path;
}

bool CrystalBatch::absorbs() const {
  return std::any_of(row(absorption), row(absorption) + padded_, [](float a) { return a > 0; });
}

}  // namespace arcus::phase
