#include "tests/fuzz/body_from_bytes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "tests/support/random_numbers.h"

namespace instep::test {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostPoints = 300;
constexpr int kMostSteps = 24;

/// Takes numbers off the front of bytes; zeros at their end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }
  unsigned byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  /// In [0, 1].
  double part() { return byte() / 255.0; }
  double within(double low, double high) { return low + (high - low) * part(); }
  /// From 1e-12 to 1e4, evenly by its logarithm.
  double size() { return std::pow(10.0, within(-12.0, 4.0)); }
  /// Any double there is.
  double any() {
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = (bits << 8) | byte();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

/// Rows of points round the z axis, and the faces between them.
void add_tube(Bytes& bytes, FuzzedBody& body, bool ball) {
  const int columns = 3 + static_cast<int>(bytes.byte() % 28);
  const int rows = 1 + static_cast<int>(bytes.byte() % 10);
  const double twist = bytes.part();
  const double flatness = bytes.within(0.05, 1.0);
  for (int row = 0; row < rows; ++row) {
    const double height = rows > 1 ? 2.0 * row / (rows - 1.0) - 1.0 : 0.0;
    const double radius = ball ? std::sqrt(1.0 - 0.999 * height * height) : 1.0;
    for (int column = 0; column < columns; ++column) {
      const double angle = 2.0 * std::numbers::pi * (column + twist * row) / columns;
      body.cloud.positions.emplace_back(40.0 * radius * std::cos(angle),
                                        40.0 * flatness * radius * std::sin(angle), 40.0 * height);
    }
  }
  const auto corner = [&](int row, int column) {
    return static_cast<std::uint32_t>(row * columns + column % columns);
  };
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto a = corner(row, column);
      const auto b = corner(row, column + 1);
      const auto c = corner(row + 1, column + 1);
      body.mesh.triangles.push_back({a, b, c});
      body.mesh.triangles.push_back({a, c, corner(row + 1, column)});
    }
  }
}

void add_scatter(Bytes& bytes, FuzzedBody& body) {
  RandomNumbers random(bytes.byte());
  const Vector3d spread(bytes.within(0, 40), bytes.within(0, 40), bytes.within(0, 40));
  const std::size_t count = 1 + bytes.byte();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d place(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    body.cloud.positions.push_back(spread.cwiseProduct(place));
  }
}

void add_base(Bytes& bytes, FuzzedBody& body) {
  switch (bytes.byte() % 4) {
    case 0:
      return add_tube(bytes, body, false);
    case 1:
      return add_tube(bytes, body, true);
    case 2:
      return add_scatter(bytes, body);  // flat or a line, as its spread says
    default:
      return;
  }
}

Result<TapePlane> plane_of(Bytes& bytes, const PointCloud& cloud) {
  const unsigned kind = bytes.byte() % 8;
  if (kind == 0) {
    const auto point = [&] { return Vector3d(bytes.any(), bytes.any(), bytes.any()); };
    const Vector3d first = point();
    const Vector3d second = point();
    return TapePlane::through(first, second, point());
  }
  if (kind == 1 && !cloud.empty()) {
    const auto point = [&] { return cloud.positions[bytes.byte() * 7 % cloud.size()]; };
    const Vector3d first = point();
    const Vector3d second = point();
    return TapePlane::through(first, second, point());
  }
  const double height = bytes.within(-45, 45);
  const double slope = kind == 2 ? std::tan(bytes.within(-1.57, 1.57)) : 0.0;
  return TapePlane::through({0, 0, height}, {10, 0, height + 10 * slope}, {0, 10, height});
}

/// Neighbouring points of the list, as the bytes choose them.
std::pair<std::size_t, std::size_t> some_of(Bytes& bytes, std::size_t size) {
  const auto first = static_cast<std::size_t>(bytes.part() * static_cast<double>(size));
  const auto count = static_cast<std::size_t>(bytes.part() * static_cast<double>(size)) + 1;
  return {std::min(first, size), std::min(first + count, size)};
}

void forget_lists(FuzzedBody& body) {
  body.cloud.normals.clear();
  body.cloud.sigma_mm.clear();
  body.cloud.view_directions.clear();
  body.cloud.origins.clear();
}

void keep_room(FuzzedBody& body) {
  body.cloud.positions.resize(std::min(body.cloud.size(), kMostPoints));
}

void shake(Bytes& bytes, FuzzedBody& body) {
  const auto [first, end] = some_of(bytes, body.cloud.size());
  const double reach = bytes.size();
  RandomNumbers random(bytes.byte());
  for (std::size_t i = first; i < end; ++i) {
    body.cloud.positions[i] += reach * Vector3d(random.normal(), random.normal(), random.normal());
  }
}

void copy_some(Bytes& bytes, FuzzedBody& body) {
  const auto [first, end] = some_of(bytes, body.cloud.size());
  const Vector3d shift(bytes.within(-100, 100), bytes.part() < 0.5 ? 0.0 : bytes.size(), 0.0);
  for (std::size_t i = first; i < end; ++i) {
    body.cloud.positions.push_back(body.cloud.positions[i] + shift);
  }
}

void crowd(Bytes& bytes, FuzzedBody& body) {
  const auto [first, end] = some_of(bytes, body.cloud.size());
  const double shrink = bytes.part() < 0.3 ? 0.0 : bytes.size();
  for (std::size_t i = first + 1; i < end; ++i) {
    auto& place = body.cloud.positions[i];
    place = body.cloud.positions[first] + shrink * (place - body.cloud.positions[first]);
  }
}

void take_away(Bytes& bytes, FuzzedBody& body) {
  const auto [first, end] = some_of(bytes, body.cloud.size());
  auto& places = body.cloud.positions;
  places.erase(places.begin() + static_cast<std::ptrdiff_t>(first),
               places.begin() + static_cast<std::ptrdiff_t>(end));
}

void flatten(Bytes& bytes, FuzzedBody& body) {
  const auto axis = static_cast<Eigen::Index>(bytes.byte() % 3);
  const double factor = bytes.part() < 0.5 ? 0.0 : bytes.size();
  for (auto& place : body.cloud.positions) place[axis] *= factor;
}

void snap(Bytes& bytes, FuzzedBody& body) {
  const double grid = bytes.size();
  for (auto& place : body.cloud.positions) {
    place = (place / grid).array().round().matrix() * grid;
  }
}

void scale(Bytes& bytes, FuzzedBody& body) {
  const double factor = std::pow(10.0, bytes.within(-9.0, 4.0));
  for (auto& place : body.cloud.positions) place *= factor;
}

void tell_lists(Bytes& bytes, FuzzedBody& body) {
  PointCloud& cloud = body.cloud;
  const unsigned which = bytes.byte();
  const double turn = bytes.part() < 0.5 ? 1.0 : -1.0;
  forget_lists(body);
  RandomNumbers random(bytes.byte());
  const double sigma = bytes.size();
  for (const auto& place : cloud.positions) {
    const bool lies = random.uniform() < 0.1 * (which >> 5);
    const Vector3d outward =
        lies ? Vector3d(random.normal(), random.normal(), random.normal()) : place;
    const double length = outward.norm();
    const Vector3d unit = length > 0.0 ? Vector3d(turn * outward / length) : Vector3d::UnitX();
    if ((which & 1U) != 0) cloud.normals.push_back(unit);
    if ((which & 2U) != 0) cloud.sigma_mm.push_back(lies ? random.uniform(1e-9, 100.0) : sigma);
    if ((which & 4U) != 0) cloud.view_directions.push_back(unit);
    if ((which & 8U) != 0) {
      cloud.origins.push_back(random.uniform() < 0.3 ? PointOrigin::kPlatform : PointOrigin::kSeen);
    }
  }
}

void add_any(Bytes& bytes, FuzzedBody& body) {
  const Vector3d any(bytes.any(), bytes.any(), bytes.any());
  body.cloud.positions.push_back(any);
}

void add_faces(Bytes& bytes, FuzzedBody& body) {
  auto& faces = body.mesh.triangles;
  const auto [first, end] = some_of(bytes, faces.size());
  const unsigned turn = bytes.byte() % 3;
  for (std::size_t i = first; i < end; ++i) {
    auto face = faces[i];
    if (turn == 1) std::swap(face[0], face[1]);
    if (turn == 2) face[0] = bytes.byte() * 3;
    faces.push_back(face);
  }
  faces.resize(std::min(faces.size(), 2 * kMostPoints));
}

/// One thing that is done to the body.
void change(Bytes& bytes, FuzzedBody& body) {
  const unsigned what = bytes.byte() % 12;
  // All but the last steps make the lists of what was told longer or shorter than the points.
  if (what < 9) forget_lists(body);
  switch (what) {
    case 0:
      return shake(bytes, body);
    case 1:
      return copy_some(bytes, body);
    case 2:
      return crowd(bytes, body);
    case 3:
      return take_away(bytes, body);
    case 4:
      return flatten(bytes, body);
    case 5:
      return snap(bytes, body);
    case 6:
      return scale(bytes, body);
    case 7:
      return add_any(bytes, body);
    case 8:
      return add_scatter(bytes, body);
    case 9:
      return add_faces(bytes, body);
    default:
      return tell_lists(bytes, body);
  }
}

}  // namespace

FuzzedBody body_from_bytes(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  FuzzedBody body{{}, {}, tl::make_unexpected(Error{})};
  add_base(bytes, body);
  body.plane = plane_of(bytes, body.cloud);
  body.mesh.positions = body.cloud.positions;
  for (int step = 0; step < kMostSteps && !bytes.empty(); ++step) {
    const std::size_t before = body.cloud.size();
    change(bytes, body);
    keep_room(body);
    if (body.cloud.size() == before) continue;
    forget_lists(body);
  }
  if (body.mesh.positions.size() <= body.cloud.size()) {
    body.mesh.positions = body.cloud.positions;
  }
  return body;
}

}  // namespace instep::test
