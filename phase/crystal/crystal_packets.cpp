#include "phase/crystal/crystal_packets.h"

#include <cstring>

#include "phase/crystal/crystal_tables.h"

// Vectors lose "may alias" as arguments of templates; memory is only touched where they have it.
#pragma GCC diagnostic ignored "-Wignored-attributes"

namespace arcus::phase {

// ---- arithmetic on vectors ----------------------------------------------------------------------

namespace {

template <typename F>
using Ints = decltype(F{} < F{});

template <typename F>
[[gnu::always_inline]] inline F all(float value) {
  return filled<F>(value);
}
/// a b + c with one rounding.
template <typename F>
[[gnu::always_inline]] inline F madd(const F& a, const F& b, const F& c) {
  F sum = c;
  add_product(sum, a, b);
  return sum;
}
template <typename F>
[[gnu::always_inline]] inline F root(const F& a) {
  F result;
  asm("vsqrtps %1, %0" : "=v"(result) : "v"(a));
  return result;
}
template <typename F>
[[gnu::always_inline]] inline F with_sign_flipped(const F& a, const Ints<F>& sign) {
  return reinterpret_cast<F>(reinterpret_cast<Ints<F>>(a) ^ sign);
}
template <typename F>
[[gnu::always_inline]] inline Ints<F> sign_of(const F& a) {
  return reinterpret_cast<Ints<F>>(a) & static_cast<std::int32_t>(0x80000000u);
}
template <typename F>
[[gnu::always_inline]] inline F absolute(const F& a) {
  return reinterpret_cast<F>(reinterpret_cast<Ints<F>>(a) & 0x7fffffff);
}
template <typename F>
[[gnu::always_inline]] inline F larger(const F& a, const F& b) {
  return a > b ? a : b;
}

/// exp of numbers up to 0, to two units in the last place: powers of two and Taylor's series within
/// half an octave.
template <typename F>
[[gnu::always_inline]] inline F exponential(const F& exponent) {
  const F x = larger(exponent, all<F>(-87.0f));
  const F shift =
      all<F>(12582912.0f);  // 1.5 2^23: adding it rounds to a whole number in the last bits
  const F shifted = madd(x, all<F>(1.44269504f), shift);
  const F whole = shifted - shift;
  F f = madd(whole, all<F>(-0.693145752f), x);
  f = madd(whole, all<F>(-1.42860677e-6f), f);
  F sum = all<F>(1.0f / 720);
  for (const float c : {1.0f / 120, 1.0f / 24, 1.0f / 6, 0.5f, 1.0f, 1.0f})
    sum = madd(sum, f, all<F>(c));
  const Ints<F> power = (reinterpret_cast<Ints<F>>(shifted) - 0x4b400000 + 127) << 23;
  return sum * reinterpret_cast<F>(power);
}

template <typename F>
struct Triple {
  F x, y, z;
};
template <typename F>
[[gnu::always_inline]] inline F product(const Triple<F>& a, const Triple<F>& b) {
  return madd(a.x, b.x, madd(a.y, b.y, a.z * b.z));
}
template <typename F>
[[gnu::always_inline]] inline Triple<F> crossed(const Triple<F>& a, const Triple<F>& b) {
  return {madd(a.y, b.z, -(a.z * b.y)), madd(a.z, b.x, -(a.x * b.z)), madd(a.x, b.y, -(a.y * b.x))};
}
template <typename F>
[[gnu::always_inline]] inline Triple<F> along(const Triple<F>& from, const F& t,
                                              const Triple<F>& direction) {
  return {madd(t, direction.x, from.x), madd(t, direction.y, from.y), madd(t, direction.z, from.z)};
}
template <typename F>
[[gnu::always_inline]] inline Triple<F> chosen(const Ints<F>& mask, const Triple<F>& a,
                                               const Triple<F>& b) {
  return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

template <typename F>
struct Light {
  F i, q, u, v;
};

/// A packet of rays; see CrystalRays::Ray.
template <typename F>
struct Packet {
  Triple<F> place, direction, perpendicular;
  Light<F> light;
  Triple<F> incoming;
  F n, absorption;
};

/// Turns the axes to the plane of direction and other, but where they are parallel. As CrystalRays'
/// turn_to_plane_with.
template <typename F>
[[gnu::always_inline]] inline void turn_to_plane(Light<F>& light, Triple<F>& perpendicular,
                                                 const Triple<F>& direction,
                                                 const Triple<F>& other) {
  const Triple<F> next = crossed(direction, other);
  const Ints<F> keep = product(next, next) < 1e-10f;
  const F cosine = product(perpendicular, next), sine = product(perpendicular, other);
  const F cosine2 = cosine * cosine, sine2 = sine * sine;
  const F inverse = all<F>(1.0f) / (keep ? all<F>(1.0f) : cosine2 + sine2);
  const F c = keep ? all<F>(1.0f) : (cosine2 - sine2) * inverse;
  const F s = keep ? F{} : (cosine + cosine) * sine * inverse;
  const F q = madd(c, light.q, -(s * light.u));
  light.u = madd(s, light.q, c * light.u);
  light.q = q;
  perpendicular = chosen<F>(keep, perpendicular, next);
}

template <typename F>
struct UnsignedOf {
  typedef std::uint32_t Type [[gnu::vector_size(sizeof(F))]];
};

/// A number in [0, 1) that depends on both: C. Wellons' lowbias32 mixes the bits, the upper 24
/// count.
template <typename F>
[[gnu::always_inline]] inline F uniform(const F& seed, const Ints<F>& event) {
  using Bits = typename UnsignedOf<F>::Type;
  Bits x = reinterpret_cast<Bits>(seed) + reinterpret_cast<Bits>(event) * 0x9e3779b9u;
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  x = x ^ (x >> 16);
  return __builtin_convertvector(reinterpret_cast<Ints<F>>(x >> 8), F) * all<F>(0x1p-24f);
}

}  // namespace

// ---- what a packet meets ------------------------------------------------------------------------

template <typename Width>
struct CrystalKernel {
  using F = typename Width::FullFloats;
  using I = Ints<F>;
  using Tables = CrystalTables;
  static constexpr int size = sizeof(F) / sizeof(float);

  [[gnu::always_inline]] inline static F load(const float* from) {
    return *reinterpret_cast<const F*>(from);
  }
  [[gnu::always_inline]] inline static void store(float* to, const F& value) {
    *reinterpret_cast<F*>(to) = value;
  }

  [[gnu::always_inline]] inline static void put(std::int32_t* to, const I& value) {
    std::memcpy(to, &value, sizeof value);
  }

  /// The lit faces by their shares of the shadow, then a triangle of the face and a point of it.
  [[gnu::always_inline]] inline static void place_on_surface(const Tables& tables,
                                                             const CrystalBatch& batch, int first,
                                                             Packet<F>& packet, Triple<F>& normal,
                                                             I& number) {
    const Triple<F>& d = packet.incoming;
    F total = {};
    for (const auto& slab : tables.slabs) {
      const F cosine = product(d, {all<F>(slab.nx), all<F>(slab.ny), all<F>(slab.nz)});
      total += absolute(cosine) * (cosine < 0 ? all<F>(slab.area_plus) : all<F>(slab.area_minus));
    }
    store(batch.row(CrystalBatch::area) + first, total);
    F left = load(batch.row(CrystalBatch::face_number) + first) * total, lit_chosen = all<F>(1.0f),
      left_chosen = {};
    I slot = {}, done = {}, index = {};
    normal = {F{}, F{}, F{}};
    number = I{};
    for (const auto& slab : tables.slabs) {
      const Triple<F> axis{all<F>(slab.nx), all<F>(slab.ny), all<F>(slab.nz)};
      const F cosine = product(d, axis);
      const I plus = cosine < 0;
      const F lit = absolute(cosine) * (plus ? all<F>(slab.area_plus) : all<F>(slab.area_minus));
      const I take = (lit > 0) & ~done;
      const I away =
          sign_of(cosine) ^ static_cast<std::int32_t>(0x80000000u);  // the normal is against d
      normal = chosen<F>(take,
                         {with_sign_flipped(axis.x, away), with_sign_flipped(axis.y, away),
                          with_sign_flipped(axis.z, away)},
                         normal);
      number = take ? (plus ? slab.number_plus - I{} : slab.number_minus - I{}) : number;
      slot = take ? index + (plus ? I{} : I{} + 1) : slot;
      lit_chosen = take ? lit : lit_chosen;
      left_chosen = take ? left : left_chosen;
      done |= take & (left < lit);
      left -= lit;
      index += 2;
    }
    alignas(64) std::int32_t slots[size];
    alignas(64) float shares[size], places[3][size];
    put(slots, slot);
    store(shares, left_chosen / lit_chosen);
    for (int lane = 0; lane < size; ++lane) {
      const auto* triangle = &tables.triangles[static_cast<std::size_t>(
          tables.first_triangle[static_cast<std::size_t>(slots[lane])])];
      while (triangle->share_up_to_here <= shares[lane] && triangle->share_up_to_here < 1)
        ++triangle;
      float u = batch.row(CrystalBatch::first_number)[first + lane];
      float v = batch.row(CrystalBatch::second_number)[first + lane];
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      for (int k = 0; k < 3; ++k)
        places[k][lane] = triangle->corner[k] + u * triangle->first[k] + v * triangle->second[k];
    }
    packet.place = {load(places[0]), load(places[1]), load(places[2])};
  }

  /// Sends the packet into the crystal; returns what is reflected outside.
  [[gnu::always_inline]] inline static Light<F> enter(const Tables& tables,
                                                      const CrystalBatch& batch, int first,
                                                      Packet<F>& packet, Triple<F>& outside,
                                                      I& number) {
    packet.incoming = {load(batch.row(CrystalBatch::in_x) + first),
                       load(batch.row(CrystalBatch::in_y) + first),
                       load(batch.row(CrystalBatch::in_z) + first)};
    packet.n = load(batch.row(CrystalBatch::index) + first);
    packet.absorption = load(batch.row(CrystalBatch::absorption) + first);
    Triple<F> normal;
    place_on_surface(tables, batch, first, packet, normal, number);
    const Triple<F>& d = packet.incoming;
    const F one = all<F>(1.0f), half = all<F>(0.5f);
    F c = -product(d, normal);
    c = c > one ? one : larger(c, all<F>(1e-6f));
    const F inverse = one / packet.n;
    const F t = root(one - (one - c * c) * inverse * inverse);
    const F perpendicular = (c - packet.n * t) / (c + packet.n * t);
    const F parallel = (packet.n * c - t) / (packet.n * c + t);
    const F a = half * (parallel * parallel + perpendicular * perpendicular);
    const F b = half * (parallel * parallel - perpendicular * perpendicular);
    outside = along(d, c + c, normal);
    // At right angles to the light, where it meets the face straight on: with the axis least along
    // it.
    const Triple<F> upright = crossed(d, normal);
    const I straight = product(upright, upright) < 1e-10f;
    const I by_x = absolute(d.x) < 0.7f;
    const Triple<F> helper{by_x ? one : F{}, by_x ? F{} : one, F{}};
    packet.perpendicular = chosen<F>(straight, crossed(d, helper), upright);
    const Triple<F> scaled{d.x * inverse, d.y * inverse, d.z * inverse};
    packet.direction = along(scaled, c * inverse - t, normal);
    packet.light = {one - a, -b, F{}, F{}};
    Light<F> reflected{a, b, F{}, F{}};
    Triple<F> axes = packet.perpendicular;
    turn_to_plane(reflected, axes, outside, d);
    return reflected;
  }

  struct Meeting {
    Triple<F> leaving;
    Light<F> through, back;
    I number;
  };

  /// On to the next face; what leaves there and what goes on, its direction already turned.
  [[gnu::always_inline]] inline static Meeting advance(const Tables& tables, bool absorbs,
                                                       Packet<F>& packet) {
    const F one = all<F>(1.0f), half = all<F>(0.5f);
    F nearest = all<F>(no_face), cosine = one;  // their quotient is the distance
    Triple<F> normal{F{}, F{}, one};
    I number = {};
    for (const auto& slab : tables.slabs) {
      const Triple<F> axis{all<F>(slab.nx), all<F>(slab.ny), all<F>(slab.nz)};
      const F q = product(packet.direction, axis), p = product(packet.place, axis);
      const I sign = sign_of(q), minus = q < 0;
      const F gap = larger(
          (minus ? all<F>(slab.minus) : all<F>(slab.plus)) - with_sign_flipped(p, sign), F{});
      const F speed = absolute(q);
      const I nearer = gap * cosine < nearest * speed;
      nearest = nearer ? gap : nearest;
      cosine = nearer ? speed : cosine;
      normal = chosen<F>(nearer,
                         {with_sign_flipped(axis.x, sign), with_sign_flipped(axis.y, sign),
                          with_sign_flipped(axis.z, sign)},
                         normal);
      number = nearer ? (minus ? slab.number_minus - I{} : slab.number_plus - I{}) : number;
    }
    const F distance = nearest / cosine;
    packet.place = along(packet.place, distance, packet.direction);
    if (absorbs) {
      const F left = exponential(-(packet.absorption * distance));
      packet.light = {packet.light.i * left, packet.light.q * left, packet.light.u * left,
                      packet.light.v * left};
    }
    turn_to_plane(packet.light, packet.perpendicular, packet.direction, normal);

    // interface_matrix for an index of 1 / n, all fractions over one.
    const Light<F>& light = packet.light;
    const F& n = packet.n;
    const F c = cosine > one ? one : cosine, sine2 = one - c * c;
    const F transmitted2 = madd(-(n * n), sine2, one);
    const I total = transmitted2 <= 0;
    const F t = root(absolute(transmitted2));
    const F nc = n * c, nt = n * t;
    const F below = c * t, across = n * sine2;  // tan of half the phase under total reflection
    const F perpendicular_sum = nc + t, parallel_sum = c + nt;
    const F inverse =
        one / (total ? madd(below, below, across * across) : perpendicular_sum * parallel_sum);
    const F perpendicular = (nc - t) * parallel_sum * inverse,
            parallel = (c - nt) * perpendicular_sum * inverse;
    const F rs = perpendicular * perpendicular, rp = parallel * parallel;
    const F a = total ? one : half * (rp + rs), b = total ? F{} : half * (rp - rs);
    const F cr = total ? (across * across - below * below) * inverse : perpendicular * parallel;
    const F dr = total ? -(below + below) * across * inverse : F{};
    const F ct = total ? F{} : all<F>(4.0f) * nc * t * inverse;
    Meeting meeting;
    meeting.back = {madd(a, light.i, b * light.q), madd(b, light.i, a * light.q),
                    madd(cr, light.u, dr * light.v), madd(cr, light.v, -(dr * light.u))};
    // By subtraction: no power is lost or made.
    meeting.through = {light.i - meeting.back.i, light.q - meeting.back.q, ct * light.u,
                       ct * light.v};
    meeting.number = number;
    const Triple<F> d = packet.direction;
    meeting.leaving = along({n * d.x, n * d.y, n * d.z}, t - nc, normal);
    packet.direction = along(d, -(c + c), normal);
    Triple<F> axes = packet.perpendicular;
    turn_to_plane(meeting.through, axes, meeting.leaving, packet.incoming);
    return meeting;
  }

  [[gnu::always_inline]] inline static void write(const CrystalBatch& batch, int event, int first,
                                                  const Triple<F>& direction, const Light<F>& light,
                                                  const I& number) {
    const F rows[] = {direction.x, direction.y, direction.z, light.i,
                      light.q,     light.u,     light.v,     reinterpret_cast<F>(number)};
    for (int k = 0; k < CrystalBatch::exit_rows; ++k)
      store(batch.exit_row(event, k) + first, rows[k]);
  }

  [[gnu::always_inline]] inline static void split(const Tables& tables, const CrystalBatch& batch,
                                                  bool absorbs) {
    for (int first = 0; first < batch.padded_; first += size) {
      Packet<F> packet;
      Triple<F> outside;
      I number;
      const Light<F> reflected = enter(tables, batch, first, packet, outside, number);
      write(batch, 0, first, outside, reflected, number);
      F absorbed = {};
      for (int event = 1; event <= batch.events_; ++event) {
        const F before = packet.light.i;
        const Meeting meeting = advance(tables, absorbs, packet);
        absorbed += before - packet.light.i;
        write(batch, event, first, meeting.leaving, meeting.through, meeting.number);
        packet.light = meeting.back;
      }
      store(batch.row(CrystalBatch::lost) + first, absorbed);
      store(batch.row(CrystalBatch::still_inside) + first, packet.light.i);
    }
  }

  // ---- drawing ----------------------------------------------------------------------------------

  [[gnu::always_inline]] inline static void save(float* to, std::ptrdiff_t stride,
                                                 const Packet<F>& p) {
    const F rows[] = {p.place.x,
                      p.place.y,
                      p.place.z,
                      p.direction.x,
                      p.direction.y,
                      p.direction.z,
                      p.perpendicular.x,
                      p.perpendicular.y,
                      p.perpendicular.z,
                      p.light.i,
                      p.light.q,
                      p.light.u,
                      p.light.v,
                      p.incoming.x,
                      p.incoming.y,
                      p.incoming.z,
                      p.n,
                      p.absorption};
    static_assert(sizeof rows == CrystalBatch::state_rows * sizeof(F));
    for (int k = 0; k < CrystalBatch::state_rows; ++k) store(to + k * stride, rows[k]);
  }
  [[gnu::always_inline]] inline static Packet<F> restored(const float* from,
                                                          std::ptrdiff_t stride) {
    F r[CrystalBatch::state_rows];
    for (int k = 0; k < CrystalBatch::state_rows; ++k) r[k] = load(from + k * stride);
    return {{r[0], r[1], r[2]},
            {r[3], r[4], r[5]},
            {r[6], r[7], r[8]},
            {r[9], r[10], r[11], r[12]},
            {r[13], r[14], r[15]},
            r[16],
            r[17]};
  }
  [[gnu::always_inline]] inline static Light<F> scaled(const Light<F>& light, const F& factor) {
    return {light.i * factor, light.q * factor, light.u * factor, light.v * factor};
  }

  /// First all rays enter, and some are reflected outside. The others wait until a lane is free:
  /// lanes whose ray has left take the next one, so that all of them stay busy.
  [[gnu::always_inline]] inline static void draw(const Tables& tables, CrystalBatch& batch,
                                                 bool absorbs, int events) {
    const F one = all<F>(1.0f);
    const std::ptrdiff_t stride = batch.padded_;
    for (int first = 0; first < batch.padded_; first += size) {
      Packet<F> packet;
      Triple<F> outside;
      I number;
      const Light<F> reflected = enter(tables, batch, first, packet, outside, number);
      const F seed = load(batch.row(CrystalBatch::random_bits) + first);
      const I stays_out = uniform<F>(seed, I{}) < reflected.i;
      const Light<F> whole = scaled(reflected, one / reflected.i);
      write(batch, 0, first, outside, {stays_out ? one : F{}, whole.q, whole.u, whole.v}, number);
      store(batch.row(CrystalBatch::still_inside) + first, F{});
      packet.light = scaled(packet.light, one / packet.light.i);
      save(batch.state_row(0) + first, stride, packet);
      for (int lane = 0; lane < size; ++lane)
        batch.codes_[first + lane] = static_cast<std::uint64_t>(number[lane]);
    }

    alignas(64) float state[CrystalBatch::state_rows][size] = {}, seeds[size] = {}, out[7][size];
    alignas(64) std::int32_t event[size] = {}, leaves[size], met[size];
    int ray[size], busy = 0, next = 0;
    FacePath path[size];
    const auto refill = [&](int lane) {
      while (next < batch.padded_ && batch.exit_row(0, CrystalBatch::i)[next] != 0) ++next;
      ray[lane] = next < batch.padded_ ? next : -1;
      if (ray[lane] < 0) return;
      for (int k = 0; k < CrystalBatch::state_rows; ++k) state[k][lane] = batch.state_row(k)[next];
      seeds[lane] = batch.row(CrystalBatch::random_bits)[next];
      path[lane] = FacePath(batch.codes_[next]);
      event[lane] = 0;
      ++busy;
      ++next;
    };
    for (int lane = 0; lane < size; ++lane) refill(lane);
    // Lanes that nothing is left for repeat a ray in vain.
    for (int lane = 0; lane < size; ++lane)
      if (ray[lane] < 0)
        for (int k = 0; k < CrystalBatch::state_rows; ++k) state[k][lane] = state[k][0];
    while (busy > 0) {
      Packet<F> packet = restored(state[0], size);
      I count;
      std::memcpy(&count, event, sizeof count);
      count += 1;
      put(event, count);
      const Meeting meeting = advance(tables, absorbs, packet);
      const F arriving = packet.light.i;
      const I stays =
          (uniform<F>(load(seeds), count) * arriving < meeting.back.i) | (meeting.through.i <= 0);
      packet.light = scaled(meeting.back, arriving / (stays ? meeting.back.i : one));
      const Light<F> through =
          scaled(meeting.through, arriving / (stays ? one : meeting.through.i));
      save(state[0], size, packet);
      const F rows[] = {meeting.leaving.x, meeting.leaving.y, meeting.leaving.z, arriving,
                        through.q,         through.u,         through.v};
      for (int k = 0; k < 7; ++k) store(out[k], rows[k]);
      put(leaves, ~stays | (count >= events));
      put(met, meeting.number);
      for (int lane = 0; lane < size; ++lane) {
        path[lane] = path[lane].then(met[lane]);
        if (!leaves[lane] || ray[lane] < 0) continue;
        if (stays[lane]) {
          batch.row(CrystalBatch::still_inside)[ray[lane]] = state[9][lane];
        } else {
          for (int k = 0; k < 7; ++k) batch.exit_row(0, k)[ray[lane]] = out[k][lane];
        }
        batch.codes_[ray[lane]] = path[lane].code();
        --busy;
        refill(lane);
      }
    }
  }
};

namespace {

void split_avx2(const CrystalTables& tables, CrystalBatch& batch, bool absorbs) {
  CrystalKernel<Narrow>::split(tables, batch, absorbs);
}
[[gnu::target("arch=x86-64-v4")]] void split_avx512(const CrystalTables& tables,
                                                    CrystalBatch& batch, bool absorbs) {
  CrystalKernel<Wide>::split(tables, batch, absorbs);
}
void draw_avx2(const CrystalTables& tables, CrystalBatch& batch, bool absorbs, int events) {
  CrystalKernel<Narrow>::draw(tables, batch, absorbs, events);
}
[[gnu::target("arch=x86-64-v4")]] void draw_avx512(const CrystalTables& tables, CrystalBatch& batch,
                                                   bool absorbs, int events) {
  CrystalKernel<Wide>::draw(tables, batch, absorbs, events);
}

}  // namespace

// ---- the tracer ---------------------------------------------------------------------------------

CrystalPackets::CrystalPackets(const CrystalShape& shape, Instructions instructions)
    : tables_(std::make_unique<const CrystalTables>(shape)), instructions_(instructions) {}

CrystalPackets::CrystalPackets(CrystalPackets&&) noexcept = default;
CrystalPackets::~CrystalPackets() = default;

void CrystalPackets::split(CrystalBatch& batch) const {
  (instructions_ == Instructions::avx512 ? split_avx512 : split_avx2)(*tables_, batch,
                                                                      batch.absorbs());
  batch.drawn_ = false;
}

void CrystalPackets::draw(CrystalBatch& batch, int events) const {
  (instructions_ == Instructions::avx512 ? draw_avx512 : draw_avx2)(*tables_, batch,
                                                                    batch.absorbs(), events);
  batch.drawn_ = true;
}

}  // namespace arcus::phase
