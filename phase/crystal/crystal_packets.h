#pragma once
// Many rays through one crystal side by side, in single precision: what crystal_rays.h does, at
// millions a second. A ray may have its own direction (its own orientation of the crystal) and its
// own index (its own wavelength). Bits are equal on processors with AVX2 and AVX-512.

#include <cstdint>
#include <memory>
#include <span>

#include "phase/base/random.h"
#include "phase/crystal/crystal_shape.h"
#include "phase/crystal/face_path.h"
#include "phase/optics/stokes.h"
#include "phase/particle/instructions.h"
#include "phase/particle/lanes.h"

namespace arcus::phase {

struct CrystalTables;

/// Memory for rays that go in and light that comes out. Make one for each thread and use it again.
class CrystalBatch {
 public:
  /// rays: above 0; some hundreds stay in the cache. events: faces met from inside that `split`
  /// follows.
  CrystalBatch(int rays, int events);
  int rays() const { return rays_; }
  int events() const { return events_; }

  /// A ray: direction of travel in the crystal's axes (a unit vector), index above 1 and absorption
  /// of power per unit of length. Takes four numbers from `random`.
  void set(int ray, const Vec3& incoming, double n, double absorption_per_length, Random& random);
  /// The same with the numbers given: three in [0, 1) choose where the ray meets the crystal,
  /// `bits` what `draw` does.
  void set(int ray, const Vec3& incoming, double n, double absorption_per_length, float u_face,
           float u1, float u2, std::uint32_t bits);

  /// The same for all rays by columns, [ray], to be written: x, y, z of the direction, index, absorption, three numbers in [0, 1)
  /// and, only for `draw`, bits.
  std::span<float> input(int quantity) { return {row(quantity), static_cast<std::size_t>(rays_)}; }
  static constexpr int input_x = 0, input_y = 1, input_z = 2, input_index = 3, input_absorption = 4, input_numbers = 5;

  /// The crystal's shadow for this ray: rays from orientations drawn without regard to it count in
  /// proportion to it.
  double projected_area(int ray) const { return row(area)[ray]; }
  std::span<const float> projected_areas() const { return {row(area), static_cast<std::size_t>(rays_)}; }

  // After CrystalPackets::split: event 0 is what is reflected outside, event e what leaves at the
  // e-th face met from inside; light.i is 0 under total reflection. After draw there is event 0
  // alone: what was drawn.
  Vec3 direction(int event, int ray) const;
  Stokes light(int event, int ray) const;  ///< as CrystalExit::light
  FacePath path(int event, int ray) const;
  double absorbed(int ray) const { return row(lost)[ray]; }  ///< split only
  double cut_off(int ray) const {
    return row(still_inside)[ray];
  }  ///< power still inside at the end

  /// The same by columns, [ray]; with rays() numbers each, aligned to 64 bytes. x, y, z, i, q, u,
  /// v.
  std::span<const float> column(int event, int quantity) const {
    return {exit_row(event, quantity), static_cast<std::size_t>(rays_)};
  }
  static constexpr int x = 0, y = 1, z = 2, i = 3, q = 4, u = 5, v = 6;

 private:
  friend class CrystalPackets;
  template <typename Width>
  friend struct CrystalKernel;
  enum Row {
    in_x,
    in_y,
    in_z,
    index,
    absorption,
    face_number,
    first_number,
    second_number,
    random_bits,
    area,
    lost,
    still_inside,
    first_exit
  };
  static constexpr int exit_rows = 8;  // the last: the number of the face
  static constexpr int state_rows = 18;

  float* row(int which) const {
    return reinterpret_cast<float*>(memory_.data()) + static_cast<std::ptrdiff_t>(which) * padded_;
  }
  float* exit_row(int event, int quantity) const {
    return row(first_exit + event * exit_rows + quantity);
  }
  float* state_row(int which) const { return exit_row(events_ + 1, which); }

  bool absorbs() const;

  int rays_, padded_, events_;
  LaneMemory memory_;
  std::unique_ptr<std::uint64_t[]> codes_;  ///< of the paths drawn
  bool drawn_ = false;
};

class CrystalPackets {
 public:
  /// `instructions` other than the best are for tests.
  explicit CrystalPackets(const CrystalShape& shape,
                          Instructions instructions = best_instructions());
  CrystalPackets(CrystalPackets&&) noexcept;
  ~CrystalPackets();

  /// Every ray with all its exits. Agrees with CrystalRays::split within the rounding of floats:
  /// directions to some 1e-6 rad, powers to 1e-6, unless a ray passes that near an edge.
  void split(CrystalBatch& batch) const;
  /// One exit of every ray, drawn as CrystalRays::draw does. A ray that is still inside after
  /// `events` faces has light.i = 0 and cut_off what it had.
  void draw(CrystalBatch& batch, int events = 1000) const;

 private:
  std::unique_ptr<const CrystalTables> tables_;
  Instructions instructions_;
};

}  // namespace arcus::phase
