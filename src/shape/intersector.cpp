// The intersector with a hierarchy: Embree finds the candidates in single precision, within boxes that are a little too large, and the
// exact meeting is computed in double precision. Groups whose sizes are too different for that have hierarchies of their own.
#include "src/shape/intersector.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "phase/base/error.h"
#include "src/shape/near_groups.h"

namespace arcus::render {
namespace {

/// What callbacks need to know of a ray.
struct Question {
  RTCIntersectContext embree;  // first: callbacks get a pointer to it
  media::Ray ray;              // in double precision; farthest_m: the best so far
  double shift_m;              // from its origin to that of Embree's ray
  Departure departure;
  PieceHit best;
};

/// A group of spheres or flat pieces as its callbacks see it.
struct Group {
  const PieceGroup* pieces;
  std::uint32_t number;
  Vec3 origin_m;   // of Embree's coordinates
  double margin_m; // by which boxes are too large
};

void bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& group = *static_cast<const Group*>(arguments->geometryUserPtr);
  media::Box box;
  if (!group.pieces->spheres.empty()) {
    const Sphere& s = group.pieces->spheres[arguments->primID];
    const Vec3 centre = group.pieces->centre_m - group.origin_m + s.offset_m();
    box = {centre - Vec3(s.radius_m), centre + Vec3(s.radius_m)};
  } else {
    const Flat& flat = group.pieces->flats[arguments->primID];
    for (const double u : {-1.0, 1.0})
      for (const double v : {-1.0, 1.0}) box.include(flat.centre_m - group.origin_m + flat.edge_u_m * u + flat.edge_v_m * v);
  }
  box = box.grown_by(group.margin_m);
  const auto low = [](double x) { return std::nextafter(static_cast<float>(x), -INFINITY); };
  const auto high = [](double x) { return std::nextafter(static_cast<float>(x), INFINITY); };
  *arguments->bounds_o = {low(box.low.x), low(box.low.y), low(box.low.z), 0, high(box.high.x), high(box.high.y), high(box.high.z), 0};
}

/// The exact meeting with a piece, if it is nearer than the best so far.
bool ask(const Group& group, std::uint32_t piece, Question& question) {
  const media::Ray& ray = question.ray;
  const bool is_departure = question.departure.from == PieceId{group.number, piece};
  Meeting meeting;
  if (!group.pieces->spheres.empty()) {
    const Sphere& s = group.pieces->spheres[piece];
    if (!meet(ray.origin_m - group.pieces->centre_m - s.offset_m(), ray.direction, s.radius_m, ray.nearest_m, ray.farthest_m, is_departure,
              question.departure.goes_inside, meeting))
      return false;
  } else if (is_departure || !meet(ray, group.pieces->flats[piece], meeting)) {
    return false;
  }
  question.ray.farthest_m = meeting.distance_m;
  question.best = {{group.number, piece}, meeting};
  return true;
}

float rounded_up(double x) { return std::nextafter(static_cast<float>(x), INFINITY); }

void intersect(const RTCIntersectFunctionNArguments* arguments) {
  assert(arguments->N == 1);
  if (!arguments->valid[0]) return;
  const auto& group = *static_cast<const Group*>(arguments->geometryUserPtr);
  auto& question = *reinterpret_cast<Question*>(arguments->context);
  if (!ask(group, arguments->primID, question)) return;
  auto& hit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  hit.ray.tfar = rounded_up(question.ray.farthest_m - question.shift_m);
  hit.hit.geomID = arguments->geomID;
  hit.hit.primID = arguments->primID;
}

void occluded(const RTCOccludedFunctionNArguments* arguments) {
  assert(arguments->N == 1);
  if (!arguments->valid[0]) return;
  const auto& group = *static_cast<const Group*>(arguments->geometryUserPtr);
  auto& question = *reinterpret_cast<Question*>(arguments->context);
  if (ask(group, arguments->primID, question)) reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -INFINITY;
}

/// Embree's triangles: refused where the ray leaves them, made exact otherwise.
void filter(const RTCFilterFunctionNArguments* arguments) {
  assert(arguments->N == 1);
  const auto& group = *static_cast<const Group*>(arguments->geometryUserPtr);
  auto& question = *reinterpret_cast<Question*>(arguments->context);
  const std::uint32_t piece = RTCHitN_primID(arguments->hit, 1, 0);
  Meeting meeting;
  if (question.departure.from == PieceId{group.number, piece} || !meet_plane_of(question.ray, group.pieces->triangle(piece), meeting)) {
    arguments->valid[0] = 0;
    return;
  }
  question.ray.farthest_m = meeting.distance_m;
  question.best = {{group.number, piece}, meeting};
}

/// Of some of the groups.
class Hierarchy {
 public:
  Hierarchy(RTCDevice device, const std::vector<PieceGroup>& groups, const std::vector<std::uint32_t>& numbers) : device_(device) {
    for (const std::uint32_t number : numbers) bounds_.include(bounds_of(groups[number]));
    build(groups, numbers);
  }
  ~Hierarchy() { rtcReleaseScene(scene_); }
  Hierarchy(const Hierarchy&) = delete;
  Hierarchy& operator=(const Hierarchy&) = delete;

  std::optional<PieceHit> nearest(const media::Ray& ray, const Departure& departure) const {
    Question question;
    RTCRayHit hit;
    if (!prepare(ray, departure, question, hit.ray)) return std::nullopt;
    hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &question.embree, &hit);
    if (question.best.id.group == PieceId::none) return std::nullopt;
    return question.best;
  }
  bool is_blocked(const media::Ray& ray, const Departure& departure) const {
    Question question;
    RTCRay embree_ray;
    if (!prepare(ray, departure, question, embree_ray)) return false;
    rtcOccluded1(scene_, &question.embree, &embree_ray);
    return embree_ray.tfar < 0;
  }

 private:
  void build(const std::vector<PieceGroup>& groups, const std::vector<std::uint32_t>& numbers) {
    origin_m_ = bounds_.centre();
    const Vec3 size = bounds_.size();
    // Single precision places the ray to half a unit of 2⁻²³ in each of origin and direction, along at most the diagonal.
    const double margin_m = 0x1p-21 * (size.x + size.y + size.z);
    bounds_ = bounds_.grown_by(margin_m);
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION | RTC_SCENE_FLAG_COMPACT));
    groups_.reserve(numbers.size());
    for (const std::uint32_t number : numbers) {
      groups_.push_back({&groups[number], number, origin_m_, margin_m});
      attach(groups_.back());
    }
    rtcCommitScene(scene_);
  }
  void attach(Group& group) {
    const bool is_mesh = group.pieces->triangle_count() > 0;
    RTCGeometry geometry = rtcNewGeometry(device_, is_mesh ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserData(geometry, &group);
    if (is_mesh) {
      if (group.pieces->terrain) fill(geometry, *group.pieces->terrain);
      else fill(geometry, group.pieces->triangles);
      rtcSetGeometryIntersectFilterFunction(geometry, filter);
      rtcSetGeometryOccludedFilterFunction(geometry, filter);
    } else {
      rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(group.pieces->size()));
      rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
      rtcSetGeometryIntersectFunction(geometry, intersect);
      rtcSetGeometryOccludedFunction(geometry, occluded);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, group.number);
    rtcReleaseGeometry(geometry);
  }
  struct Buffers {
    float* corners;
    unsigned* numbers;
  };
  static Buffers new_buffers(RTCGeometry geometry, std::size_t corners, std::size_t triangles) {
    const Buffers buffers{static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, corners)),
                          static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles))};
    if (!buffers.corners || !buffers.numbers) throw cannot("the hierarchy of surfaces", "out of memory");
    return buffers;
  }
  void put(float*& corners, const Vec3& corner_m) const {
    for (int axis = 0; axis < 3; ++axis) *corners++ = static_cast<float>(corner_m[axis] - origin_m_[axis]);
  }
  void fill(RTCGeometry geometry, const std::vector<Triangle>& triangles) const {
    auto [corners, numbers] = new_buffers(geometry, 3 * triangles.size(), triangles.size());
    unsigned number = 0;
    for (const Triangle& t : triangles)
      for (const Vec3& corner : {t.a_m, t.b_m, t.c_m}) {
        put(corners, corner);
        *numbers++ = number++;
      }
  }
  void fill(RTCGeometry geometry, const Terrain& terrain) const {
    auto [corners, numbers] = new_buffers(geometry, std::size_t{terrain.columns()} * terrain.rows(), terrain.triangles());
    for (std::uint32_t row = 0; row < terrain.rows(); ++row)
      for (std::uint32_t column = 0; column < terrain.columns(); ++column) put(corners, terrain.corner_m(column, row));
    for (std::uint32_t i = 0; i < terrain.triangles(); ++i) {
      const Terrain::Corners at = terrain.corners(i);
      for (const std::uint32_t corner : {at.a, at.b, at.c}) *numbers++ = corner;
    }
  }
  /// False where the ray passes all pieces by.
  bool prepare(const media::Ray& ray, const Departure& departure, Question& question, RTCRay& embree_ray) const {
    const auto part = media::clip(ray, bounds_);
    if (!part) return false;
    rtcInitIntersectContext(&question.embree);
    question.ray = ray;
    question.departure = departure;
    question.best.id = {};
    // Embree's ray begins where the box does, so that single precision is enough however far away the eye is.
    const Vec3 origin = ray.at(part->begin) - origin_m_;
    question.shift_m = part->begin;
    embree_ray.org_x = static_cast<float>(origin.x);
    embree_ray.org_y = static_cast<float>(origin.y);
    embree_ray.org_z = static_cast<float>(origin.z);
    embree_ray.dir_x = static_cast<float>(ray.direction.x);
    embree_ray.dir_y = static_cast<float>(ray.direction.y);
    embree_ray.dir_z = static_cast<float>(ray.direction.z);
    embree_ray.tnear = 0;
    embree_ray.tfar = rounded_up(part->end - part->begin);
    embree_ray.time = 0;
    embree_ray.mask = ~0u;
    embree_ray.id = embree_ray.flags = 0;
    return true;
  }

  RTCDevice device_;
  RTCScene scene_ = nullptr;
  media::Box bounds_;
  Vec3 origin_m_;
  std::vector<Group> groups_;
};

class Hierarchies : public Intersector {
 public:
  explicit Hierarchies(const std::vector<PieceGroup>& groups) : device_(rtcNewDevice(nullptr)) {
    if (!device_) throw cannot("embree", "no device");
    rtcSetDeviceErrorFunction(device_, [](void* self, RTCError error, const char* text) {
      static_cast<Hierarchies*>(self)->error_ = std::to_string(error) + (text ? std::string(": ") + text : "");
    }, this);
    for (const auto& numbers : groups_near_together(groups)) {
      parts_.push_back(std::make_unique<const Hierarchy>(device_, groups, numbers));
      if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE || !error_.empty())
        throw cannot("the hierarchy of surfaces", "embree reports " + error_);
    }
  }
  ~Hierarchies() override {
    parts_.clear();
    rtcReleaseDevice(device_);
  }
  Hierarchies(const Hierarchies&) = delete;
  Hierarchies& operator=(const Hierarchies&) = delete;

  std::optional<PieceHit> nearest(const media::Ray& ray, const Departure& departure) const override {
    std::optional<PieceHit> best;
    media::Ray rest = ray;
    for (const auto& part : parts_)
      if (const auto found = part->nearest(rest, departure)) {
        best = found;
        rest.farthest_m = found->meeting.distance_m;
      }
    return best;
  }
  bool is_blocked(const media::Ray& ray, const Departure& departure) const override {
    return std::any_of(parts_.begin(), parts_.end(), [&](const auto& part) { return part->is_blocked(ray, departure); });
  }

 private:
  RTCDevice device_;
  std::string error_;
  std::vector<std::unique_ptr<const Hierarchy>> parts_;
};

}  // namespace

std::unique_ptr<const Intersector> make_hierarchy(const std::vector<PieceGroup>& groups) { return std::make_unique<Hierarchies>(groups); }

}  // namespace arcus::render
